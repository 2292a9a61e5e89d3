//! The iso-surface of kernels that are not cubic along a ray, and the depths between which an f32 renderer meets it.
//!
//! Such a renderer evaluates the field at most a quarter of a voxel apart, beginning anew in each cell, and narrows the
//! first change of sign down. Rounding moves these places, so a bound may not depend on them. Intervals enclose all
//! values on a part of a ray: the fractions in a cell are given the half width of the part as their error, and the kernel
//! is evaluated on them. Three parts of the ray make a bound of the depth:
//!
//! | part | condition | consequence |
//! |---|---|---|
//! | from the beginning to t − e | all values surely on one side | no root is found there |
//! | from t + e on, a quarter of a voxel long | all values surely on the other side | a value there is evaluated, so a root before it is found |
//! | between them | none | the root that is found lies in it |

use super::surface::{MOST, Met, within_most};
use crate::field::{CellPosition, Field, Sampler};
use crate::number::{Bounded, Real};
use crate::ray::lattice::IndexRay;
use crate::surface::{RootFinder, STEP, SurfaceHit};
use drypoint_scene::glam::DVec3;

/// The smallest error of positions, in voxels, to which parts of a ray are halved.
const LEAST: f64 = 1e-9;

/// The first root on a ray from a depth on. Roots beyond `end` count as none.
#[inline]
pub(super) fn first(
    field: &Field<'_, Bounded>,
    roots: &RootFinder,
    ray: &IndexRay<Bounded>,
    [start, end]: [f64; 2],
) -> Met {
    let mask = field.volume().mask();
    let is_masked = |cell: [usize; 3]| mask.is_some_and(|mask| mask.touches_cell(cell));
    let root = roots.first(field, mask, ray.line(), [start, f64::INFINITY]).filter(|t| *t <= end);
    let values = ValuesOnRay::new(field, roots.iso(), ray);
    // Up to the root, or to the end of the ray.
    let last = root.unwrap_or(end);
    let (mut before, mut left) = (None, last);
    for (cell, [enters, leaves]) in roots.cells(ray.line(), [start, last]) {
        if is_masked(cell) {
            before = None;
            continue;
        }
        let above = *before.get_or_insert_with(|| values.over(cell, [enters; 2]).value() > 0.0);
        let reached = values.until(cell, [enters, leaves], above);
        if reached < leaves {
            left = reached;
            break;
        }
    }
    let Some(t) = root else {
        return if left < last { Met::Open(None) } else { Met::Nowhere };
    };
    // Behind the root, where any renderer evaluates a value.
    let Some(above) = before else { return Met::Open(Some(SurfaceHit { t, cut: None })) };
    let behind = t + (MOST + STEP) / values.along.length();
    let cells: Vec<_> = roots.cells(ray.line(), [t, behind]).collect();
    let mut right = cells.last().map_or(f64::INFINITY, |(_, [_, leaves])| *leaves);
    for &(cell, [enters, leaves]) in cells.iter().rev() {
        let from = if is_masked(cell) { leaves } else { values.since(cell, [enters, leaves], !above) };
        right = right.min(from);
        if from > enters {
            break;
        }
    }
    within_most(ray, t, (t - left).max(right - t))
}

/// The values of a field on a ray, less iso.
struct ValuesOnRay<'f, 'v> {
    field: &'f Field<'v, Bounded>,
    iso: Bounded,
    origin: DVec3,
    along: DVec3,
    /// The errors of positions along each axis; none along an axis of length 1, whose coordinate is ignored.
    errors: [Option<f64>; 3],
    /// The length of the parts that are not halved any more.
    least: f64,
}

impl<'f, 'v> ValuesOnRay<'f, 'v> {
    fn new(field: &'f Field<'v, Bounded>, iso: f64, ray: &IndexRay<Bounded>) -> Self {
        let ([origin, along], errors, dims) = (ray.line(), ray.errors(), field.volume().dims());
        let largest = errors.into_iter().fold(LEAST, f64::max);
        Self {
            field,
            iso: Bounded::from_f64(iso),
            origin,
            along,
            errors: [0, 1, 2].map(|axis| (dims[axis] > 1).then_some(errors[axis])),
            least: largest / along.length(),
        }
    }

    /// Encloses f − iso on a part of the ray in a cell.
    #[inline]
    fn over(&self, cell: [usize; 3], [from, to]: [f64; 2]) -> Bounded {
        let half = 0.5 * (to - from);
        let (p, reach) = (self.origin + self.along * (from + half), self.along.abs() * half);
        let fraction = |axis: usize| match self.errors[axis] {
            Some(error) => Bounded::new(p[axis] - cell[axis] as f64, reach[axis] + error),
            None => Bounded::ZERO,
        };
        self.field.value_at(CellPosition { cell, w: [0, 1, 2].map(fraction) }) - self.iso
    }

    /// Whether all values on a part of the ray in a cell lie on one side of iso, or none if that is not sure.
    #[inline]
    fn is_on_side(&self, cell: [usize; 3], part: [f64; 2], above: bool) -> Option<bool> {
        let [lo, hi] = self.over(cell, part).ends();
        match (lo > 0.0, hi < 0.0) {
            (true, _) => Some(above),
            (_, true) => Some(!above),
            _ => None,
        }
    }

    /// The depth in a part up to which all values surely lie on a side.
    #[inline]
    fn until(&self, cell: [usize; 3], [from, to]: [f64; 2], above: bool) -> f64 {
        match self.is_on_side(cell, [from, to], above) {
            Some(is_on_side) => return if is_on_side { to } else { from },
            None if to - from <= self.least => return from,
            None => {}
        }
        let middle = 0.5 * (from + to);
        let reached = self.until(cell, [from, middle], above);
        if reached < middle { reached } else { self.until(cell, [middle, to], above) }
    }

    /// The depth in a part from which on all values surely lie on a side.
    #[inline]
    fn since(&self, cell: [usize; 3], [from, to]: [f64; 2], above: bool) -> f64 {
        match self.is_on_side(cell, [from, to], above) {
            Some(is_on_side) => return if is_on_side { from } else { to },
            None if to - from <= self.least => return to,
            None => {}
        }
        let middle = 0.5 * (from + to);
        let reached = self.since(cell, [middle, to], above);
        if reached > middle { reached } else { self.since(cell, [from, middle], above) }
    }
}
