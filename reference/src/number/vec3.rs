//! Vectors of three numbers of the sample loop. glam's vectors are not generic over the number.

use super::{Arithmetic, Real};
use drypoint_scene::glam::DVec3;
use std::ops::{Add, Mul, Neg, Sub};

/// A vector or a point. Its space is documented where it is used.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Vec3<R> {
    /// First component.
    pub x: R,
    /// Second component.
    pub y: R,
    /// Third component.
    pub z: R,
}

impl<R: Arithmetic> Vec3<R> {
    /// The vector of three components.
    #[inline(always)]
    pub fn new(x: R, y: R, z: R) -> Self {
        Self { x, y, z }
    }

    /// a·b, summed x, y, z.
    #[inline(always)]
    pub fn dot(self, b: Self) -> R {
        self.x * b.x + self.y * b.y + self.z * b.z
    }

    /// a × b.
    #[inline(always)]
    pub fn cross(self, b: Self) -> Self {
        Self::new(self.y * b.z - self.z * b.y, self.z * b.x - self.x * b.z, self.x * b.y - self.y * b.x)
    }

    /// ‖a‖.
    #[inline(always)]
    pub fn length(self) -> R {
        self.dot(self).sqrt()
    }

    /// The vector a in as many lanes as x has.
    #[inline(always)]
    pub fn constant(x: R, a: Vec3<R::Number>) -> Self {
        Self::new(x.constant(a.x), x.constant(a.y), x.constant(a.z))
    }

    /// a where the mask is true, else b.
    #[inline(always)]
    pub fn select(mask: R::Mask, a: Self, b: Self) -> Self {
        Self::new(R::select(mask, a.x, b.x), R::select(mask, a.y, b.y), R::select(mask, a.z, b.z))
    }
}

impl<R: Real> Vec3<R> {
    /// The zero vector.
    #[inline(always)]
    pub fn zero() -> Self {
        Self::new(R::ZERO, R::ZERO, R::ZERO)
    }

    /// Converts a vector of glam, rounding its numbers.
    pub fn from_glam(v: DVec3) -> Self {
        Self::new(R::from_f64(v.x), R::from_f64(v.y), R::from_f64(v.z))
    }

    /// Converts to a vector of glam.
    pub fn to_glam(self) -> DVec3 {
        DVec3::new(self.x.to_f64(), self.y.to_f64(), self.z.to_f64())
    }

    /// The angle to another vector in radians, atan2(‖a × b‖, a·b): accurate near 0 and π, where acos is not ([CUR-3]).
    #[inline]
    pub fn angle(self, b: Self) -> R {
        self.cross(b).length().atan2(self.dot(b))
    }
}

impl<R: Arithmetic> Add for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn add(self, b: Self) -> Self {
        Self::new(self.x + b.x, self.y + b.y, self.z + b.z)
    }
}

impl<R: Arithmetic> Sub for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, b: Self) -> Self {
        Self::new(self.x - b.x, self.y - b.y, self.z - b.z)
    }
}

impl<R: Arithmetic> Neg for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn neg(self) -> Self {
        Self::new(-self.x, -self.y, -self.z)
    }
}

impl<R: Arithmetic> Mul<R> for Vec3<R> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, s: R) -> Self {
        Self::new(self.x * s, self.y * s, self.z * s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_near_zero_keep_their_digits() {
        let a = Vec3::new(1.0, 0.0, 0.0);
        let b = Vec3::new(1.0, 1e-9, 0.0);
        assert!((a.angle(b) - 1e-9).abs() < 1e-24);
        assert_eq!(a.angle(-a), std::f64::consts::PI);
        assert_eq!(a.cross(Vec3::new(0.0, 1.0, 0.0)), Vec3::new(0.0, 0.0, 1.0));
    }
}
