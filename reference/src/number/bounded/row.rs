//! Rows of voxels.

use super::Bounded;
use crate::number::RowOfFour;
use fearless_simd::Simd;
use std::ops::{Add, Mul, Sub};

/// Four numbers of a row.
#[derive(Clone, Copy)]
pub struct BoundedRow([Bounded; 4]);

impl<S: Simd> RowOfFour<S, Bounded> for BoundedRow {
    fn load(_: S, numbers: [Bounded; 4]) -> Self {
        Self(numbers)
    }
}

impl From<BoundedRow> for [Bounded; 4] {
    fn from(row: BoundedRow) -> Self {
        row.0
    }
}

impl Add for BoundedRow {
    type Output = Self;

    fn add(self, b: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] + b.0[i]))
    }
}

impl Sub<Bounded> for BoundedRow {
    type Output = Self;

    fn sub(self, b: Bounded) -> Self {
        Self(self.0.map(|a| a - b))
    }
}

impl Mul<Bounded> for BoundedRow {
    type Output = Self;

    fn mul(self, b: Bounded) -> Self {
        Self(self.0.map(|a| a * b))
    }
}
