//! The cell of a position, and the fractions within it ([REC-1], [SPACE-1]).

use crate::number::{Real, Vec3};

/// A position as its cell and the fractions in [0, 1] from the cell's first voxel on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellPosition<R> {
    /// min(⌊x⌋, max(N − 2, 0)) on each axis.
    pub cell: [usize; 3],
    /// x − cell; 0 on an axis of length 1.
    pub w: [R; 3],
}

impl<R: Real> CellPosition<R> {
    /// The place in f64.
    #[inline]
    pub(crate) fn to_f64(self) -> CellPosition<f64> {
        let [x, y, z] = self.w;
        CellPosition { cell: self.cell, w: [x.to_f64(), y.to_f64(), z.to_f64()] }
    }
}

/// The cells of a grid.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Cells<R> {
    /// The last cell of each axis, max(N − 2, 0).
    last: [R; 3],
    /// Whether each axis has length 1, so that its coordinate is ignored. None if no axis has.
    flat: Option<[bool; 3]>,
}

impl<R: Real> Cells<R> {
    pub(crate) fn new(dims: [usize; 3]) -> Self {
        let flat = dims.map(|n| n == 1);
        Self { last: dims.map(|n| R::from_f64((n.max(2) - 2) as f64)), flat: flat.contains(&true).then_some(flat) }
    }

    /// max(N − 2, 0) on each axis.
    #[inline(always)]
    pub(crate) fn last(&self) -> [R; 3] {
        self.last
    }

    #[inline(always)]
    fn along(&self, axis: usize, x: R) -> (usize, R) {
        let cell = x.min(self.last[axis]).to_index();
        (cell, x - R::from_index(cell))
    }

    /// The place of a position inside the box of [SPACE-1].
    #[inline(always)]
    pub(crate) fn locate(&self, p: Vec3<R>) -> CellPosition<R> {
        let (x, y, z) = (self.along(0, p.x), self.along(1, p.y), self.along(2, p.z));
        let w = [x.1, y.1, z.1];
        let w = match self.flat {
            None => w,
            Some(flat) => [0, 1, 2].map(|a| if flat[a] { R::ZERO } else { w[a] }),
        };
        CellPosition { cell: [x.0, y.0, z.0], w }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_last_voxel_belongs_to_the_last_cell_and_short_axes_have_one() {
        let cells = Cells::<f64>::new([4, 2, 1]);
        let at = |x, y, z| cells.locate(Vec3::new(x, y, z));
        assert_eq!(at(0.0, 0.0, 0.0), CellPosition { cell: [0, 0, 0], w: [0.0, 0.0, 0.0] });
        assert_eq!(at(2.75, 0.5, -0.5), CellPosition { cell: [2, 0, 0], w: [0.75, 0.5, 0.0] });
        assert_eq!(at(3.0, 1.0, 0.5), CellPosition { cell: [2, 0, 0], w: [1.0, 1.0, 0.0] });
        assert_eq!(at(-0.0, 0.0, -0.0), at(0.0, 0.0, 0.0));
    }

    /// The floor and the way from it, against the definition, at and around whole numbers.
    #[test]
    fn cells_are_floors() {
        let cells = Cells::<f64>::new([300, 2, 2]);
        for i in 0..299 {
            let x = f64::from(i);
            for x in [x, x.next_up(), x + 0.5, (x + 1.0).next_down()] {
                let at = cells.locate(Vec3::new(x, 0.0, 0.0));
                assert_eq!((at.cell[0], at.w[0]), (x.floor() as usize, x - x.floor()), "{x}");
            }
        }
    }
}
