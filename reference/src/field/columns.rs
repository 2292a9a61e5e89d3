//! Lowest and highest voxels of rows that lie side by side.

use drypoint_scene::volume::{Access, Voxel};
use std::ops::Range;

/// Voxels compared at a time: enough that the compiler keeps the loop and vectorizes it.
const LANES: usize = 64;

/// Lowest and highest voxel of several rows, for each x.
pub(crate) struct Columns<V> {
    lo: Vec<V>,
    hi: Vec<V>,
    width: usize,
}

impl<V: Voxel> Columns<V> {
    pub(crate) fn new(width: usize) -> Self {
        Self { lo: Vec::new(), hi: Vec::new(), width }
    }

    /// Takes a row, along x.
    pub(crate) fn add(&mut self, voxels: impl Access<Voxel = V>, y: usize, z: usize) {
        if self.lo.is_empty() {
            self.lo = (0..self.width).map(|x| voxels.at(x, y, z)).collect();
            self.hi = self.lo.clone();
            return;
        }
        let (lo, lo_rest) = self.lo.as_chunks_mut::<LANES>();
        let (hi, hi_rest) = self.hi.as_chunks_mut::<LANES>();
        for (i, (lo, hi)) in lo.iter_mut().zip(&mut *hi).enumerate() {
            let row = voxels.row::<LANES>(i * LANES, y, z);
            for x in 0..LANES {
                compare(row[x], &mut lo[x], &mut hi[x]);
            }
        }
        let start = lo.len() * LANES;
        for (i, (lo, hi)) in lo_rest.iter_mut().zip(hi_rest).enumerate() {
            compare(voxels.at(start + i, y, z), lo, hi);
        }
    }

    /// Lowest and highest voxel of some columns, of which there is at least one.
    pub(crate) fn range(&self, columns: Range<usize>) -> [V; 2] {
        let [mut lo, mut hi] = [self.lo[columns.start], self.hi[columns.start]];
        for x in columns {
            compare(self.lo[x], &mut lo, &mut hi);
            compare(self.hi[x], &mut lo, &mut hi);
        }
        [lo, hi]
    }
}

#[inline(always)]
fn compare<V: Voxel>(v: V, lo: &mut V, hi: &mut V) {
    *lo = if v < *lo { v } else { *lo };
    *hi = if v > *hi { v } else { *hi };
}
