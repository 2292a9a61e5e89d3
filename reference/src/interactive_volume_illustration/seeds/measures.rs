//! The quantities of a seed's probability, measured at the voxels of blocks (3.2; [HATCH-5]).

use super::pyramid::{outwards, span};
use drypoint_scene::parallel;
use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

/// |∇| and the curvature at a voxel, both in [0, 1].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct VoxelMeasure {
    /// ‖∇f‖ in its range ([VAL-2]).
    pub gradient: f64,
    /// κ = min(1, |mean curvature| · smallest spacing), or curvedness for it; 0 where there is no direction.
    pub curvature: f64,
}

/// The largest values over the voxels of a block, as bytes rounded up.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LargestMeasure {
    /// The largest |∇|.
    pub gradient: u8,
    /// The largest curvature.
    pub curvature: u8,
}

/// Measures every voxel of some blocks once, and returns the number of these voxels.
pub(super) fn of_blocks(
    blocks: &[[usize; 3]],
    dims: [usize; 3],
    measure: impl Fn([usize; 3]) -> VoxelMeasure + Sync,
) -> (Vec<LargestMeasure>, u64) {
    let asked = VoxelSet::new(blocks, dims);
    let measure_at = |at: usize| {
        let VoxelMeasure { gradient, curvature } =
            measure([at % dims[0], at / dims[0] % dims[1], at / (dims[0] * dims[1])]);
        LargestMeasure { gradient: outwards(gradient), curvature: outwards(curvature) }
    };
    let measured = parallel::gather(asked.bits.len(), parallel::RUN, &|words, measured| {
        measured.extend(asked.voxels(words).map(measure_at));
    });
    let largest = |block: &[usize; 3]| {
        rows_of(*block, dims).flatten().map(|at| measured[asked.before(at)]).fold(LargestMeasure::default(), |a, b| {
            LargestMeasure { gradient: a.gradient.max(b.gradient), curvature: a.curvature.max(b.curvature) }
        })
    };
    (
        parallel::gather(blocks.len(), parallel::RUN, &|run, all| all.extend(blocks[run].iter().map(largest))),
        measured.len() as u64,
    )
}

/// Rows of a block's voxels, as ranges of linear indices.
fn rows_of(block: [usize; 3], dims: [usize; 3]) -> impl Iterator<Item = Range<usize>> {
    let [x, y, z] = [0, 1, 2].map(|a| span(block[a], dims[a]));
    let start = move |j: usize, k: usize| dims[0] * (j + dims[1] * k);
    z.flat_map(move |k| y.clone().map(move |j| start(j, k))).map(move |row| row + x.start..row + x.end)
}

/// A set of voxels of a grid, with ranks.
struct VoxelSet {
    /// One bit for each voxel.
    bits: Vec<u64>,
    /// Number of members before each word of bits.
    before: Vec<usize>,
}

impl VoxelSet {
    fn new(blocks: &[[usize; 3]], dims: [usize; 3]) -> Self {
        let words = dims.iter().product::<usize>().div_ceil(64);
        let bits: Vec<AtomicU64> = (0..words).map(|_| AtomicU64::new(0)).collect();
        parallel::each_of(blocks.chunks(parallel::RUN).collect(), &|_, blocks| {
            for at in blocks.iter().flat_map(|&block| rows_of(block, dims).flatten()) {
                let bit = 1 << (at % 64);
                if bits[at / 64].load(Ordering::Relaxed) & bit == 0 {
                    bits[at / 64].fetch_or(bit, Ordering::Relaxed);
                }
            }
        });
        let bits: Vec<u64> = bits.into_iter().map(AtomicU64::into_inner).collect();
        let mut sum = 0;
        let mut before = Vec::with_capacity(bits.len());
        for word in &bits {
            before.push(sum);
            sum += word.count_ones() as usize;
        }
        Self { bits, before }
    }

    /// Members in some words of bits, in ascending order.
    fn voxels(&self, words: Range<usize>) -> impl Iterator<Item = usize> {
        words.clone().zip(&self.bits[words]).flat_map(|(word, &bits)| {
            let next = |bits: &u64| Some(bits & (bits - 1)).filter(|rest| *rest != 0);
            let each = std::iter::successors(Some(bits).filter(|bits| *bits != 0), next);
            each.map(move |bits| 64 * word + bits.trailing_zeros() as usize)
        })
    }

    /// Number of members before a voxel.
    #[inline]
    fn before(&self, at: usize) -> usize {
        let lower = self.bits[at / 64] & ((1 << (at % 64)) - 1);
        self.before[at / 64] + lower.count_ones() as usize
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;
    use std::sync::Mutex;

    /// Each voxel of a block is measured once, whatever blocks share it. No other voxel is measured.
    #[test]
    fn voxels_of_blocks_are_measured_once() {
        for dims in [[130, 5, 4], [2, 2, 2], [1, 9, 70], [64, 3, 3]] {
            let blocks = dims.map(|n: usize| (n - 1).max(1).div_ceil(2));
            let all = (0..blocks.iter().product())
                .map(|i: usize| [i % blocks[0], i / blocks[0] % blocks[1], i / blocks[0] / blocks[1]]);
            let some: Vec<[usize; 3]> = all.filter(|b| (b[0] * 7 + b[1] * 5 + b[2] * 3) % 4 == 0).collect();
            let asked = Mutex::new(Vec::new());
            let value = |[x, y, z]: [usize; 3]| ((x * 31 + y * 17 + z * 7) % 256) as f64 / 255.0;
            let (largest, measured) = of_blocks(&some, dims, |at| {
                asked.lock().unwrap().push(at);
                VoxelMeasure { gradient: value(at), curvature: 1.0 - value(at) }
            });
            let voxels = |b: &[usize; 3]| {
                let [x, y, z] = [0, 1, 2].map(|a| 2 * b[a]..(2 * b[a] + 3).min(dims[a]));
                let each =
                    z.flat_map(|k| y.clone().flat_map(|j| x.clone().map(move |i| [i, j, k])).collect::<Vec<_>>());
                each.collect::<Vec<_>>()
            };
            let mut asked = asked.into_inner().unwrap();
            asked.sort_unstable();
            let want: BTreeSet<[usize; 3]> = some.iter().flat_map(voxels).collect();
            assert_eq!((asked.len() as u64, &asked), (measured, &want.into_iter().collect()), "{dims:?}");
            for (block, largest) in some.iter().zip(largest) {
                let of =
                    |f: &dyn Fn(f64) -> f64| voxels(block).into_iter().map(|v| outwards(f(value(v)))).max().unwrap();
                assert_eq!(largest, LargestMeasure { gradient: of(&|v| v), curvature: of(&|v| 1.0 - v) });
            }
        }
    }
}
