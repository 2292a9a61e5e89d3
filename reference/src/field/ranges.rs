//! What values a kernel can return in each brick of cells ([RAY-2]).

use crate::number::Real;
use drypoint_scene::volume::{Access, Volume};
use drypoint_scene::with_access;

/// Lowest and highest stored number among the voxels of the cells from `first` up to, not including, `end`.
pub(super) fn voxels_of_cells(volume: &Volume, first: [usize; 3], end: [usize; 3]) -> [f64; 2] {
    let dims = volume.dims();
    let last: [usize; 3] = std::array::from_fn(|a| end[a].min(dims[a] - 1));
    with_access!(volume, |a| {
        let mut lo = drypoint_scene::volume::Voxel::to_f64(a.at(first[0], first[1], first[2]));
        let mut hi = lo;
        for z in first[2]..=last[2] {
            for y in first[1]..=last[1] {
                for x in first[0]..=last[0] {
                    let v = drypoint_scene::volume::Voxel::to_f64(a.at(x, y, z));
                    lo = lo.min(v);
                    hi = hi.max(v);
                }
            }
        }
        [lo, hi]
    })
}

/// Wider by what rounding can add.
pub(super) fn widened<R: Real>([lo, hi]: [f64; 2]) -> [f64; 2] {
    let rounding = 8.0 * R::EPSILON.to_f64() * lo.abs().max(hi.abs());
    [lo - rounding, hi + rounding]
}
