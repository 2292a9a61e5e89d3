//! What one number and eight of them side by side have in common.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4, f64x8};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A number, or a lane of numbers for each of which the same is computed. Formulas over it take the same steps in both, and
/// so give the same bits.
pub trait Arithmetic:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// x/2.
    fn half(self) -> Self;

    /// √x.
    fn sqrt(self) -> Self;

    /// x^n from 1, by repeated squaring, lowest bit first ([PREC-4]).
    #[inline(always)]
    fn pow_whole(self, one: Self, mut n: u32) -> Self {
        let (mut result, mut square) = (one, self);
        while n > 0 {
            if n & 1 == 1 {
                result = result * square;
            }
            square = square * square;
            n >>= 1;
        }
        result
    }

    /// a + w(b − a), which returns a constant exactly ([REC-1]).
    #[inline(always)]
    fn lerp(a: Self, b: Self, w: Self) -> Self {
        a + w * (b - a)
    }
}

impl Arithmetic for f64 {
    #[inline(always)]
    fn half(self) -> Self {
        self * 0.5
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }
}

impl Arithmetic for f32 {
    #[inline(always)]
    fn half(self) -> Self {
        self * 0.5
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        self.sqrt()
    }
}

impl<S: Simd> Arithmetic for f64x4<S> {
    #[inline(always)]
    fn half(self) -> Self {
        self * 0.5
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        SimdFloat::sqrt(self)
    }
}

impl<S: Simd> Arithmetic for f64x8<S> {
    #[inline(always)]
    fn half(self) -> Self {
        self * 0.5
    }

    #[inline(always)]
    fn sqrt(self) -> Self {
        SimdFloat::sqrt(self)
    }
}
