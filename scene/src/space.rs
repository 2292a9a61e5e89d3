//! Index, world and eye space ([SPACE-1] … [SPACE-5]).

use glam::{DMat3, DVec3};

/// The position of a volume's voxels: dims, and the affine map `world = D · index + origin`.
#[derive(Clone, Debug, PartialEq)]
pub struct Grid {
    dims: [usize; 3],
    axes: DMat3,
    inverse: DMat3,
    origin: DVec3,
    smallest_singular: f64,
}

/// A fault that makes a grid impossible.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SpaceError {
    /// An axis has no voxel.
    #[error("axis {axis} has no voxels")]
    EmptyAxis {
        /// 0, 1 or 2.
        axis: usize,
    },
    /// The number of voxels does not fit in memory's address range.
    #[error("dims {dims:?} overflow")]
    Overflow {
        /// The dims as given.
        dims: [usize; 3],
    },
    /// D is singular or not finite: its columns do not span space ([SPACE-2]).
    #[error("the axis directions are singular or not finite: {axes:?}")]
    Singular {
        /// The columns of D.
        axes: [[f64; 3]; 3],
    },
}

impl Grid {
    /// A grid of `dims` voxels (x fastest) whose columns of D are `axes` (direction times spacing) and whose voxel
    /// (0, 0, 0) lies at `origin`, in world units.
    ///
    /// # Errors
    /// An empty axis, an overflowing product of dims, or a D that is singular or not finite.
    pub fn new(dims: [usize; 3], axes: DMat3, origin: DVec3) -> Result<Self, SpaceError> {
        if let Some(axis) = dims.iter().position(|&n| n == 0) {
            return Err(SpaceError::EmptyAxis { axis });
        }
        dims.iter().try_fold(1usize, |n, &d| n.checked_mul(d)).ok_or(SpaceError::Overflow { dims })?;
        let singular = SpaceError::Singular { axes: axes.to_cols_array_2d() };
        let values = singular_values(axes);
        if !axes.is_finite() || !origin.is_finite() || values[2] <= values[0] * 1e-12 {
            return Err(singular);
        }
        let inverse = axes.inverse();
        if !inverse.is_finite() {
            return Err(singular);
        }
        Ok(Self { dims, axes, inverse, origin, smallest_singular: values[2] })
    }

    /// An axis-aligned grid with the given spacings and voxel (0, 0, 0) at the world's origin.
    ///
    /// # Errors
    /// See [`Grid::new`].
    pub fn with_spacing(dims: [usize; 3], spacing: [f64; 3]) -> Result<Self, SpaceError> {
        Self::new(dims, DMat3::from_diagonal(DVec3::from_array(spacing)), DVec3::ZERO)
    }

    /// Voxels along x, y, z.
    #[inline]
    pub fn dims(&self) -> [usize; 3] {
        self.dims
    }

    /// Number of voxels.
    pub fn len(&self) -> usize {
        self.dims[0] * self.dims[1] * self.dims[2]
    }

    /// Never true: a grid has at least one voxel.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// D: columns are axis directions times spacing.
    #[inline]
    pub fn axes(&self) -> DMat3 {
        self.axes
    }

    /// D⁻¹.
    #[inline]
    pub fn inverse_axes(&self) -> DMat3 {
        self.inverse
    }

    /// World position of voxel (0, 0, 0).
    #[inline]
    pub fn origin(&self) -> DVec3 {
        self.origin
    }

    /// `world = D · index + origin` ([SPACE-2]).
    #[inline]
    pub fn to_world(&self, index: DVec3) -> DVec3 {
        self.axes * index + self.origin
    }

    /// `index = D⁻¹ (world − origin)`.
    #[inline]
    pub fn to_index(&self, world: DVec3) -> DVec3 {
        self.inverse * (world - self.origin)
    }

    /// The grid in a world whose axes are reversed where `signs` has −1, exact to the last bit.
    pub(crate) fn flipped(&self, signs: DVec3) -> Self {
        let flip = DMat3::from_diagonal(signs);
        Self { axes: flip * self.axes, inverse: self.inverse * flip, origin: signs * self.origin, ..self.clone() }
    }

    /// Whether two grids have the same voxels at the same places, up to a thousandth of a voxel, as headers round them.
    pub fn coincides(&self, other: &Self) -> bool {
        const ROUNDED: f64 = 1e-3;
        let close = |(a, b): (DVec3, DVec3)| (a - b).length() <= ROUNDED * self.smallest_singular;
        let mut corners = self.world_corners().into_iter().zip(other.world_corners());
        self.dims == other.dims && corners.all(close)
    }

    /// Norms of the columns of D, in world units.
    pub fn spacing(&self) -> [f64; 3] {
        [self.axes.x_axis.length(), self.axes.y_axis.length(), self.axes.z_axis.length()]
    }

    /// One voxel: the smallest spacing. Axes of length 1 count only if there is no other ([SPACE-5]).
    #[inline]
    pub fn voxel(&self) -> f64 {
        let spacing = self.spacing();
        let longer = |axis: &usize| self.dims[*axis] > 1;
        let smallest = (0..3).filter(longer).map(|a| spacing[a]).fold(f64::INFINITY, f64::min);
        if smallest.is_finite() { smallest } else { spacing.into_iter().fold(f64::INFINITY, f64::min) }
    }

    /// The smallest singular value of D, the voxel of [PREC-3] and [SPACE-4].
    pub fn smallest_singular_value(&self) -> f64 {
        self.smallest_singular
    }

    /// Lowest and highest corner, in index space, of the closed box on which the field is defined: [0, N − 1] on
    /// each axis, [−½, ½] on an axis of length 1 ([SPACE-1]).
    #[inline]
    pub fn index_box(&self) -> [DVec3; 2] {
        let end = |n: usize| if n == 1 { [-0.5, 0.5] } else { [0.0, (n - 1) as f64] };
        let [x, y, z] = self.dims.map(end);
        [DVec3::new(x[0], y[0], z[0]), DVec3::new(x[1], y[1], z[1])]
    }

    /// Lowest and highest corner, in index space, of the box about voxels from `lo` to `hi`. An axis of length 1 reaches
    /// half a voxel each way ([VS-2]).
    pub fn voxel_box(&self, [lo, hi]: [[usize; 3]; 2]) -> [DVec3; 2] {
        let at = |axis: usize, i: usize, end: f64| if self.dims[axis] == 1 { end } else { i as f64 };
        let corner =
            |voxel: [usize; 3], end: DVec3| std::array::from_fn(|axis| at(axis, voxel[axis], end[axis])).into();
        let [first, last] = self.index_box();
        [corner(lo, first), corner(hi, last)]
    }

    /// The eight corners of the field's box in world space, x fastest.
    pub fn world_corners(&self) -> [DVec3; 8] {
        self.corners_of(self.index_box())
    }

    /// The eight corners in world space of a box in index space, given by its lowest and highest corner, x fastest.
    pub fn corners_of(&self, ends: [DVec3; 2]) -> [DVec3; 8] {
        std::array::from_fn(|i| self.to_world(DVec3::new(ends[i & 1].x, ends[(i >> 1) & 1].y, ends[(i >> 2) & 1].z)))
    }

    /// World position of the centre of the field's box.
    pub fn centre(&self) -> DVec3 {
        let [lo, hi] = self.index_box();
        self.to_world((lo + hi) * 0.5)
    }

    /// Half the largest diagonal of the field's box, in world units: the r of [RAY-5].
    pub fn radius(&self) -> f64 {
        let corner = self.world_corners();
        (0..4).map(|i| (corner[i] - corner[7 - i]).length()).fold(0.0, f64::max) * 0.5
    }
}

/// The singular values of a 3×3 matrix, largest first, by one-sided Jacobi rotations (Hestenes 1958), which keeps the
/// small ones accurate where the eigenvalues of MᵀM lose half their digits.
pub fn singular_values(m: DMat3) -> [f64; 3] {
    let largest = m.to_cols_array().into_iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    if largest == 0.0 || !largest.is_finite() {
        return [largest; 3];
    }
    let mut column = [m.x_axis / largest, m.y_axis / largest, m.z_axis / largest];
    // Convergence is quadratic: a 3×3 matrix is done after six sweeps at the most.
    for _ in 0..12 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            let (a, b, c) = (column[p].length_squared(), column[q].length_squared(), column[p].dot(column[q]));
            if c == 0.0 {
                continue;
            }
            let zeta = (b - a) / (2.0 * c);
            let t = zeta.signum() / (zeta.abs() + (1.0 + zeta * zeta).sqrt());
            let cos = 1.0 / (1.0 + t * t).sqrt();
            let sin = cos * t;
            (column[p], column[q]) = (column[p] * cos - column[q] * sin, column[p] * sin + column[q] * cos);
        }
    }
    let mut values = column.map(|c| c.length() * largest);
    values.sort_by(|a, b| b.total_cmp(a));
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn singular_values_of_a_shear_and_of_extreme_spacing() {
        let [a, b, c] = singular_values(DMat3::from_diagonal(DVec3::new(1.0, 1000.0, 1e-9)));
        assert_eq!([a, b], [1000.0, 1.0]);
        assert!((c - 1e-9).abs() < 1e-24);
        // [[1, 1], [0, 1]] has singular values φ and 1/φ, φ the golden ratio.
        let shear = DMat3::from_cols(DVec3::X, DVec3::new(1.0, 1.0, 0.0), DVec3::Z);
        let phi = (1.0 + 5f64.sqrt()) / 2.0;
        let values = singular_values(shear);
        assert!((values[0] - phi).abs() < 1e-15 && (values[2] - 1.0 / phi).abs() < 1e-15);
    }

    #[test]
    fn a_box_of_voxels_ends_at_their_centres_and_half_a_voxel_from_a_flat_axis() {
        let grid = Grid::with_spacing([5, 1, 3], [1.0; 3]).unwrap();
        let found = grid.voxel_box([[1, 0, 0], [3, 0, 2]]);
        assert_eq!(found, [DVec3::new(1.0, -0.5, 0.0), DVec3::new(3.0, 0.5, 2.0)]);
        assert_eq!(grid.voxel_box([[0; 3], [4, 0, 2]]), grid.index_box());
    }

    #[test]
    fn index_and_world_are_inverse() {
        let axes = DMat3::from_cols(DVec3::new(1.0, 0.1, 0.0), DVec3::new(-0.2, 2.0, 0.3), DVec3::new(0.0, 0.5, 4.0));
        let grid = Grid::new([5, 6, 7], axes, DVec3::new(10.0, -20.0, 30.0)).unwrap();
        let p = DVec3::new(1.25, 3.5, 5.75);
        assert!((grid.to_index(grid.to_world(p)) - p).length() < 1e-14);
        assert_eq!(grid.to_world(DVec3::ZERO), grid.origin());
    }

    #[test]
    fn an_axis_of_length_one_has_a_box_of_one_voxel_and_does_not_set_the_voxel() {
        let grid = Grid::with_spacing([4, 1, 3], [2.0, 0.1, 5.0]).unwrap();
        assert_eq!(grid.index_box(), [DVec3::new(0.0, -0.5, 0.0), DVec3::new(3.0, 0.5, 2.0)]);
        assert_eq!(grid.voxel(), 2.0);
        assert_eq!(Grid::with_spacing([1, 1, 1], [2.0, 0.1, 5.0]).unwrap().voxel(), 0.1);
    }

    #[test]
    fn singular_axes_are_refused() {
        let flat = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::X + DVec3::Y);
        assert!(matches!(Grid::new([2; 3], flat, DVec3::ZERO), Err(SpaceError::Singular { .. })));
        let nan = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::splat(f64::NAN));
        assert!(matches!(Grid::new([2; 3], nan, DVec3::ZERO), Err(SpaceError::Singular { .. })));
        assert!(matches!(Grid::with_spacing([2, 0, 2], [1.0; 3]), Err(SpaceError::EmptyAxis { axis: 1 })));
    }

    #[test]
    fn centre_and_radius_of_the_box() {
        let grid = Grid::with_spacing([3, 5, 9], [1.0, 1.0, 0.5]).unwrap();
        assert_eq!(grid.centre(), DVec3::new(1.0, 2.0, 2.0));
        assert_eq!(grid.radius(), 3.0);
    }
}
