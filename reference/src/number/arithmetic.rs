//! Operations that single numbers and vectors of lanes have in common.

use super::lanes::{self, Eight};
use super::{Decision, Real};
use drypoint_scene::math::{self, One, Width};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4, f64x8, mask64x4, mask64x8};
use std::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Not, Sub};

/// A truth value, or one for each lane.
pub trait Mask: Copy + BitAnd<Output = Self> + BitOr<Output = Self> + Not<Output = Self> {
    /// Whether the mask is true in some lane. If it is true in none, both widths can skip expensive steps.
    fn any(self) -> bool;

    /// Whether it is true in all lanes.
    fn all(self) -> bool;
}

/// A number, or a vector of lanes on which the same computation runs.
///
/// A formula over this trait is written once. It takes the same steps at both widths, and so gives the same bits. At a
/// branch both sides are computed, and [`select`](Self::select) takes one. A formula is `#[inline(always)]` and has no
/// closures, which would be compiled without the vector registers.
pub trait Arithmetic:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self> + Neg<Output = Self>
{
    /// The number in a lane.
    type Number: Real;
    /// The result of a comparison.
    type Mask: Mask;

    /// x in as many lanes as `self` has.
    fn constant(self, x: Self::Number) -> Self;

    /// x/2.
    fn half(self) -> Self;

    /// √x.
    fn sqrt(self) -> Self;

    /// |x|.
    fn abs(self) -> Self;

    /// self < other.
    fn below(self, other: Self) -> Self::Mask;

    /// self ≤ other.
    fn at_most(self, other: Self) -> Self::Mask;

    /// self = other.
    fn equals(self, other: Self) -> Self::Mask;

    /// a where the mask is true, else b.
    fn select(mask: Self::Mask, a: Self, b: Self) -> Self;

    /// 0 in as many lanes.
    #[inline(always)]
    fn zero(self) -> Self {
        self.constant(Self::Number::ZERO)
    }

    /// 1 in as many lanes.
    #[inline(always)]
    fn one(self) -> Self {
        self.constant(Self::Number::ONE)
    }

    /// The smaller one; `self` where neither is.
    #[inline(always)]
    fn min(self, other: Self) -> Self {
        Self::select(other.below(self), other, self)
    }

    /// The larger one; `self` where neither is.
    #[inline(always)]
    fn max(self, other: Self) -> Self {
        Self::select(self.below(other), other, self)
    }

    /// Clamped to [0, 1].
    #[inline(always)]
    fn clamp_01(self) -> Self {
        self.max(self.zero()).min(self.one())
    }

    /// x^n by repeated squaring, lowest bit first ([PREC-4]).
    #[inline(always)]
    fn pow_whole(self, n: u32) -> Self {
        math::pow_whole(self, self.one(), n)
    }

    /// Whether the number exceeds a bound of rounding. A number up to the bound is rounding error.
    #[inline(always)]
    fn exceeds(self, rounding: Self::Number) -> Self::Mask {
        self.constant(rounding).below(self)
    }

    /// The number itself, marked with the decision that comparisons with it make. The picture may jump at such a
    /// comparison.
    #[inline(always)]
    fn deciding(self, _: Decision) -> Self {
        self
    }

    /// Composites an opacity α behind this opacity A: returns w = (1 − A)·α, and A + w.
    #[inline(always)]
    fn laid_before(self, alpha: Self) -> (Self, Self) {
        let w = (self.one() - self) * alpha;
        (w, self + w)
    }

    /// a + w(b − a), which returns a constant exactly ([REC-1]).
    #[inline(always)]
    fn lerp(a: Self, b: Self, w: Self) -> Self {
        a + w * (b - a)
    }
}

/// Numbers with the transcendental functions that samples need. All come from [`drypoint_scene::math`] ([PREC-4]).
pub trait Elementary: Arithmetic {
    /// The angle of (x, self), self ≥ 0, from the x axis.
    fn angle(self, x: Self) -> Self;

    /// x^y of opacities x in (0, 1], for y about 1, in the lanes `asked`. The other lanes hold arbitrary numbers.
    fn power(self, y: Self, asked: Self::Mask) -> Self;

    /// x^y. Integers y up to 64 use repeated squaring.
    fn pow(self, y: Self::Number) -> Self;
}

/// Numbers in f64, for which [`drypoint_scene::math`] has series.
pub(crate) trait Double: Arithmetic<Number = f64> {
    /// The width of the numbers.
    type Width: Width<Number = Self>;

    /// The width of `self`.
    fn width(self) -> Self::Width;
}

impl Mask for bool {
    #[inline(always)]
    fn any(self) -> bool {
        self
    }

    #[inline(always)]
    fn all(self) -> bool {
        self
    }
}

macro_rules! number {
    ($number:ident) => {
        impl Arithmetic for $number {
            type Number = Self;
            type Mask = bool;

            #[inline(always)]
            fn constant(self, x: Self) -> Self {
                x
            }

            #[inline(always)]
            fn half(self) -> Self {
                self * 0.5
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                self.sqrt()
            }

            #[inline(always)]
            fn abs(self) -> Self {
                self.abs()
            }

            #[inline(always)]
            fn below(self, other: Self) -> bool {
                self < other
            }

            #[inline(always)]
            fn at_most(self, other: Self) -> bool {
                self <= other
            }

            #[inline(always)]
            fn equals(self, other: Self) -> bool {
                self == other
            }

            #[inline(always)]
            fn select(mask: bool, a: Self, b: Self) -> Self {
                if mask { a } else { b }
            }
        }
    };
}

number!(f64);
number!(f32);

macro_rules! lanes {
    ($lanes:ident, $mask:ident) => {
        impl<S: Simd> Mask for $mask<S> {
            #[inline(always)]
            fn any(self) -> bool {
                self.any_true()
            }

            #[inline(always)]
            fn all(self) -> bool {
                self.all_true()
            }
        }

        impl<S: Simd> Arithmetic for $lanes<S> {
            type Number = f64;
            type Mask = $mask<S>;

            #[inline(always)]
            fn constant(self, x: f64) -> Self {
                <Self as SimdBase<S>>::splat(self.simd, x)
            }

            #[inline(always)]
            fn half(self) -> Self {
                self * 0.5
            }

            #[inline(always)]
            fn sqrt(self) -> Self {
                SimdFloat::sqrt(self)
            }

            #[inline(always)]
            fn abs(self) -> Self {
                SimdBase::abs(self)
            }

            #[inline(always)]
            fn below(self, other: Self) -> $mask<S> {
                self.simd_lt(other)
            }

            #[inline(always)]
            fn at_most(self, other: Self) -> $mask<S> {
                self.simd_le(other)
            }

            #[inline(always)]
            fn equals(self, other: Self) -> $mask<S> {
                self.simd_eq(other)
            }

            #[inline(always)]
            fn select(mask: $mask<S>, a: Self, b: Self) -> Self {
                Select::select(mask, a, b)
            }
        }
    };
}

lanes!(f64x4, mask64x4);
lanes!(f64x8, mask64x8);

impl Double for f64 {
    type Width = One;

    #[inline(always)]
    fn width(self) -> One {
        One
    }
}

impl<S: Simd> Double for f64x8<S> {
    type Width = Eight<S>;

    #[inline(always)]
    fn width(self) -> Eight<S> {
        Eight(self.simd)
    }
}

impl Elementary for f64 {
    #[inline]
    fn angle(self, x: Self) -> Self {
        math::angle(self, x)
    }

    #[inline]
    fn power(self, y: Self, _: bool) -> Self {
        math::power(self, y)
    }

    #[inline]
    fn pow(self, y: Self) -> Self {
        math::pow(self, y)
    }
}

impl Elementary for f32 {
    #[inline]
    fn angle(self, x: Self) -> Self {
        math::atan2_f32(self, x)
    }

    #[inline]
    fn power(self, y: Self, _: bool) -> Self {
        math::pow_f32(self, y)
    }

    #[inline]
    fn pow(self, y: Self) -> Self {
        math::pow_f32(self, y)
    }
}

impl<S: Simd> Elementary for f64x8<S> {
    #[inline(always)]
    fn angle(self, x: Self) -> Self {
        math::angle::angle(self.width(), self, x)
    }

    #[inline(always)]
    fn power(self, y: Self, asked: mask64x8<S>) -> Self {
        lanes::power(self, y, asked.to_bitmask())
    }

    /// Computed lane by lane, because the shininess is rarely a fraction.
    #[inline(always)]
    fn pow(self, y: f64) -> Self {
        f64x8::from_fn(self.simd, |lane| math::pow(self[lane], y))
    }
}
