//! Exact B-spline coefficients of samples, with the border of [REC-1].
//!
//! Along a line the cubic spline takes the value (c₋₁ + 4c₀ + c₁)/6 at a sample, the quintic one (c₋₂ + 26c₋₁ + 66c₀ +
//! 26c₁ + c₂)/120. Beyond the border c₋₁ = 3c₀ − 3c₁ + c₂ and c₋₂ = 6c₀ − 8c₁ + 3c₂, the recurrence applied twice. The
//! first row of the cubic system is therefore (7, −2, 1)/6. The first two of the quintic system are (150, −60, 30)/120
//! and (29, 63, 27, 1)/120. The last rows are their mirror images.
//!
//! No row has an entry more than two beside the diagonal, and every row is diagonally dominant. An LU decomposition of
//! five bands without pivoting solves the system, and serves all lines of one length. Quadratics are reproduced up to
//! the border. Lines of one and two samples are their own coefficients.

use crate::number::Real;
use drypoint_scene::parallel;

/// The decomposed system of one line.
#[derive(Clone, Debug)]
pub(super) struct Prefilter<R> {
    /// The factors by which the two samples before each sample are subtracted from it, the nearer one first.
    forward: Vec<[R; 2]>,
    /// The factor of each sample, of the sample after it, and of the one after that.
    backward: Vec<[R; 3]>,
}

/// Numbers that one task works on at a time.
const CHUNK: usize = 4096;

impl<R: Real> Prefilter<R> {
    /// The system of n samples for the cubic (`pad` 1) or the quintic spline (`pad` 2). Returns none if n < 3, where
    /// the samples are the coefficients.
    pub(super) fn new(n: usize, pad: usize) -> Option<Self> {
        if n < 3 {
            return None;
        }
        let scale = if pad == 1 { 6.0 } else { 120.0 };
        // Row i of the decomposed matrix, from column i on.
        let mut upper: Vec<[f64; 3]> = Vec::with_capacity(n);
        let mut forward = Vec::with_capacity(n);
        for i in 0..n {
            let [mut a, mut b, mut c, mut d, e] = row(i, n, pad);
            let mut taken = [0.0; 2];
            if i >= 2 {
                let u = upper[i - 2];
                taken[1] = a / u[0];
                a = taken[1];
                b -= a * u[1];
                c -= a * u[2];
            }
            if i >= 1 {
                let u = upper[i - 1];
                taken[0] = b / u[0];
                c -= taken[0] * u[1];
                d -= taken[0] * u[2];
            }
            upper.push([c, d, e]);
            forward.push(taken.map(R::from_f64));
        }
        let backward = upper.iter().map(|u| [scale / u[0], u[1] / u[0], u[2] / u[0]].map(R::from_f64)).collect();
        Some(Self { forward, backward })
    }

    /// Solves one line in place.
    pub(super) fn solve_line(&self, c: &mut [R]) {
        let (mut one, mut two) = (R::ZERO, R::ZERO);
        for (c, &[a, b]) in c.iter_mut().zip(&self.forward) {
            *c = *c - b * two - a * one;
            (one, two) = (*c, one);
        }
        (one, two) = (R::ZERO, R::ZERO);
        for (c, &[f, a, b]) in c.iter_mut().zip(&self.backward).rev() {
            *c = f * *c - b * two - a * one;
            (one, two) = (*c, one);
        }
    }

    /// Solves `lanes` lines in place that lie side by side. Sample i of all lines is the i-th run of `lanes` numbers.
    pub(super) fn solve_lanes(&self, c: &mut [R], lanes: usize) {
        let n = self.forward.len();
        for i in 0..n {
            let [a, b] = self.forward[i];
            let (before, rest) = c.split_at_mut(i * lanes);
            let one = &before[i.saturating_sub(1) * lanes..];
            let two = &before[i.saturating_sub(2) * lanes..];
            match i {
                0 => {}
                1 => lane_by_lane(&mut rest[..lanes], one, one, |y, one, _| y - a * one),
                _ => lane_by_lane(&mut rest[..lanes], one, two, |y, one, two| y - b * two - a * one),
            }
        }
        for i in (0..n).rev() {
            let [f, a, b] = self.backward[i];
            let (before, after) = c.split_at_mut((i + 1) * lanes);
            let (here, one) = (&mut before[i * lanes..], &after[..]);
            match n - 1 - i {
                0 => here.iter_mut().for_each(|y| *y = f * *y),
                1 => lane_by_lane(here, one, one, |y, one, _| f * y - a * one),
                _ => lane_by_lane(here, one, &after[lanes..], |y, one, two| f * y - b * two - a * one),
            }
        }
    }
}

/// here = f(here, one, two) for each lane; long runs are shared among threads.
fn lane_by_lane<R: Real>(here: &mut [R], one: &[R], two: &[R], f: impl Fn(R, R, R) -> R + Sync) {
    let chunk = |chunk: usize, here: &mut [R]| {
        let from = chunk * CHUNK;
        for ((y, &one), &two) in here.iter_mut().zip(&one[from..]).zip(&two[from..]) {
            *y = f(*y, one, two);
        }
    };
    if here.len() <= CHUNK { chunk(0, here) } else { parallel::chunks_mut(here, CHUNK, &chunk) }
}

/// The entries of row i at columns i − 2 … i + 2, in sixths or 120ths. Taps beyond the border are folded back.
fn row(i: usize, n: usize, pad: usize) -> [f64; 5] {
    let taps: [f64; 5] = if pad == 1 { [0.0, 1.0, 4.0, 1.0, 0.0] } else { [1.0, 26.0, 66.0, 26.0, 1.0] };
    let mut row = [0.0; 5];
    for (k, tap) in taps.into_iter().enumerate() {
        // Column i + k − 2, counted from either end.
        let (left, right) = ((i + k) as isize - 2, n as isize + 1 - (i + k) as isize);
        let outside = (-left).max(-right);
        if outside <= 0 {
            row[k] += tap;
            continue;
        }
        let nearest = if outside == 1 { [3.0, -3.0, 1.0] } else { [6.0, -8.0, 3.0] };
        for (c, weight) in nearest.into_iter().enumerate() {
            let column = if left < 0 { c } else { n - 1 - c };
            // A row never reaches further than two columns: row 0 folds to columns 0 … 2, row 1 to 0 … 3.
            row[column + 2 - i] += tap * weight;
        }
    }
    row
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_rows_at_the_border_are_those_worked_by_hand() {
        assert_eq!(row(0, 9, 1), [0.0, 0.0, 7.0, -2.0, 1.0]);
        assert_eq!(row(8, 9, 1), [1.0, -2.0, 7.0, 0.0, 0.0]);
        assert_eq!(row(4, 9, 1), [0.0, 1.0, 4.0, 1.0, 0.0]);
        assert_eq!(row(0, 9, 2), [0.0, 0.0, 150.0, -60.0, 30.0]);
        assert_eq!(row(1, 9, 2), [0.0, 29.0, 63.0, 27.0, 1.0]);
        assert_eq!(row(7, 9, 2), [1.0, 27.0, 63.0, 29.0, 0.0]);
        assert_eq!(row(1, 3, 2), [0.0, 30.0, 60.0, 30.0, 0.0]);
    }

    /// The system's rows applied to the solution give the samples back. Every row is dominant by a factor of 5/3 (cubic)
    /// or 2/15 of its diagonal (quintic, row 7/8), so the residual is a few ε of the largest sample.
    #[test]
    fn solutions_satisfy_the_system() {
        for pad in [1, 2] {
            let scale = if pad == 1 { 6.0 } else { 120.0 };
            for n in [3, 4, 5, 6, 7, 20, 101] {
                let samples: Vec<f64> = (0..n).map(|i| ((i * 7919 + 3) % 101) as f64).collect();
                let mut c = samples.clone();
                let filter = Prefilter::<f64>::new(n, pad).unwrap();
                filter.solve_line(&mut c);
                for i in 0..n {
                    let sum: f64 = (0..5)
                        .map(|k| (k, row(i, n, pad)[k]))
                        .filter(|r| r.1 != 0.0)
                        .map(|(k, a)| a * c[i + k - 2])
                        .sum();
                    let bound = 64.0 * f64::EPSILON * c.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
                    assert!((sum / scale - samples[i]).abs() <= bound, "{pad} {n} {i}: {sum}");
                }
                // Three lines side by side are solved as each by itself, bit for bit.
                let mut lanes: Vec<f64> = samples.iter().flat_map(|&s| [s, -s, 2.0 * s]).collect();
                filter.solve_lanes(&mut lanes, 3);
                let want: Vec<f64> = c.iter().flat_map(|&s| [s, -s, 2.0 * s]).collect();
                assert_eq!(lanes, want);
            }
        }
        assert!(Prefilter::<f64>::new(2, 1).is_none() && Prefilter::<f64>::new(1, 2).is_none());
    }
}
