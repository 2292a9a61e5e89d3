//! What one number and eight of them side by side have in common.

use fearless_simd::{Simd, f64x8};
use std::ops::{Add, Mul, Sub};

/// A number, or a lane of numbers for each of which the same is computed. Formulas over it take the same steps in both, and
/// so give the same bits.
pub trait Arithmetic: Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> {
    /// x/2.
    fn half(self) -> Self;

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
}

impl Arithmetic for f32 {
    #[inline(always)]
    fn half(self) -> Self {
        self * 0.5
    }
}

impl<S: Simd> Arithmetic for f64x8<S> {
    #[inline(always)]
    fn half(self) -> Self {
        self * 0.5
    }
}
