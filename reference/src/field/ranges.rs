//! Ranges of the values that a kernel can return in each brick of cells ([RAY-2]).

use super::columns::Columns;
use super::stencil::Stencils;
use crate::number::Real;
use drypoint_scene::volume::{BrickRow, Voxel};
use drypoint_scene::with_access;

/// The largest of Σ|w| over a cell of Catmull–Rom, (5/4)³ = 1.953125, rounded up.
const OVERSHOOT: f64 = 1.954;

/// Lowest and highest voxel of the cells of each brick.
pub(super) fn corners(stencils: &Stencils<'_>, row: &BrickRow) -> Vec<[f64; 2]> {
    // A cell ends at the voxel after its first one, if that voxel exists.
    voxels(stencils, row, 0, 1)
}

/// Lowest and highest number of the 4³ voxels around the cells of each brick, including voxels continued beyond the
/// border.
pub(super) fn supports<R: Real>(stencils: &Stencils<'_>, row: &BrickRow) -> Vec<[f64; 2]> {
    let dims = stencils.dims();
    let at_border = |a: usize, i: usize| i == 0 || i + 2 >= dims[a];
    let mut ranges = voxels(stencils, row, 1, 2);
    for ([lo, hi], [first, end]) in ranges.iter_mut().zip(row.cells()) {
        for z in first[2]..end[2] {
            for y in first[1]..end[1] {
                let row_at_border = at_border(1, y) || at_border(2, z);
                for x in (first[0]..end[0]).filter(|&x| row_at_border || at_border(0, x)) {
                    for c in stencils.block::<R>([x, y, z]).into_iter().flatten().flatten() {
                        (*lo, *hi) = (lo.min(c.to_f64()), hi.max(c.to_f64()));
                    }
                }
            }
        }
    }
    ranges
}

/// The range of Catmull–Rom values over samples in a range: its middle ± [`OVERSHOOT`] half-ranges.
pub(super) fn overshot([lo, hi]: [f64; 2]) -> [f64; 2] {
    let (middle, half) = (lo + (hi - lo) * 0.5, (hi - lo) * (0.5 * OVERSHOOT));
    [middle - half, middle + half]
}

/// A range widened by the possible rounding: 8 ε of its largest magnitude, between four and eight units in the last
/// place of that number. An interpolation a + w(b − a) with 0 ≤ w ≤ 1 leaves [a, b] by at most one and a half units,
/// and there are three interpolations. B-splines and Catmull–Rom exceed their range by less than the slack in their
/// bounds.
pub(super) fn widened<R: Real>([lo, hi]: [f64; 2]) -> [f64; 2] {
    let rounding = 8.0 * R::EPSILON.to_f64() * lo.abs().max(hi.abs());
    [lo - rounding, hi + rounding]
}

/// Lowest and highest voxel read by each brick's cells, as stencils read them: from `before` voxels before a cell to
/// `after` voxels after it.
fn voxels(stencils: &Stencils<'_>, row: &BrickRow, before: usize, after: usize) -> Vec<[f64; 2]> {
    let dims = stencils.dims();
    let reached =
        |[first, end]: [[usize; 3]; 2], a: usize| first[a].saturating_sub(before)..(end[a] + after).min(dims[a]);
    with_access!(stencils.volume(), |voxels| {
        let mut columns = Columns::new(dims[0]);
        if let Some(brick) = row.cells().next() {
            for z in reached(brick, 2) {
                for y in reached(brick, 1) {
                    columns.add(voxels, y, z);
                }
            }
        }
        let range = |brick| columns.range(reached(brick, 0)).map(|v| Voxel::to_f64(v) * stencils.scale());
        row.cells().map(range).collect()
    })
}
