//! Ranges of the values that a kernel can return in each cell of a brick ([RAY-2]). In steep regions they are far
//! narrower than the brick's range.

use super::{Field, KernelData, ranges};
use crate::number::Real;
use drypoint_scene::volume::BRICK;

/// Cells of a brick.
pub(crate) const CELLS: usize = BRICK * BRICK * BRICK;

/// Most numbers that the cells of a brick read along an axis. The quintic spline has six taps.
const MOST: usize = BRICK + 5;

/// Lowest and highest numbers, [z][y][x].
type Extremes = [[[[f64; 2]; MOST]; MOST]; MOST];

impl<R: Real> Field<'_, R> {
    /// Ranges that contain every sample of the field, one range for each cell of a brick, x fastest. Ranges of cells
    /// beyond the grid's last cell mean nothing.
    pub(crate) fn cell_ranges(&self, brick: [usize; 3]) -> [[f64; 2]; CELLS] {
        let first = brick.map(|i| i * BRICK);
        let mut numbers: Extremes = [[[[0.0; 2]; MOST]; MOST]; MOST];
        let taps = match &self.kernel {
            KernelData::Trilinear => 2,
            KernelData::BsplineSmooth | KernelData::CatmullRom | KernelData::Bspline(_) => 4,
            KernelData::Bspline5(_) => 6,
        };
        let side = BRICK + taps - 1;
        match &self.kernel {
            KernelData::Bspline(c) | KernelData::Bspline5(c) => c.around(first, side, |at, c| put(&mut numbers, at, c)),
            _ => self.stencils.around::<R>(first, taps / 2 - 1, side, &mut |at, c| put(&mut numbers, at, c)),
        }
        closed(&mut numbers, side, taps);
        let range = |i: usize| {
            let read = numbers[i / BRICK / BRICK][i / BRICK % BRICK][i % BRICK];
            let read = if matches!(self.kernel, KernelData::CatmullRom) { ranges::overshot(read) } else { read };
            let [a, b] = ranges::widened::<R>(read).map(|v| self.to_value(R::from_f64(v)).to_f64());
            [a.min(b), a.max(b)]
        };
        std::array::from_fn(range)
    }
}

fn put(numbers: &mut Extremes, [x, y, z]: [usize; 3], number: f64) {
    numbers[z][y][x] = [number; 2];
}

/// Replaces each number by the extremes of the `taps` numbers from it on along each axis, for the first [`BRICK`].
fn closed(numbers: &mut Extremes, side: usize, taps: usize) {
    let join = |[lo, hi]: [f64; 2], [a, b]: [f64; 2]| [lo.min(a), hi.max(b)];
    for plane in &mut numbers[..side] {
        for row in &mut plane[..side] {
            for x in 0..BRICK {
                row[x] = row[x..x + taps].iter().copied().fold(row[x], join);
            }
        }
        for y in 0..BRICK {
            for x in 0..BRICK {
                plane[y][x] = plane[y..y + taps].iter().map(|row| row[x]).fold(plane[y][x], join);
            }
        }
    }
    for z in 0..BRICK {
        for y in 0..BRICK {
            for x in 0..BRICK {
                numbers[z][y][x] = numbers[z..z + taps].iter().map(|plane| plane[y][x]).fold(numbers[z][y][x], join);
            }
        }
    }
}
