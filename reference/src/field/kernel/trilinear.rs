//! Trilinear interpolation, the papers' kernel ([REC-1]).

use crate::field::Field;
use crate::field::place::Place;
use crate::field::sampler::Interpolant;
use crate::number::{Real, Vec3};

/// Three nested interpolations, x then y then z: continuous, interpolates the voxels, exact for f = xyz.
#[derive(Clone, Copy, Debug)]
pub struct Trilinear;

/// Numbers at (y, z) = (0, 0), (1, 0), (0, 1), (1, 1) interpolated along y, then z.
#[inline(always)]
pub(in crate::field) fn bilinear<R: Real>(c: [R; 4], wy: R, wz: R) -> R {
    R::lerp(R::lerp(c[0], c[1], wy), R::lerp(c[2], c[3], wy), wz)
}

impl<R: Real> Interpolant<R> for Trilinear {
    #[inline(always)]
    fn value(&self, field: &Field<'_, R>, at: Place<R>) -> R {
        let [wx, wy, wz] = at.w;
        field.stencils.with_corners(at.cell, |rows| bilinear(rows.map(|r| R::lerp(r[0], r[1], wx)), wy, wz))
    }

    /// Constant along each axis inside a cell, with jumps between cells.
    #[inline]
    fn gradient(&self, field: &Field<'_, R>, at: Place<R>) -> Vec3<R> {
        let [wx, wy, wz] = at.w;
        let along_x = |a: [R; 2], b: [R; 2]| R::lerp(b[0] - a[0], b[1] - a[1], wx);
        field.stencils.with_corners(at.cell, |r| {
            Vec3::new(
                bilinear(r.map(|r| r[1] - r[0]), wy, wz),
                R::lerp(along_x(r[0], r[1]), along_x(r[2], r[3]), wz),
                R::lerp(along_x(r[0], r[2]), along_x(r[1], r[3]), wy),
            )
        })
    }
}
