//! The angle of a point in the upper half plane, for angles between vectors ([CUR-3]).
//!
//! Computed with + − × ÷ alone, without a branch, at every [`Width`] ([PREC-4]).

use super::Width;
use super::double::Double;
use super::transmittance::TO_WHOLE;
use std::f64::consts::{FRAC_PI_2, PI};

/// Steps of the tangent from 0 to 1.
const STEPS: usize = 64;

/// π/2 − [`FRAC_PI_2`].
const FRAC_PI_2_LO: f64 = 6.123_233_995_736_766e-17;

/// atan(i/64) in two parts.
static ANGLES: [[f64; 2]; STEPS + 1] = {
    let mut table = [[0.0; 2]; STEPS + 1];
    let mut angle = Double::new(0.0);
    let mut i = 0;
    while i < STEPS {
        // atan((i + 1)/64) − atan(i/64) = atan(s), s = 64/(64² + i(i + 1)), by its series.
        let s = Double::new(STEPS as f64).over((STEPS * STEPS + i * (i + 1)) as f64);
        let z = s.times(s);
        let mut sum = Double::new(0.0);
        let mut k = 10;
        while k > 0 {
            k -= 1;
            sum = Double::new(1.0).over((2 * k + 1) as f64).plus(sum.times(z).times(Double::new(-1.0)));
        }
        angle = angle.plus(s.times(sum));
        i += 1;
        table[i] = [angle.hi, angle.lo];
    }
    table
};

/// The angle of (x, y), y ≥ 0, from the x axis, in [0, π], to less than two ulp; 0 at the origin. Small angles keep their
/// digits.
#[inline(always)]
pub fn angle<W: Width>(width: W, y: W::Number, x: W::Number) -> W::Number {
    let zero = width.number(0.0);
    let behind = width.below(x, zero);
    let across = width.select(behind, -x, x);
    let steep = width.below(across, y);
    let (small, large) = (width.select(steep, across, y), width.select(steep, y, across));
    let t = width.select(width.below(zero, large), small / large, zero);
    // atan t = atan c + atan d, c the nearest step and d = (t − c)/(1 + tc).
    let whole = t * STEPS as f64 + TO_WHOLE;
    let c = (whole - TO_WHOLE) * (1.0 / STEPS as f64);
    let d = (t - c) / (t * c + 1.0);
    let [hi, lo] = width.look_up(&ANGLES, width.bits(whole) & 127);
    let d2 = d * d;
    let rest = d - d * d2 * ((d2 * -0.2 + 1.0 / 3.0) + d2 * d2 * (1.0 / 7.0));
    let rest = lo + rest;
    // Folded back: over the diagonal, then over the y axis.
    let (hi, rest) = folded(width, steep, [FRAC_PI_2, FRAC_PI_2_LO], [hi, rest]);
    let (hi, rest) = folded(width, behind, [PI, 2.0 * FRAC_PI_2_LO], [hi, rest]);
    hi + rest
}

/// Where the mask is true, the angle counted from the other end of a quadrant or of a half turn. Angles are in two
/// parts.
#[inline(always)]
fn folded<W: Width>(
    width: W,
    mask: W::Mask,
    [end, end_lo]: [f64; 2],
    [hi, lo]: [W::Number; 2],
) -> (W::Number, W::Number) {
    let (end, end_lo) = (width.number(end), width.number(end_lo));
    (width.select(mask, end - hi, hi), width.select(mask, end_lo - lo, lo))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::angle;

    #[test]
    fn against_libm() {
        // libm's is within an ulp, this one within two.
        for i in 0..200_000 {
            let (sin, cos) = libm::sincos(f64::from(i) * (PI / 199_999.0));
            for (y, x) in
                [(sin.abs(), cos), (sin.abs() * 1e-7, cos), (sin.abs(), cos * 1e-9), (sin.abs() * 3e-150, cos)]
            {
                let (got, want) = (angle(y, x), libm::atan2(y, x));
                assert!(got.to_bits().abs_diff(want.to_bits()) <= 3, "{y:e} {x:e}: {got:e} {want:e}");
            }
        }
    }

    #[test]
    fn on_the_axes_and_between_them() {
        assert_eq!([angle(0.0, 1.0), angle(1.0, 0.0), angle(0.0, -1.0), angle(0.0, 0.0)], [0.0, FRAC_PI_2, PI, 0.0]);
        assert_eq!([angle(2.0, 2.0), angle(0.5, -0.5)], [PI / 4.0, 3.0 * PI / 4.0]);
        assert_eq!(angle(1e-300, 1.0), 1e-300);
    }

    /// The digits of π/4 and of atan ½ beyond those of f64 (OEIS A003881, A073000).
    #[test]
    fn the_table_has_twice_the_digits() {
        assert_eq!(ANGLES[64][0], PI / 4.0);
        assert!((ANGLES[64][1] - 3.061_616_997_868_383e-17).abs() < 1e-31);
        assert_eq!(ANGLES[32][0], 0.463_647_609_000_806_1);
        assert!((ANGLES[32][1] - 2.269_877_745_296_169e-17).abs() < 1e-31);
        for (i, [hi, lo]) in ANGLES.iter().enumerate() {
            // libm's is within an ulp.
            assert!(hi.to_bits().abs_diff(libm::atan(i as f64 / 64.0).to_bits()) <= 1);
            assert!(lo.abs() <= hi * f64::EPSILON / 2.0);
        }
    }
}
