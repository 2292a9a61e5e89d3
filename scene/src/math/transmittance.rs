//! The logarithm of a transmittance and the way back, for opacity correction ([VAL-4]).
//!
//! The series cover the arguments that occur: 0 ≤ α < 1 and y ≤ 0. They use + − × alone, without a branch, at every
//! [`Width`] ([PREC-4]). Latency counts, since compositing waits for the result. Table steps of 2⁻⁷ leave polynomials
//! so short that both together take half as long as `libm`'s `log1p` and `expm1`.

use super::Width;
use super::double::Double;
use std::ops::{Add, Mul, Sub};

/// Steps of an octave in the tables.
pub(super) const STEPS: usize = 128;
/// Bits that count them.
const STEPS_BITS: u32 = STEPS.trailing_zeros();
const MANTISSA_BITS: u32 = f64::MANTISSA_DIGITS - 1;

/// ln 2 = [`LN_2_HI`] + [`LN_2_LO`]; the first has 40 bits, so that its product with a whole number below 2¹³ is exact.
pub(super) const LN_2_HI: f64 = 0.693_147_180_559_208_2;
/// The rest of ln 2 beyond [`LN_2_HI`].
pub(super) const LN_2_LO: f64 = 7.371_002_565_167_799e-13;

/// 1.5 · 2⁵²: a small number that is added leaves its nearest whole number in the low bits of the sum.
pub(super) const TO_WHOLE: f64 = (3u64 << 51) as f64;

/// 1/c and ln c for c = 1 + i/128, the logarithm in two parts. The first part is a multiple of 2⁻⁴⁴, so that adding
/// multiples of ln 2's first part to it is exact.
static LOGARITHMS: [[f64; 3]; STEPS] = {
    let mut table = [[0.0; 3]; STEPS];
    let mut i = 0;
    while i < STEPS {
        let c = (STEPS + i) as f64 / STEPS as f64;
        let ln = Double::ln_ratio(c, 1.0);
        /// Adding it rounds to multiples of 2⁻⁴⁴.
        const COARSE: f64 = (3 << 7) as f64;
        let hi = (ln.hi + COARSE) - COARSE;
        table[i] = [1.0 / c, hi, (ln.hi - hi) + ln.lo];
        i += 1;
    }
    table
};

/// 2^(i/128) in two parts.
static POWERS: [[f64; 2]; STEPS] = {
    let factor = Double::ln_ratio(2.0, 1.0).over(STEPS as f64).exp_m1().plus(Double::new(1.0));
    let mut table = [[0.0; 2]; STEPS];
    let mut power = Double::new(1.0);
    let mut i = 0;
    while i < STEPS {
        table[i] = [power.hi, power.lo];
        power = power.times(factor);
        i += 1;
    }
    table
};

/// The nearest step of the tables to positive normal numbers: c of 2ⁿc, read off their bits.
pub(super) struct Octave<W: Width> {
    n: W::Number,
    /// 2⁻ⁿ.
    pub(super) scale: W::Number,
    pub(super) c: W::Number,
    /// The row of c.
    step: W::Bits,
}

impl<W: Width> Octave<W> {
    #[inline(always)]
    pub(super) fn new(width: W, x: W::Number) -> Self {
        let nearest = width.bits(x) + (1 << (MANTISSA_BITS - STEPS_BITS - 1));
        let step = (nearest >> (MANTISSA_BITS - STEPS_BITS)) & (STEPS as u64 - 1);
        // The exponent with its bias of 1023: in the low bits of 2⁵² it is a number, and 2046 minus it is that of 2⁻ⁿ.
        let exponent = nearest >> MANTISSA_BITS;
        let whole = (1u64 << MANTISSA_BITS) as f64;
        Self {
            n: width.of_bits(exponent | whole.to_bits()) - (whole + 1023.0),
            scale: width.of_bits(((exponent ^ 2047) - 1) << MANTISSA_BITS),
            c: width.of_bits((step << (MANTISSA_BITS - STEPS_BITS)) | 1f64.to_bits()),
            step,
        }
    }

    /// ln(2ⁿ(c + d)) = n ln 2 + ln c + ln(1 + r), r = d/c, |d| ≤ 2⁻⁸, in two parts; the first is exact.
    #[inline(always)]
    pub(super) fn ln(&self, width: W, d: W::Number) -> [W::Number; 2] {
        let [inverse, ln_hi, ln_lo] = width.look_up(&LOGARITHMS, self.step);
        let r = d * inverse;
        let r2 = r * r;
        let series = (r * (1.0 / 3.0) + -0.5) + r2 * ((r * 0.2 + -0.25) + r2 * (r * (1.0 / 7.0) + -1.0 / 6.0));
        [self.n * LN_2_HI + ln_hi, r + ((self.n * LN_2_LO + ln_lo) + r2 * series)]
    }
}

/// The nearest k to 128y/ln 2: in the low bits of a number, and as a number. Then y = k ln 2/128 + r, |r| ≤ ln 2/256.
#[inline(always)]
pub(super) fn steps<N>(y: N) -> (N, N)
where
    N: Copy + Add<f64, Output = N> + Sub<f64, Output = N> + Mul<f64, Output = N>,
{
    let whole = y * (STEPS as f64 * std::f64::consts::LOG2_E) + TO_WHOLE;
    (whole, whole - TO_WHOLE)
}

/// e^r − 1 for |r| ≤ ln 2/256.
#[inline(always)]
pub(super) fn grown<N>(r: N) -> N
where
    N: Copy + Add<Output = N> + Mul<Output = N> + Add<f64, Output = N> + Mul<f64, Output = N>,
{
    let r2 = r * r;
    let series = (r * (1.0 / 6.0) + 0.5) + r2 * ((r * (1.0 / 120.0) + 1.0 / 24.0) + r2 * (1.0 / 720.0));
    r + r2 * series
}

/// 2^(k/128) for the k of [`steps`] in the low bits of a number: the two parts that its table has, and the exponent that they
/// have to be scaled by.
#[inline(always)]
pub(super) fn power_of_two<W: Width>(width: W, whole: W::Number) -> ([W::Number; 2], W::Bits) {
    let k = width.bits(whole);
    (width.look_up(&POWERS, k & (STEPS as u64 - 1)), (k >> STEPS_BITS) << MANTISSA_BITS)
}

/// ln(1 − α) for 0 ≤ α < 1, to less than an ulp; −α where α is tiny.
#[inline(always)]
pub fn ln_one_minus<W: Width>(width: W, alpha: W::Number) -> W::Number {
    // 1 − α = 2ⁿ(c + d), c the nearest step, read off 1 − α rounded. 2⁻ⁿ − c has few bits and d is at most 2⁻⁸, so that
    // 2⁻ⁿ − c − 2⁻ⁿα, computed from left to right, is d exactly. Up to α = 2⁻⁹ n and ln c are 0 and r = −α.
    let octave = Octave::new(width, width.number(1.0) - alpha);
    let [hi, lo] = octave.ln(width, (octave.scale - octave.c) - octave.scale * alpha);
    hi + lo
}

/// 1 − e^y for y ≤ 0, to less than two ulp; −y where y is tiny.
#[inline(always)]
pub fn one_minus_exp<W: Width>(width: W, y: W::Number) -> W::Number {
    // Beyond this the result is 1.
    let least = width.number(-64.0);
    let y = width.select(width.below(least, y), y, least);
    // e^y = 2^(k/128) e^r.
    let (whole, k) = steps(y);
    let grown = grown((y - k * (LN_2_HI / STEPS as f64)) - k * (LN_2_LO / STEPS as f64));
    let ([hi, lo], exponent) = power_of_two(width, whole);
    let (hi, one) = (width.scaled(hi, exponent), width.number(1.0));
    (one - hi) - (hi * grown + width.scaled(one, exponent) * lo)
}

/// 1 − √(1 − α) for 0 ≤ α ≤ 1, as α/(1 + √(1 − α)): to less than two ulp, without cancellation.
#[inline(always)]
pub fn one_minus_root<W: Width>(width: W, alpha: W::Number) -> W::Number {
    let one = width.number(1.0);
    alpha / (one + width.sqrt(one - alpha))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::{ln_one_minus, one_minus_exp, one_minus_root};

    /// N numbers in (0, 1) in ascending order. They are even steps through the bit patterns, which are steps of the
    /// logarithm down to the smallest number; even steps of the number itself; and even steps of the logarithm of the
    /// distance to 1.
    fn opacities(n: u64) -> Vec<f64> {
        let one = 1f64.to_bits();
        let third = n / 3;
        let mut all: Vec<f64> = (0..third)
            .flat_map(|i| {
                let by_exponent = f64::from_bits(1 + (one - 2) / third * i);
                let even = (i as f64 + 0.5) / third as f64;
                let left = f64::from_bits(one - (54 << 52) / third * i - 1);
                [by_exponent, even, 1.0 - left]
            })
            .filter(|&a| 0.0 < a && a < 1.0)
            .collect();
        all.sort_by(f64::total_cmp);
        all
    }

    /// The distance of two numbers of one sign in units of the last place.
    fn apart(a: f64, b: f64) -> u64 {
        a.abs().to_bits().abs_diff(b.abs().to_bits())
    }

    /// The error of a number, in its own units of the last place.
    fn ulps(got: f64, truth: Double) -> f64 {
        let ulp = got.abs().next_up() - got.abs();
        (((got - truth.hi) - truth.lo) / ulp).abs()
    }

    #[test]
    fn a_million_arguments_against_libm() {
        // libm's own two functions are within an ulp.
        for alpha in opacities(1_000_000) {
            let y = ln_one_minus(alpha);
            assert!(apart(y, libm::log1p(-alpha)) <= 1, "{alpha:e}");
            let y = 0.53 * y;
            assert!(apart(one_minus_exp(y), -libm::expm1(y)) <= 2, "{y:e}");
        }
    }

    #[test]
    fn errors_against_twice_the_digits() {
        // Below the half ulp of the last rounding: r, then 2⁻⁹ of it squared, and the sum before the last; for the power
        // also the last place of the product, which near 1 is that of the difference.
        let mut worst = [0.0f64; 2];
        // Where products of halves of the digits do not underflow.
        for alpha in opacities(60_000).into_iter().filter(|&a| a > 1e-200) {
            let ln = ln_one_minus(alpha);
            // Newton's step from there: ln + (1 − α)e^−ln − 1.
            let e = Double::new(-ln).exp_m1();
            let rest = e.plus(Double::new(-alpha)).plus(e.times(Double::new(-alpha)));
            worst[0] = worst[0].max(ulps(ln, Double::new(ln).plus(rest)));
            for y in [ln, 0.5 * ln, 0.61 * ln] {
                let e = Double::new(y).exp_m1();
                worst[1] = worst[1].max(ulps(one_minus_exp(y), Double { hi: -e.hi, lo: -e.lo }));
            }
        }
        assert!(worst[0] < 1.0 && worst[1] < 2.0, "{worst:?}");
        // An error near 0 over so many arguments would show that nothing was measured.
        assert!(worst[0] > 0.5 && worst[1] > 0.5, "{worst:?}");
    }

    #[test]
    fn roots_against_twice_the_digits() {
        let mut worst = 0f64;
        for alpha in opacities(60_000).into_iter().filter(|&a| a > 1e-200) {
            // y(2 − y) = α; Newton's step from y.
            let y = one_minus_root(alpha);
            let rest = Double::new(y).times(Double::sum(2.0, -y)).plus(Double::new(-alpha));
            worst = worst.max(ulps(y, Double::new(y).plus(rest.over(2.0 * (y - 1.0)))));
        }
        assert!(worst > 0.5 && worst < 2.0, "{worst}");
        assert_eq!([0.0, 0.75, 1.0].map(one_minus_root), [0.0, 0.5, 1.0]);
    }

    #[test]
    fn ends() {
        assert_eq!(ln_one_minus(0.0), 0.0);
        assert_eq!(one_minus_exp(0.0), 0.0);
        assert_eq!(one_minus_exp(-0.0), 0.0);
        for y in [-38.0, -63.9, -64.0, -1e9, f64::NEG_INFINITY] {
            assert_eq!(one_minus_exp(y), 1.0, "{y}");
        }
        for tiny in [f64::from_bits(1), f64::MIN_POSITIVE, 1e-300, 1e-17] {
            assert_eq!((ln_one_minus(tiny), one_minus_exp(-tiny)), (-tiny, tiny));
        }
        assert!((ln_one_minus(1f64.next_down()) - (0.5 * f64::EPSILON).ln()).abs() < 1e-14);
    }

    /// The result is right to the last place, as far as a function within an ulp can be.
    #[test]
    fn more_opacity_is_less_light() {
        let opacities = opacities(300_000);
        let lns: Vec<f64> = opacities.iter().map(|&a| ln_one_minus(a)).collect();
        let back: Vec<f64> = lns.iter().map(|&y| one_minus_exp(0.53 * y)).collect();
        for i in 1..opacities.len() {
            assert!(lns[i] <= lns[i - 1] || apart(lns[i], lns[i - 1]) <= 1);
            assert!(back[i] >= back[i - 1] || apart(back[i], back[i - 1]) <= 2);
        }
    }
}
