//! Fields whose kernel has no lanes of its own: one position after the other, as a ray alone would ask.

use super::{LANES, PlaceColumns, Places, Reader, Seconds, places, splat};
use crate::field::Field;
use crate::field::place::Place;
use crate::field::sampler::{AnySampler, Interpolant, Sampled, index_gradient, index_second, number};
use crate::number::lanes::widely;
use crate::number::{Sym3, Vec3};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, mask64x8};

/// A kernel's results for the lanes `asked`, along the index axes and before slope and intercept. Loops over samples
/// are compiled once for all expensive kernels and call these methods.
pub(crate) trait Each: Sync {
    /// Values.
    fn numbers(&self, at: &PlaceColumns, asked: u64) -> [f64; LANES];

    /// Gradients.
    fn gradients(&self, at: &PlaceColumns, asked: u64) -> [[f64; LANES]; 3];

    /// Gradients and Hessians: x, y, z, xx, xy, xz, yy, yz, zz.
    fn seconds(&self, at: &PlaceColumns, asked: u64) -> [[f64; LANES]; 9];
}

impl<K: Interpolant<f64>> Each for Sampled<'_, '_, f64, K> {
    fn numbers(&self, at: &PlaceColumns, asked: u64) -> [f64; LANES] {
        let [numbers] = of_each(asked, |lane| [number(self, at.place(lane))]);
        numbers
    }

    fn gradients(&self, at: &PlaceColumns, asked: u64) -> [[f64; LANES]; 3] {
        of_each(asked, |lane| {
            let Vec3 { x, y, z } = index_gradient(self, at.place(lane), estimated_gradient);
            [x, y, z]
        })
    }

    fn seconds(&self, at: &PlaceColumns, asked: u64) -> [[f64; LANES]; 9] {
        of_each(asked, |lane| {
            let (Vec3 { x, y, z }, Sym3 { xx, xy, xz, yy, yz, zz }) =
                index_second(self, at.place(lane), estimated_second);
            [x, y, z, xx, xy, xz, yy, yz, zz]
        })
    }
}

/// The field's estimate, compiled once and not for each kernel.
#[inline(never)]
fn estimated_gradient(field: &Field<'_, f64>, at: Place<f64>) -> Vec3<f64> {
    field.estimated_gradient(at)
}

/// The field's estimate, compiled once and not for each kernel.
#[inline(never)]
fn estimated_second(field: &Field<'_, f64>, at: Place<f64>) -> (Vec3<f64>, Sym3<f64>) {
    field.estimated_second(at)
}

/// Columns of what is computed for the lanes `asked`; zeros in the others.
#[inline(always)]
fn of_each<const N: usize>(asked: u64, compute: impl Fn(usize) -> [f64; N]) -> [[f64; LANES]; N] {
    widely(
        #[inline(always)]
        || {
            let mut columns = [[0.0; LANES]; N];
            let mut left = asked;
            while left != 0 {
                let lane = left.trailing_zeros() as usize % LANES;
                left &= left - 1;
                let of_lane = compute(lane);
                for i in 0..N {
                    columns[i][lane] = of_lane[i];
                }
            }
            columns
        },
    )
}

impl AnySampler<'_, '_, f64> {
    /// The kernel.
    pub(crate) fn each(&self) -> &dyn Each {
        match self {
            Self::Trilinear(sampled) => sampled,
            Self::Bspline(sampled) => sampled,
            Self::BsplineSmooth(sampled) => sampled,
            Self::Bspline5(sampled) => sampled,
            Self::CatmullRom(sampled) => sampled,
        }
    }
}

/// Reads a field that [`fits_lanes`](Field::fits_lanes) by its kernel.
#[derive(Clone, Copy)]
pub(crate) struct EachReader<'f, 'v, S> {
    simd: S,
    field: &'f Field<'v, f64>,
    each: &'f dyn Each,
}

impl<'f, 'v, S: Simd> EachReader<'f, 'v, S> {
    /// Reads a field with its own kernel, `each`.
    #[inline(always)]
    pub(crate) fn new(simd: S, field: &'f Field<'v, f64>, each: &'f dyn Each) -> Self {
        Self { simd, field, each }
    }
}

/// [`Reader::seconds`] of a field's kernel.
#[inline(always)]
pub(super) fn seconds<S: Simd>(
    simd: S,
    field: &Field<'_, f64>,
    each: &dyn Each,
    at: &Places<S>,
    asked: mask64x8<S>,
) -> Seconds<S> {
    let mut lanes = [f64x8::splat(simd, 0.0); 9];
    for (lanes, numbers) in lanes.iter_mut().zip(each.seconds(&at.alone(), asked.to_bitmask())) {
        *lanes = numbers.simd_into(simd);
    }
    let [x, y, z, xx, xy, xz, yy, yz, zz] = lanes;
    let hessian = Sym3 { xx, xy, xz, yy, yz, zz }.scaled(f64x8::splat(simd, field.derivative));
    (splat(simd, &field.to_world).apply(Vec3::new(x, y, z)), splat(simd, &field.inverse_transpose).congruence(hessian))
}

impl<S: Simd> Reader<S> for EachReader<'_, '_, S> {
    const DEAR: bool = true;

    #[inline(always)]
    fn places(&self, p: Vec3<f64x8<S>>) -> Places<S> {
        places(self.simd, self.field, p)
    }

    #[inline(always)]
    fn values(&self, at: &Places<S>, asked: mask64x8<S>) -> f64x8<S> {
        let numbers = self.each.numbers(&at.alone(), asked.to_bitmask());
        f64x8::simd_from(self.simd, numbers) * self.field.slope + self.field.intercept
    }

    #[inline(always)]
    fn gradients(&self, at: &Places<S>, asked: mask64x8<S>) -> Vec3<f64x8<S>> {
        let [x, y, z] = self.each.gradients(&at.alone(), asked.to_bitmask());
        let simd = self.simd;
        let index = Vec3::new(x.simd_into(simd), y.simd_into(simd), z.simd_into(simd));
        splat(simd, &self.field.to_world).apply(index)
    }

    #[inline(always)]
    fn seconds(&self, at: &Places<S>, asked: mask64x8<S>) -> Seconds<S> {
        seconds(self.simd, self.field, self.each, at, asked)
    }
}
