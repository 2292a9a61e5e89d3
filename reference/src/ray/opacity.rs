//! Opacity correction ([VAL-4]).

use crate::number::Real;

/// From an opacity α per reference length Δ₀ to that of one step: α(Δ) = 1 − (1 − α)^(Δ/Δ₀), exact at α = 0 and α = 1
/// and without cancellation for tiny α.
///
/// Three ways to the same number, chosen once a ray. A step of Δ₀ leaves α as it is; steps of ½, ¼, … of it need
/// square roots alone, 1 − √(1 − α) = α/(1 + √(1 − α)), once for each halving; any other takes −expm1(Δ/Δ₀ · ln_1p(−α)).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Correction<R> {
    /// Δ = Δ₀ · 2^−n, n at most [`MOST_HALVINGS`].
    Halvings(u32),
    /// Any other Δ/Δ₀.
    Ratio(R),
}

/// Each halving rounds a few times: beyond these the logarithm is as fast and more exact.
pub const MOST_HALVINGS: u32 = 3;

impl<R: Real> Correction<R> {
    /// For Δ_ray/Δ₀.
    pub fn new(ratio: f64) -> Self {
        (0..=MOST_HALVINGS)
            .find(|&n| ratio * f64::from(1 << n) == 1.0)
            .map_or_else(|| Self::Ratio(R::from_f64(ratio)), Self::Halvings)
    }

    /// α(Δ).
    #[inline]
    pub fn apply(self, alpha: R) -> R {
        match self {
            Self::Halvings(n) => {
                let mut alpha = alpha;
                for _ in 0..n {
                    alpha = alpha / (R::ONE + (R::ONE - alpha).sqrt());
                }
                alpha
            }
            Self::Ratio(ratio) => {
                if alpha <= R::ZERO {
                    R::ZERO
                } else if alpha >= R::ONE {
                    R::ONE
                } else {
                    -(ratio * (-alpha).ln_1p()).exp_m1()
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn correct(alpha: f64, ratio: f64) -> f64 {
        Correction::new(ratio).apply(alpha)
    }

    #[test]
    fn ends_halves_and_tiny_opacities() {
        for ratio in [1.0, 0.5, 0.125, 0.37, 2.5] {
            assert_eq!(correct(0.0, ratio), 0.0);
            assert_eq!(correct(1.0, ratio), 1.0);
        }
        // Two half steps of 1 − √¼ = ½ make one of ¾.
        assert_eq!(correct(0.75, 0.5), 0.5);
        assert_eq!(correct(0.3, 1.0), 0.3);
        // To first order the correction of a tiny opacity is ratio·α; its second order is α²/8.
        for ratio in [0.5, 0.49] {
            assert!((correct(1e-12, ratio) / (ratio * 1e-12) - 1.0).abs() < 1e-11);
        }
    }

    #[test]
    fn steps_compose() {
        // n corrections to Δ/n leave the transmittance of one Δ, whatever α.
        for alpha in [1e-9, 0.01, 0.3, 0.9, 0.999_999] {
            for n in [2, 3, 8, 100] {
                let a = correct(alpha, 1.0 / f64::from(n));
                let left = 1.0 - (1.0 - a).powi(n);
                assert!((left - alpha).abs() <= 4.0 * f64::from(n) * f64::EPSILON, "{alpha} {n}: {left}");
            }
        }
    }

    #[test]
    fn halvings_agree_with_the_logarithm() {
        // Each halving rounds three times, the logarithm's way about as often; relative to the result.
        for n in 0..=MOST_HALVINGS {
            let ratio = 1.0 / f64::from(1 << n);
            assert_eq!(Correction::<f64>::new(ratio), Correction::Halvings(n));
            for i in 1..1000 {
                let alpha = f64::from(i) / 1000.0;
                let (a, b) = (correct(alpha, ratio), Correction::Ratio(ratio).apply(alpha));
                // Near α = 1 both see 1 − α, whose relative rounding the powers shrink.
                assert!((a - b).abs() <= 8.0 * f64::EPSILON * a, "{n} {alpha}: {a} {b}");
            }
        }
    }
}
