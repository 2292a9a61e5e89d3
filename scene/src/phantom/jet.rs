//! Second-order jets: a number with its gradient and Hessian in space.
//!
//! A phantom's formula is written once over [`Scalar`]. Over f64 it gives the value, over [`Jet`] also the exact
//! derivatives, by the sum, product and chain rules (forward differentiation; Griewank, Walther: Evaluating
//! Derivatives, 2nd ed., 2008, chapter 13). Both give the same bits for the value.

use crate::math;
use glam::{DMat3, DVec3};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A value with its gradient and its Hessian, which is symmetric bit for bit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet {
    /// f.
    pub value: f64,
    /// ∇f.
    pub gradient: DVec3,
    /// ∇∇ᵀf.
    pub hessian: DMat3,
}

/// The numbers that a phantom's formula is written over: f64, or [`Jet`].
pub(super) trait Scalar:
    Copy
    + Neg<Output = Self>
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
{
    /// A number that does not depend on the place.
    fn constant(c: f64) -> Self;
    /// The value alone, for decisions.
    fn real(self) -> f64;
    /// √x. At x = 0, where the root has no derivative, gradient and Hessian are given as 0.
    fn sqrt(self) -> Self;
    /// e^x.
    fn exp(self) -> Self;
    /// Natural logarithm.
    fn ln(self) -> Self;
    /// Sine of an angle in radians.
    fn sin(self) -> Self;
    /// Cosine of an angle in radians.
    fn cos(self) -> Self;
    /// cos √x for x ≥ 0: smooth at 0, where the root is not.
    fn cos_of_root(self) -> Self;
    /// 1 / (1 + e^−x), without overflow.
    fn logistic(self) -> Self;

    /// x².
    fn squared(self) -> Self {
        self * self
    }

    /// x^n by repeated squaring, lowest bit first.
    fn powi(self, mut n: u32) -> Self {
        let (mut result, mut square) = (Self::constant(1.0), self);
        while n > 0 {
            if n & 1 == 1 {
                result = result * square;
            }
            square = square * square;
            n >>= 1;
        }
        result
    }

    /// The larger of two.
    fn max(self, other: Self) -> Self {
        if other.real() > self.real() { other } else { self }
    }

    /// The smaller of two.
    fn min(self, other: Self) -> Self {
        if other.real() < self.real() { other } else { self }
    }

    /// The magnitude.
    fn abs(self) -> Self {
        if self.real() < 0.0 { -self } else { self }
    }
}

/// The sum of squares of some components.
pub(super) fn length_squared<S: Scalar, const N: usize>(v: [S; N]) -> S {
    v.into_iter().skip(1).fold(v[0].squared(), |sum, x| sum + x.squared())
}

/// The Euclidean length of some components.
pub(super) fn length<S: Scalar, const N: usize>(v: [S; N]) -> S {
    length_squared(v).sqrt()
}

impl Jet {
    /// The three coordinates of a point, each with its own direction as gradient.
    pub fn coordinates(p: DVec3) -> [Self; 3] {
        let coordinate = |value, gradient| Self { value, gradient, hessian: DMat3::ZERO };
        [coordinate(p.x, DVec3::X), coordinate(p.y, DVec3::Y), coordinate(p.z, DVec3::Z)]
    }

    /// φ(self) from φ, φ′ and φ″ at the value.
    fn chain(self, [phi, first, second]: [f64; 3]) -> Self {
        Self {
            value: phi,
            gradient: self.gradient * first,
            hessian: self.hessian * first + outer(self.gradient, self.gradient) * second,
        }
    }
}

/// a bᵀ.
fn outer(a: DVec3, b: DVec3) -> DMat3 {
    DMat3::from_cols(a * b.x, a * b.y, a * b.z)
}

/// sin √x / √x and its neighbour (sin √x / √x − cos √x) / x, which cancels near 0 and is summed as a series there:
/// Σ (−x)^k · (2k + 2) / (2k + 3)!. At x = ¼ nine terms leave 10⁻²⁴.
fn sinc_of_root(x: f64) -> [f64; 2] {
    let root = x.sqrt();
    if x > 0.25 {
        let sinc = math::sin(root) / root;
        return [sinc, (sinc - math::cos(root)) / x];
    }
    let (mut sinc, mut next, mut term) = (0.0, 0.0, 1.0);
    for k in 0..9 {
        let j = f64::from(2 * k);
        // term = (−x)^k / (2k + 1)!
        sinc += term;
        next += term * (j + 2.0) / ((j + 2.0) * (j + 3.0));
        term *= -x / ((j + 2.0) * (j + 3.0));
    }
    [sinc, next]
}

impl Scalar for f64 {
    #[inline(always)]
    fn constant(c: f64) -> Self {
        c
    }
    #[inline(always)]
    fn real(self) -> f64 {
        self
    }
    #[inline(always)]
    fn sqrt(self) -> Self {
        f64::sqrt(self)
    }
    fn exp(self) -> Self {
        math::exp(self)
    }
    fn ln(self) -> Self {
        math::ln(self)
    }
    fn sin(self) -> Self {
        math::sin(self)
    }
    fn cos(self) -> Self {
        math::cos(self)
    }
    fn cos_of_root(self) -> Self {
        math::cos(f64::sqrt(self))
    }
    fn logistic(self) -> Self {
        // The exponent is never positive, so nothing overflows.
        let e = math::exp(-f64::abs(self));
        if self < 0.0 { e / (1.0 + e) } else { 1.0 / (1.0 + e) }
    }
}

impl Scalar for Jet {
    fn constant(c: f64) -> Self {
        Self { value: c, gradient: DVec3::ZERO, hessian: DMat3::ZERO }
    }
    fn real(self) -> f64 {
        self.value
    }
    fn sqrt(self) -> Self {
        let root = self.value.sqrt();
        if root == 0.0 {
            return Self::constant(root);
        }
        self.chain([root, 0.5 / root, -0.25 / (self.value * root)])
    }
    fn exp(self) -> Self {
        self.chain([math::exp(self.value); 3])
    }
    fn ln(self) -> Self {
        let inverse = 1.0 / self.value;
        self.chain([math::ln(self.value), inverse, -inverse * inverse])
    }
    fn sin(self) -> Self {
        let sin = math::sin(self.value);
        self.chain([sin, math::cos(self.value), -sin])
    }
    fn cos(self) -> Self {
        let cos = math::cos(self.value);
        self.chain([cos, -math::sin(self.value), -cos])
    }
    fn cos_of_root(self) -> Self {
        let [sinc, next] = sinc_of_root(self.value);
        self.chain([Scalar::cos_of_root(self.value), -0.5 * sinc, 0.25 * next])
    }
    fn logistic(self) -> Self {
        let (s, rest) = (Scalar::logistic(self.value), Scalar::logistic(-self.value));
        self.chain([s, s * rest, s * rest * (rest - s)])
    }
}

impl Neg for Jet {
    type Output = Self;
    fn neg(self) -> Self {
        Self { value: -self.value, gradient: -self.gradient, hessian: -self.hessian }
    }
}

impl Add for Jet {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self { value: self.value + b.value, gradient: self.gradient + b.gradient, hessian: self.hessian + b.hessian }
    }
}

impl Sub for Jet {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        self + -b
    }
}

impl Mul for Jet {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        let mixed = outer(self.gradient, b.gradient) + outer(b.gradient, self.gradient);
        Self {
            value: self.value * b.value,
            gradient: self.gradient * b.value + b.gradient * self.value,
            hessian: self.hessian * b.value + b.hessian * self.value + mixed,
        }
    }
}

impl Div for Jet {
    type Output = Self;
    fn div(self, b: Self) -> Self {
        // From q b = a: ∇q = (∇a − q ∇b) / b, and so on. The value is divided once, as in f64.
        let value = self.value / b.value;
        let gradient = (self.gradient - b.gradient * value) / b.value;
        let mixed = outer(gradient, b.gradient) + outer(b.gradient, gradient);
        Self { value, gradient, hessian: (self.hessian - b.hessian * value - mixed) * (1.0 / b.value) }
    }
}

impl Add<f64> for Jet {
    type Output = Self;
    fn add(self, c: f64) -> Self {
        Self { value: self.value + c, ..self }
    }
}

impl Sub<f64> for Jet {
    type Output = Self;
    fn sub(self, c: f64) -> Self {
        Self { value: self.value - c, ..self }
    }
}

impl Mul<f64> for Jet {
    type Output = Self;
    fn mul(self, c: f64) -> Self {
        Self { value: self.value * c, gradient: self.gradient * c, hessian: self.hessian * c }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn product_and_quotient_by_hand() {
        // f = x² y / z at (3, 2, 4): ∇f = (2xy, x², −x²y/z) / z.
        let [x, y, z] = Jet::coordinates(DVec3::new(3.0, 2.0, 4.0));
        let f = x * x * y / z;
        assert_eq!(f.value, 4.5);
        assert_eq!(f.gradient, DVec3::new(3.0, 2.25, -1.125));
        // f_xx = 2y/z, f_xy = 2x/z, f_xz = −2xy/z², f_yy = 0, f_yz = −x²/z², f_zz = 2x²y/z³.
        let h = DMat3::from_cols(
            DVec3::new(1.0, 1.5, -0.75),
            DVec3::new(1.5, 0.0, -0.5625),
            DVec3::new(-0.75, -0.5625, 0.5625),
        );
        assert_eq!(f.hessian, h);
    }

    #[test]
    fn functions_by_hand() {
        let one = |t: f64, f: fn(Jet) -> Jet| {
            let j = f(Jet::coordinates(DVec3::new(t, 0.0, 0.0))[0]);
            [j.value, j.gradient.x, j.hessian.x_axis.x]
        };
        assert_eq!(one(4.0, Scalar::sqrt), [2.0, 0.25, -1.0 / 32.0]);
        assert_eq!(one(0.0, Scalar::sqrt), [0.0; 3]);
        assert_eq!(one(0.0, Scalar::exp), [1.0; 3]);
        assert_eq!(one(0.5, Scalar::ln), [math::ln(0.5), 2.0, -4.0]);
        assert_eq!(one(0.0, Scalar::sin), [0.0, 1.0, 0.0]);
        assert_eq!(one(0.0, Scalar::cos), [1.0, 0.0, -1.0]);
        assert_eq!(one(0.0, Scalar::logistic), [0.5, 0.25, 0.0]);
        assert_eq!(one(-1000.0, Scalar::logistic), [0.0; 3]);
        assert_eq!(one(1000.0, Scalar::logistic), [1.0, 0.0, 0.0]);
        // cos √x = 1 − x/2 + x²/24 − …
        assert_eq!(one(0.0, Scalar::cos_of_root), [1.0, -0.5, 1.0 / 12.0]);
        assert_eq!(one(-3.0, Scalar::abs), [3.0, -1.0, 0.0]);
        assert_eq!(one(3.0, |x| x.powi(5)), [243.0, 405.0, 540.0]);
    }

    #[test]
    fn the_series_meets_the_closed_form() {
        // Above ¼ the closed form cancels by a factor of 3/x at most, so both sides of the seam agree to 16 ε.
        for x in [0.25, 0.2500001] {
            let root = f64::sqrt(x);
            let sinc = math::sin(root) / root;
            let [a, b] = sinc_of_root(x);
            assert!((a - sinc).abs() < 4e-16);
            assert!((b - (sinc - math::cos(root)) / x).abs() < 4e-15, "{b}");
        }
    }
}
