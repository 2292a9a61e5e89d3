//! Which cell a position belongs to, and where in it ([REC-1], [SPACE-1]).

use crate::number::{Real, Vec3};

/// A position as its cell and the fractions in [0, 1] from the cell's first voxel on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place<R> {
    /// min(⌊x⌋, max(N − 2, 0)) on each axis.
    pub cell: [usize; 3],
    /// x − cell; 0 on an axis of length 1.
    pub w: [R; 3],
}

/// The cells of a grid.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cells<R> {
    /// The last cell of each axis, max(N − 2, 0).
    last: [usize; 3],
    /// 1, or 0 on an axis of length 1, whose coordinate is ignored.
    live: [R; 3],
}

impl<R: Real> Cells<R> {
    pub(super) fn new(dims: [usize; 3]) -> Self {
        Self { last: dims.map(|n| n.max(2) - 2), live: dims.map(|n| if n == 1 { R::ZERO } else { R::ONE }) }
    }

    #[inline(always)]
    fn along(&self, axis: usize, x: R) -> (usize, R) {
        let (cell, w) = (x * self.live[axis]).split();
        // Only the last voxel itself lies beyond the last cell.
        if cell > self.last[axis] { (self.last[axis], R::ONE) } else { (cell, w) }
    }

    /// The place of a position inside the box of [SPACE-1].
    #[inline(always)]
    pub(super) fn locate(&self, p: Vec3<R>) -> Place<R> {
        let (x, y, z) = (self.along(0, p.x), self.along(1, p.y), self.along(2, p.z));
        Place { cell: [x.0, y.0, z.0], w: [x.1, y.1, z.1] }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_voxel_belongs_to_the_last_cell_and_short_axes_have_one() {
        let cells = Cells::<f64>::new([4, 2, 1]);
        let at = |x, y, z| cells.locate(Vec3::new(x, y, z));
        assert_eq!(at(0.0, 0.0, 0.0), Place { cell: [0, 0, 0], w: [0.0, 0.0, 0.0] });
        assert_eq!(at(2.75, 0.5, -0.5), Place { cell: [2, 0, 0], w: [0.75, 0.5, 0.0] });
        assert_eq!(at(3.0, 1.0, 0.5), Place { cell: [2, 0, 0], w: [1.0, 1.0, 0.0] });
    }
}
