//! The pyramid over the volume that finds the cells of an iso-surface (3.2; [HATCH-5]).
//!
//! The pyramid is a pointerless octree. An entry of its lowest level, the paper's second, is a *block* of 2 × 2 × 2
//! cells. A block has 3 × 3 × 3 voxels. Neighbours share voxels; otherwise no block would hold the cells between
//! them.

use crate::field::Columns;
use drypoint_scene::parallel;
use drypoint_scene::volume::{Volume, Voxel};
use drypoint_scene::with_access;
use std::ops::Range;

/// Ranges of values, level by level, and the largest curvatures if they are known everywhere.
#[derive(Clone, Debug)]
pub struct Pyramid {
    /// The least and the largest value of each entry as bytes, rounded outwards. The first level holds blocks, each
    /// further level 2 × 2 × 2 entries of the one below, up to a single entry.
    ranges: Vec<PyramidLevel<[u8; 2]>>,
    /// The largest κ of each entry as a byte, rounded up. There are as many levels as in `ranges`, or none.
    curvatures: Vec<PyramidLevel<u8>>,
    cells: [usize; 3],
    /// The values of byte 0 and of byte 255.
    range: [f64; 2],
}

/// One level of the pyramid, x fastest.
#[derive(Clone, Debug)]
struct PyramidLevel<T> {
    dims: [usize; 3],
    entries: Vec<T>,
}

/// Number of the grid's cells along each axis. An axis of one voxel has one cell without thickness.
pub(super) fn cells_of(dims: [usize; 3]) -> [usize; 3] {
    dims.map(|n| (n - 1).max(1))
}

/// Voxels of a block along an axis.
pub(super) fn span(block: usize, voxels: usize) -> Range<usize> {
    2 * block..(2 * block + 3).min(voxels)
}

impl<T: Copy + Send> PyramidLevel<T> {
    /// Builds a level of blocks from rows: `row` gets a row's y and z and returns its blocks.
    fn of_rows(dims: [usize; 3], row: &(dyn Fn([usize; 2]) -> Vec<T> + Sync)) -> Self {
        let blocks = cells_of(dims).map(|n| n.div_ceil(2));
        let entries = parallel::gather(blocks[1] * blocks[2], 1, &|rows, entries| {
            rows.for_each(|i| entries.extend(row([i % blocks[1], i / blocks[1]])));
        });
        Self { dims: blocks, entries }
    }

    fn at(&self, [x, y, z]: [usize; 3]) -> T {
        self.entries[x + self.dims[0] * (y + self.dims[1] * z)]
    }

    /// Returns this level and all above it. `join` combines children to an entry.
    fn levels(self, join: impl Fn(T, T) -> T) -> Vec<Self> {
        let mut levels = vec![self];
        while let Some(last) = levels.last().filter(|level| level.dims != [1; 3]) {
            let dims = last.dims.map(|n| n.div_ceil(2));
            let entry = |entry| children(entry, last.dims).map(|child| last.at(child)).reduce(&join);
            let entries = positions(dims).filter_map(entry).collect();
            levels.push(Self { dims, entries });
        }
        levels
    }
}

/// Positions in a grid, x fastest.
fn positions([nx, ny, nz]: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    (0..nz).flat_map(move |z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])))
}

/// Up to eight children of an entry on the finer level, x fastest.
fn children(entry: [usize; 3], finer: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
    let part = move |axis: usize| 2 * entry[axis]..(2 * entry[axis] + 2).min(finer[axis]);
    part(2).flat_map(move |z| part(1).flat_map(move |y| part(0).map(move |x| [x, y, z])))
}

impl Pyramid {
    /// Builds the pyramid of a volume. Voxels that blocks share are read more than once.
    pub fn new(volume: &Volume) -> Self {
        let dims = volume.dims();
        let range = volume.range();
        let bytes = |stored: [f64; 2]| {
            let [a, b] = stored.map(|v| volume.slope() * v + volume.intercept());
            [byte(range, a.min(b)).floor() as u8, byte(range, a.max(b)).ceil() as u8]
        };
        let row = |[y, z]: [usize; 2]| {
            with_access!(volume, |voxels| {
                let mut columns = Columns::new(dims[0]);
                for k in span(z, dims[2]) {
                    for j in span(y, dims[1]) {
                        columns.add(voxels, j, k);
                    }
                }
                let of_block = |x| bytes(columns.range(span(x, dims[0])).map(Voxel::to_f64));
                (0..cells_of(dims)[0].div_ceil(2)).map(of_block).collect()
            })
        };
        let ranges = PyramidLevel::of_rows(dims, &row).levels(|a, b| [a[0].min(b[0]), a[1].max(b[1])]);
        Self { ranges, curvatures: Vec::new(), cells: cells_of(dims), range }
    }

    /// Adds the largest curvature of each entry, from κ in [0, 1] of all voxels ([HATCH-5]).
    pub(super) fn with_curvature(self, dims: [usize; 3], curvature: impl Fn([usize; 3]) -> f64 + Sync) -> Self {
        let row = |[y, z]: [usize; 2]| {
            let rows = || span(z, dims[2]).flat_map(|k| span(y, dims[1]).map(move |j| [j, k]));
            let column = |x: usize| rows().map(|[j, k]| curvature([x, j, k])).fold(0.0, f64::max);
            let columns: Vec<f64> = (0..dims[0]).map(column).collect();
            let of_block = |x| outwards(columns[span(x, dims[0])].iter().copied().fold(0.0, f64::max));
            (0..cells_of(dims)[0].div_ceil(2)).map(of_block).collect()
        };
        Self { curvatures: PyramidLevel::of_rows(dims, &row).levels(u8::max), ..self }
    }

    /// Number of the grid's cells along each axis.
    pub fn cells(&self) -> [usize; 3] {
        self.cells
    }

    /// Size of all levels in bytes.
    pub fn bytes(&self) -> u64 {
        let curvatures: usize = self.curvatures.iter().map(|level| level.entries.len()).sum();
        self.entries() * size_of::<[u8; 2]>() as u64 + curvatures as u64
    }

    /// Number of entries of all levels.
    pub fn entries(&self) -> u64 {
        self.ranges.iter().map(|level| level.entries.len() as u64).sum()
    }

    /// Returns the blocks that may contain a value, depth first: every block whose closed range contains it (4.1;
    /// [HATCH-6]). If curvatures are known and C₀ is given, blocks without κ above C₀ are left out.
    pub fn blocks(&self, value: f64, min_curvature: Option<f64>) -> Vec<[usize; 3]> {
        let b = byte(self.range, value);
        self.found(|[lo, hi]| lo <= b.ceil() && b.floor() <= hi, min_curvature)
    }

    /// Like [`blocks`](Self::blocks), for blocks whose closed range may contain a value that counts ([HATCH-16]).
    /// `counts` gets ranges that are widened by one step of a byte to either side.
    pub fn blocks_among(&self, counts: impl Fn([f64; 2]) -> bool, min_curvature: Option<f64>) -> Vec<[usize; 3]> {
        let [lo, hi] = self.range;
        let value = |byte: f64| {
            let t = (byte / 255.0).clamp(0.0, 1.0);
            lo * (1.0 - t) + hi * t
        };
        self.found(|[lo, hi]| counts([value(lo - 1.0), value(hi + 1.0)]), min_curvature)
    }

    fn found(&self, counts: impl Fn([f64; 2]) -> bool, min_curvature: Option<f64>) -> Vec<[usize; 3]> {
        let mut found = Vec::new();
        let goes_on = |level: usize, entry: [usize; 3]| {
            let is_above = |min: f64| self.curvatures.get(level).is_none_or(|of| is_above(of.at(entry), min));
            counts(self.ranges[level].at(entry).map(f64::from)) && min_curvature.is_none_or(is_above)
        };
        self.descend(self.ranges.len() - 1, [0; 3], &goes_on, &mut found);
        found
    }

    fn descend(
        &self,
        level: usize,
        entry: [usize; 3],
        goes_on: &impl Fn(usize, [usize; 3]) -> bool,
        found: &mut Vec<[usize; 3]>,
    ) {
        if !goes_on(level, entry) {
            return;
        }
        match level.checked_sub(1) {
            None => found.push(entry),
            Some(below) => {
                for child in children(entry, self.ranges[below].dims) {
                    self.descend(below, child, goes_on, found);
                }
            }
        }
    }

    /// Cells of a block, x fastest.
    pub fn cells_of_block(&self, block: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
        children(block, self.cells)
    }
}

/// Converts a measure in [0, 1] to a byte, rounded up.
pub(super) fn outwards(measure: f64) -> u8 {
    (measure * 255.0).ceil() as u8
}

/// Whether a measure stored as a byte may be above a bound.
pub(super) fn is_above(byte: u8, bound: f64) -> bool {
    f64::from(byte) / 255.0 > bound
}

/// Maps a value onto the scale of bytes, not yet rounded. The map is monotonic. In a constant volume its value maps
/// to 0.
fn byte([lo, hi]: [f64; 2], value: f64) -> f64 {
    // Halves, because the difference of the largest numbers overflows.
    let (width, above) = (0.5 * hi - 0.5 * lo, 0.5 * value - 0.5 * lo);
    if width > 0.0 {
        above / width * 255.0
    } else if above == 0.0 {
        0.0
    } else {
        f64::INFINITY.copysign(above)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::philox::uniform;
    use drypoint_scene::space::Grid;
    use drypoint_scene::volume::Voxels;

    fn volume(dims: [usize; 3], value: impl Fn([usize; 3]) -> f64) -> Volume {
        let voxels = positions(dims).map(value).collect();
        Volume::new(Grid::with_spacing(dims, [1.0; 3]).unwrap(), Voxels::F64(voxels), 1.0, 0.0).unwrap()
    }

    fn noise(dims: [usize; 3]) -> Volume {
        volume(dims, |at| uniform(3, at.map(|i| i as u32), 0) * 100.0 - 20.0)
    }

    fn voxels(block: [usize; 3], dims: [usize; 3]) -> impl Iterator<Item = [usize; 3]> {
        let span = move |axis: usize| 2 * block[axis]..(2 * block[axis] + 3).min(dims[axis]);
        span(2).flat_map(move |z| span(1).flat_map(move |y| span(0).map(move |x| [x, y, z])))
    }

    /// All blocks whose voxels' closed range contains the value.
    fn exhaustive(volume: &Volume, value: f64) -> Vec<[usize; 3]> {
        let dims = volume.dims();
        let block_has = |block: &[usize; 3]| {
            let values: Vec<f64> = voxels(*block, dims).map(|at| volume.value(at)).collect();
            values.iter().any(|v| *v <= value) && values.iter().any(|v| *v >= value)
        };
        positions(cells_of(dims).map(|n| n.div_ceil(2))).filter(block_has).collect()
    }

    /// No block is missing, whatever the sides. Surplus blocks are no more than a byte's rounding lets in.
    #[test]
    fn blocks_are_those_of_a_search_through_all() {
        for dims in [[2, 2, 2], [3, 4, 5], [9, 2, 17], [1, 6, 6], [1, 1, 1], [12, 13, 8]] {
            let volume = noise(dims);
            let pyramid = Pyramid::new(&volume);
            let [lo, hi] = volume.range();
            for k in 0..=40 {
                let value = lo + (hi - lo) * f64::from(k) / 40.0;
                let mut found = pyramid.blocks(value, None);
                found.sort_by_key(|&[x, y, z]| [z, y, x]);
                assert!(found.windows(2).all(|w| w[0] != w[1]));
                assert!(exhaustive(&volume, value).iter().all(|block| found.contains(block)), "{dims:?} {value}");
            }
            assert_eq!(pyramid.blocks(lo - 1.0, None), [[0; 3]; 0]);
            assert_eq!(pyramid.blocks(hi + 1.0, None), [[0; 3]; 0]);
        }
    }

    /// Byte volumes need no rounding: the blocks are exactly those of the search.
    #[test]
    fn of_bytes_no_block_is_too_much() {
        let volume = volume([11, 9, 10], |at| (uniform(5, at.map(|i| i as u32), 0) * 256.0).floor().max(0.0));
        let [lo, hi] = volume.range();
        assert_eq!([lo, hi], [0.0, 255.0]);
        let pyramid = Pyramid::new(&volume);
        for value in [0.0, 1.0, 17.0, 17.5, 128.0, 254.0, 255.0] {
            let mut found = pyramid.blocks(value, None);
            found.sort_by_key(|&[x, y, z]| [z, y, x]);
            let want = exhaustive(&volume, value);
            if value.fract() == 0.0 {
                assert_eq!(found, want, "{value}");
            } else {
                assert!(want.iter().all(|block| found.contains(block)));
            }
        }
    }

    /// An entry's curvature is the largest of all voxels below it. The blocks equal those of a search through all,
    /// and the descent stops above regions that are not curved enough.
    #[test]
    fn blocks_that_are_curved_enough() {
        for dims in [[9, 8, 20], [2, 2, 2], [1, 6, 6], [33, 17, 5]] {
            let volume = noise(dims);
            let curvature = |at: [usize; 3]| uniform(9, at.map(|i| i as u32 / 3), 0).powi(20);
            let pyramid = Pyramid::new(&volume).with_curvature(dims, curvature);
            assert_eq!(pyramid.bytes(), 3 * pyramid.entries());
            let value = 30.0;
            for min in [0.0, 0.02, 0.3, 0.9] {
                let found = pyramid.blocks(value, Some(min));
                let largest = |block: &[usize; 3]| voxels(*block, dims).map(curvature).fold(0.0, f64::max);
                let want = |block: &[usize; 3]| (largest(block) * 255.0).ceil() / 255.0 > min;
                let all: Vec<_> = pyramid.blocks(value, None).into_iter().filter(want).collect();
                assert_eq!(found, all, "{dims:?} {min}");
            }
            let flat = Pyramid::new(&volume).with_curvature(dims, |_| 0.01);
            let entries = std::cell::Cell::new(0);
            let counts = |_| entries.replace(entries.get() + 1) >= 0;
            assert_eq!((flat.blocks_among(counts, Some(0.02)), entries.get()), (Vec::new(), 1));
        }
    }

    #[test]
    fn a_constant_has_its_value_everywhere_and_no_other() {
        let pyramid = Pyramid::new(&volume([5, 5, 5], |_| 7.0));
        assert_eq!(pyramid.blocks(7.0, None).len(), 8);
        assert_eq!(pyramid.blocks(7.0f64.next_up(), None), [[0; 3]; 0]);
        assert_eq!(pyramid.blocks(-7.0, None), [[0; 3]; 0]);
    }

    /// 17³ voxels are 16³ cells, 8³ blocks: 512 + 64 + 8 + 1 entries of two bytes.
    #[test]
    fn levels_by_hand() {
        let pyramid = Pyramid::new(&noise([17; 3]));
        assert_eq!((pyramid.entries(), pyramid.bytes(), pyramid.cells()), (585, 1170, [16; 3]));
        assert_eq!(pyramid.cells_of_block([7, 0, 3]).count(), 8);
        let odd = Pyramid::new(&noise([4, 2, 1]));
        assert_eq!(odd.cells_of_block([1, 0, 0]).collect::<Vec<_>>(), [[2, 0, 0]]);
    }

    /// Depth first: the blocks of an eighth of the volume follow each other.
    #[test]
    fn the_way_is_depth_first() {
        let blocks = Pyramid::new(&volume([17; 3], |_| 1.0)).blocks(1.0, None);
        assert_eq!(
            blocks[..8],
            [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1], [1, 1, 1]]
        );
        assert!(blocks[..64].iter().all(|block| block.iter().all(|&i| i < 4)));
    }
}
