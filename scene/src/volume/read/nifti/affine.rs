//! The map from voxels to the world: sform, qform or spacings (nifti1.h, methods 3, 2 and 1).

use super::fields::Fields;
use glam::{DMat3, DVec3};

/// The position of a file's voxels in the world.
pub(super) struct VoxelAffine {
    /// D.
    pub(super) axes: DMat3,
    /// Voxel (0, 0, 0).
    pub(super) origin: DVec3,
    /// Whether the world is anatomical (RAS), which spacings alone do not say.
    pub(super) anatomical: bool,
    /// The fields that D comes from.
    pub(super) axes_field: &'static str,
    /// The fields that the origin comes from.
    pub(super) origin_field: &'static str,
}

/// Takes the best of the three ways that a header has to place its voxels.
pub(super) fn place(fields: &Fields) -> VoxelAffine {
    if fields.sform_code > 0 {
        let column = |i: usize| DVec3::new(fields.srow[0][i], fields.srow[1][i], fields.srow[2][i]);
        let axes = DMat3::from_cols(column(0), column(1), column(2));
        let field = "srow_x, srow_y, srow_z";
        return VoxelAffine { axes, origin: column(3), anatomical: true, axes_field: field, origin_field: field };
    }
    let spacing = spacing(fields);
    if fields.qform_code > 0 {
        let mirrored = if fields.pixdim[0] < 0.0 { -1.0 } else { 1.0 };
        let scale = DMat3::from_diagonal(DVec3::new(spacing.x, spacing.y, spacing.z * mirrored));
        return VoxelAffine {
            axes: rotation(fields.quatern) * scale,
            origin: DVec3::from_array(fields.qoffset),
            anatomical: true,
            axes_field: "quatern_b, quatern_c, quatern_d, pixdim",
            origin_field: "qoffset_x, qoffset_y, qoffset_z",
        };
    }
    let axes = DMat3::from_diagonal(spacing);
    VoxelAffine { axes, origin: DVec3::ZERO, anatomical: false, axes_field: "pixdim", origin_field: "pixdim" }
}

/// The spacings. Older files put a sign on some, which means nothing in NIfTI; axes that do not count have 1.
fn spacing(fields: &Fields) -> DVec3 {
    let axis = |i: usize| if (i as i64) <= fields.dim[0] { fields.pixdim[i].abs() } else { 1.0 };
    DVec3::new(axis(1), axis(2), axis(3))
}

/// The rotation of a unit quaternion a + bi + cj + dk whose a ≥ 0 is not stored. Where rounding has made b, c, d longer
/// than 1, they are scaled to it and a is 0.
fn rotation([b, c, d]: [f64; 3]) -> DMat3 {
    let rest = 1.0 - (b * b + c * c + d * d);
    // f32 components leave an error of this size: a is then rounding only (nifti1.h has the same bound).
    let (a, [b, c, d]) = if rest < 1e-7 {
        let scale = 1.0 / (b * b + c * c + d * d).sqrt();
        (0.0, [b * scale, c * scale, d * scale])
    } else {
        (rest.sqrt(), [b, c, d])
    };
    DMat3::from_cols(
        DVec3::new(a * a + b * b - c * c - d * d, 2.0 * (b * c + a * d), 2.0 * (b * d - a * c)),
        DVec3::new(2.0 * (b * c - a * d), a * a + c * c - b * b - d * d, 2.0 * (c * d + a * b)),
        DVec3::new(2.0 * (b * d + a * c), 2.0 * (c * d - a * b), a * a + d * d - b * b - c * c),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fields() -> Fields {
        Fields { dim: [3, 4, 5, 6, 0, 0, 0, 0], pixdim: [1.0, 2.0, 3.0, 4.0, 0.0, 0.0, 0.0, 0.0], ..Fields::default() }
    }

    #[test]
    fn a_third_of_a_turn_about_the_diagonal() {
        // (½, ½, ½, ½) takes x to y, y to z and z to x, exactly.
        let placed = place(&Fields { qform_code: 1, quatern: [0.5; 3], qoffset: [7.0, 8.0, 9.0], ..fields() });
        assert_eq!(placed.axes, DMat3::from_cols(DVec3::Y * 2.0, DVec3::Z * 3.0, DVec3::X * 4.0));
        assert_eq!(placed.origin, DVec3::new(7.0, 8.0, 9.0));
        assert!(placed.anatomical);
    }

    #[test]
    fn a_quarter_turn_about_z_with_the_third_axis_mirrored() {
        let quatern = [0.0, 0.0, f64::from(0.5f32.sqrt())];
        let mut fields = Fields { qform_code: 1, quatern, ..fields() };
        fields.pixdim[0] = -1.0;
        let want = DMat3::from_cols(DVec3::Y * 2.0, DVec3::X * -3.0, DVec3::Z * -4.0);
        // √½ in f32 is off by 2⁻²⁵, which a unit quaternion passes on.
        assert!(place(&fields).axes.abs_diff_eq(want, 1e-6));
    }

    #[test]
    fn half_a_turn_has_no_a() {
        // b a little too long, as rounding leaves it: 1 + 2⁻²³.
        let axes = rotation([f64::from(1.0 + f32::EPSILON), 0.0, 0.0]);
        assert_eq!(axes, DMat3::from_diagonal(DVec3::new(1.0, -1.0, -1.0)));
    }

    #[test]
    fn the_sform_wins_over_the_qform_and_both_over_spacings() {
        let srow = [[0.0, 0.0, -4.0, 1.0], [2.0, 0.5, 0.0, 2.0], [0.0, 3.0, 0.0, 3.0]];
        let both = Fields { sform_code: 2, srow, qform_code: 1, quatern: [0.5; 3], ..fields() };
        let placed = place(&both);
        let want = DMat3::from_cols(DVec3::Y * 2.0, DVec3::new(0.0, 0.5, 3.0), DVec3::Z * 0.0 + DVec3::X * -4.0);
        assert_eq!((placed.axes, placed.origin), (want, DVec3::new(1.0, 2.0, 3.0)));
        let none = place(&Fields { sform_code: 0, ..fields() });
        assert_eq!(none.axes, DMat3::from_diagonal(DVec3::new(2.0, 3.0, 4.0)));
        assert!(!none.anatomical && none.origin == DVec3::ZERO);
    }

    #[test]
    fn signs_of_spacings_and_axes_that_do_not_count() {
        let mut flat = fields();
        flat.dim[0] = 2;
        flat.pixdim[1] = -2.0;
        flat.pixdim[3] = 0.0;
        assert_eq!(place(&flat).axes, DMat3::from_diagonal(DVec3::new(2.0, 3.0, 1.0)));
    }
}
