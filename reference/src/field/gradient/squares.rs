//! ‖g‖² by central differences, Sobel's operator and the regression at every voxel of a row, eight side by side. The
//! operations are those of one voxel, so the bits are the same.

use super::regression::Taps;
use crate::field::{Field, GradientEstimator};
use crate::number::lanes::{LANES, widely};
use crate::number::{Mat3, Real, Vec3};

/// Number of rows that the gradients of a row read: the row and its neighbours, (y, z) = (−1, −1), (0, −1), … (1, 1).
const ROWS: usize = 9;

/// Index of the row itself.
const MIDDLE: usize = 4;

/// The voxels that eight gradients read in each of the rows.
type Windows<R> = [[R; LANES + 2]; ROWS];

/// The components of eight gradients along the index axes.
type Lane<R> = [[R; LANES]; 3];

impl<R: Real> Field<'_, R> {
    /// ‖g‖² times 4^−e of the voxels of a row except the first and the last. The bits are those of the squared length
    /// of [`voxel_gradient`](crate::field::Sampler::voxel_gradient). `rows` is working memory, and `squares` is as long
    /// as the row.
    ///
    /// Returns whether the row was computed. Rows at a border, rows shorter than ten voxels, fields with an axis of
    /// length 1 or with scaled numbers, and the estimator `analytic` are not computed.
    pub(crate) fn squares_inside(&self, [y, z]: [usize; 2], rows: &mut Vec<R>, squares: &mut [R]) -> bool {
        let (nx, inside) = (squares.len(), squares.len().saturating_sub(2));
        if inside < LANES || !self.stencils.surrounds([1, y, z]) {
            return false;
        }
        let is_central = match (self.how.gradient, &self.regression) {
            (GradientEstimator::Central, _) => true,
            (GradientEstimator::Sobel, _) | (GradientEstimator::Regression, Some(_)) => false,
            _ => return false,
        };
        rows.resize(ROWS * nx, R::ZERO);
        for (i, row) in rows.chunks_exact_mut(nx).enumerate() {
            // Central differences read no row that is beside the middle one along both axes.
            if !is_central || i % 2 == 1 || i == MIDDLE {
                self.stencils.read_row(y - 1 + i % 3, z - 1 + i / 3, row);
            }
        }
        let rows = rows.as_slice();
        match &self.regression {
            _ if is_central => in_world(&self.to_world, squares, |start| central(rows, nx, start)),
            Some(regression) if self.how.gradient == GradientEstimator::Regression => {
                let taps = regression.taps_inside();
                in_world(&self.to_world, squares, |start| changing(rows, nx, start, |w, first| fitted(w, first, taps)));
            }
            _ => in_world(&self.to_world, squares, |start| changing(rows, nx, start, sobel)),
        }
        true
    }
}

/// Writes the squared lengths of the gradients. `eight` returns the gradients of the eight voxels after a given one.
fn in_world<R: Real>(to_world: &Mat3<R>, squares: &mut [R], eight: impl Fn(usize) -> Lane<R>) {
    let inside = squares.len() - 2;
    widely(
        #[inline(always)]
        || {
            for start in (0..inside).step_by(LANES) {
                // If fewer than eight are left, the last eight of the row are computed again.
                let start = start.min(inside - LANES);
                let [x, y, z] = eight(start);
                let out = &mut squares[start + 1..][..LANES];
                for l in 0..LANES {
                    let gradient = to_world.apply(Vec3::new(x[l], y[l], z[l]));
                    out[l] = gradient.dot(gradient);
                }
            }
        },
    );
}

/// Central differences at the eight voxels after the one at `start`.
#[inline(always)]
fn central<R: Real>(rows: &[R], nx: usize, start: usize) -> Lane<R> {
    let run = |row: usize, from: usize| -> &[R] { &rows[row * nx + start + from..][..LANES] };
    let pairs = [
        [run(MIDDLE, 0), run(MIDDLE, 2)],
        [run(MIDDLE - 1, 1), run(MIDDLE + 1, 1)],
        [run(MIDDLE - 3, 1), run(MIDDLE + 3, 1)],
    ];
    let mut lane = [[R::ZERO; LANES]; 3];
    for (lane, [down, up]) in lane.iter_mut().zip(pairs) {
        for l in 0..LANES {
            lane[l] = (up[l] - down[l]) * R::HALF;
        }
    }
    lane
}

/// The gradients of an estimator that reads 3³ voxels, at the eight voxels after `start`. They are 0 where all voxels
/// are equal.
#[inline(always)]
fn changing<R: Real>(
    rows: &[R],
    nx: usize,
    start: usize,
    estimate: impl Fn(&Windows<R>, &[R; LANES]) -> Lane<R>,
) -> Lane<R> {
    let mut windows = [[R::ZERO; LANES + 2]; ROWS];
    for (r, window) in windows.iter_mut().enumerate() {
        window.copy_from_slice(&rows[r * nx + start..][..LANES + 2]);
    }
    let mut first = [R::ZERO; LANES];
    first.copy_from_slice(&windows[MIDDLE][1..=LANES]);
    let mut differs = [false; LANES];
    for window in &windows {
        for l in 0..LANES {
            differs[l] |= window[l] != first[0];
        }
        differs[0] |= window[LANES] != first[0] || window[LANES + 1] != first[0];
    }
    if differs == [false; LANES] { [[R::ZERO; LANES]; 3] } else { estimate(&windows, &first) }
}

/// The regression of [REC-2], from differences to each voxel itself.
#[inline(always)]
fn fitted<R: Real>(windows: &Windows<R>, first: &[R; LANES], taps: &Taps<R>) -> Lane<R> {
    let mut sums = [[R::ZERO; LANES]; 3];
    for (sum, taps) in sums.iter_mut().zip(taps) {
        for &(t, weight) in taps {
            let window = &windows[t / 3];
            for l in 0..LANES {
                sum[l] += (window[t % 3 + l] - first[l]) * weight;
            }
        }
    }
    sums
}

/// Sobel's operator, with the sums of [`sobel::at_voxel`](super::sobel::at_voxel) in their order.
#[inline(always)]
fn sobel<R: Real>(windows: &Windows<R>, first: &[R; LANES]) -> Lane<R> {
    let (half, quarter) = (R::HALF, R::HALF * R::HALF);
    let (value, slope) = ([quarter, half, quarter], [-half, R::ZERO, half]);
    // For each x: sums over z and y, named by the derivatives in (y, z).
    let [mut s00, mut s10, mut s01] = [[[R::ZERO; LANES]; 3]; 3];
    for k in 0..3 {
        for i in 0..3 {
            let [mut p0, mut p1] = [[R::ZERO; LANES]; 2];
            for j in 0..3 {
                for l in 0..LANES {
                    let c = windows[3 * k + j][i + l] - first[l];
                    p0[l] += c * value[j];
                    p1[l] += c * slope[j];
                }
            }
            for l in 0..LANES {
                s00[i][l] += p0[l] * value[k];
                s10[i][l] += p1[l] * value[k];
                s01[i][l] += p0[l] * slope[k];
            }
        }
    }
    let mut lane = [[R::ZERO; LANES]; 3];
    for l in 0..LANES {
        let smooth = |s: &[[R; LANES]; 3]| (s[0][l] * quarter + s[2][l] * quarter) + s[1][l] * half;
        lane[0][l] = s00[2][l] * half - s00[0][l] * half;
        (lane[1][l], lane[2][l]) = (smooth(&s10), smooth(&s01));
    }
    lane
}
