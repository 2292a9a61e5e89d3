//! What values a kernel can return in each brick of cells ([RAY-2]).

use super::stencil::Stencils;
use crate::number::Real;
use drypoint_scene::volume::{Access, Voxel};
use drypoint_scene::with_access;

/// The largest of Σ|w| over a cell of Catmull–Rom, (5/4)³ = 1.953125, rounded up.
const OVERSHOOT: f64 = 1.954;

/// Lowest and highest voxel of the cells from `first` up to, not including, `end`.
pub(super) fn corners(stencils: &Stencils<'_>, first: [usize; 3], end: [usize; 3]) -> [f64; 2] {
    // A cell ends at the voxel after its first one, where there is one.
    voxels(stencils, first, std::array::from_fn(|a| (end[a] + 1).min(stencils.dims()[a])))
}

/// Lowest and highest number that the 4³ voxels around the cells from `first` up to, not including, `end` have, those
/// beyond the border continued.
pub(super) fn supports<R: Real>(stencils: &Stencils<'_>, first: [usize; 3], end: [usize; 3]) -> [f64; 2] {
    let dims = stencils.dims();
    let from = first.map(|i| i.saturating_sub(1));
    let [mut lo, mut hi] = voxels(stencils, from, std::array::from_fn(|a| (end[a] + 2).min(dims[a])));
    let at_border = |a: usize, i: usize| i == 0 || i + 2 >= dims[a];
    for z in first[2]..end[2] {
        for y in first[1]..end[1] {
            let row_at_border = at_border(1, y) || at_border(2, z);
            for x in (first[0]..end[0]).filter(|&x| row_at_border || at_border(0, x)) {
                for c in stencils.block::<R>([x, y, z]).into_iter().flatten().flatten() {
                    (lo, hi) = (lo.min(c.to_f64()), hi.max(c.to_f64()));
                }
            }
        }
    }
    [lo, hi]
}

/// What Catmull–Rom can make of samples in a range: their middle ± [`OVERSHOOT`] half-ranges.
pub(super) fn overshot([lo, hi]: [f64; 2]) -> [f64; 2] {
    let (middle, half) = (lo + (hi - lo) * 0.5, (hi - lo) * (0.5 * OVERSHOOT));
    [middle - half, middle + half]
}

/// A range widened by what rounding can add: 8 ε of its largest magnitude, at least four and at most eight of that
/// number's last places. An interpolation a + w(b − a) with 0 ≤ w ≤ 1 leaves a, b by at most one and a half, and there
/// are three of them; B-splines and Catmull–Rom leave their range by less than their bounds leave room.
pub(super) fn widened<R: Real>([lo, hi]: [f64; 2]) -> [f64; 2] {
    let rounding = 8.0 * R::EPSILON.to_f64() * lo.abs().max(hi.abs());
    [lo - rounding, hi + rounding]
}

/// Lowest and highest voxel from `first` up to, not including, `end`, as stencils read them.
fn voxels(stencils: &Stencils<'_>, first: [usize; 3], end: [usize; 3]) -> [f64; 2] {
    let [lo, hi] = with_access!(stencils.volume(), |a| {
        let start = a.at(first[0], first[1], first[2]);
        let (mut lo, mut hi) = (start, start);
        for z in first[2]..end[2] {
            for y in first[1]..end[1] {
                for x in first[0]..end[0] {
                    let v = a.at(x, y, z);
                    lo = if v < lo { v } else { lo };
                    hi = if v > hi { v } else { hi };
                }
            }
        }
        [lo, hi].map(Voxel::to_f64)
    });
    [lo * stencils.scale(), hi * stencils.scale()]
}
