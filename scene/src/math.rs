//! The only source of transcendental functions ([PREC-4]).
//!
//! All functions are from the pure-Rust `libm`, or are this module's own series over `+ − × ÷`. The same scene
//! therefore gives the same bits on every IEEE 754 machine. `+ − × ÷ √` are the language's own, and exactly rounded
//! everywhere.
//!
//! The series are written once, over a [`Width`]: for one number, and for the vector registers of another crate.

use std::ops::Mul;

pub mod angle;
mod double;
pub mod power;
pub mod transmittance;
mod width;

pub use double::compare_products;
pub use width::{One, Width};

/// [`angle::angle`] of one point.
#[inline]
pub fn angle(y: f64, x: f64) -> f64 {
    angle::angle(One, y, x)
}

/// x^y for 0 < x ≤ 1 and 0 ≤ y up to slightly above 1.5, to less than an ulp. See [`power::power`]; for tiny x, [`pow`]
/// is used.
#[inline]
pub fn power(x: f64, y: f64) -> f64 {
    if x < power::LEAST { pow(x, y) } else { power::power(One, x, y) }
}

/// [`transmittance::ln_one_minus`] of one number.
#[inline]
pub fn ln_one_minus(alpha: f64) -> f64 {
    transmittance::ln_one_minus(One, alpha)
}

/// [`transmittance::one_minus_exp`] of one number.
#[inline]
pub fn one_minus_exp(y: f64) -> f64 {
    transmittance::one_minus_exp(One, y)
}

/// [`transmittance::one_minus_root`] of one number.
#[inline]
pub fn one_minus_root(alpha: f64) -> f64 {
    transmittance::one_minus_root(One, alpha)
}

/// e^x.
#[inline]
pub fn exp(x: f64) -> f64 {
    libm::exp(x)
}

/// e^x − 1 without cancellation at small x.
#[inline]
pub fn exp_m1(x: f64) -> f64 {
    libm::expm1(x)
}

/// Natural logarithm.
#[inline]
pub fn ln(x: f64) -> f64 {
    libm::log(x)
}

/// ln(1 + x) without cancellation at small x.
#[inline]
pub fn ln_1p(x: f64) -> f64 {
    libm::log1p(x)
}

/// Logarithm to base 2.
#[inline]
pub fn log2(x: f64) -> f64 {
    libm::log2(x)
}

/// x^y. A whole exponent up to 64 in magnitude is repeated squaring in a fixed order ([PREC-4]).
#[inline]
pub fn pow(x: f64, y: f64) -> f64 {
    if y == (y as i32) as f64 && y.abs() <= 64.0 {
        let p = pow_whole(x, 1.0, y.abs() as u32);
        if y < 0.0 { 1.0 / p } else { p }
    } else {
        libm::pow(x, y)
    }
}

/// The cube root, of negative numbers too.
#[inline]
pub fn cbrt(x: f64) -> f64 {
    libm::cbrt(x)
}

/// x^n from `one`, by repeated squaring, lowest bit first ([PREC-4]).
#[inline(always)]
pub fn pow_whole<T: Copy + Mul<Output = T>>(x: T, one: T, mut n: u32) -> T {
    let (mut result, mut square) = (one, x);
    while n > 0 {
        if n & 1 == 1 {
            result = result * square;
        }
        square = square * square;
        n >>= 1;
    }
    result
}

/// Sine of an angle in radians.
#[inline]
pub fn sin(x: f64) -> f64 {
    libm::sin(x)
}

/// Cosine of an angle in radians.
#[inline]
pub fn cos(x: f64) -> f64 {
    libm::cos(x)
}

/// Tangent of an angle in radians.
pub fn tan(x: f64) -> f64 {
    libm::tan(x)
}

/// Angle of the point (x, y) from the x axis, in radians, in (−π, π].
#[inline]
pub fn atan2(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}

/// Hyperbolic tangent.
pub fn tanh(x: f64) -> f64 {
    libm::tanh(x)
}

/// √(x² + y²) without overflow.
#[inline]
pub fn hypot(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}

/// x · 2^n, exact as long as the result is normal.
#[inline]
pub fn scale_by_power_of_two(x: f64, n: i32) -> f64 {
    libm::ldexp(x, n)
}

/// The exponent e for which |x| · 2^−e lies in [½, 1); 0 for x = 0, NaN and ±∞.
pub fn exponent(x: f64) -> i32 {
    if x == 0.0 || !x.is_finite() { 0 } else { libm::frexp(x).1 }
}

/// x^y in f32; whole exponents as [`pow`].
pub fn pow_f32(x: f32, y: f32) -> f32 {
    if y == (y as i32) as f32 && y.abs() <= 64.0 {
        let p = pow_whole(x, 1.0, y.abs() as u32);
        if y < 0.0 { 1.0 / p } else { p }
    } else {
        libm::powf(x, y)
    }
}

/// Angle of the point (x, y) from the x axis, in f32.
pub fn atan2_f32(y: f32, x: f32) -> f32 {
    libm::atan2f(y, x)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_powers_are_products() {
        assert_eq!(pow(3.0, 5.0), 243.0);
        assert_eq!(pow(2.0, -3.0), 0.125);
        assert_eq!(pow(-2.0, 3.0), -8.0);
        assert_eq!(pow(0.0, 0.0), 1.0);
        assert!((pow(2.0, 0.5) - 2f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn exponent_brings_into_the_half_open_octave() {
        for x in [1.0, 0.5, 0.75, 3.0, 1e300, 1e-310, 255.0] {
            let m = scale_by_power_of_two(x, -exponent(x));
            assert!((0.5..1.0).contains(&m), "{x}: {m}");
        }
        assert_eq!(exponent(0.0), 0);
    }
}
