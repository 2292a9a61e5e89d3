//! The operations that the sample code needs of a number.

use super::{Elementary, Vec3};
use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::math;
use drypoint_scene::volume::Voxel;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x4, f64x4};
use std::fmt::Debug;
use std::ops::{Add, AddAssign, Mul, MulAssign, Sub, SubAssign};

/// Four numbers of a row of voxels, in one register if the processor has a suitable one.
pub trait RowOfFour<S, R>:
    Copy + Add<Output = Self> + Sub<R, Output = Self> + Mul<R, Output = Self> + Into<[R; 4]>
{
    /// The row of four numbers.
    fn load(simd: S, numbers: [R; 4]) -> Self;
}

/// f64 or f32. `+ − × ÷ √` are those of IEEE 754. Transcendental functions come from `drypoint_scene::math` alone
/// ([PREC-4]).
pub trait Real:
    Elementary<Number = Self, Mask = bool>
    + Debug
    + Default
    + PartialOrd
    + Send
    + Sync
    + 'static
    + AddAssign
    + SubAssign
    + MulAssign
{
    /// Four numbers in a register.
    type Four<S: Simd>: RowOfFour<S, Self>;

    /// 0.
    const ZERO: Self;
    /// 1.
    const ONE: Self;
    /// ½.
    const HALF: Self;
    /// The relative bound of [PREC-3], up to which a gradient is rounding error: 2⁻⁴⁶, in f32 2⁻²⁰.
    const NO_NORMAL: Self;
    /// The ‖Pv‖ up to which the direction of a unit vector in a tangent plane is lost to rounding ([CUR-2]): 2⁻²⁶, in
    /// f32 2⁻¹². It is the root of ε or slightly less.
    const NO_DIRECTION: Self;
    /// The distance from 1 to the next number.
    const EPSILON: Self;
    /// Voxels whose largest magnitude has an exponent beyond this are scaled as they are read, so that sums do not
    /// overflow.
    const FAR_EXPONENT: i32;

    /// The nearest number of this type.
    fn from_f64(x: f64) -> Self;
    /// The number in f64.
    fn to_f64(self) -> f64;
    /// The stored voxel as a number of this type.
    fn from_voxel<V: Voxel>(v: V) -> Self;
    /// Several stored voxels as numbers of this type.
    fn from_voxels<V: Voxel, const N: usize>(v: [V; N]) -> [Self; N];
    /// ⌊x⌋ and x − ⌊x⌋ for 0 ≤ x < 2³¹ (f32: 2²²), without the saturation of an `as` cast and without a library call.
    fn split(self) -> (usize, Self);
    /// ⌊x⌋ for 0 ≤ x < 2³² by truncation. It is slower than [`split`](Self::split) alone, but has the lower latency
    /// where many operations wait for it.
    fn to_index(self) -> usize;
    /// ⌊x⌋ as a first guess for a search. None if the search must not use a guess.
    #[inline(always)]
    fn proposed_index(self) -> Option<usize> {
        Some(self.to_index())
    }
    /// The number i, up to 2³² (f32: 2²⁴).
    fn from_index(i: usize) -> Self;
    /// The next larger number.
    fn next_up(self) -> Self;
    /// The next smaller number.
    fn next_down(self) -> Self;
    /// The angle of (x, self) from the x axis.
    fn atan2(self, x: Self) -> Self;

    /// o + a·t: the position of a ray with origin o and direction a at the depth t, along one axis.
    #[inline(always)]
    fn on_ray(o: Self, a: Self, t: Self) -> Self {
        o + a * t
    }

    /// f of some numbers, computed in f64 and rounded once. f is monotone in each of them, rising or falling.
    #[inline(always)]
    fn monotone<const N: usize>(numbers: [Self; N], f: impl Fn([f64; N]) -> f64) -> Self {
        Self::from_f64(f(numbers.map(Self::to_f64)))
    }

    /// Assigns a position by a function in f64.
    #[inline(always)]
    fn assigned<T: Copy + PartialEq>(position: Vec3<Self>, assign: impl Fn(Vec3<f64>) -> T) -> T {
        assign(Vec3::new(position.x.to_f64(), position.y.to_f64(), position.z.to_f64()))
    }

    /// L·p + t of a position p, computed in f64 and rounded once.
    #[inline(always)]
    fn mapped(position: Vec3<Self>, (linear, offset): (DMat3, DVec3)) -> Vec3<Self> {
        Vec3::from_glam(linear * position.to_glam() + offset)
    }

    /// The number itself, which is known to lie in a range up to rounding. Its error interval is cut to the range.
    #[inline(always)]
    fn known_within(self, _: [f32; 2]) -> Self {
        self
    }

    /// The number itself, which is known to lie between two numbers up to rounding. Its error interval is cut to theirs.
    #[inline(always)]
    fn known_between(self, _: Self, _: Self) -> Self {
        self
    }

    /// √(x² + y²) without overflow on the way.
    #[inline]
    fn hypot(self, other: Self) -> Self {
        let (a, b) = (self.abs(), other.abs());
        let (small, large) = if a < b { (a, b) } else { (b, a) };
        if large == Self::ZERO {
            return Self::ZERO;
        }
        let ratio = small / large;
        large * (Self::ONE + ratio * ratio).sqrt()
    }
}

macro_rules! row_of_four {
    ($number:ident, $four:ident) => {
        impl<S: Simd> RowOfFour<S, $number> for $four<S> {
            #[inline(always)]
            fn load(simd: S, numbers: [$number; 4]) -> Self {
                numbers.simd_into(simd)
            }
        }
    };
}

row_of_four!(f64, f64x4);
row_of_four!(f32, f32x4);

/// 2⁵². A smaller number added to it leaves its nearest integer in the low bits of the mantissa.
const MAGIC_F64: f64 = (1u64 << 52) as f64;
/// 2²³, the same for f32.
const MAGIC_F32: f32 = (1u32 << 23) as f32;

/// 2⁵² + ⌊x⌋ for 0 ≤ x < 2⁵¹. If the nearest integer lies above x, 1 is subtracted by a mask: a branch would be
/// mispredicted at every second sample.
#[inline(always)]
fn floor_f64(x: f64) -> f64 {
    let nearest = x + MAGIC_F64;
    let above = u64::from(nearest - MAGIC_F64 > x).wrapping_neg();
    nearest - f64::from_bits(above & 1f64.to_bits())
}

/// 2²³ + ⌊x⌋ for 0 ≤ x < 2²².
#[inline(always)]
fn floor_f32(x: f32) -> f32 {
    let nearest = x + MAGIC_F32;
    let above = u32::from(nearest - MAGIC_F32 > x).wrapping_neg();
    nearest - f32::from_bits(above & 1f32.to_bits())
}

impl Real for f64 {
    type Four<S: Simd> = f64x4<S>;

    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const HALF: Self = 0.5;
    const NO_NORMAL: Self = 1.0 / (1u64 << 46) as f64;
    const NO_DIRECTION: Self = 1.0 / (1u64 << 26) as f64;
    const EPSILON: Self = f64::EPSILON;
    const FAR_EXPONENT: i32 = 500;

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x
    }

    #[inline(always)]
    fn to_f64(self) -> f64 {
        self
    }

    #[inline(always)]
    fn from_voxel<V: Voxel>(v: V) -> Self {
        v.to_f64()
    }

    #[inline(always)]
    fn from_voxels<V: Voxel, const N: usize>(v: [V; N]) -> [Self; N] {
        V::all_to_f64(v)
    }

    #[inline(always)]
    fn split(self) -> (usize, Self) {
        let floor = floor_f64(self);
        (floor.to_bits() as u32 as usize, self - (floor - MAGIC_F64))
    }

    #[inline(always)]
    fn to_index(self) -> usize {
        // A saturating cast takes two instructions more than a plain one to u32, and five more to the signed types.
        self as u32 as usize
    }

    #[inline(always)]
    fn from_index(i: usize) -> Self {
        i as u32 as f64
    }

    fn next_up(self) -> Self {
        self.next_up()
    }

    fn next_down(self) -> Self {
        self.next_down()
    }

    #[inline]
    fn atan2(self, x: Self) -> Self {
        math::atan2(self, x)
    }
}

impl Real for f32 {
    type Four<S: Simd> = f32x4<S>;

    const ZERO: Self = 0.0;
    const ONE: Self = 1.0;
    const HALF: Self = 0.5;
    const NO_NORMAL: Self = 1.0 / (1u64 << 20) as f32;
    const NO_DIRECTION: Self = 1.0 / (1u64 << 12) as f32;
    const EPSILON: Self = f32::EPSILON;
    const FAR_EXPONENT: i32 = 60;

    #[inline(always)]
    fn from_f64(x: f64) -> Self {
        x as f32
    }

    #[inline(always)]
    fn to_f64(self) -> f64 {
        f64::from(self)
    }

    #[inline(always)]
    fn from_voxel<V: Voxel>(v: V) -> Self {
        v.to_f32()
    }

    #[inline(always)]
    fn from_voxels<V: Voxel, const N: usize>(v: [V; N]) -> [Self; N] {
        V::all_to_f32(v)
    }

    #[inline(always)]
    fn split(self) -> (usize, Self) {
        let floor = floor_f32(self);
        ((floor.to_bits() & 0x7f_ffff) as usize, self - (floor - MAGIC_F32))
    }

    #[inline(always)]
    fn to_index(self) -> usize {
        // A saturating cast takes two instructions more than a plain one to u32, and five more to the signed types.
        self as u32 as usize
    }

    #[inline(always)]
    fn from_index(i: usize) -> Self {
        i as u32 as f32
    }

    fn next_up(self) -> Self {
        self.next_up()
    }

    fn next_down(self) -> Self {
        self.next_down()
    }

    #[inline]
    fn atan2(self, x: Self) -> Self {
        math::atan2_f32(self, x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Arithmetic;

    #[test]
    fn split_is_floor_and_fraction() {
        for x in [0.0, 0.25, 0.5, 0.75, 1.0, 1.5, 2.5, 3.5, 254.999_999, 255.0, 1e6 + 0.5, 2147483000.75] {
            let (i, w) = Real::split(x);
            assert_eq!((i as f64, w), (f64::floor(x), x - f64::floor(x)), "{x}");
        }
        for x in [0.0f32, 0.5, 1.5, 2.5, 100.999, 4095.5] {
            let (i, w) = Real::split(x);
            assert_eq!((i as f32, w), (f32::floor(x), x - f32::floor(x)), "{x}");
        }
    }

    #[test]
    fn indices_are_floors() {
        for x in [0.0, 0.25, 1.0, 2.75, 1e6 + 0.5] {
            assert_eq!(Real::to_index(x), Real::split(x).0);
            assert_eq!(Real::to_index(x as f32), Real::split(x as f32).0);
        }
        assert_eq!((f64::from_index(1_000_001), f32::from_index(4096)), (1_000_001.0, 4096.0));
    }

    /// exp(y ln x) in f32 would be off by y ln x last places.
    #[test]
    fn powers_in_f32_are_within_a_last_place() {
        for x in [1e-6f32, 0.3, 0.9, 0.999, 1.7, 100.0] {
            for y in [0.01f32, 0.3, 1.5, 10.25, 15.5] {
                let exact = f64::from(x).pow(f64::from(y));
                for got in [x.pow(y), x.power(y, true)].into_iter().filter(|got| got.is_normal()) {
                    assert!(
                        (f64::from(got) - exact).abs() <= f64::from(f32::EPSILON) * exact,
                        "{x} {y}: {got} {exact}"
                    );
                }
            }
        }
    }

    #[test]
    fn split_takes_a_negative_zero() {
        assert_eq!(Real::split(-0.0f64), (0, 0.0));
        assert_eq!(Real::split(-0.0f32), (0, 0.0));
    }

    #[test]
    fn hypot_neither_overflows_nor_loses_the_small_one() {
        assert_eq!(Real::hypot(3.0, -4.0), 5.0);
        assert_eq!(Real::hypot(0.0, 0.0), 0.0);
        // Four roundings after the scaling: two last places.
        assert!((Real::hypot(3e200, 4e200) / 5e200 - 1.0).abs() <= 2.0 * f64::EPSILON);
        assert!((Real::hypot(3e30f32, 4e30) / 5e30 - 1.0).abs() <= 2.0 * f32::EPSILON);
    }

    #[test]
    fn lerp_returns_constants_exactly() {
        for w in [0.0, 0.1, 1.0 / 3.0, 1.0] {
            assert_eq!(f64::lerp(1000.3, 1000.3, w), 1000.3);
        }
    }
}
