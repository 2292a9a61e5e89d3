//! 3×3 matrices of the sample loop: the maps of derivatives from index to world space.

use super::{Arithmetic, Real, Sym3, Vec3};
use drypoint_scene::glam::DMat3;

/// A matrix by its rows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Mat3<R> {
    /// Three rows.
    pub rows: [Vec3<R>; 3],
}

impl<R: Arithmetic> Mat3<R> {
    /// M v.
    #[inline(always)]
    pub fn apply(&self, v: Vec3<R>) -> Vec3<R> {
        Vec3::new(self.rows[0].dot(v), self.rows[1].dot(v), self.rows[2].dot(v))
    }

    /// M S Mᵀ for a symmetric S.
    #[inline(always)]
    pub fn congruence(&self, s: Sym3<R>) -> Sym3<R> {
        let [a, b, c] = self.rows;
        let (sb, sc) = (s.apply(b), s.apply(c));
        Sym3 { xx: s.form(a, a), xy: a.dot(sb), xz: a.dot(sc), yy: b.dot(sb), yz: b.dot(sc), zz: c.dot(sc) }
    }
}

impl<R: Real> Mat3<R> {
    /// Converts a matrix of glam, rounding its numbers.
    pub fn from_glam(m: DMat3) -> Self {
        Self { rows: [0, 1, 2].map(|i| Vec3::from_glam(m.row(i))) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::DVec3;

    #[test]
    fn products_agree_with_glam() {
        let m = DMat3::from_cols(DVec3::new(1.0, 2.0, -3.0), DVec3::new(0.5, -4.0, 2.0), DVec3::new(3.0, 1.0, 8.0));
        let v = DVec3::new(2.0, -1.0, 0.25);
        assert_eq!(Mat3::<f64>::from_glam(m).apply(Vec3::from_glam(v)).to_glam(), m * v);
        let s = Sym3 { xx: 1.0, xy: 2.0, xz: 3.0, yy: 4.0, yz: 5.0, zz: 6.0 };
        let dense = DMat3::from_cols(DVec3::new(1.0, 2.0, 3.0), DVec3::new(2.0, 4.0, 5.0), DVec3::new(3.0, 5.0, 6.0));
        let want = m * dense * m.transpose();
        let got = Mat3::<f64>::from_glam(m).congruence(s);
        // Small whole numbers and halves: every product and sum is exact.
        assert_eq!([got.xx, got.xy, got.xz], want.x_axis.to_array());
        assert_eq!([got.yy, got.yz, got.zz], [want.y_axis.y, want.y_axis.z, want.z_axis.z]);
    }
}
