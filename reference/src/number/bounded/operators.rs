//! + − × ÷, and comparisons.

use super::{Bounded, DIVIDED, of, ways};
use std::cmp::Ordering;
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

impl Add for Bounded {
    type Output = Self;

    fn add(self, b: Self) -> Self {
        Self::rounded(self.value + b.value, self.error + b.error)
    }
}

impl Sub for Bounded {
    type Output = Self;

    fn sub(self, b: Self) -> Self {
        Self::rounded(self.value - b.value, self.error + b.error)
    }
}

impl Mul for Bounded {
    type Output = Self;

    fn mul(self, b: Self) -> Self {
        let propagated = of(self.value.abs(), b.error) + of(b.value.abs(), self.error) + of(self.error, b.error);
        Self::rounded(self.value * b.value, propagated)
    }
}

impl Div for Bounded {
    type Output = Self;

    fn div(self, b: Self) -> Self {
        let (value, least) = (self.value / b.value, b.value.abs() - b.error);
        let propagated = match self.error + of(value.abs(), b.error) {
            0.0 => 0.0,
            _ if least <= 0.0 => f64::INFINITY,
            errors => errors / least,
        };
        Self::granted(value, propagated, DIVIDED)
    }
}

impl Neg for Bounded {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

impl AddAssign for Bounded {
    fn add_assign(&mut self, b: Self) {
        *self = *self + b;
    }
}

impl SubAssign for Bounded {
    fn sub_assign(&mut self, b: Self) {
        *self = *self - b;
    }
}

impl MulAssign for Bounded {
    fn mul_assign(&mut self, b: Self) {
        *self = *self * b;
    }
}

/// Whether the values are equal. If errors leave equality of equal values open, both ways are evaluated. Numbers of
/// different values that f32 might find equal are not: a formula that jumps there also jumps between the two values.
impl PartialEq for Bounded {
    fn eq(&self, other: &Self) -> bool {
        self.value == other.value && ways::order(self, other) == Some(Ordering::Equal)
    }
}

/// The order of the values, or another open one. See [`ways`].
impl PartialOrd for Bounded {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        ways::order(self, other)
    }
}
