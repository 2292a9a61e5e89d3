//! Derivatives of the prefiltered cubic B-spline of the grid smoothed by a Gaussian ([REC-3]).

use crate::field::FieldError;
use crate::field::coefficients::Coefficients;
use crate::field::stencil::Stencils;
use crate::number::Real;
use drypoint_scene::math;
use drypoint_scene::space::Grid;

/// The longest σ, in voxels of an axis. A longer Gaussian has more taps than a volume has voxels.
const LONGEST: f64 = 1000.0;

/// Weights at 0, 1, … ⌊4σ⌋ voxels along each axis, for σ = `scale` in world units.
///
/// # Errors
/// A scale that is negative, not a number, or longer than 1000 voxels.
pub(in crate::field) fn taps(grid: &Grid, scale: f64) -> Result<[Vec<f64>; 3], FieldError> {
    let sigma = grid.spacing().map(|spacing| scale / spacing);
    if !(scale >= 0.0 && sigma.iter().all(|&s| s <= LONGEST)) {
        return Err(FieldError::Scale {
            scale,
            longest: LONGEST * grid.spacing().into_iter().fold(f64::INFINITY, f64::min),
        });
    }
    Ok(sigma.map(half_taps))
}

/// The coefficients of the volume smoothed with the taps of each axis.
pub(in crate::field) fn smoothed<R: Real>(stencils: &Stencils<'_>, taps: &[Vec<f64>; 3]) -> Coefficients<R> {
    let mut coefficients = Coefficients::of_voxels(stencils, 1);
    for (axis, half) in taps.iter().enumerate() {
        let n = stencils.dims()[axis];
        if n > 1 && half.len() > 1 {
            let rows: Vec<_> = (0..n).map(|i| row(half, i, n)).collect();
            coefficients = coefficients.convolve(axis, &rows);
        }
    }
    coefficients.prefilter()
}

/// Weights at 0, 1, … ⌊4σ⌋, normalized over all taps on both sides.
pub(in crate::field) fn half_taps(sigma: f64) -> Vec<f64> {
    // σ = 0 has one tap, which leaves the samples unchanged.
    let reach = (4.0 * sigma) as usize;
    let weight = |k: usize| if k == 0 { 1.0 } else { math::exp(-0.5 * (k as f64 / sigma) * (k as f64 / sigma)) };
    let half: Vec<f64> = (0..=reach).map(weight).collect();
    let sum = half[0] + 2.0 * half[1..].iter().rev().sum::<f64>();
    half.iter().map(|w| w / sum).collect()
}

/// The weights of smoothed sample i of a line of n ≥ 2, and the first sample that they apply to. Taps beyond the border
/// add to the weights of the samples from which the line is extrapolated.
pub(in crate::field) fn row<R: Real>(half: &[f64], i: usize, n: usize) -> (usize, Vec<R>) {
    let reach = half.len() - 1;
    let short = n.min(3);
    // If a tap falls outside, the three samples at that border are read too.
    let (mut first, mut end) = (i.saturating_sub(reach), (i + reach + 1).min(n));
    if i < reach {
        end = end.max(short);
    }
    if i + reach >= n {
        first = first.min(n - short);
    }
    // Each tap counts at its own sample. Taps outside count by extrapolation at the three samples next to the border.
    let mut weights = vec![0.0; end - first];
    for (k, &w) in half.iter().enumerate() {
        if k > 0 && i < k {
            let beyond = extrapolation(k - i, n);
            (0..short).for_each(|c| weights[c] += w * beyond[c]);
        } else if k > 0 {
            weights[i - k - first] += w;
        }
        if i + k >= n {
            let beyond = extrapolation(i + k - (n - 1), n);
            (0..short).for_each(|c| weights[n - 1 - c - first] += w * beyond[c]);
        } else {
            weights[i + k - first] += w;
        }
    }
    (first, weights.into_iter().map(R::from_f64).collect())
}

/// Weights of the three samples nearest to a border in the sample k steps beyond it. The sample lies on the parabola
/// through the three, as after applying c₋₁ = 3c₀ − 3c₁ + c₂ k times. Two samples are continued by their line.
fn extrapolation(k: usize, n: usize) -> [f64; 3] {
    let k = k as f64;
    if n == 2 {
        return [1.0 + k, -k, 0.0];
    }
    [(k + 1.0) * (k + 2.0) / 2.0, -k * (k + 2.0), k * (k + 1.0) / 2.0]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extrapolation_is_the_recurrence_applied_again_and_again() {
        let mut c = vec![[0.0, 0.0, 1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]];
        for k in 1..6 {
            let n = c.len();
            c.push([0, 1, 2].map(|i| 3.0 * c[n - 1][i] - 3.0 * c[n - 2][i] + c[n - 3][i]));
            assert_eq!(extrapolation(k, 9), c[n]);
        }
        assert_eq!(extrapolation(2, 2), [3.0, -2.0, 0.0]);
    }

    #[test]
    fn taps_reach_four_sigma_and_sum_to_one() {
        let half = half_taps(1.0);
        assert_eq!(half.len(), 5);
        let sum = half[0] + 2.0 * half[1..].iter().sum::<f64>();
        assert!((sum - 1.0).abs() <= 4.0 * f64::EPSILON);
        // e^(−½): the ratio of neighbouring weights at 0 and σ.
        assert!((half[1] / half[0] - 0.6065306597126334).abs() < 1e-15);
        assert_eq!(half_taps(0.2), [1.0]);
        assert_eq!(half_taps(0.0), [1.0]);
    }

    /// Every smoothed sample of a quadratic is the quadratic plus the variance of the taps, at the border too.
    #[test]
    fn quadratics_stay_quadratics() {
        for n in [3, 4, 9, 40] {
            let half = half_taps(1.7);
            let variance = 2.0 * half.iter().enumerate().map(|(k, w)| w * (k * k) as f64).sum::<f64>();
            for i in 0..n {
                let (first, weights) = row::<f64>(&half, i, n);
                let square = |x: usize| (x * x) as f64;
                let got: f64 = weights.iter().enumerate().map(|(k, w)| w * square(first + k)).sum();
                // Extrapolation weights grow with the square of the reach, 7 taps: up to 36, times values up to n².
                let bound = 36.0 * 16.0 * square(n) * f64::EPSILON;
                assert!((got - square(i) - variance).abs() < bound, "{n} {i}: {got}");
            }
        }
    }
}
