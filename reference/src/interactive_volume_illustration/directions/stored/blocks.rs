//! Storage for the directions of voxels. A direction is computed on demand, by the first thread that asks for it.

use crate::field::curvature::Curvature;
use crate::number::Vec3;
use drypoint_scene::glam::DVec3;
use drypoint_scene::parallel;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU64, Ordering};

/// Number of voxels along the side of a block.
const SIDE: usize = 8;
const VOXELS: usize = SIDE * SIDE * SIDE;

/// Number of blocks along the side of a group that is computed at once for the whole grid. It is large enough that
/// neighbouring groups share little work.
const AT_ONCE: usize = 6;

/// Numbers of a line: its direction and its curvature.
const NUMBERS: usize = 4;

/// The corners of a cell, as steps from its first voxel.
pub(super) const CORNERS: [[usize; 3]; 8] =
    [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1], [1, 1, 1]];

/// The stored first number of an unknown line. Bits are stored inverted, so that zeroed memory is no valid number.
const UNKNOWN: u64 = 0;

/// The stored first number of a voxel without a direction: the inverted bits of NaN.
const NONE: u64 = !0x7ff8_0000_0000_0000;

/// One of a voxel's lines. Two lines fill a cache line. All threads that write to it write the same numbers, the
/// first number last.
#[derive(Debug, Default)]
#[repr(align(32))]
struct LineSlot([AtomicU64; NUMBERS]);

impl LineSlot {
    fn set(&self, made: Option<(Vec3<f64>, f64)>) {
        let first = made.map_or(NONE, |(e, k)| {
            for (to, number) in self.0[1..].iter().zip([e.y, e.z, k]) {
                to.store(number.to_bits(), Ordering::Relaxed);
            }
            !e.x.to_bits()
        });
        self.0[0].store(first, Ordering::Release);
    }

    /// The stored bits of the first number.
    #[inline]
    fn first(&self) -> u64 {
        self.0[0].load(Ordering::Acquire)
    }

    /// The line whose first number has these stored bits.
    #[inline]
    fn line(&self, first: u64) -> Option<Vec3<f64>> {
        (first != NONE).then(|| Vec3::new(f64::from_bits(!first), self.number(1), self.number(2)))
    }

    #[inline]
    fn number(&self, i: usize) -> f64 {
        f64::from_bits(self.0[i].load(Ordering::Relaxed))
    }
}

/// Both lines of a voxel.
#[derive(Clone, Copy)]
struct VoxelSlots<'a>([&'a LineSlot; 2]);

impl VoxelSlots<'_> {
    fn set(self, made: Option<Curvature<f64>>) {
        self.0[0].set(made.map(|c| (c.e1, c.k1)));
        self.0[1].set(made.map(|c| (c.e2, c.k2)));
    }

    /// Computes one of the lines.
    #[cold]
    #[inline(never)]
    fn make(self, which: usize, make: impl FnOnce() -> Option<Curvature<f64>>) -> Option<Vec3<f64>> {
        self.set(make());
        self.0[which].line(self.0[which].first())
    }

    /// Returns one of the lines and computes it if needed. `first` holds the stored bits of its first number.
    #[inline]
    fn line(self, which: usize, first: u64, make: impl FnOnce() -> Option<Curvature<f64>>) -> Option<Vec3<f64>> {
        if first == UNKNOWN { self.make(which, make) } else { self.0[which].line(first) }
    }
}

/// The voxels of a grid in blocks. A block is allocated at the first query of one of its voxels.
#[derive(Debug)]
pub(super) struct DirectionBlocks {
    /// Number of voxels along each axis.
    voxels: [usize; 3],
    /// Number of blocks along each axis.
    dims: [usize; 3],
    /// Blocks with their slots. A block without slots has no direction anywhere.
    blocks: Vec<OnceLock<Box<[LineSlot]>>>,
}

/// Voxels of a box, x fastest: from `first` up to, but excluding, `end`.
#[derive(Clone, Copy, Debug)]
pub(in super::super) struct VoxelBox {
    pub(in super::super) first: [usize; 3],
    pub(in super::super) end: [usize; 3],
}

impl VoxelBox {
    /// Number of voxels along each axis.
    pub(in super::super) fn sides(&self) -> [usize; 3] {
        [0, 1, 2].map(|a| self.end[a] - self.first[a])
    }

    /// All voxels of the box.
    pub(in super::super) fn each(&self) -> impl Iterator<Item = [usize; 3]> + use<> {
        let Self { first, end } = *self;
        let row = move |z, y| (first[0]..end[0]).map(move |x| [x, y, z]);
        (first[2]..end[2]).flat_map(move |z| (first[1]..end[1]).flat_map(move |y| row(z, y)))
    }
}

/// Slots of a block: all first lines, then all second ones.
fn slots() -> Box<[LineSlot]> {
    (0..2 * VOXELS).map(|_| LineSlot::default()).collect()
}

impl DirectionBlocks {
    pub(super) fn new(voxels: [usize; 3]) -> Self {
        let dims = voxels.map(|n| n.div_ceil(SIDE));
        Self { voxels, dims, blocks: (0..dims.iter().product()).map(|_| OnceLock::new()).collect() }
    }

    #[inline]
    fn pair(&self, [x, y, z]: [usize; 3]) -> Option<VoxelSlots<'_>> {
        let [nx, ny, _] = self.dims;
        let block = self.blocks[(z / SIDE * ny + y / SIDE) * nx + x / SIDE].get_or_init(slots);
        let at = (z % SIDE * SIDE + y % SIDE) * SIDE + x % SIDE;
        Some(VoxelSlots([block.get(at)?, block.get(VOXELS + at)?]))
    }

    /// Both curvatures and directions of a voxel.
    pub(super) fn get(&self, voxel: [usize; 3], make: impl Fn() -> Option<Curvature<f64>>) -> Option<Curvature<f64>> {
        let pair = self.pair(voxel)?;
        let [first, second] = pair.0;
        let e1 = pair.line(0, first.first(), &make)?;
        // Another thread may have written only the first line so far.
        let e2 = pair.line(1, second.first(), &make)?;
        Some(Curvature { k1: first.number(3), k2: second.number(3), e1, e2 })
    }

    /// Stores both lines of a voxel.
    pub(super) fn set(&self, voxel: [usize; 3], made: Option<Curvature<f64>>) {
        if let Some(pair) = self.pair(voxel) {
            pair.set(made);
        }
    }

    /// Reads the first or second lines of the corners of a cell whose bits are set. Returns a bit for each corner
    /// that has a line. All corners are requested from memory before any is used.
    #[inline]
    pub(super) fn lines(
        &self,
        cell: [usize; 3],
        corners: u8,
        which: usize,
        make: impl Fn([usize; 3]) -> Option<Curvature<f64>>,
        lines: &mut [DVec3; 8],
    ) -> u8 {
        let [x, y, z] = cell;
        let voxel = |i: usize| [x + (i & 1), y + (i >> 1 & 1), z + (i >> 2)];
        let is_asked = |i: usize| corners >> i & 1 == 1;
        let mut has = 0;
        let mut pairs = [const { None }; 8];
        for i in (0..8).filter(|i| is_asked(*i)) {
            pairs[i] = self.pair(voxel(i)).map(|pair| (pair, pair.0[which].first()));
        }
        for i in (0..8).filter(|i| is_asked(*i)) {
            let line = pairs[i].and_then(|(pair, first)| pair.line(which, first, || make(voxel(i))));
            if let Some(line) = line {
                lines[i] = line.to_glam();
                has |= 1 << i;
            }
        }
        has
    }

    /// Computes every voxel, some blocks at once. `start` gets a box and returns the function that computes its
    /// voxels.
    pub(super) fn fill<M: FnMut([usize; 3]) -> Option<Curvature<f64>>>(&self, start: impl Fn(VoxelBox) -> M + Sync) {
        let groups = self.dims.map(|n| n.div_ceil(AT_ONCE));
        parallel::each(groups.iter().product(), &|i| {
            let group = [i % groups[0], i / groups[0] % groups[1], i / (groups[0] * groups[1])];
            let first = group.map(|g| g * AT_ONCE * SIDE);
            let end = [0, 1, 2].map(|a| (first[a] + AT_ONCE * SIDE).min(self.voxels[a]));
            let mut make = start(VoxelBox { first, end });
            let mut made = Vec::with_capacity(VOXELS);
            let blocks = VoxelBox { first: first.map(|i| i / SIDE), end: end.map(|i| i.div_ceil(SIDE)) };
            for block in blocks.each() {
                let first = block.map(|i| i * SIDE);
                let voxels = VoxelBox { first, end: [0, 1, 2].map(|a| (first[a] + SIDE).min(self.voxels[a])) };
                made.clear();
                made.extend(voxels.each().map(&mut make));
                self.keep(block, voxels, &made);
            }
        });
    }

    /// Stores the voxels of a block, in their order.
    fn keep(&self, block: [usize; 3], voxels: VoxelBox, made: &[Option<Curvature<f64>>]) {
        let [nx, ny, _] = self.dims;
        let place = &self.blocks[(block[2] * ny + block[1]) * nx + block[0]];
        let is_empty = made.iter().all(Option::is_none);
        let slots = place.get_or_init(|| if is_empty { Box::default() } else { slots() });
        for (voxel, made) in voxels.each().zip(made).filter(|_| !slots.is_empty()) {
            if let Some(pair) = self.pair(voxel) {
                pair.set(*made);
            }
        }
    }

    /// Number of voxels with a direction.
    pub(super) fn made(&self) -> u64 {
        let has = |slot: &&LineSlot| ![UNKNOWN, NONE].contains(&slot.first());
        self.kept().map(|block| block.iter().take(VOXELS).filter(has).count() as u64).sum()
    }

    /// Size of the allocated blocks in bytes.
    pub(super) fn bytes(&self) -> u64 {
        self.kept().map(|block| size_of_val(block) as u64).sum()
    }

    fn kept(&self) -> impl Iterator<Item = &[LineSlot]> {
        self.blocks.iter().filter_map(OnceLock::get).map(|block| &**block)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    fn of(voxel: [usize; 3]) -> Option<Curvature<f64>> {
        let [x, y, z] = voxel.map(|i| i as f64);
        let c = Curvature { k1: x, k2: -y, e1: Vec3::new(z, 0.0, -0.0), e2: Vec3::new(-x, y, z) };
        (voxel[0] % 3 != 1 && voxel[2] < 12).then_some(c)
    }

    #[test]
    fn each_voxel_is_made_once_and_is_its_own() {
        let dims = [17, 9, 26];
        let all = VoxelBox { first: [0; 3], end: dims };
        let lazy = DirectionBlocks::new(dims);
        let asked = Cell::new(0);
        let make = |voxel| {
            asked.set(asked.get() + 1);
            of(voxel)
        };
        assert_eq!((lazy.bytes(), lazy.made()), (0, 0));
        for _ in 0..2 {
            for voxel in all.each().step_by(5) {
                assert_eq!(lazy.get(voxel, || make(voxel)), of(voxel));
                let want = of(voxel).map(|c| [c.e1, c.e2].map(Vec3::to_glam));
                for which in 0..2 {
                    let mut lines = [DVec3::ZERO; 8];
                    let has = lazy.lines(voxel, 1, which, |_| None, &mut lines);
                    assert_eq!((has, lines[0]), want.map_or((0, DVec3::ZERO), |w| (1, w[which])));
                }
            }
        }
        assert_eq!(asked.get(), all.each().step_by(5).count());
        assert_eq!(lazy.made(), all.each().step_by(5).filter_map(of).count() as u64);
        let whole = DirectionBlocks::new(dims);
        whole.fill(|_| of);
        assert_eq!(whole.made(), all.each().filter_map(of).count() as u64);
        // 3 × 2 × 4 blocks, of which those at x = 16 and from z = 16 on are empty.
        assert_eq!(whole.bytes(), 2 * 2 * 2 * 512 * 64);
        assert!(all.each().all(|voxel| whole.get(voxel, || panic!("{voxel:?} is not there")) == of(voxel)));
    }
}
