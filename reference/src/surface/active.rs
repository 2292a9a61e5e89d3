//! The blocks of cells in which a field can have a value, from the ranges of its bricks ([RAY-2]).

use drypoint_scene::volume::{BRICK, Bricks};

/// Number of bricks along the side of a block, which is tested first.
const BRICKS: usize = 4;

/// Number of cells along the side of a block.
const BLOCK: usize = BRICKS * BRICK;

/// One bit for each brick and one for each block of bricks: whether a value lies in its closed range.
#[derive(Clone, Debug)]
pub(super) struct ActiveBricks {
    bricks: BitArray,
    blocks: BitArray,
}

#[derive(Clone, Debug)]
struct BitArray {
    dims: [usize; 3],
    words: Vec<u64>,
}

impl BitArray {
    fn new(dims: [usize; 3]) -> Self {
        Self { dims, words: vec![0; (dims[0] * dims[1] * dims[2]).div_ceil(64)] }
    }

    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.dims[1] + y) * self.dims[0] + x
    }

    fn set(&mut self, at: [usize; 3]) {
        let i = self.index(at);
        self.words[i / 64] |= 1 << (i % 64);
    }

    #[inline(always)]
    fn get(&self, at: [usize; 3]) -> bool {
        let i = self.index(at);
        self.words[i / 64] >> (i % 64) & 1 == 1
    }
}

impl ActiveBricks {
    /// Marks the bricks whose range contains a value.
    pub(super) fn new(bricks: &Bricks, value: f64) -> Self {
        let [nx, ny, _] = bricks.dims;
        let mut active =
            Self { bricks: BitArray::new(bricks.dims), blocks: BitArray::new(bricks.dims.map(|n| n.div_ceil(BRICKS))) };
        let ranges = bricks.ranges.iter().enumerate();
        for (i, _) in ranges.filter(|(_, [lo, hi])| *lo <= value && value <= *hi) {
            let at = [i % nx, i / nx % ny, i / (nx * ny)];
            active.bricks.set(at);
            active.blocks.set(at.map(|i| i / BRICKS));
        }
        active
    }

    /// The side of the largest block around a cell that cannot contain the value. Returns none if the cell's brick
    /// can contain it.
    #[inline(always)]
    pub(super) fn empty(&self, cell: [usize; 3]) -> Option<usize> {
        if !self.blocks.get(cell.map(|i| i / BLOCK)) {
            Some(BLOCK)
        } else if !self.bricks.get(cell.map(|i| i / BRICK)) {
            Some(BRICK)
        } else {
            None
        }
    }

    /// The bricks that can contain the value, in their order.
    pub(super) fn all(&self) -> Vec<[usize; 3]> {
        let [nx, ny, nz] = self.bricks.dims;
        let at = |i: usize| [i % nx, i / nx % ny, i / (nx * ny)];
        (0..nx * ny * nz).map(at).filter(|&brick| self.bricks.get(brick)).collect()
    }

    /// Size in bytes.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.bricks.words.as_slice()) + size_of_val(self.blocks.words.as_slice())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn blocks_are_as_their_bricks() {
        // 40 × 8 × 8 cells: 10 bricks a row, 3 blocks. One brick holds the value, at the closed end of its range.
        let mut bricks = Bricks::new([41, 9, 9], &|row| row.cells().map(|_| [0.0, 1.0]).collect());
        bricks.ranges[5] = [2.0, 3.0];
        let active = ActiveBricks::new(&bricks, 2.0);
        assert_eq!(active.empty([20, 3, 0]), None);
        assert_eq!(active.empty([23, 0, 3]), None);
        assert_eq!(active.empty([24, 0, 0]), Some(BRICK), "the brick beside it, in the same block");
        assert_eq!(active.empty([20, 4, 0]), Some(BRICK));
        assert_eq!(active.empty([0, 0, 0]), Some(BLOCK));
        assert_eq!(active.empty([39, 7, 7]), Some(BLOCK));
        assert_eq!(active.all(), [[5, 0, 0]]);
    }
}
