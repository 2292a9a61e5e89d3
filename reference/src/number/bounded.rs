//! Numbers that carry a bound of their distance to an f32 evaluation: running error analysis (Higham, *Accuracy and
//! Stability of Numerical Algorithms*, 3.3).
//!
//! A [`Bounded`] is a number of the reference, in f64, with a bound of its distance to the corresponding number of an
//! f32 renderer. That renderer follows the same formulas in the same order. Fusing a product and a sum is allowed,
//! since it leaves out a rounding. Each operation propagates the errors of its operands and adds its own grant, in
//! units in the last place (ULP), 2⁻²³ of the result:
//!
//! | operation | grant | source |
//! |---|---|---|
//! | + − ×, numbers from the scene, voxels | ½ ULP, none where f32 holds the result | IEEE 754; WGSL, *Floating Point Evaluation*: correctly rounded |
//! | ÷ | 2.5 ULP | WGSL, *Floating Point Accuracy* |
//! | √ | 4.5 ULP | WGSL: inherited from 1/inverseSqrt, 2 ULP under a division of 2.5 ULP |
//! | angle, logarithm, opacity correction, sRGB | 16 ULP | own polynomials of + − × ÷ √, whose divisions and roots have the grants above |
//! | x^y | 16 ULP and 5|y ln x| ULP | e^(y ln x), of which the product carries the error of the logarithm |
//! | a result in f32's subnormal range | 2⁻¹²⁶ | WGSL: may be flushed to 0 |
//!
//! Propagation is not linearized. A product takes |a|e_b + |b|e_a + e_a·e_b, a quotient divides by |b| − e_b, and
//! monotone functions are evaluated at the ends. Plain rules ignore that errors can cancel. So
//! [`lerp`](Arithmetic::lerp), *over* ([`laid_before`](Arithmetic::laid_before)) and hypot use the derivative of the
//! operation as a whole.
//!
//! Comparisons that the errors leave open are evaluated both ways. See [`ways`](super::ways).

mod operators;
mod row;

use super::{Arithmetic, Decision, Elementary, Real, Vec3, ways};
use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::volume::Voxel;
use fearless_simd::Simd;
use row::BoundedRow;
use std::cmp::Ordering;

/// A unit in the last place of f32, relative to the number: 2⁻²³. A little more covers the roundings of f64.
const ULP: f64 = (1.0 + 1.0 / (1u64 << 24) as f64) / (1u64 << 23) as f64;
/// Grant of a correctly rounded operation.
const ROUNDED: f64 = 0.5 * ULP;
/// Grant of a division.
const DIVIDED: f64 = 2.5 * ULP;
/// Grant of a square root.
const ROOT: f64 = 4.5 * ULP + ROUNDED * ULP;
/// Grant of a transcendental function.
const TRANSCENDENTAL: f64 = 16.0 * ULP;
/// The smallest normal number of f32, 2⁻¹²⁶: smaller ones may be flushed to 0.
const TINY: f64 = f32::MIN_POSITIVE as f64;

/// A number in f64, and a bound of its distance to the number of an f32 renderer.
#[derive(Clone, Copy, Debug, Default)]
pub struct Bounded {
    value: f64,
    error: f64,
    /// The decision that comparisons with the number make.
    decision: Decision,
}

impl Bounded {
    /// A number that f32 holds exactly.
    pub const fn exact(value: f64) -> Self {
        Self { value, error: 0.0, decision: Decision::Step }
    }

    /// A number with its bound. A NaN error counts as unbounded.
    pub fn new(value: f64, error: f64) -> Self {
        Self { value, error: if error.is_nan() { f64::INFINITY } else { error }, decision: Decision::Step }
    }

    /// The number in f64.
    pub fn value(self) -> f64 {
        self.value
    }

    /// The bound.
    pub fn error(self) -> f64 {
        self.error
    }

    /// The decision that comparisons with the number make.
    pub(super) fn decision(self) -> Decision {
        self.decision
    }

    /// The ends of the interval in which an f32 renderer's number lies.
    pub fn ends(self) -> [f64; 2] {
        [self.value - self.error, self.value + self.error]
    }

    /// The number with a bound that also covers `other`, another outcome of an open decision.
    pub(crate) fn joined(self, other: Self) -> Self {
        let away = (self.value - other.value).abs() + other.error;
        Self::new(self.value, if away.is_nan() { away } else { self.error.max(away) })
    }

    /// The result of an operation: propagated errors, and the operation's grant.
    fn granted(value: f64, propagated: f64, grant: f64) -> Self {
        let largest = value.abs() + propagated;
        let flushed = if largest > 0.0 && value.abs() - propagated < TINY { TINY } else { 0.0 };
        Self::new(value, propagated + grant * largest + flushed)
    }

    /// The result of a correctly rounded operation on numbers with or without errors.
    fn rounded(value: f64, propagated: f64) -> Self {
        if propagated == 0.0 { Self::from_f64(value) } else { Self::granted(value, propagated, ROUNDED) }
    }

    /// The number without its error.
    fn bare(self) -> Self {
        Self { error: 0.0, ..self }
    }

    /// The number with an additional error `more`.
    fn with_more(self, more: f64) -> Self {
        Self::new(self.value, self.error + more * (1.0 + 4.0 * ULP))
    }

    /// Compares two numbers by their values.
    pub(super) fn by_value(&self, other: &Self) -> Option<Ordering> {
        self.value.partial_cmp(&other.value)
    }

    /// Whether an f32 renderer may order the two numbers differently.
    pub(super) fn is_open(&self, other: &Self) -> bool {
        let (away, errors) = ((self.value - other.value).abs(), self.error + other.error);
        // Infinite numbers without errors have an order.
        errors > 0.0 && (away <= errors || away.is_nan())
    }
}

/// A factor times an error. The product is 0 if either is 0, even if the other is infinite.
fn of(factor: f64, error: f64) -> f64 {
    if factor == 0.0 || error == 0.0 { 0.0 } else { factor * error }
}

impl Arithmetic for Bounded {
    type Number = Self;
    type Mask = bool;

    fn constant(self, x: Self) -> Self {
        x
    }

    fn half(self) -> Self {
        Self::new(self.value * 0.5, self.error * 0.5)
    }

    fn sqrt(self) -> Self {
        let value = self.value.sqrt();
        let [lo, hi] = self.ends().map(|x| x.max(0.0).sqrt());
        // e/(√x + √(x ± e)), without the cancellation of the difference.
        let away = |end: f64| if value + end > 0.0 { self.error / (value + end) } else { 0.0 };
        let propagated = away(lo).min(value).max(away(hi));
        Self::granted(value, propagated, ROOT)
    }

    fn abs(self) -> Self {
        Self { value: self.value.abs(), ..self }
    }

    fn below(self, other: Self) -> bool {
        self < other
    }

    fn at_most(self, other: Self) -> bool {
        self <= other
    }

    fn equals(self, other: Self) -> bool {
        self == other
    }

    fn select(mask: bool, a: Self, b: Self) -> Self {
        if mask { a } else { b }
    }

    fn deciding(self, decision: Decision) -> Self {
        Self { decision, ..self }
    }

    /// The bound of rounding differs between the number types. The value of `rounding` is the bound of f64, and its
    /// error is the distance to that of f32.
    fn exceeds(self, rounding: Self) -> bool {
        let middle = Self::new(rounding.value + 0.5 * rounding.error, 0.5 * rounding.error);
        match self.is_open(&middle) {
            true => ways::choose(self.value > rounding.value, [self, rounding], Decision::Normal),
            false => self.value > rounding.value,
        }
    }

    fn min(self, other: Self) -> Self {
        let value = if other.value < self.value { other.value } else { self.value };
        hull(value, [0, 1].map(|end| self.ends()[end].min(other.ends()[end])))
    }

    fn max(self, other: Self) -> Self {
        let value = if self.value < other.value { other.value } else { self.value };
        hull(value, [0, 1].map(|end| self.ends()[end].max(other.ends()[end])))
    }

    /// |1 − w|e_a + |w|e_b + |b − a|e_w: each error counts with its share. The plain rules would exceed this sum by
    /// 2|w|e_a.
    fn lerp(a: Self, b: Self, w: Self) -> Self {
        let [a0, b0, w0] = [a, b, w].map(Self::bare);
        let of_ends = of((1.0 - w.value).abs(), a.error) + of(w.value.abs(), b.error);
        let of_way = of((b.value - a.value).abs() + a.error + b.error, w.error);
        (a0 + w0 * (b0 - a0)).with_more(of_ends + of_way)
    }

    /// |1 − α|e_A + |1 − A|e_α: A contracts the earlier error, which plain rules would let grow as 1 + α.
    fn laid_before(self, alpha: Self) -> (Self, Self) {
        let (a, alpha0) = (self.bare(), alpha.bare());
        let through = Self::exact(1.0) - a;
        let opacity = (a + through * alpha0).with_more(
            of((1.0 - alpha.value).abs(), self.error)
                + of((1.0 - self.value).abs(), alpha.error)
                + of(self.error, alpha.error),
        );
        ((Self::exact(1.0) - self) * alpha, opacity)
    }
}

/// A value in an interval, with its distance to the farther end as error.
fn hull(value: f64, [lo, hi]: [f64; 2]) -> Bounded {
    Bounded::new(value, if lo == hi { 0.0 } else { (value - lo).max(hi - value) })
}

impl Elementary for Bounded {
    fn angle(self, x: Self) -> Self {
        let (own, other) = (self.ends(), x.ends());
        corners(self.value.angle(x.value), [[own[0].max(0.0), own[1]], other], |[y, x]| y.angle(x))
    }

    fn power(self, y: Self, _: bool) -> Self {
        raised(Self::monotone([self, y], |[x, y]| x.max(0.0).power(y, true)), self, y)
    }

    fn pow(self, y: Self) -> Self {
        raised(Self::monotone([self, y], |[x, y]| x.max(0.0).pow(y)), self, y)
    }
}

/// x^y, where the product y ln x is rounded before the exponential.
fn raised(power: Bounded, x: Bounded, y: Bounded) -> Bounded {
    let product = if x.value > 0.0 { (y.value * x.value.ln()).abs() } else { 0.0 };
    power.with_more(power.value.abs() * product * 5.0 * ULP)
}

/// A function that is monotone in each argument, from the ends of the arguments' intervals.
fn corners<const N: usize>(value: f64, ends: [[f64; 2]; N], f: impl Fn([f64; N]) -> f64) -> Bounded {
    let mut farthest: f64 = 0.0;
    for corner in 0..1usize << N {
        let at = std::array::from_fn(|i| ends[i][corner >> i & 1]);
        let away = (f(at) - value).abs();
        farthest = if away.is_nan() { f64::INFINITY } else { farthest.max(away) };
    }
    Bounded::granted(value, farthest, TRANSCENDENTAL)
}

impl Real for Bounded {
    type Four<S: Simd> = BoundedRow;

    const ZERO: Self = Self::exact(0.0);
    const ONE: Self = Self::exact(1.0);
    const HALF: Self = Self::exact(0.5);
    /// See [`exceeds`](Arithmetic::exceeds).
    const NO_NORMAL: Self =
        Self { value: f64::NO_NORMAL, error: f32::NO_NORMAL as f64 - f64::NO_NORMAL, decision: Decision::Normal };
    const NO_DIRECTION: Self = Self {
        value: f64::NO_DIRECTION,
        error: f32::NO_DIRECTION as f64 - f64::NO_DIRECTION,
        decision: Decision::Normal,
    };
    const EPSILON: Self = Self::exact(f64::EPSILON);
    const FAR_EXPONENT: i32 = f64::FAR_EXPONENT;

    fn from_f64(x: f64) -> Self {
        let held = x as f32;
        let held = if held.is_subnormal() { 0.0 } else { f64::from(held) };
        Self::new(x, if held == x || x.is_nan() { 0.0 } else { (x - held).abs() })
    }

    fn to_f64(self) -> f64 {
        self.value
    }

    fn from_voxel<V: Voxel>(v: V) -> Self {
        Self::from_f64(v.to_f64())
    }

    fn from_voxels<V: Voxel, const N: usize>(v: [V; N]) -> [Self; N] {
        v.map(Self::from_voxel)
    }

    /// A number that is not known to ±½ can have any fraction.
    fn split(self) -> (usize, Self) {
        if self.error >= 0.5 {
            let i = self.value as u32;
            return (i as usize, Self::new(self.value - f64::from(i), f64::INFINITY));
        }
        let i = self.to_index();
        (i, self - Self::from_index(i))
    }

    /// ⌊x⌋, or an open neighbour.
    fn to_index(self) -> usize {
        let i = self.value as u32;
        let whole = |i: u32| Self::exact(f64::from(i));
        if ways::order(&self, &whole(i + 1)) != Some(Ordering::Less) {
            return i as usize + 1;
        }
        let before = i > 0 && ways::order(&self, &whole(i)) == Some(Ordering::Less);
        i as usize - usize::from(before)
    }

    /// Returns none. An uncertain index would exclude neighbours that a search has to try.
    fn proposed_index(self) -> Option<usize> {
        None
    }

    fn from_index(i: usize) -> Self {
        Self::exact(i as u32 as f64)
    }

    fn next_up(self) -> Self {
        Self { value: self.value.next_up(), ..self }
    }

    fn next_down(self) -> Self {
        Self { value: self.value.next_down(), ..self }
    }

    fn atan2(self, x: Self) -> Self {
        self.angle(x)
    }

    /// The error of the position, which the ray's origin carries. All samples of a ray share one bound.
    fn on_ray(o: Self, a: Self, t: Self) -> Self {
        Self::new(o.value + a.value * t.value, o.error)
    }

    fn monotone<const N: usize>(numbers: [Self; N], f: impl Fn([f64; N]) -> f64) -> Self {
        corners(f(numbers.map(Self::value)), numbers.map(Self::ends), f)
    }

    /// The assignment of the position, or an open one at a corner of the box about it.
    fn assigned<T: Copy + PartialEq>(position: Vec3<Self>, assign: impl Fn(Vec3<f64>) -> T) -> T {
        let at = |ends: [f64; 3]| assign(Vec3::new(ends[0], ends[1], ends[2]));
        let numbers = [position.x, position.y, position.z];
        let here = at(numbers.map(Self::value));
        for corner in 0..8 {
            let there = at([0, 1, 2].map(|axis| numbers[axis].ends()[corner >> axis & 1]));
            let is_other = there != here;
            if is_other && ways::choose(false, [Self::exact(corner as f64), position.x], Decision::Label) {
                return there;
            }
        }
        here
    }

    /// Σ|L|e, and roundings of the factors, the products, the sums and the offset: six of the sum of all magnitudes.
    fn mapped(position: Vec3<Self>, (linear, offset): (DMat3, DVec3)) -> Vec3<Self> {
        let p = position.to_glam();
        let errors = DVec3::new(position.x.error, position.y.error, position.z.error);
        let sizes = DMat3::from_cols(linear.x_axis.abs(), linear.y_axis.abs(), linear.z_axis.abs());
        let error = sizes * errors + 6.0 * ROUNDED * (sizes * (p.abs() + errors) + offset.abs());
        let q = linear * p + offset;
        Vec3::new(Self::new(q.x, error.x), Self::new(q.y, error.y), Self::new(q.z, error.z))
    }

    fn known_within(self, range: [f32; 2]) -> Self {
        self.known_between(Self::exact(range[0].into()), Self::exact(range[1].into()))
    }

    fn known_between(self, a: Self, b: Self) -> Self {
        let [a, b] = [a.ends(), b.ends()];
        let [lo, hi] = [a[0].min(b[0]), a[1].max(b[1])];
        // Interpolations between numbers in the range are rounded.
        let rounded = 8.0 * ULP * lo.abs().max(hi.abs());
        let farthest = (hi - self.value).max(self.value - lo) + rounded;
        Self { error: self.error.min(farthest), ..self }
    }

    /// The distance of (x, y) from the origin changes by at most the displacement of (x, y).
    fn hypot(self, other: Self) -> Self {
        let value = Real::hypot(self.value, other.value);
        let scaled = 2.0 * (DIVIDED + 2.0 * ROUNDED) + ROOT + ROUNDED;
        Self::granted(value, self.error.hypot(other.error), scaled)
    }
}

#[cfg(test)]
mod tests;
