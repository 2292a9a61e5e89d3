//! The first place on a line where a field has a value.

use super::active::ActiveBricks;
use super::cubic::{BernsteinCubic, bracketed, mix};
use super::traversal::{CellBox, CellTraversal, IndexLine};
use crate::field::{CellPosition, Field, Sampler};
use crate::number::Real;
use drypoint_scene::glam::DVec3;
use drypoint_scene::math;
use drypoint_scene::volume::{Bricks, Mask};

/// Distance of evaluations along a line, in voxels, for kernels that are not cubic there.
pub(crate) const STEP: f64 = 0.25;

/// A finder of roots of f = iso along lines. It holds data about a field and a value, but not the field.
#[derive(Clone, Debug)]
pub(crate) struct RootFinder {
    iso: f64,
    /// The power of two by which differences from `iso` are multiplied; it brings them below 2.
    scale: f64,
    bounds: CellBox,
    active: Option<ActiveBricks>,
}

/// The result of a search in one cell.
enum CellSearch {
    /// The first root in the cell.
    Root(f64),
    /// The cell has no root. `above` tells whether the value is above `iso` where the line leaves the cell.
    None { above: bool },
}

impl RootFinder {
    /// A finder for a field and a value. If the ranges of the field's bricks are given, bricks that exclude the value
    /// are skipped.
    pub(crate) fn new<R: Real>(field: &Field<'_, R>, iso: f64, bricks: Option<&Bricks>) -> Self {
        let volume = field.volume();
        // Without the scale, differences of the largest numbers would overflow and squares of the smallest would
        // underflow.
        let exponent = math::exponent(volume.largest_magnitude().max(iso.abs())).clamp(-1000, 1000);
        Self {
            iso,
            scale: math::scale_by_power_of_two(1.0, -exponent),
            bounds: CellBox::new(volume.grid()),
            active: bricks.map(|bricks| ActiveBricks::new(bricks, iso)),
        }
    }

    /// The value of the surface.
    pub(crate) fn iso(&self) -> f64 {
        self.iso
    }

    /// The bricks that can contain the value. Returns none if their ranges are unknown.
    pub(super) fn bricks(&self) -> Option<Vec<[usize; 3]>> {
        self.active.as_ref().map(ActiveBricks::all)
    }

    /// Whether the field's box contains a place in index space.
    pub(super) fn holds(&self, index: DVec3) -> bool {
        self.bounds.holds(index)
    }

    /// Drops the ranges of bricks, for a field that they do not bound.
    pub(crate) fn look_everywhere(&mut self) {
        self.active = None;
    }

    /// Size in bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.active.as_ref().map_or(0, ActiveBricks::bytes)
    }

    /// The smallest t in a closed range at which the line has the value. Cells that touch a masked voxel contain no
    /// root ([PREC-2]).
    pub(crate) fn first<R: Real>(
        &self,
        field: &Field<'_, R>,
        mask: Option<&Mask>,
        line: IndexLine,
        range: [f64; 2],
    ) -> Option<f64> {
        let length = line[1].length();
        let mut walk = CellTraversal::new(&self.bounds, line, range)?;
        // The side on which the line left the previous cell. The values of two cells on their common face are equal
        // for trilinear values, and equal up to rounding for others. So a root there may be missing in both.
        let mut before = None;
        loop {
            let passed = if let Some(side) = self.active.as_ref().and_then(|active| active.empty(walk.cell())) {
                before = None;
                side
            } else if mask.is_some_and(|mask| mask.touches_cell(walk.cell())) {
                before = None;
                1
            } else {
                match self.in_cell(field, &walk, length, before) {
                    CellSearch::Root(t) => return Some(t),
                    CellSearch::None { above } => before = Some(above),
                }
                1
            };
            if !walk.pass(passed) {
                return None;
            }
        }
    }

    /// The cells on a line in a closed range, each with its part of the range.
    pub(crate) fn cells(&self, line: IndexLine, range: [f64; 2]) -> impl Iterator<Item = ([usize; 3], [f64; 2])> {
        let mut walk = CellTraversal::new(&self.bounds, line, range);
        std::iter::from_fn(move || {
            let met = walk.as_ref().map(|walk| (walk.cell(), walk.range()));
            walk = walk.take().and_then(|mut walk| walk.pass(1).then_some(walk));
            met
        })
    }

    fn in_cell<R: Real>(
        &self,
        field: &Field<'_, R>,
        walk: &CellTraversal,
        length: f64,
        before: Option<bool>,
    ) -> CellSearch {
        let [enters, leaves] = walk.range();
        match field.corners(walk.cell()) {
            Some(corners) => {
                // Trilinear: f along the line is a cubic. Corners on one side of `iso` exclude a root without
                // computing it.
                let over = |c: R| self.over(c);
                let corners = corners.map(|row| row.map(over));
                if let Some(above) = one_side(&corners)
                    && before.is_none_or(|b| b == above)
                {
                    return CellSearch::None { above };
                }
                let cubic = along(&corners, walk.entry(), walk.exit());
                // A change of sign between the previous cell and this one is a root on their common face.
                if before.is_some_and(|above| above != (cubic.0[0] > 0.0)) {
                    return CellSearch::Root(enters);
                }
                match cubic.first_root() {
                    Some(u) => CellSearch::Root(enters + u * (leaves - enters)),
                    None => CellSearch::None { above: cubic.0[3] > 0.0 },
                }
            }
            None => {
                let value =
                    |w: [f64; 3]| self.over(field.value_at(CellPosition { cell: walk.cell(), w: w.map(R::from_f64) }));
                // Other kernels: equidistant values, and a bracketed root at the first change of sign.
                let steps = (length * (leaves - enters) / STEP).ceil().max(1.0);
                let (mut from, mut at_from) = (enters, value(walk.entry()));
                if at_from == 0.0 || before.is_some_and(|above| above != (at_from > 0.0)) {
                    return CellSearch::Root(enters);
                }
                let mut step = 0.0;
                while step < steps {
                    step += 1.0;
                    let last = step >= steps;
                    let to = if last { leaves } else { enters + (leaves - enters) * (step / steps) };
                    let at_to = value(if last { walk.exit() } else { walk.at(to) });
                    if at_to == 0.0 {
                        return CellSearch::Root(to);
                    }
                    if (at_to > 0.0) != (at_from > 0.0) {
                        return CellSearch::Root(bracketed(|t| value(walk.at(t)), [from, at_from], [to, at_to]));
                    }
                    (from, at_from) = (to, at_to);
                }
                CellSearch::None { above: at_from > 0.0 }
            }
        }
    }

    /// f − iso, scaled.
    #[inline(always)]
    fn over<R: Real>(&self, value: R) -> f64 {
        value.to_f64() * self.scale - self.iso * self.scale
    }
}

/// The side of `iso` on which all corners of a cell lie, if they lie on one side.
#[inline(always)]
fn one_side(corners: &[[f64; 2]; 4]) -> Option<bool> {
    let all = |side: fn(f64) -> bool| corners.iter().flatten().all(|&c| side(c));
    if all(|c| c > 0.0) {
        Some(true)
    } else if all(|c| c < 0.0) {
        Some(false)
    } else {
        None
    }
}

/// The trilinear interpolation of a cell's corners along the line between two places in the cell.
///
/// The coefficients are values of the polar form. Each axis takes its coordinate from one of the two places.
/// Combinations with equally many coordinates from the second place are averaged over the axes. All values are
/// interpolations of the corners.
fn along(corners: &[[f64; 2]; 4], from: [f64; 3], to: [f64; 3]) -> BernsteinCubic {
    let at = |x: f64, y: f64, z: f64| {
        let [a, b, c, d] = corners.map(|row| mix(row[0], row[1], x));
        mix(mix(a, b, y), mix(c, d, y), z)
    };
    let ([x0, y0, z0], [x1, y1, z1]) = (from, to);
    let one = at(x1, y0, z0) + at(x0, y1, z0) + at(x0, y0, z1);
    let two = at(x0, y1, z1) + at(x1, y0, z1) + at(x1, y1, z0);
    BernsteinCubic([at(x0, y0, z0), one / 3.0, two / 3.0, at(x1, y1, z1)])
}
