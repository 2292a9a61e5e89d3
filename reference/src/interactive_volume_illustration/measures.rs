//! What a seed's probability is made from, at the voxels of blocks (3.2; [HATCH-5]).

use super::pyramid::outwards;
use rayon::prelude::*;

/// |∇| and the curvature at a voxel, both in [0, 1].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Measure {
    /// ‖∇f‖ in its range ([VAL-2]).
    pub gradient: f64,
    /// κ = min(1, |mean curvature| · smallest spacing), or curvedness for it; 0 where there is no direction.
    pub curvature: f64,
}

/// The largest of each over the voxels of a block, as bytes that are rounded outwards.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Largest {
    /// Of |∇|.
    pub gradient: u8,
    /// Of the curvature.
    pub curvature: u8,
}

/// Measures every voxel of some blocks once, and how many there are.
pub(super) fn of_blocks(
    blocks: &[[usize; 3]],
    dims: [usize; 3],
    measure: impl Fn([usize; 3]) -> Measure + Sync,
) -> (Vec<Largest>, u64) {
    let linear = |[x, y, z]: [usize; 3]| x + dims[0] * (y + dims[1] * z);
    let voxels_of = |block: &[usize; 3]| {
        let block = *block;
        let span = move |axis: usize| 2 * block[axis]..(2 * block[axis] + 3).min(dims[axis]);
        span(2).flat_map(move |z| span(1).flat_map(move |y| span(0).map(move |x| [x, y, z])))
    };
    let mut voxels: Vec<usize> = blocks.par_iter().flat_map_iter(|block| voxels_of(block).map(linear)).collect();
    voxels.par_sort_unstable();
    voxels.dedup();
    let measured: Vec<Largest> = voxels
        .par_iter()
        .map(|&at| {
            let Measure { gradient, curvature } =
                measure([at % dims[0], at / dims[0] % dims[1], at / (dims[0] * dims[1])]);
            Largest { gradient: outwards(gradient), curvature: outwards(curvature) }
        })
        .collect();
    let of_voxel =
        |at: [usize; 3]| voxels.binary_search(&linear(at)).map_or_else(|_| Largest::default(), |i| measured[i]);
    let largest = |block: &[usize; 3]| {
        voxels_of(block).map(of_voxel).fold(Largest::default(), |a, b| Largest {
            gradient: a.gradient.max(b.gradient),
            curvature: a.curvature.max(b.curvature),
        })
    };
    (blocks.par_iter().map(largest).collect(), voxels.len() as u64)
}
