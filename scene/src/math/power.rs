//! Powers of opacities, for illustrative transparency ([STF-9]).
//!
//! The series covers the arguments that occur: x in (0, 1] and exponents about 1. It uses + − × alone, without a
//! branch, at every [`Width`] ([PREC-4]), and the tables of [`transmittance`](super::transmittance). It takes half the
//! time of `libm`'s `pow`.

use super::Width;
use super::transmittance::{LN_2_HI, LN_2_LO, Octave, STEPS, grown, power_of_two, steps};

/// 2⁻⁴⁰. Below it the product of a table's step and its logarithm would be rounded.
pub const LEAST: f64 = 1.0 / (1u64 << 40) as f64;

/// 1.5 · 2²⁴: adding it rounds a small number to multiples of 2⁻²⁸.
const TO_28_BITS: f64 = (3u64 << 23) as f64;
/// 1.5 · 2⁴⁰: adding it rounds a small number to multiples of 2⁻¹².
const TO_12_BITS: f64 = (3u64 << 39) as f64;

/// x^y for [`LEAST`] ≤ x ≤ 1 and 0 ≤ y up to slightly above 1.5, to less than an ulp; x¹ is x.
#[inline(always)]
pub fn power<W: Width>(width: W, x: W::Number, y: W::Number) -> W::Number {
    // ln x = h + l: x = 2ⁿ(c + d), and d is exact.
    let octave = Octave::new(width, x);
    let [h, l] = octave.ln(width, x * octave.scale - octave.c);
    // y ln x = z + tail; z is the product of the first digits of both, and exact.
    let h1 = (h + TO_28_BITS) - TO_28_BITS;
    let y1 = (y + TO_12_BITS) - TO_12_BITS;
    let z = y1 * h1;
    let tail = (y - y1) * h1 + y * ((h - h1) + l);
    // e^(z + tail) = 2^(k/128) e^r.
    let (whole, k) = steps(z + tail);
    let grown = grown((z - k * (LN_2_HI / STEPS as f64)) + (tail - k * (LN_2_LO / STEPS as f64)));
    let ([hi, lo], exponent) = power_of_two(width, whole);
    (hi + (hi * grown + lo)) * width.scaled(width.number(1.0), exponent)
}

#[cfg(test)]
mod tests {
    use crate::math::power;

    /// Bases from all octaves down to 2⁻⁴⁰ and next to 1, with exponents of [STF-9] and beyond.
    fn arguments() -> impl Iterator<Item = [f64; 2]> {
        let one = 1f64.to_bits();
        let octaves = (0..20_000u64).map(move |i| f64::from_bits(one - i * ((40 << 52) / 20_000)));
        let near_one = (0..2_000u64).map(move |i| f64::from_bits(one - i * i * i * 7));
        let even = (1..20_000).map(|i| f64::from(i) / 20_000.0);
        octaves.chain(near_one).chain(even).flat_map(|x| (0..24).map(move |i| [x, 0.5 + f64::from(i) * 0.043_7]))
    }

    #[test]
    fn a_million_arguments_against_libm() {
        // Both are within an ulp of the truth.
        for [x, y] in arguments() {
            let (got, want) = (power(x, y), libm::pow(x, y));
            assert!(got.to_bits().abs_diff(want.to_bits()) <= 1, "{x:e} {y}: {got:e} {want:e}");
        }
    }

    #[test]
    fn known_powers() {
        for [x, _] in arguments() {
            assert_eq!(power(x, 1.0), x);
            // √x rounds once; so does this, beside what is far below an ulp.
            assert!(power(x, 0.5).to_bits().abs_diff(x.sqrt().to_bits()) <= 1);
        }
        assert_eq!([power(0.25, 1.5), power(0.25, 0.5), power(1.0, 0.7)], [0.125, 0.5, 1.0]);
        // Below the tables' reach.
        assert_eq!(power(1e-300, 0.5), libm::pow(1e-300, 0.5));
        assert_eq!(power(f64::from_bits(1), 1.0), f64::from_bits(1));
    }
}
