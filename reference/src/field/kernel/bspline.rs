//! Cubic B-splines, twice continuously differentiable ([REC-1]). On prefiltered coefficients the spline interpolates
//! the voxels; on the voxels themselves it smooths them.

use crate::field::Field;
use crate::field::coefficients::Coefficients;
use crate::field::kernel::Interpolant;
use crate::field::place::CellPosition;
use crate::field::tensor::{self, Taps};
use crate::number::{Real, Sym3, Vec3};

/// The prefiltered cubic B-spline.
#[derive(Clone, Copy, Debug)]
pub struct Bspline<'f, R>(pub(in crate::field) &'f Coefficients<R>);

/// The cubic B-spline of the voxels. It smooths: x² becomes x² + ⅓.
#[derive(Clone, Copy, Debug)]
pub struct BsplineSmooth;

/// β³ at t + 1, t, t − 1, t − 2 for 0 ≤ t ≤ 1, with first and second derivatives.
///
/// The two outer pieces are t³/6, the two inner ones (1 + 3t + 3t² − 3t³)/6, each with its mirror image in 1 − t.
#[inline(always)]
pub(in crate::field) fn taps<R: Real>(t: R) -> Taps<R, 4> {
    let c = |x: f64| R::from_f64(x);
    let u = R::ONE - t;
    let outer = |t: R| t * t * t * c(1.0 / 6.0);
    let inner = |t: R| c(1.0 / 6.0) + R::HALF * t * (R::ONE + t - t * t);
    let outer_first = |t: R| R::HALF * t * t;
    let inner_first = |t: R| R::HALF + t - c(1.5) * t * t;
    let inner_second = |t: R| R::ONE - c(3.0) * t;
    Taps {
        value: [outer(u), inner(u), inner(t), outer(t)],
        first: [-outer_first(u), -inner_first(u), inner_first(t), outer_first(t)],
        second: [u, inner_second(u), inner_second(t), t],
    }
}

impl<R: Real> Interpolant<R> for Bspline<'_, R> {
    #[inline]
    fn value(&self, _: &Field<'_, R>, at: CellPosition<R>) -> R {
        self.0.base() + self.0.sum(at.cell, &tensor::Value { w: at.w, taps })
    }

    #[inline]
    fn gradient(&self, _: &Field<'_, R>, at: CellPosition<R>) -> Vec3<R> {
        self.0.sum(at.cell, &tensor::Gradient { w: at.w, taps })
    }

    #[inline]
    fn second(&self, _: &Field<'_, R>, at: CellPosition<R>) -> (Vec3<R>, Sym3<R>) {
        self.0.sum(at.cell, &tensor::Second { w: at.w, taps })
    }
}

impl<R: Real> Interpolant<R> for BsplineSmooth {
    #[inline]
    fn value(&self, field: &Field<'_, R>, at: CellPosition<R>) -> R {
        field.stencils.sum(at.cell, &tensor::Value { w: at.w, taps })
    }

    #[inline]
    fn gradient(&self, field: &Field<'_, R>, at: CellPosition<R>) -> Vec3<R> {
        field.stencils.sum(at.cell, &tensor::Gradient { w: at.w, taps })
    }

    #[inline]
    fn second(&self, field: &Field<'_, R>, at: CellPosition<R>) -> (Vec3<R>, Sym3<R>) {
        field.stencils.sum(at.cell, &tensor::Second { w: at.w, taps })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn published_values_at_the_knots_and_half_way() {
        let close = |got: [f64; 4], want: [f64; 4]| {
            for i in 0..4 {
                assert!((got[i] - want[i]).abs() <= 2.0 * f64::EPSILON, "{got:?} {want:?}");
            }
        };
        close(taps(0.0).value, [1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0, 0.0]);
        close(taps(0.0).first, [-0.5, 0.0, 0.5, 0.0]);
        close(taps(0.0).second, [1.0, -2.0, 1.0, 0.0]);
        close(taps(0.5).value, [1.0 / 48.0, 23.0 / 48.0, 23.0 / 48.0, 1.0 / 48.0]);
        close(taps(0.5).first, [-0.125, -0.625, 0.625, 0.125]);
        close(taps(0.5).second, [0.5, -0.5, -0.5, 0.5]);
        close(taps(1.0).value, [0.0, 1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0]);
    }
}
