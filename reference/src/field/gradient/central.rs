//! Central differences on the voxels, then trilinear interpolation: the papers' gradient ([REC-2]).
//!
//! At the border (−3f₀ + 4f₁ − f₂)/2, which is the central difference of the line continued by 3f₀ − 3f₁ + f₂.
//! Voxels are subtracted before anything is weighted: of whole numbers the differences are exact, so a constant added to
//! them changes no bit.

use crate::field::Field;
use crate::field::kernel::trilinear::bilinear;
use crate::field::place::Place;
use crate::field::stencil::Cross;
use crate::number::{Real, Vec3};

/// The interpolated central differences at a place.
#[inline(never)]
pub(in crate::field) fn gradient<R: Real>(field: &Field<'_, R>, at: Place<R>) -> Vec3<R> {
    field.stencils.with_cross(at.cell, |voxels| interpolated(&voxels, at.w))
}

#[inline(always)]
fn interpolated<R: Real>(c: &Cross<R>, [wx, wy, wz]: [R; 3]) -> Vec3<R> {
    let inner = c.x.map(|r| [r[1], r[2]]);
    // Rows one voxel down and one voxel up at (y, z) = (0, 0), (1, 0), (0, 1), (1, 1).
    let along_y = [(c.y[0], inner[1]), (inner[0], c.y[1]), (c.y[2], inner[3]), (inner[2], c.y[3])];
    let along_z = [(c.z[0], inner[2]), (c.z[1], inner[3]), (inner[0], c.z[2]), (inner[1], c.z[3])];
    let between = |(down, up): ([R; 2], [R; 2])| R::lerp(up[0] - down[0], up[1] - down[1], wx);
    Vec3::new(
        R::HALF * bilinear(c.x.map(|r| R::lerp(r[2] - r[0], r[3] - r[1], wx)), wy, wz),
        R::HALF * bilinear(along_y.map(between), wy, wz),
        R::HALF * bilinear(along_z.map(between), wy, wz),
    )
}
