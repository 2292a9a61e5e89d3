//! Minimum and maximum over bricks of cells, for empty-space skipping ([RAY-2]).

use crate::parallel;

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
    /// Bricks over the cells of a grid, with the ranges that `ranges` gives for each row of them along x.
    pub fn new(grid_dims: [usize; 3], ranges: &(dyn Fn(&BrickRow) -> Vec<[f64; 2]> + Sync)) -> Self {
        let cells = grid_dims.map(|n| n.max(2) - 1);
        let dims = cells.map(|n| n.div_ceil(BRICK));
        let ranges = parallel::map(dims[1] * dims[2], &|row| {
            let brick = [row % dims[1], row / dims[1]];
            let ranges = ranges(&BrickRow { cells, brick });
            debug_assert_eq!(ranges.len(), dims[0]);
            ranges
        });
        let ranges = ranges.concat();
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

/// The bricks of one row along x.
#[derive(Clone, Copy, Debug)]
pub struct BrickRow {
    /// Cells of the grid.
    cells: [usize; 3],
    /// The row's place among the bricks, along y and z.
    brick: [usize; 2],
}

impl BrickRow {
    /// The first cell of each brick and the cell after its last, along x, y, z.
    pub fn cells(&self) -> impl Iterator<Item = [[usize; 3]; 2]> + use<> {
        let Self { cells, brick: [y, z] } = *self;
        (0..cells[0].div_ceil(BRICK)).map(move |x| {
            let first = [x, y, z].map(|i| i * BRICK);
            [first, std::array::from_fn(|a| (first[a] + BRICK).min(cells[a]))]
        })
    }
}
