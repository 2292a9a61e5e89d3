//! The index table of a bricked volume, and its queries.

use super::brick::{self, Brick, SIDE, VOXELS};
use super::pool::Pool;
use crate::memory::{self, NoRoom};
use crate::parallel;
use crate::volume::Voxel;
use std::collections::HashSet;
use std::sync::Arc;

/// The brick of each place, x fastest.
pub type BrickTable<V> = Vec<Arc<Brick<V>>>;

/// A volume in bricks.
#[derive(Clone, Debug)]
pub struct BrickedVolume<V> {
    dims: [usize; 3],
    /// Bricks along x, y, z.
    bricks: [usize; 3],
    table: BrickTable<V>,
    pool: Pool<V>,
}

/// Bytes that a modification may add without asking for memory.
const GRANTED: u64 = 16 << 20;

/// Bricks along each axis of a volume.
pub(super) fn bricks_along(dims: [usize; 3]) -> [usize; 3] {
    dims.map(|n| n.div_ceil(SIDE))
}

impl<V: Voxel> BrickedVolume<V> {
    /// A volume of one value: one brick.
    ///
    /// # Panics
    /// If an axis has no voxel.
    pub fn constant(dims: [usize; 3], value: V) -> Self {
        assert!(dims.iter().all(|&n| n > 0));
        let (bricks, mut pool) = (bricks_along(dims), Pool::new());
        let brick = pool.shared(Brick::new(vec![value; VOXELS].into(), [SIDE; 3]));
        Self { dims, bricks, table: vec![brick; bricks.iter().product()], pool }
    }

    /// A volume of the values that a function has at voxels.
    ///
    /// # Errors
    /// Memory that the budget does not allow.
    pub fn from_fn(dims: [usize; 3], value: impl Fn([usize; 3]) -> V + Sync) -> Result<Self, NoRoom> {
        assert!(dims.iter().all(|&n| n > 0));
        let bricks = bricks_along(dims);
        let mut volume = Self { dims, bricks, table: Vec::with_capacity(bricks.iter().product()), pool: Pool::new() };
        let layer = bricks[0] * bricks[1];
        // A layer of bricks at a time, so that bricks which are equal never are in memory all at once.
        for z in 0..bricks[2] {
            memory::room_for(layer as u64, Self::BRICK_BYTES)?;
            let made = parallel::map(layer, &|i| {
                let brick = [i % bricks[0], i / bricks[0], z];
                let extent = volume.extent(brick);
                Brick::new(gathered(brick, extent, &value), extent)
            });
            volume.table.extend(made.into_iter().map(|brick| volume.pool.shared(brick)));
        }
        Ok(volume)
    }

    /// Bytes of a brick's voxels.
    const BRICK_BYTES: u64 = (VOXELS * size_of::<V>()) as u64;

    /// Voxels of a brick that lie in the volume, along x, y, z.
    fn extent(&self, brick: [usize; 3]) -> [usize; 3] {
        extent(self.dims, brick)
    }

    /// Voxels along x, y, z.
    pub fn dims(&self) -> [usize; 3] {
        self.dims
    }

    /// Bricks along x, y, z.
    pub fn bricks(&self) -> [usize; 3] {
        self.bricks
    }

    /// The brick of each place, x fastest.
    pub fn table(&self) -> &BrickTable<V> {
        &self.table
    }

    /// Takes the bricks of an earlier or later state of this volume.
    ///
    /// # Panics
    /// If it is a table of another number of bricks.
    pub fn restore(&mut self, table: BrickTable<V>) {
        assert_eq!(table.len(), self.table.len());
        self.table = table;
    }

    /// Bricks that differ from each other.
    pub fn distinct_bricks(&self) -> usize {
        self.table.iter().map(Arc::as_ptr).collect::<HashSet<_>>().len()
    }

    /// Bytes of the distinct bricks and of the table.
    pub fn bytes(&self) -> usize {
        bytes(self.distinct_bricks(), self.table.len(), size_of::<V>())
    }

    /// The index of a voxel's brick in the table, and of the voxel in the brick.
    #[inline(always)]
    fn place(&self, [x, y, z]: [usize; 3]) -> (usize, usize) {
        let brick = (z / SIDE * self.bricks[1] + y / SIDE) * self.bricks[0] + x / SIDE;
        (brick, (z % SIDE * SIDE + y % SIDE) * SIDE + x % SIDE)
    }

    /// The value at a voxel.
    ///
    /// # Panics
    /// If it lies outside the bricks.
    #[inline(always)]
    pub fn value(&self, voxel: [usize; 3]) -> V {
        let (brick, voxel) = self.place(voxel);
        self.table[brick].voxels()[voxel]
    }

    /// The values at the corners of the cell that begins at a voxel: pairs along x at (y, z) = (0, 0), (1, 0), (0, 1),
    /// (1, 1). On an axis of length 1 both ends are the one voxel.
    ///
    /// # Panics
    /// If the cell lies outside the volume.
    #[inline(always)]
    pub fn corners(&self, cell: [usize; 3]) -> [[V; 2]; 4] {
        let [x, y, z] = cell;
        if cell.iter().all(|i| i % SIDE != SIDE - 1) {
            let (brick, first) = self.place(cell);
            let end = first + SIDE * SIDE + SIDE + 2;
            let voxels = &self.table[brick].voxels()[first..end];
            let pair = |i: usize| [voxels[i], voxels[i + 1]];
            return [pair(0), pair(SIDE), pair(SIDE * SIDE), pair(SIDE * SIDE + SIDE)];
        }
        let pair = |y, z| [self.value([x, y, z]), self.value([x + 1, y, z])];
        [pair(y, z), pair(y + 1, z), pair(y, z + 1), pair(y + 1, z + 1)]
    }

    /// The lowest and the highest value.
    pub fn range(&self) -> [V; 2] {
        let ranges = self.table.iter().map(|brick| brick.range());
        ranges
            .fold(self.table[0].range(), |[lo, hi], [a, b]| [if a < lo { a } else { lo }, if b > hi { b } else { hi }])
    }

    /// The first and the last voxel of the smallest box around the values that are not 0; none if all are 0.
    pub fn occupied(&self) -> Option<[[usize; 3]; 2]> {
        let boxes = self.table.iter().enumerate().filter_map(|(i, brick)| {
            let [nx, ny, _] = self.bricks;
            let at = [i % nx, i / nx % ny, i / (nx * ny)];
            let [lo, hi] = brick.occupied()?;
            // A voxel that the border repeats is as the last one inside, which bounds the box then.
            let inside = |voxel: [usize; 3]| -> [usize; 3] {
                std::array::from_fn(|a| (at[a] * SIDE + voxel[a]).min(self.dims[a] - 1))
            };
            Some([inside(lo), inside(hi)])
        });
        boxes.reduce(|[lo, hi], [a, b]| {
            [std::array::from_fn(|i| lo[i].min(a[i])), std::array::from_fn(|i| hi[i].max(b[i]))]
        })
    }

    /// Modifies the voxels from `first` up to, but excluding, `end`: `change` gets a voxel and its value. Returns how many
    /// bricks have other values than before; only these are replaced.
    ///
    /// # Errors
    /// Memory that the budget does not allow. Nothing is modified then.
    ///
    /// # Panics
    /// If a voxel lies outside the volume.
    pub fn modify(
        &mut self,
        first: [usize; 3],
        end: [usize; 3],
        mut change: impl FnMut([usize; 3], V) -> V,
    ) -> Result<usize, NoRoom> {
        assert!((0..3).all(|a| end[a] <= self.dims[a]));
        if (0..3).any(|a| first[a] >= end[a]) {
            return Ok(0);
        }
        let [lo, hi] = [first.map(|i| i / SIDE), end.map(|i| i.div_ceil(SIDE))];
        let places =
            (lo[2]..hi[2]).flat_map(|z| (lo[1]..hi[1]).flat_map(move |y| (lo[0]..hi[0]).map(move |x| [x, y, z])));
        let most = (0..3).map(|a| (hi[a] - lo[a]) as u64).product::<u64>() * Self::BRICK_BYTES;
        if most > GRANTED {
            memory::room(most)?;
        }
        let mut changed = 0;
        for at in places {
            let i = (at[2] * self.bricks[1] + at[1]) * self.bricks[0] + at[0];
            let start = at.map(|i| i * SIDE);
            let extent = self.extent(at);
            let span = |a: usize| first[a].max(start[a])..end[a].min(start[a] + extent[a]);
            let mut voxels: Option<Box<[V]>> = None;
            for (z, y) in span(2).flat_map(|z| span(1).map(move |y| (z, y))) {
                for x in span(0) {
                    let (_, inside) = self.place([x, y, z]);
                    // Each voxel is visited once, so that its value is still the one before.
                    let before = self.table[i].voxels()[inside];
                    let after = change([x, y, z], before);
                    if !brick::is_same(before, after) {
                        voxels.get_or_insert_with(|| self.table[i].voxels().into())[inside] = after;
                    }
                }
            }
            if let Some(voxels) = voxels {
                self.table[i] = self.pool.shared(Brick::new(voxels, extent));
                changed += 1;
            }
        }
        Ok(changed)
    }
}

/// Voxels of a brick that lie in a volume, along x, y, z.
pub(super) fn extent(dims: [usize; 3], brick: [usize; 3]) -> [usize; 3] {
    std::array::from_fn(|a| (dims[a] - brick[a] * SIDE).min(SIDE))
}

/// The voxels of a brick. Voxels beyond the border have the value of the brick's first voxel.
pub(super) fn gathered<V: Voxel>(brick: [usize; 3], extent: [usize; 3], value: impl Fn([usize; 3]) -> V) -> Box<[V]> {
    let start = brick.map(|i| i * SIDE);
    let mut voxels = vec![value(start); VOXELS];
    for (z, y) in (0..extent[2]).flat_map(|z| (0..extent[1]).map(move |y| (z, y))) {
        let line = &mut voxels[(z * SIDE + y) * SIDE..][..extent[0]];
        line.iter_mut().enumerate().for_each(|(x, v)| *v = value([start[0] + x, start[1] + y, start[2] + z]));
    }
    voxels.into()
}

/// Bytes of so many distinct bricks, and of a table of so many places.
pub(super) fn bytes(distinct: usize, places: usize, voxel: usize) -> usize {
    distinct * VOXELS * voxel + places * size_of::<usize>()
}
