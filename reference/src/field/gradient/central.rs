//! Central differences on the voxels, then trilinear interpolation: the papers' gradient ([REC-2]).
//!
//! At the border (−3f₀ + 4f₁ − f₂)/2 is the central difference of the line continued by 3f₀ − 3f₁ + f₂. Voxels are
//! subtracted before they are weighted. Differences of integers are exact, so a constant added to them changes no bit.

use crate::bilinear::bilinear;
use crate::field::Field;
use crate::field::place::CellPosition;
use crate::field::stencil::{self, Cross};
use crate::number::{Arithmetic, Real, Vec3};
use drypoint_scene::volume::Access;
use drypoint_scene::with_access;

/// The interpolated central differences at a place.
#[inline(always)]
pub(in crate::field) fn gradient<R: Real>(field: &Field<'_, R>, at: CellPosition<R>) -> Vec3<R> {
    let ([x, y, z], [wx, wy, wz]) = (at.cell, at.w);
    in_registers(field, x, y, z, wx, wy, wz)
}

/// Compiled once for each number type, not once for each caller. All arguments fit in registers.
#[inline(never)]
fn in_registers<R: Real>(field: &Field<'_, R>, x: usize, y: usize, z: usize, wx: R, wy: R, wz: R) -> Vec3<R> {
    let at = CellPosition { cell: [x, y, z], w: [wx, wy, wz] };
    match field.stencils.careful_cross(at.cell) {
        Some(cross) => interpolated(cross, at.w),
        // Compiled for each stored type, so that the 32 numbers do not pass through memory.
        None => with_access!(field.volume, |a| interpolated(stencil::cross(a, at.cell), at.w)),
    }
}

/// The differences at a voxel that has neighbours on all sides.
#[inline(always)]
pub(super) fn at_voxel<R: Real>(voxels: impl Access, [x, y, z]: [usize; 3]) -> Vec3<R> {
    let a = voxels.window::<3>(x - 1, y - 1, z - 1);
    let read = |x, y, z| R::from_voxel(a.at(x, y, z));
    let d = |down: [usize; 3], up: [usize; 3]| read(up[0], up[1], up[2]) - read(down[0], down[1], down[2]);
    Vec3::new(d([0, 1, 1], [2, 1, 1]), d([1, 0, 1], [1, 2, 1]), d([1, 1, 0], [1, 1, 2])) * R::HALF
}

/// Twice the differences, interpolated, and halved. With closures over arrays, this function takes twice as long.
#[inline(always)]
pub(in crate::field) fn interpolated<R: Arithmetic>(c: Cross<R>, [wx, wy, wz]: [R; 3]) -> Vec3<R> {
    let [a, b, e, f] = [middle(c.x[0]), middle(c.x[1]), middle(c.x[2]), middle(c.x[3])];
    let x = [along_x(c.x[0], wx), along_x(c.x[1], wx), along_x(c.x[2], wx), along_x(c.x[3], wx)];
    let y = [d(c.y[0], b, wx), d(a, c.y[1], wx), d(c.y[2], f, wx), d(e, c.y[3], wx)];
    let z = [d(c.z[0], e, wx), d(c.z[1], f, wx), d(a, c.z[2], wx), d(b, c.z[3], wx)];
    Vec3::new(bilinear(x, wy, wz).half(), bilinear(y, wy, wz).half(), bilinear(z, wy, wz).half())
}

/// The difference of two rows at the two corners, interpolated along x.
#[inline(always)]
fn d<R: Arithmetic>(down: [R; 2], up: [R; 2], wx: R) -> R {
    R::lerp(up[0] - down[0], up[1] - down[1], wx)
}

/// The central difference of one row along x, interpolated along x.
#[inline(always)]
fn along_x<R: Arithmetic>(r: [R; 4], wx: R) -> R {
    d([r[0], r[1]], [r[2], r[3]], wx)
}

#[inline(always)]
fn middle<R: Copy>(r: [R; 4]) -> [R; 2] {
    [r[1], r[2]]
}
