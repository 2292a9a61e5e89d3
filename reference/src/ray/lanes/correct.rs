//! [`Correction`](crate::ray::opacity::Correction) in lanes.

use crate::number::lanes::Eight;
use drypoint_scene::math::transmittance::{ln_one_minus, one_minus_exp, one_minus_root};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8};

/// α(Δ) for opacities in [0, 1] and Δ/Δ₀ of each lane.
#[inline(always)]
pub(super) fn correct<S: Simd>(alpha: f64x8<S>, ratio: f64x8<S>) -> f64x8<S> {
    let simd = alpha.simd;
    let (zero, one) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, 1.0));
    let opaque = alpha.simd_ge(1.0);
    let between = opaque.select(zero, alpha);
    let half = ratio.simd_eq(0.5);
    let corrected = if half.all_true() {
        one_minus_root(Eight(simd), between)
    } else {
        let mut corrected = one_minus_exp(Eight(simd), ratio * ln_one_minus(Eight(simd), between));
        if half.any_true() {
            corrected = half.select(one_minus_root(Eight(simd), between), corrected);
        }
        ratio.simd_eq(1.0).select(alpha, corrected)
    };
    opaque.select(one, alpha.simd_le(0.0).select(zero, corrected))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::lanes::LANES;
    use crate::ray::opacity::Correction;
    use fearless_simd::{Level, dispatch};

    /// Opacities of all sizes, with the ends, at steps of all kinds: bit for bit what one opacity becomes alone.
    #[test]
    fn lanes_take_the_steps_of_one() {
        let level = Level::new();
        let one = 1f64.to_bits();
        let even = (0..4096u64).map(|i| i as f64 / 4095.0);
        let by_exponent = (0..4096u64).map(|i| f64::from_bits(one / 4096 * i));
        let near_one = (0..64u64).map(|i| f64::from_bits(one - i));
        let opacities: Vec<f64> = even.chain(by_exponent).chain(near_one).collect();
        for ratio in [1.0, 0.5, 0.487_3, 2.0, 1e-9, 700.0] {
            for opacities in opacities.chunks_exact(LANES) {
                let alpha: [f64; LANES] = std::array::from_fn(|lane| opacities[lane]);
                let got: [f64; LANES] = dispatch!(level, simd => {
                    correct(alpha.simd_into(simd), f64x8::splat(simd, ratio)).into()
                });
                let want = alpha.map(|a| Correction::new(ratio).apply(a));
                assert_eq!(got.map(f64::to_bits), want.map(f64::to_bits), "{alpha:?} {ratio}");
            }
        }
    }
}
