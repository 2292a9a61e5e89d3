//! Minimum and maximum over bricks of cells, for empty-space skipping ([RAY-2]).

/// Cells along the side of a brick.
pub const BRICK: usize = 4;

/// The range of values that the field can take in each brick of [`BRICK`]³ cells, x fastest.
#[derive(Clone, Debug, PartialEq)]
pub struct Bricks {
    /// Bricks along x, y, z.
    pub dims: [usize; 3],
    /// Lowest and highest value in each brick.
    pub ranges: Vec<[f64; 2]>,
}

impl Bricks {
    /// Bricks over the cells of a grid, each with the range that `range` gives for the cells from its first argument
    /// up to, not including, its second.
    pub fn new(grid_dims: [usize; 3], range: impl Fn([usize; 3], [usize; 3]) -> [f64; 2] + Sync) -> Self {
        use rayon::prelude::*;
        let cells = grid_dims.map(|n| n.max(2) - 1);
        let dims = cells.map(|n| n.div_ceil(BRICK));
        let ranges = (0..dims.iter().product::<usize>())
            .into_par_iter()
            .map(|b| {
                let brick = [b % dims[0], b / dims[0] % dims[1], b / (dims[0] * dims[1])];
                let first = brick.map(|i| i * BRICK);
                range(first, std::array::from_fn(|a| (first[a] + BRICK).min(cells[a])))
            })
            .collect();
        Self { dims, ranges }
    }

    /// The linear index of the brick that holds a cell.
    #[inline(always)]
    pub fn of_cell(&self, [x, y, z]: [usize; 3]) -> usize {
        ((z / BRICK) * self.dims[1] + y / BRICK) * self.dims[0] + x / BRICK
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        self.ranges.len() * size_of::<[f64; 2]>()
    }
}
