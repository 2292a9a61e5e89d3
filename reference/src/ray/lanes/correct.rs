//! [`Correction`](crate::ray::opacity::Correction) in lanes.

use crate::number::lanes::look_up;
use drypoint_scene::math::transmittance::{LN_2_HI, LN_2_LO, LOGARITHMS, POWERS, STEPS, STEPS_BITS, TO_WHOLE};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8};

const MANTISSA_BITS: u32 = f64::MANTISSA_DIGITS - 1;

/// α(Δ) for opacities in [0, 1] and Δ/Δ₀ of each lane.
#[inline(always)]
pub(super) fn correct<S: Simd>(alpha: f64x8<S>, ratio: f64x8<S>) -> f64x8<S> {
    let simd = alpha.simd;
    let (zero, one) = (f64x8::splat(simd, 0.0), f64x8::splat(simd, 1.0));
    let opaque = alpha.simd_ge(1.0);
    let between = opaque.select(zero, alpha);
    let half = ratio.simd_eq(0.5);
    let corrected = if half.all_true() {
        half_step(between)
    } else {
        let mut corrected = one_minus_exp(ratio * ln_one_minus(between));
        if half.any_true() {
            corrected = half.select(half_step(between), corrected);
        }
        ratio.simd_eq(1.0).select(alpha, corrected)
    };
    opaque.select(one, alpha.simd_le(0.0).select(zero, corrected))
}

/// The steps of [`math::one_minus_root`](drypoint_scene::math::one_minus_root).
#[inline(always)]
fn half_step<S: Simd>(alpha: f64x8<S>) -> f64x8<S> {
    let one = f64x8::splat(alpha.simd, 1.0);
    alpha / (one + (one - alpha).sqrt())
}

/// The steps of [`math::ln_one_minus`](drypoint_scene::math::ln_one_minus).
#[inline(always)]
fn ln_one_minus<S: Simd>(alpha: f64x8<S>) -> f64x8<S> {
    let simd = alpha.simd;
    let nearest = (f64x8::splat(simd, 1.0) - alpha).to_bits() + (1u64 << (MANTISSA_BITS - STEPS_BITS - 1));
    let step = (nearest >> (MANTISSA_BITS - STEPS_BITS)) & (STEPS as u64 - 1);
    // The exponent with its bias of 1023.
    let exponent = nearest >> MANTISSA_BITS;
    let whole = (1u64 << MANTISSA_BITS) as f64;
    let n = f64x8::from_bits(exponent | whole.to_bits()) - (whole + 1023.0);
    let scale = f64x8::from_bits(((exponent ^ 2047) - 1) << MANTISSA_BITS);
    let c = f64x8::from_bits((step << (MANTISSA_BITS - STEPS_BITS)) | 1f64.to_bits());
    let d = (scale - c) - scale * alpha;
    let [inverse, ln_hi, ln_lo] = look_up(simd, &LOGARITHMS, step.into());
    let r = d * inverse;
    let r2 = r * r;
    let series = (r * (1.0 / 3.0) + -0.5) + r2 * ((r * 0.2 + -0.25) + r2 * (r * (1.0 / 7.0) + -1.0 / 6.0));
    (n * LN_2_HI + ln_hi) + (r + ((n * LN_2_LO + ln_lo) + r2 * series))
}

/// The steps of [`math::one_minus_exp`](drypoint_scene::math::one_minus_exp).
#[inline(always)]
fn one_minus_exp<S: Simd>(y: f64x8<S>) -> f64x8<S> {
    let simd = y.simd;
    let y = y.simd_gt(-64.0).select(y, f64x8::splat(simd, -64.0));
    let whole = y * (STEPS as f64 * std::f64::consts::LOG2_E) + TO_WHOLE;
    let k = whole - TO_WHOLE;
    let r = (y - k * (LN_2_HI / STEPS as f64)) - k * (LN_2_LO / STEPS as f64);
    let r2 = r * r;
    let series = (r * (1.0 / 6.0) + 0.5) + r2 * ((r * (1.0 / 120.0) + 1.0 / 24.0) + r2 * (1.0 / 720.0));
    let grown = r + r2 * series;
    let k = whole.to_bits();
    let exponent = (k >> STEPS_BITS) << MANTISSA_BITS;
    let [hi, lo] = look_up(simd, &POWERS, (k & (STEPS as u64 - 1)).into());
    let hi = f64x8::from_bits(hi.to_bits() + exponent);
    let scale = f64x8::from_bits(exponent + 1f64.to_bits());
    (f64x8::splat(simd, 1.0) - hi) - (hi * grown + scale * lo)
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
