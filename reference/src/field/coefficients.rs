//! Coefficients of a B-spline on a volume's grid, with a border that continues them.

use super::prefilter::Prefilter;
use super::stencil::{Stencils, beyond};
use super::tensor::{Rows, RowsFn, Sum};
use crate::number::lanes::wide;
use crate::number::{Real, RowOfFour};
use drypoint_scene::measured::PaddedNumbers;
use drypoint_scene::parallel;
use fearless_simd::Simd;

/// Coefficients minus a constant, x fastest, padded beyond each border by the reach of the spline.
///
/// The constant is the lowest voxel. It is added back to every value. A constant volume therefore has coefficients 0,
/// and adding a constant to integers changes no bit of the coefficients.
#[derive(Clone, Debug)]
pub(super) struct Coefficients<R> {
    data: Vec<R>,
    /// Numbers along x, y, z with the border.
    dims: [usize; 3],
    /// Numbers along x, y, z without the border.
    inner: [usize; 3],
    /// Numbers before the first one of a line.
    pad: usize,
    base: R,
}

/// Rows of four coefficients.
struct RowsOfFour<'c, S, R> {
    simd: S,
    window: &'c [R],
    /// Steps in `window` from a row to the next one along y and along z.
    strides: [usize; 2],
}

impl<S: Simd, R: Real> Rows<R::Four<S>> for RowsOfFour<'_, S, R> {
    #[inline(always)]
    fn row(&self, j: usize, k: usize) -> R::Four<S> {
        let from = k * self.strides[1] + j * self.strides[0];
        let row = &self.window[from..from + 4];
        R::Four::load(self.simd, [row[0], row[1], row[2], row[3]])
    }

    #[inline(always)]
    fn zero(&self) -> R::Four<S> {
        R::Four::load(self.simd, [R::ZERO; 4])
    }
}

/// The largest stride of rows and planes: 2²⁸ numbers where addresses have 32 bits.
const LONGEST_STRIDE: usize = usize::MAX >> 4;

impl<R: Real> Coefficients<R> {
    /// The voxels, as stencils read them, with room for the border of a spline of degree 2 · `pad` + 1.
    pub(super) fn of_voxels(stencils: &Stencils<'_>, pad: usize) -> Self {
        let inner = stencils.dims();
        // A cell reaches from `pad` voxels before it to pad + 1 after it, and there is a cell even on a short axis.
        let dims = inner.map(|n| n.max(2) + 2 * pad);
        let base: R = stencils.lowest();
        let mut data = vec![R::ZERO; dims.iter().product()];
        let row_of = |row: usize| (row % dims[1], row / dims[1]);
        parallel::chunks_mut(&mut data, dims[0], &|row, out| {
            let (y, z) = row_of(row);
            let (Some(y), Some(z)) = (y.checked_sub(pad), z.checked_sub(pad)) else { return };
            if y < inner[1] && z < inner[2] {
                let out = &mut out[pad..pad + inner[0]];
                stencils.read_row(y, z, out);
                out.iter_mut().for_each(|c| *c -= base);
            }
        });
        Self { data, dims, inner, pad, base }
    }

    /// Solves for the spline that interpolates the samples, and continues its coefficients beyond the border.
    pub(super) fn prefilter(mut self) -> Self {
        for axis in 0..3 {
            if let Some(filter) = Prefilter::new(self.inner[axis], self.pad) {
                match axis {
                    0 => self.lines_along_x(&|line| filter.solve_line(line)),
                    1 => self.slabs(&|rows, lanes| filter.solve_lanes(rows, lanes)),
                    _ => self.planes(&|planes, lanes| filter.solve_lanes(planes, lanes)),
                }
            }
        }
        self.data.iter_mut().for_each(|c| *c = R::from_f64(c.to_f64()));
        self.fill_border();
        self
    }

    /// Continues the samples beyond the border.
    pub(super) fn continued(mut self) -> Self {
        self.fill_border();
        self
    }

    /// The numbers times a factor, without the constant.
    pub(super) fn padded(&self, factor: f64) -> PaddedNumbers {
        let data = self.data.iter().map(|c| c.to_f64() * factor).collect();
        PaddedNumbers::new(data, self.dims, self.pad)
    }

    /// Replaces each sample by a weighted sum over its line along one axis. `rows` holds the first sample of each sum,
    /// and the weights from that sample on.
    pub(super) fn convolve(mut self, axis: usize, rows: &[(usize, Vec<R>)]) -> Self {
        let [px, py, _] = self.dims;
        let stride = [1, px, px * py][axis];
        let mut out = vec![R::ZERO; self.data.len()];
        let (dims, inner, pad, data) = (self.dims, self.inner, self.pad, &self.data);
        parallel::chunks_mut(&mut out, px, &|row, out| {
            let at = [pad, row % dims[1], row / dims[1]];
            let is_inner = |a: usize| at[a] >= pad && at[a] < pad + inner[a];
            if !(is_inner(1) && is_inner(2)) {
                return;
            }
            let start = row * px;
            if axis == 0 {
                for (x, (first, weights)) in rows.iter().enumerate() {
                    let from = start + pad + first;
                    let samples = &data[from..from + weights.len()];
                    let mut sum = R::ZERO;
                    for (&c, &w) in samples.iter().zip(weights) {
                        sum += c * w;
                    }
                    out[pad + x] = sum;
                }
            } else {
                let (first, weights) = &rows[at[axis] - pad];
                for (i, &w) in weights.iter().enumerate() {
                    let from = (start + (first + i) * stride) - (at[axis] - pad) * stride;
                    for (sum, &c) in out.iter_mut().zip(&data[from..from + px]) {
                        *sum += c * w;
                    }
                }
            }
        });
        self.data = out;
        self
    }

    /// The constant that is added to the spline of the coefficients to make a value.
    #[inline(always)]
    pub(super) fn base(&self) -> R {
        self.base
    }

    /// Bytes in memory.
    pub(super) fn bytes(&self) -> u64 {
        (self.data.len() * size_of::<R>()) as u64
    }

    /// The rows that a cell's spline reads, `N` = 2 pad + 2 in each direction.
    #[inline(always)]
    pub(super) fn rows<const N: usize>(&self, [x, y, z]: [usize; 3]) -> impl Fn(usize, usize) -> [R; N] + '_ {
        debug_assert_eq!(N, 2 * self.pad + 2);
        let [px, py, _] = self.dims;
        let plane = px * py;
        // With this the compiler knows that offsets do not overflow, and that all rows lie in the window if it does.
        assert!(px <= LONGEST_STRIDE && plane <= LONGEST_STRIDE);
        let window = &self.data[(z * py + y) * px + x..][..(N - 1) * (plane + px) + N];
        move |j, k| {
            let from = k * plane + j * px;
            let row = &window[from..from + N];
            std::array::from_fn(|i| row[i])
        }
    }

    /// A sum over the numbers that a cell's cubic spline reads.
    #[inline(always)]
    pub(super) fn sum<T: Sum<R>>(&self, cell: [usize; 3], sum: &T) -> T::Of {
        match wide() {
            Some(simd) => simd.vectorize(
                #[inline(always)]
                || self.sum_in(simd, cell, sum),
            ),
            None => sum.over(&RowsFn(self.rows::<4>(cell))),
        }
    }

    #[inline(always)]
    fn sum_in<S: Simd, T: Sum<R>>(&self, simd: S, [x, y, z]: [usize; 3], sum: &T) -> T::Of {
        let [px, py, _] = self.dims;
        let plane = px * py;
        // See `rows`.
        assert!(px <= LONGEST_STRIDE && plane <= LONGEST_STRIDE);
        let window = &self.data[(z * py + y) * px + x..][..3 * (plane + px) + 4];
        sum.over(&RowsOfFour { simd, window, strides: [px, plane] })
    }

    /// Differences to the coefficient of a voxel, which is tap 1 on each axis. The border must have at least one
    /// coefficient.
    #[inline(always)]
    pub(super) fn differences_around(&self, [x, y, z]: [usize; 3]) -> impl Fn(usize, usize, usize) -> f64 + '_
    where
        R: Into<f64>,
    {
        let [px, py, _] = self.dims;
        let before = self.pad - 1;
        let from = ((z + before) * py + y + before) * px + x + before;
        let window = &self.data[from..from + 2 * (px * py + px + 1) + 1];
        let number = move |i: usize, j: usize, k: usize| window[(k * py + j) * px + i].into();
        let first: f64 = number(1, 1, 1);
        move |i, j, k| number(i, j, k) - first
    }

    /// Lowest and highest number that the cells from `first` up to, not including, `end` read. The constant is
    /// included.
    pub(super) fn range(&self, first: [usize; 3], end: [usize; 3]) -> [f64; 2] {
        let reach = 2 * self.pad + 1;
        let [px, py, _] = self.dims;
        let start = (first[2] * py + first[1]) * px + first[0];
        let (mut lo, mut hi) = (self.data[start], self.data[start]);
        for z in first[2]..end[2] + reach {
            for y in first[1]..end[1] + reach {
                let row = (z * py + y) * px;
                for &c in &self.data[row + first[0]..row + end[0] + reach] {
                    (lo, hi) = (lo.min(c), hi.max(c));
                }
            }
        }
        [(lo + self.base).to_f64(), (hi + self.base).to_f64()]
    }

    /// Calls `take` with the index and the number of `side` numbers along each axis, from the first number that the
    /// cell `first` reads. The constant is included. Beyond the last number the nearest one is repeated.
    pub(super) fn around(&self, first: [usize; 3], side: usize, mut take: impl FnMut([usize; 3], f64)) {
        let [px, py, pz] = self.dims;
        for (z, y) in (0..side * side).map(|row| (row / side, row % side)) {
            let row = ((first[2] + z).min(pz - 1) * py + (first[1] + y).min(py - 1)) * px;
            for x in 0..side {
                take([x, y, z], (self.data[row + (first[0] + x).min(px - 1)] + self.base).to_f64());
            }
        }
    }

    fn lines_along_x(&mut self, solve: &(dyn Fn(&mut [R]) + Sync)) {
        let (pad, n) = (self.pad, self.inner[0]);
        parallel::chunks_mut(&mut self.data, self.dims[0], &|_, row| solve(&mut row[pad..pad + n]));
    }

    /// Lines along y, a whole row of them at a time.
    fn slabs(&mut self, solve: &(dyn Fn(&mut [R], usize) + Sync)) {
        let ([px, py, _], pad, n) = (self.dims, self.pad, self.inner[1]);
        parallel::chunks_mut(&mut self.data, px * py, &|_, slab| solve(&mut slab[pad * px..(pad + n) * px], px));
    }

    /// Lines along z, a whole plane of them at a time.
    fn planes(&mut self, solve: &dyn Fn(&mut [R], usize)) {
        let ([px, py, _], pad, n) = (self.dims, self.pad, self.inner[2]);
        solve(&mut self.data[pad * px * py..(pad + n) * px * py], px * py);
    }

    /// Continues the numbers beyond the border, along x, then y, then z, by the recurrence of [REC-1].
    fn fill_border(&mut self) {
        let ([px, py, _], [nx, ny, nz], pad) = (self.dims, self.inner, self.pad);
        parallel::chunks_mut(&mut self.data, px, &|_, row| continue_lanes(row, 1, nx, pad));
        parallel::chunks_mut(&mut self.data, px * py, &|_, slab| continue_lanes(slab, px, ny, pad));
        continue_lanes(&mut self.data, px * py, nz, pad);
    }
}

/// Fills what lies outside the n samples from `pad` on; a sample is a run of `lanes` numbers.
pub(super) fn continue_lanes<R: Real>(data: &mut [R], lanes: usize, n: usize, pad: usize) {
    let padded = data.len() / lanes;
    for i in pad + n..padded {
        for lane in 0..lanes {
            let c = |back: usize| data[i.saturating_sub(back) * lanes + lane];
            data[i * lanes + lane] = beyond(i - pad, c(1), c(2), c(3));
        }
    }
    for i in (0..pad).rev() {
        for lane in 0..lanes {
            let c = |ahead: usize| data[(i + ahead).min(padded - 1) * lanes + lane];
            data[i * lanes + lane] = beyond(padded - i - 1, c(1), c(2), c(3));
        }
    }
}
