//! Fields whose kernel has no implementation in lanes: each position is evaluated on its own, as for a single ray.

use super::{LANES, PlaceColumns, Places, Reader, Seconds, places, splat};
use crate::field::kernel::{Bspline, Bspline5, BsplineSmooth, CatmullRom, Interpolant, Trilinear};
use crate::field::sampler::with_kernel;
use crate::field::{Field, GradientEstimator, KernelData, Second};
use crate::number::lanes::widely;
use crate::number::{Sym3, Vec3};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, mask64x8};

impl Field<'_, f64> {
    /// Values of the lanes `asked`, before slope and intercept.
    fn numbers_of(&self, at: &PlaceColumns, asked: u64) -> [f64; LANES] {
        let [numbers] = with_kernel!(self, |kernel| of_each(asked, |lane| [kernel.value(self, at.place(lane))]));
        numbers
    }

    /// Gradients of the lanes `asked` along the index axes.
    fn gradients_of(&self, at: &PlaceColumns, asked: u64) -> [[f64; LANES]; 3] {
        match self.how.gradient {
            GradientEstimator::Analytic => {
                with_kernel!(self, |kernel| of_each(asked, |lane| of_vector(kernel.gradient(self, at.place(lane)))))
            }
            _ => of_each(asked, |lane| of_vector(self.index_gradient(at.place(lane)))),
        }
    }

    /// Gradients and Hessians of the lanes `asked` along the index axes: x, y, z, xx, xy, xz, yy, yz, zz.
    fn seconds_of(&self, at: &PlaceColumns, asked: u64) -> [[f64; LANES]; 9] {
        match self.second {
            Second::Analytic => {
                with_kernel!(self, |kernel| of_each(asked, |lane| of_both(kernel.second(self, at.place(lane)))))
            }
            _ => of_each(asked, |lane| of_both(self.index_second(at.place(lane)))),
        }
    }
}

#[inline(always)]
fn of_vector(Vec3 { x, y, z }: Vec3<f64>) -> [f64; 3] {
    [x, y, z]
}

#[inline(always)]
fn of_both((g, h): (Vec3<f64>, Sym3<f64>)) -> [f64; 9] {
    [g.x, g.y, g.z, h.xx, h.xy, h.xz, h.yy, h.yz, h.zz]
}

/// Columns of the results of `compute` for the lanes `asked`; zeros in the other lanes.
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

/// Reads a field that [`fits_lanes`](Field::fits_lanes) one lane at a time.
#[derive(Clone, Copy)]
pub(crate) struct EachReader<'f, 'v, S> {
    simd: S,
    field: &'f Field<'v, f64>,
}

impl<'f, 'v, S: Simd> EachReader<'f, 'v, S> {
    /// Reads a field with its own kernel.
    #[inline(always)]
    pub(crate) fn new(simd: S, field: &'f Field<'v, f64>) -> Self {
        Self { simd, field }
    }
}

/// [`Reader::seconds`] of a field's kernel.
#[inline(always)]
pub(super) fn seconds<S: Simd>(simd: S, field: &Field<'_, f64>, at: &Places<S>, asked: mask64x8<S>) -> Seconds<S> {
    let mut lanes = [f64x8::splat(simd, 0.0); 9];
    for (lanes, numbers) in lanes.iter_mut().zip(field.seconds_of(&at.alone(), asked.to_bitmask())) {
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
        let numbers = self.field.numbers_of(&at.alone(), asked.to_bitmask());
        f64x8::simd_from(self.simd, numbers) * self.field.slope + self.field.intercept
    }

    #[inline(always)]
    fn gradients(&self, at: &Places<S>, asked: mask64x8<S>) -> Vec3<f64x8<S>> {
        let [x, y, z] = self.field.gradients_of(&at.alone(), asked.to_bitmask());
        let simd = self.simd;
        let index = Vec3::new(x.simd_into(simd), y.simd_into(simd), z.simd_into(simd));
        splat(simd, &self.field.to_world).apply(index)
    }

    #[inline(always)]
    fn seconds(&self, at: &Places<S>, asked: mask64x8<S>) -> Seconds<S> {
        seconds(self.simd, self.field, at, asked)
    }
}
