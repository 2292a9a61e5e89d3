//! Widths: the number of values for which a series is computed at once.

use std::ops::{Add, BitAnd, BitOr, BitXor, Div, Mul, Neg, Shl, Shr, Sub};

/// One number or several side by side, and the operations on them that the series of this module are made of.
///
/// A series is written once over this trait. It takes the same steps at every width, and so gives the same bits
/// ([PREC-4]). [`One`] is the width of one number. A crate that has vector registers adds their widths.
pub trait Width: Copy {
    /// The numbers.
    type Number: Copy
        + Neg<Output = Self::Number>
        + Add<Output = Self::Number>
        + Sub<Output = Self::Number>
        + Mul<Output = Self::Number>
        + Div<Output = Self::Number>
        + Add<f64, Output = Self::Number>
        + Sub<f64, Output = Self::Number>
        + Mul<f64, Output = Self::Number>;
    /// The bit patterns of the numbers.
    type Bits: Copy
        + Add<u64, Output = Self::Bits>
        + Sub<u64, Output = Self::Bits>
        + BitAnd<u64, Output = Self::Bits>
        + BitOr<u64, Output = Self::Bits>
        + BitXor<u64, Output = Self::Bits>
        + Shl<u32, Output = Self::Bits>
        + Shr<u32, Output = Self::Bits>;
    /// A truth value for each number.
    type Mask: Copy;

    /// x for each number.
    fn number(self, x: f64) -> Self::Number;
    /// √x.
    fn sqrt(self, x: Self::Number) -> Self::Number;
    /// a < b.
    fn below(self, a: Self::Number, b: Self::Number) -> Self::Mask;
    /// a where the mask is true, else b.
    fn select(self, mask: Self::Mask, a: Self::Number, b: Self::Number) -> Self::Number;
    /// The bits of numbers.
    fn bits(self, x: Self::Number) -> Self::Bits;
    /// Numbers of given bits.
    fn of_bits(self, bits: Self::Bits) -> Self::Number;
    /// x·2^e for e in the bits of an exponent, modulo their number, as long as the result is normal.
    fn scaled(self, x: Self::Number, exponent: Self::Bits) -> Self::Number;
    /// The columns of a table, each in the row of its number. Rows beyond the last are the last.
    fn look_up<const N: usize, const ROWS: usize>(self, table: &[[f64; N]; ROWS], row: Self::Bits)
    -> [Self::Number; N];
}

/// The width of a number.
#[derive(Clone, Copy, Debug)]
pub struct One;

impl Width for One {
    type Number = f64;
    type Bits = u64;
    type Mask = bool;

    #[inline(always)]
    fn number(self, x: f64) -> f64 {
        x
    }

    #[inline(always)]
    fn sqrt(self, x: f64) -> f64 {
        x.sqrt()
    }

    #[inline(always)]
    fn below(self, a: f64, b: f64) -> bool {
        a < b
    }

    #[inline(always)]
    fn select(self, mask: bool, a: f64, b: f64) -> f64 {
        if mask { a } else { b }
    }

    #[inline(always)]
    fn bits(self, x: f64) -> u64 {
        x.to_bits()
    }

    #[inline(always)]
    fn of_bits(self, bits: u64) -> f64 {
        f64::from_bits(bits)
    }

    #[inline(always)]
    fn scaled(self, x: f64, exponent: u64) -> f64 {
        f64::from_bits(x.to_bits().wrapping_add(exponent))
    }

    #[inline(always)]
    fn look_up<const N: usize, const ROWS: usize>(self, table: &[[f64; N]; ROWS], row: u64) -> [f64; N] {
        table[(row as usize).min(ROWS - 1)]
    }
}
