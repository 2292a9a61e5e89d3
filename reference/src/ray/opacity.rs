//! Opacity correction ([VAL-4]).

use crate::number::Real;

/// α(Δ) = 1 − (1 − α)^(Δ/Δ₀) for an opacity α per reference length Δ₀, `ratio` = Δ_ray/Δ₀.
///
/// Exact at α = 0 and α = 1, and without cancellation for tiny α.
#[inline]
pub fn correct<R: Real>(alpha: R, ratio: R) -> R {
    if alpha <= R::ZERO {
        R::ZERO
    } else if alpha >= R::ONE {
        R::ONE
    } else {
        -(ratio * (-alpha).ln_1p()).exp_m1()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_halves_and_tiny_opacities() {
        assert_eq!(correct(0.0, 0.37), 0.0);
        assert_eq!(correct(1.0, 0.37), 1.0);
        // Two half steps of 1 − √¼ = ½ make one of ¾.
        assert!((correct(0.75, 0.5) - 0.5f64).abs() < 1e-16);
        // To first order the correction of a tiny opacity is ratio·α; its second order is α²/8.
        assert!((correct(1e-12, 0.5) / 0.5e-12 - 1.0f64).abs() < 1e-11);
        assert_eq!(correct(5e-324, 0.5), 0.0);
    }

    #[test]
    fn steps_compose() {
        // n corrections to Δ/n leave the transmittance of one Δ, whatever α.
        for alpha in [1e-9, 0.01, 0.3, 0.9, 0.999_999] {
            for n in [2, 3, 8, 100] {
                let a: f64 = correct(alpha, 1.0 / f64::from(n));
                let left = 1.0 - (1.0 - a).powi(n);
                assert!((left - alpha).abs() <= 4.0 * f64::from(n) * f64::EPSILON, "{alpha} {n}: {left}");
            }
        }
    }
}
