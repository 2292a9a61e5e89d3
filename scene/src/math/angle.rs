//! The angle of a point in the upper half plane, for angles between vectors ([CUR-3]).
//!
//! From + − × ÷ alone, without a branch, so that lanes can take the same steps to the same bits ([PREC-4]).

use super::double::Double;
use super::transmittance::TO_WHOLE;
use std::f64::consts::{FRAC_PI_2, PI};

/// Steps of the tangent from 0 to 1.
pub const STEPS: usize = 64;

/// π/2 − [`FRAC_PI_2`].
pub const FRAC_PI_2_LO: f64 = 6.123_233_995_736_766e-17;

/// atan(i/64) in two parts.
pub static ANGLES: [[f64; 2]; STEPS + 1] = {
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
#[inline]
pub fn angle(y: f64, x: f64) -> f64 {
    let across = if x < 0.0 { -x } else { x };
    let steep = y > across;
    let (small, large) = if steep { (across, y) } else { (y, across) };
    let t = if large > 0.0 { small / large } else { 0.0 };
    // atan t = atan c + atan d, c the nearest step and d = (t − c)/(1 + tc).
    let whole = t * STEPS as f64 + TO_WHOLE;
    let c = (whole - TO_WHOLE) * (1.0 / STEPS as f64);
    let d = (t - c) / (t * c + 1.0);
    let [hi, lo] = ANGLES[(whole.to_bits() as usize % 128).min(STEPS)];
    let d2 = d * d;
    let rest = d - d * d2 * ((d2 * -0.2 + 1.0 / 3.0) + d2 * d2 * (1.0 / 7.0));
    // Folded back: over the diagonal, then over the y axis.
    let (hi, rest) = if steep { (FRAC_PI_2 - hi, FRAC_PI_2_LO - (lo + rest)) } else { (hi, lo + rest) };
    let (hi, rest) = if x < 0.0 { (PI - hi, 2.0 * FRAC_PI_2_LO - rest) } else { (hi, rest) };
    hi + rest
}

#[cfg(test)]
mod tests {
    use super::*;

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
