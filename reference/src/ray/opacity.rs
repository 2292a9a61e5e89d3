//! Opacity correction ([VAL-4]).

use crate::number::{Double, Mask, Real};
use drypoint_scene::math::transmittance;

/// Converts an opacity α per reference length Δ₀ to that of one step: α(Δ) = 1 − (1 − α)^(Δ/Δ₀), computed as
/// −expm1(Δ/Δ₀ · ln_1p(−α)). This is exact at α = 0 and α = 1, and without cancellation for tiny α. Half of Δ₀, a
/// common step, needs only a square root. A step of Δ₀ leaves α unchanged.
#[inline(always)]
pub(super) fn correct<A: Double>(alpha: A, ratio: A) -> A {
    let (zero, one, width) = (alpha.zero(), alpha.one(), alpha.width());
    let (clear, opaque) = (alpha.at_most(zero), one.at_most(alpha));
    let (whole, half) = (ratio.equals(one), ratio.equals(one.half()));
    // The logarithm of an opaque sample is not finite.
    let between = A::select(opaque, zero, alpha);
    let mut corrected = alpha;
    if !(clear | opaque | whole).all() {
        if !half.all() {
            let ln = transmittance::ln_one_minus(width, between);
            corrected = A::select(whole, alpha, transmittance::one_minus_exp(width, ratio * ln));
        }
        if half.any() {
            corrected = A::select(half, transmittance::one_minus_root(width, between), corrected);
        }
    }
    A::select(clear, zero, A::select(opaque, one, corrected))
}

/// The correction of one ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Correction {
    /// Δ/Δ₀.
    ratio: f64,
}

impl Correction {
    /// The correction for Δ_ray/Δ₀.
    pub fn new(ratio: f64) -> Self {
        Self { ratio }
    }

    /// α(Δ). For f32 it is computed in f64 and rounded once.
    #[inline]
    pub fn apply<R: Real>(self, alpha: R) -> R {
        R::monotone([alpha], |[alpha]| correct(alpha, self.ratio))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::lanes::LANES;
    use crate::number::lanes::testing::same;
    use fearless_simd::prelude::*;
    use fearless_simd::{Level, dispatch, f64x8};

    fn correct(alpha: f64, ratio: f64) -> f64 {
        Correction::new(ratio).apply(alpha)
    }

    #[test]
    fn ends_halves_and_tiny_opacities() {
        for ratio in [1.0, 0.5, 0.125, 0.37, 2.5] {
            assert_eq!(correct(0.0, ratio), 0.0);
            assert_eq!(correct(1.0, ratio), 1.0);
        }
        assert_eq!(correct(0.3, 1.0), 0.3);
        // Two half steps of 1 − √¼ = ½ make one of ¾; four roundings.
        assert!((correct(0.75, 0.5) - 0.5).abs() <= 2.0 * f64::EPSILON);
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
    fn halves_agree_with_square_roots() {
        // α/(1 + √(1 − α)) rounds four times; the logarithm, the product and the power of any other ratio add up to four
        // last places. From α near 1 the neighbours of ½ part by ln(1 − α) times as much as they differ.
        for i in 1..1000 {
            let alpha = f64::from(i) / 1000.0;
            let (got, want) = (correct(alpha, 0.5f64.next_up()), correct(alpha, 0.5));
            // Near α = 1 both see 1 − α, whose relative rounding the powers shrink.
            assert!((got - want).abs() <= 6.0 * f64::EPSILON * want, "{alpha}: {got} {want}");
            // f32 is that, rounded.
            let alpha = alpha as f32;
            assert_eq!(Correction::new(0.53).apply(alpha), correct(f64::from(alpha), 0.53) as f32);
        }
    }

    /// Opacities of all sizes, with the ends, at steps of all kinds: bit for bit what one opacity becomes alone.
    #[test]
    fn lanes_take_the_steps_of_one() {
        let level = Level::new();
        let one = 1f64.to_bits();
        let even = (0..4096u64).map(|i| i as f64 / 4095.0);
        let by_exponent = (0..4096u64).map(|i| f64::from_bits(one / 4096 * i));
        let near_one = (0..64u64).map(|i| f64::from_bits(one - i));
        let opacities: Vec<f64> = even.chain(by_exponent).chain(near_one).collect();
        let ratios = [1.0, 0.5, 0.487_3, 2.0, 1e-9, 700.0];
        // The same in all lanes, then each its own.
        let together = ratios.map(|ratio| [ratio; LANES]);
        let apart: [[f64; LANES]; 6] =
            std::array::from_fn(|turn| std::array::from_fn(|lane| ratios[(turn + lane) % 6]));
        for ratio in together.into_iter().chain(apart) {
            for opacities in opacities.chunks_exact(LANES) {
                let alpha: [f64; LANES] = std::array::from_fn(|lane| opacities[lane]);
                let got: [f64; LANES] = dispatch!(level, simd => {
                    super::correct::<f64x8<_>>(alpha.simd_into(simd), ratio.simd_into(simd)).into()
                });
                same(got, |lane| correct(alpha[lane], ratio[lane]));
            }
        }
    }
}
