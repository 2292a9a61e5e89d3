//! Trilinear interpolation, the papers' kernel ([REC-1]).

use crate::bilinear::bilinear;
use crate::field::Field;
use crate::field::kernel::Interpolant;
use crate::field::place::CellPosition;
use crate::field::stencil::{self, Corners};
use crate::number::{Arithmetic, Real, Vec3};
use drypoint_scene::with_access;

/// Three nested interpolations, x then y then z: continuous, interpolates the voxels, exact for f = xyz.
#[derive(Clone, Copy, Debug)]
pub struct Trilinear;

/// The interpolation itself, along x first.
#[inline(always)]
pub(crate) fn value<R: Arithmetic>(rows: [[R; 2]; 4], [wx, wy, wz]: [R; 3]) -> R {
    bilinear([along(rows[0], wx), along(rows[1], wx), along(rows[2], wx), along(rows[3], wx)], wy, wz)
}

#[inline(always)]
fn along<R: Arithmetic>(r: [R; 2], wx: R) -> R {
    R::lerp(r[0], r[1], wx)
}

/// The kernel's derivative: constant along each axis inside a cell, with jumps between cells.
#[inline(always)]
fn gradient<R: Real>(r: Corners<R>, [wx, wy, wz]: [R; 3]) -> Vec3<R> {
    let step = |a: [R; 2]| a[1] - a[0];
    let along_x = |a: [R; 2], b: [R; 2]| R::lerp(b[0] - a[0], b[1] - a[1], wx);
    Vec3::new(
        bilinear([step(r[0]), step(r[1]), step(r[2]), step(r[3])], wy, wz),
        R::lerp(along_x(r[0], r[1]), along_x(r[2], r[3]), wz),
        R::lerp(along_x(r[0], r[2]), along_x(r[1], r[3]), wy),
    )
}

impl<R: Real> Interpolant<R> for Trilinear {
    #[inline(always)]
    fn value(&self, field: &Field<'_, R>, at: CellPosition<R>) -> R {
        match field.stencils.careful_corners(at.cell) {
            Some(corners) => value(corners, at.w),
            None => with_access!(field.volume, |a| value(stencil::corners(a, at.cell), at.w)),
        }
    }

    #[inline]
    fn gradient(&self, field: &Field<'_, R>, at: CellPosition<R>) -> Vec3<R> {
        match field.stencils.careful_corners(at.cell) {
            Some(corners) => gradient(corners, at.w),
            None => with_access!(field.volume, |a| gradient(stencil::corners(a, at.cell), at.w)),
        }
    }
}

impl Trilinear {
    /// Number of values that are worth computing at once.
    pub(in crate::field) const AT_ONCE: usize = 8;

    /// The numbers at several places. The stored type is decided once for all of them, and the reads overlap. Deciding
    /// and waiting for each place in turn would take most of the time.
    #[inline(always)]
    pub(in crate::field) fn values<R: Real>(
        field: &Field<'_, R>,
        place: impl Fn(usize) -> CellPosition<R>,
        values: &mut [R],
    ) {
        let places = values.iter_mut().enumerate().map(|(i, value)| (place(i), value));
        if field.stencils.careful() {
            places.for_each(|(at, v)| *v = Self.value(field, at));
        } else {
            with_access!(field.volume, |a| places.for_each(|(at, v)| *v = value(stencil::corners(a, at.cell), at.w)));
        }
    }

    /// The numbers at the corners of a cell.
    #[inline(always)]
    pub(in crate::field) fn corners<R: Real>(field: &Field<'_, R>, cell: [usize; 3]) -> Corners<R> {
        match field.stencils.careful_corners(cell) {
            Some(corners) => corners,
            None => with_access!(field.volume, |a| stencil::corners(a, cell)),
        }
    }
}
