//! A field at eight positions side by side, for rays that are cast in lanes.
//!
//! Lanes cover trilinear values, central differences and Sobel's operator of integers of 8 or 16 bits, which is what
//! scanners store. The formulas are those of one position, over lanes, so the bits are the same. Voxels are fetched
//! lane by lane, whole rows at a time, and unpacked in lanes. Other kernels are evaluated for one position [after the
//! other](each).

mod each;
mod gradient;

pub(crate) use self::each::EachReader;
use self::each::seconds;

use super::place::CellPosition;
use super::{Field, GradientEstimator, KernelData};
use crate::bilinear::bilinear;
use crate::number::{Mat3, Sym3, Vec3};
use drypoint_scene::volume::{Access, Linear, Voxel, Voxels};
use fearless_simd::prelude::*;
use fearless_simd::{Bytes, Simd, f64x4, f64x8, mask64x8, u64x4, u64x8};

pub(crate) use crate::number::lanes::LANES;

/// 2⁵². In the sum of 2⁵² and an integer below it, the low bits are the integer.
const TO_BITS: f64 = (1u64 << 52) as f64;
const MANTISSA: u64 = (1 << 52) - 1;

/// Stored numbers of which four fit into one word. Signed numbers are read as unsigned, with their sign bit flipped.
pub(crate) trait Packed: Voxel + Into<u64> {
    /// Bits of one number.
    const BITS: u32 = 8 * size_of::<Self>() as u32;
}

impl Packed for u8 {}
impl Packed for u16 {}

/// Neighbours along x, the first in the lowest bits.
#[inline(always)]
fn word<V: Packed, const N: usize>(row: [V; N]) -> u64 {
    let mut word = 0;
    for (i, voxel) in row.into_iter().enumerate() {
        word |= voxel.into() << (V::BITS * i as u32);
    }
    word
}

/// Width of the part of a word that holds numbers, in bits. The byte above stays 0, and the highest two hold the top
/// bits of 2⁵² as a double.
const ROOM: u32 = 40;
/// Index of the byte that stays 0.
const NOTHING: u64 = 5;

/// Byte selectors, for every word of a vector. They take number i of each of two words, plus 2⁵², whose bits both words
/// hold.
const fn picks<V: Packed>(i: usize) -> [u64; LANES] {
    let bytes = V::BITS as u64 / 8;
    let mut picks = 0x0706 << 48;
    let mut byte = 0;
    while byte < 6 {
        let from = if byte < bytes { i as u64 * bytes + byte } else { NOTHING };
        picks |= from << (8 * byte);
        byte += 1;
    }
    let second = picks + 0x0808_0808_0808_0808;
    [picks, second, picks, second, picks, second, picks, second]
}

/// The stored voxels around eight cells.
///
/// The eight are written out one by one: the compiler then builds a vector from eight words at once instead of
/// inserting them in turn.
struct Windows<'v, V>([Linear<'v, V>; LANES]);

impl<V: Packed> Windows<'_, V> {
    /// The row of four at (y, z) of each.
    #[inline(always)]
    fn rows(&self, y: usize, z: usize) -> [u64; LANES] {
        let Self([a, b, c, d, e, f, g, h]) = self;
        [row(a, y, z), row(b, y, z), row(c, y, z), row(d, y, z), row(e, y, z), row(f, y, z), row(g, y, z), row(h, y, z)]
    }

    /// The two numbers of each of two rows (y, z) on the edges of the cell.
    #[inline(always)]
    fn pairs(&self, at: [(usize, usize); 2]) -> [u64; LANES] {
        let Self([a, b, c, d, e, f, g, h]) = self;
        [pairs(a, at), pairs(b, at), pairs(c, at), pairs(d, at), pairs(e, at), pairs(f, at), pairs(g, at), pairs(h, at)]
    }
}

#[inline(always)]
fn row<V: Packed>(window: &Linear<'_, V>, y: usize, z: usize) -> u64 {
    word(window.row::<4>(0, y, z))
}

#[inline(always)]
fn pairs<V: Packed>(window: &Linear<'_, V>, [(y, z), (next_y, next_z)]: [(usize, usize); 2]) -> u64 {
    // A window of four begins a voxel before the cell.
    let x = window.dims()[0] / 2 - 1;
    word(window.row::<2>(x, y, z)) | word(window.row::<2>(x, next_y, next_z)) << (2 * V::BITS)
}

/// Cells and the fractions in them, like [`CellPosition`].
#[derive(Clone, Copy)]
pub(crate) struct Places<S: Simd> {
    cell: Vec3<f64x8<S>>,
    w: [f64x8<S>; 3],
}

impl<S: Simd> Places<S> {
    /// The columns of the cells, then those of the fractions.
    #[inline(always)]
    pub(crate) fn to_columns(self) -> [[f64; LANES]; 6] {
        let Self { cell, w: [wx, wy, wz] } = self;
        [cell.x.into(), cell.y.into(), cell.z.into(), wx.into(), wy.into(), wz.into()]
    }

    /// Restores the places from [`to_columns`](Self::to_columns).
    #[inline(always)]
    pub(crate) fn from_columns([x, y, z, wx, wy, wz]: [f64x8<S>; 6]) -> Self {
        Self { cell: Vec3::new(x, y, z), w: [wx, wy, wz] }
    }

    /// The places as scalars, for one lane at a time.
    #[inline(always)]
    pub(crate) fn alone(&self) -> PlaceColumns {
        let [wx, wy, wz] = self.w;
        PlaceColumns {
            cell: [whole(self.cell.x), whole(self.cell.y), whole(self.cell.z)],
            w: [wx.into(), wy.into(), wz.into()],
        }
    }
}

/// [`Places`] as scalars, for one lane at a time.
pub(crate) struct PlaceColumns {
    cell: [[usize; LANES]; 3],
    w: [[f64; LANES]; 3],
}

impl PlaceColumns {
    /// The cell of a lane.
    #[inline(always)]
    pub(crate) fn cell(&self, lane: usize) -> [usize; 3] {
        let [x, y, z] = &self.cell;
        [x[lane], y[lane], z[lane]]
    }

    /// The place of a lane.
    #[inline(always)]
    fn place(&self, lane: usize) -> CellPosition<f64> {
        let [wx, wy, wz] = &self.w;
        CellPosition { cell: self.cell(lane), w: [wx[lane], wy[lane], wz[lane]] }
    }
}

/// Gradients and Hessians of one field, like [`Sampler::hessian_at`](super::Sampler::hessian_at).
pub(crate) type Seconds<S> = (Vec3<f64x8<S>>, Sym3<f64x8<S>>);

/// Reads a field in lanes.
pub(crate) trait Reader<S: Simd>: Copy {
    /// Whether values are expensive. If so, only values that may be visible in their cells are asked for.
    const DEAR: bool;

    /// The places of positions inside the box. Positions outside get the nearest cell, and fractions beyond [0, 1].
    fn places(&self, p: Vec3<f64x8<S>>) -> Places<S>;

    /// The values at places, of the lanes `asked` at least.
    fn values(&self, at: &Places<S>, asked: mask64x8<S>) -> f64x8<S>;

    /// World gradients, times 2^−e, at the places of `asked`; anything in the other lanes.
    fn gradients(&self, at: &Places<S>, asked: mask64x8<S>) -> Vec3<f64x8<S>>;

    /// World gradients and Hessians, times 2^−e, at the places of `asked`; anything in the other lanes.
    fn seconds(&self, at: &Places<S>, asked: mask64x8<S>) -> Seconds<S>;
}

/// Whole numbers in [0, 2⁵²) as indices.
#[inline(always)]
pub(crate) fn whole<S: Simd>(x: f64x8<S>) -> [usize; LANES] {
    let bits: [u64; LANES] = ((x + TO_BITS).to_bits() & MANTISSA).into();
    let mut whole = [0; LANES];
    for lane in 0..LANES {
        whole[lane] = bits[lane] as usize;
    }
    whole
}

/// The places of positions. See [`Reader::places`].
#[inline(always)]
fn places<S: Simd>(simd: S, field: &Field<'_, f64>, p: Vec3<f64x8<S>>) -> Places<S> {
    let [x, y, z] = field.cells.last();
    let (x, y, z) = (along(simd, p.x, x), along(simd, p.y, y), along(simd, p.z, z));
    Places { cell: Vec3::new(x.0, y.0, z.0), w: [x.1, y.1, z.1] }
}

/// The cell of a coordinate, and the distance from the cell's first voxel.
#[inline(always)]
fn along<S: Simd>(simd: S, x: f64x8<S>, last: f64) -> (f64x8<S>, f64x8<S>) {
    let zero = f64x8::splat(simd, 0.0);
    let cell = x.max(zero).min(f64x8::splat(simd, last)).floor();
    (cell, x - cell)
}

/// One matrix in all lanes.
#[inline(always)]
fn splat<S: Simd>(simd: S, m: &Mat3<f64>) -> Mat3<f64x8<S>> {
    let zero = f64x8::splat(simd, 0.0);
    let mut rows = [Vec3::new(zero, zero, zero); 3];
    for (row, r) in rows.iter_mut().zip(&m.rows) {
        *row = Vec3::new(f64x8::splat(simd, r.x), f64x8::splat(simd, r.y), f64x8::splat(simd, r.z));
    }
    Mat3 { rows }
}

/// A reader of small integers that are interpolated trilinearly.
#[derive(Clone, Copy)]
pub(crate) struct LaneReader<'f, 'v, S: Simd, V> {
    simd: S,
    field: &'f Field<'v, f64>,
    voxels: Linear<'f, V>,
    /// The sign bit of a number; 0 for unsigned types. A signed number with this bit flipped is an unsigned number,
    /// larger by the value of the bit.
    sign: u64,
    /// The sign bits of the numbers in the lower half of a word.
    signs: u64,
    /// The number to which 0 is raised.
    zero: f64,
    to_world: Mat3<f64x8<S>>,
}

impl Field<'_, f64> {
    /// Whether a [`Reader`] reads this field, and its gradients if `gradient` is set. The numbers must be integers,
    /// read as they are stored. [`LaneReader`] reads the trilinear kernel: numbers of at most 16 bits, central
    /// differences or Sobel's operator, at least four voxels on each axis. [`EachReader`] reads the other kernels if a
    /// sample's `looks` are expensive too; otherwise single rays are as fast.
    pub(crate) fn fits_lanes(&self, gradient: bool, looks: bool) -> bool {
        if self.formula.is_some() || self.stencils.careful() || !self.volume.is_integer() {
            return false;
        }
        if !matches!(self.kernel, KernelData::Trilinear) {
            return looks;
        }
        let estimator = matches!(self.how.gradient, GradientEstimator::Central | GradientEstimator::Sobel);
        (estimator || !gradient)
            && matches!(self.volume.voxels(), Voxels::U8(_) | Voxels::I8(_) | Voxels::U16(_) | Voxels::I16(_))
            && self.stencils.dims().iter().all(|&n| n >= 4)
    }
}

impl<S: Simd, V: Packed> Reader<S> for LaneReader<'_, '_, S, V> {
    const DEAR: bool = false;

    #[inline(always)]
    fn places(&self, p: Vec3<f64x8<S>>) -> Places<S> {
        places(self.simd, self.field, p)
    }

    #[inline(always)]
    fn values(&self, at: &Places<S>, _: mask64x8<S>) -> f64x8<S> {
        let start = self.offsets(at.cell);
        let v = self.windows::<2>(start);
        let [[a, b, c, d], [e, f, g, h]] =
            [self.raised(v.pairs([(0, 0), (1, 0)])), self.raised(v.pairs([(0, 1), (1, 1)]))];
        let [wx, wy, wz] = at.w;
        let along_x = [self.between(a, b, wx), self.between(c, d, wx), self.between(e, f, wx), self.between(g, h, wx)];
        let read = bilinear(along_x, wy, wz);
        read * self.field.slope + self.field.intercept
    }

    #[inline(always)]
    fn gradients(&self, at: &Places<S>, asked: mask64x8<S>) -> Vec3<f64x8<S>> {
        self.differences(at, asked)
    }

    #[inline(always)]
    fn seconds(&self, at: &Places<S>, asked: mask64x8<S>) -> Seconds<S> {
        seconds(self.simd, self.field, at, asked)
    }
}

impl<'f, 'v, S: Simd, V: Packed> LaneReader<'f, 'v, S, V> {
    /// Reads a field that [`fits_lanes`](Field::fits_lanes). `voxels` are the bits of its voxels, and `is_signed` tells
    /// how to read them.
    #[inline(always)]
    pub(crate) fn new(simd: S, field: &'f Field<'v, f64>, voxels: &'f [V], is_signed: bool) -> Self {
        let to_world = splat(simd, &field.to_world);
        let sign = u64::from(is_signed) << (V::BITS - 1);
        let signs = if V::BITS == 8 { sign * 0x0101_0101 } else { sign * 0x0001_0001 };
        let zero = TO_BITS + sign as f64;
        Self { simd, field, voxels: Linear::new(voxels, field.stencils.dims()), sign, signs, zero, to_world }
    }

    /// The windows of side `N` that begin at the given linear offsets.
    #[inline(always)]
    fn windows<const N: usize>(&self, [a, b, c, d, e, f, g, h]: [usize; LANES]) -> Windows<'f, V> {
        let v = &self.voxels;
        Windows([
            v.window_at::<N>(a),
            v.window_at::<N>(b),
            v.window_at::<N>(c),
            v.window_at::<N>(d),
            v.window_at::<N>(e),
            v.window_at::<N>(f),
            v.window_at::<N>(g),
            v.window_at::<N>(h),
        ])
    }

    /// Linear offsets of voxels in the volume.
    #[inline(always)]
    fn offsets(&self, voxel: Vec3<f64x8<S>>) -> [usize; LANES] {
        let [nx, ny, _] = self.voxels.dims();
        // Whole numbers below 2⁵², so that products and sums are exact.
        let offset = voxel.z * (nx * ny) as f64 + voxel.y * nx as f64 + voxel.x;
        whole(offset)
    }

    /// Interpolates between two numbers, both raised.
    #[inline(always)]
    fn between(&self, a: f64x8<S>, b: f64x8<S>, w: f64x8<S>) -> f64x8<S> {
        // The formula of `lerp`: integers this small have exact differences.
        (a - self.zero) + w * (b - a)
    }

    /// The first `N` numbers in each word, all raised by the same integer, so that their differences are unchanged.
    ///
    /// Code in lanes has no closures. A closure that is not inlined at once is compiled for the baseline processor, and
    /// each vector operation in it stays a call.
    #[inline(always)]
    fn raised<const N: usize>(&self, words: [u64; LANES]) -> [f64x8<S>; N] {
        let mut raised = [f64x8::splat(self.simd, 0.0); N];
        if N as u32 * V::BITS > ROOM {
            for (i, number) in raised.iter_mut().enumerate() {
                *number = self.raised_at(words, i);
            }
            return raised;
        }
        let words: u64x8<S> = words.simd_into(self.simd);
        let words = words ^ (self.signs | TO_BITS.to_bits());
        for (i, number) in raised.iter_mut().enumerate() {
            let picked: u64x8<S> = picks::<V>(i).simd_into(self.simd);
            *number = f64x8::from_bits(words.swizzle_dyn_within_blocks(Bytes::to_bytes(picked)));
        }
        raised
    }

    /// Number i in each word, raised.
    #[inline(always)]
    fn raised_at(&self, words: [u64; LANES], i: usize) -> f64x8<S> {
        let words: u64x8<S> = words.simd_into(self.simd);
        let bits = (words >> (V::BITS * i as u32)) & ((1u64 << V::BITS) - 1);
        f64x8::from_bits((bits ^ self.sign) | TO_BITS.to_bits())
    }

    /// The four numbers in one word, raised.
    #[inline(always)]
    fn raised_row(&self, word: u64) -> f64x4<S> {
        let bits = u64::from(V::BITS);
        let places: u64x4<S> = [0, bits, 2 * bits, 3 * bits].simd_into(self.simd);
        let bits = self.simd.shrv_u64x4(u64x4::splat(self.simd, word), places) & ((1u64 << V::BITS) - 1);
        f64x4::from_bits((bits ^ self.sign) | TO_BITS.to_bits())
    }
}
