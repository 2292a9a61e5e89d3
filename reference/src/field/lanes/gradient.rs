//! Gradients at eight positions side by side ([REC-2]).

use super::{LANES, LaneReader, Packed, Places, word};
use crate::field::GradientEstimator;
use crate::field::gradient::{central, sobel};
use crate::field::place::CellPosition;
use crate::field::stencil::Cross;
use crate::field::tensor::{self, Rows};
use crate::number::Vec3;
use drypoint_scene::volume::Access;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4, f64x8, mask64x8};

/// The largest number of gradients that are computed one by one.
const FEW: u32 = 2;
/// [`FEW`] for Sobel's operator, for which the columns of a single cell already fill vectors.
const FEW_SOBEL: u32 = 5;

impl<S: Simd, V: Packed> LaneReader<'_, '_, S, V> {
    /// [`Reader::gradients`](super::Reader::gradients).
    #[inline(always)]
    pub(super) fn differences(&self, at: &Places<S>, asked: mask64x8<S>) -> Vec3<f64x8<S>> {
        let inner = self.field.stencils.inner().map(|n| n as f64);
        let cell = at.cell;
        let inside = cell.x.simd_ge(1.0)
            & cell.x.simd_le(inner[0])
            & cell.y.simd_ge(1.0)
            & cell.y.simd_le(inner[1])
            & cell.z.simd_ge(1.0)
            & cell.z.simd_le(inner[2]);
        let zero = f64x8::splat(self.simd, 0.0);
        let zero = Vec3::new(zero, zero, zero);
        let is_sobel = self.field.how.gradient == GradientEstimator::Sobel;
        let start =
            self.offsets(Vec3::select(asked & inside, Vec3::new(cell.x - 1.0, cell.y - 1.0, cell.z - 1.0), zero));
        // All eight lanes are computed together, even those that were not asked for.
        let together = (asked & inside).to_bitmask().count_ones() > if is_sobel { FEW_SOBEL } else { FEW };
        let mut index = zero;
        let mut alone = asked.to_bitmask();
        if together {
            index = if is_sobel { self.sobel(start, at.w) } else { self.central(start, at.w) };
            alone = (asked & !inside).to_bitmask();
        }
        let inside = inside.to_bitmask();
        while alone != 0 {
            let lane = alone.trailing_zeros() as usize;
            alone &= alone - 1;
            let w = [at.w[0][lane], at.w[1][lane], at.w[2][lane]];
            let cell = [cell.x[lane] as usize, cell.y[lane] as usize, cell.z[lane] as usize];
            let g = match (is_sobel, inside >> lane & 1 == 1) {
                (true, true) => self.sobel_alone(start[lane], w),
                (true, false) => sobel::gradient(self.field, CellPosition { cell, w }),
                (false, _) => central::gradient(self.field, CellPosition { cell, w }),
            };
            (index.x[lane], index.y[lane], index.z[lane]) = (g.x, g.y, g.z);
        }
        self.to_world.apply(index)
    }

    /// Central differences in cells whose stencils lie in the grid. `start` holds the offsets of the stencils' first
    /// voxels.
    #[inline(always)]
    fn central(&self, start: [usize; LANES], w: [f64x8<S>; 3]) -> Vec3<f64x8<S>> {
        let v = self.windows::<4>(start);
        let x = [v.rows(1, 1), v.rows(2, 1), v.rows(1, 2), v.rows(2, 2)];
        let y = [self.raised(v.pairs([(0, 1), (3, 1)])), self.raised(v.pairs([(0, 2), (3, 2)]))];
        let z = [self.raised(v.pairs([(1, 0), (2, 0)])), self.raised(v.pairs([(1, 3), (2, 3)]))];
        let cross = Cross {
            x: [self.raised(x[0]), self.raised(x[1]), self.raised(x[2]), self.raised(x[3])],
            y: in_twos(y),
            z: in_twos(z),
        };
        central::interpolated(cross, w)
    }

    /// Sobel's operator in cells whose stencils lie in the grid, one column of taps of all cells at a time.
    #[inline(always)]
    fn sobel(&self, start: [usize; LANES], [wx, wy, wz]: [f64x8<S>; 3]) -> Vec3<f64x8<S>> {
        let v = self.windows::<4>(start);
        let mut words = [[[0; LANES]; 4]; 4];
        for (k, plane) in words.iter_mut().enumerate() {
            for (j, rows) in plane.iter_mut().enumerate() {
                *rows = v.rows(j, k);
            }
        }
        let (one, zero) = (f64x8::splat(self.simd, 1.0), f64x8::splat(self.simd, 0.0));
        let x = sobel::taps_inside(wx, one, zero);
        let (y, z) = (sobel::taps_inside(wy, one, zero), sobel::taps_inside(wz, one, zero));
        let first = self.raised_at(words[1][1], 1);
        let mut sums = [[zero; 4]; 3];
        for i in 0..4 {
            let of_column = tensor::gradient_sums(&ColumnOfEach { reader: self, words: &words, i }, first, [&y, &z]);
            for (sum, column) in sums.iter_mut().zip(of_column) {
                sum[i] = column;
            }
        }
        tensor::gradient_of_sums(&sums, &x)
    }

    /// Sobel's operator in one cell, a row of taps at a time.
    #[inline(always)]
    fn sobel_alone(&self, start: usize, [wx, wy, wz]: [f64; 3]) -> Vec3<f64> {
        let a = self.voxels.window_at::<4>(start);
        let mut words = [[0; 4]; 4];
        for (k, plane) in words.iter_mut().enumerate() {
            for (j, row) in plane.iter_mut().enumerate() {
                *row = word(a.row::<4>(0, j, k));
            }
        }
        let rows = RowsOfOne { reader: self, words: &words };
        let taps =
            [sobel::taps_inside(wx, 1.0, 0.0), sobel::taps_inside(wy, 1.0, 0.0), sobel::taps_inside(wz, 1.0, 0.0)];
        tensor::gradient(&rows, &taps)
    }
}

#[inline(always)]
fn in_twos<T>([[a, b, c, d], [e, f, g, h]]: [[T; 4]; 2]) -> [[T; 2]; 4] {
    [[a, b], [c, d], [e, f], [g, h]]
}

/// Column i of the voxels around eight cells, as they are stored.
struct ColumnOfEach<'r, 'f, 'v, S: Simd, V> {
    reader: &'r LaneReader<'f, 'v, S, V>,
    words: &'r [[[u64; LANES]; 4]; 4],
    i: usize,
}

impl<S: Simd, V: Packed> Rows<f64x8<S>> for ColumnOfEach<'_, '_, '_, S, V> {
    #[inline(always)]
    fn row(&self, j: usize, k: usize) -> f64x8<S> {
        self.reader.raised_at(self.words[k][j], self.i)
    }

    #[inline(always)]
    fn zero(&self) -> f64x8<S> {
        f64x8::splat(self.reader.simd, 0.0)
    }
}

/// The rows of the voxels around one cell, as they are stored.
struct RowsOfOne<'r, 'f, 'v, S: Simd, V> {
    reader: &'r LaneReader<'f, 'v, S, V>,
    words: &'r [[u64; 4]; 4],
}

impl<S: Simd, V: Packed> Rows<f64x4<S>> for RowsOfOne<'_, '_, '_, S, V> {
    #[inline(always)]
    fn row(&self, j: usize, k: usize) -> f64x4<S> {
        self.reader.raised_row(self.words[k][j])
    }

    #[inline(always)]
    fn zero(&self) -> f64x4<S> {
        f64x4::splat(self.reader.simd, 0.0)
    }
}
