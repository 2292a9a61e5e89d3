//! Catmull–Rom: interpolates the voxels, C¹, exact for quadratics ([REC-1]).

use crate::field::Field;
use crate::field::kernel::Interpolant;
use crate::field::place::CellPosition;
use crate::field::tensor::{self, Taps};
use crate::number::{Real, Vec3};

/// The Catmull–Rom spline.
#[derive(Clone, Copy, Debug)]
pub struct CatmullRom;

/// Weights of samples −1 … 2 for 0 ≤ t ≤ 1, with first derivatives. The cubic passes through samples 0 and 1, with
/// central differences as slopes. Its second derivatives jump at the voxels and are no estimate ([REC-3]), so they are
/// left out.
#[inline(always)]
fn taps<R: Real>(t: R) -> Taps<R, 4> {
    let c = |x: f64| R::from_f64(x);
    let u = R::ONE - t;
    let outer = |t: R| -(R::HALF * t * t * (R::ONE - t));
    let inner = |t: R| R::HALF * t * (R::ONE + t * (c(4.0) - c(3.0) * t));
    let outer_first = |t: R| R::HALF * t * (c(3.0) * t - c(2.0));
    let inner_first = |t: R| R::HALF + t * (c(4.0) - c(4.5) * t);
    Taps {
        value: [outer(u), inner(u), inner(t), outer(t)],
        first: [-outer_first(u), -inner_first(u), inner_first(t), outer_first(t)],
        second: [R::ZERO; 4],
    }
}

impl<R: Real> Interpolant<R> for CatmullRom {
    #[inline]
    fn value(&self, field: &Field<'_, R>, at: CellPosition<R>) -> R {
        field.stencils.sum(at.cell, &tensor::Value { w: at.w, taps })
    }

    #[inline]
    fn gradient(&self, field: &Field<'_, R>, at: CellPosition<R>) -> Vec3<R> {
        field.stencils.sum(at.cell, &tensor::Gradient { w: at.w, taps })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_worked_weights() {
        assert_eq!(taps(0.0f64).value, [0.0, 1.0, 0.0, 0.0]);
        assert_eq!(taps(1.0f64).value, [0.0, 0.0, 1.0, 0.0]);
        assert_eq!(taps(0.5f64).value, [-1.0 / 16.0, 9.0 / 16.0, 9.0 / 16.0, -1.0 / 16.0]);
        assert_eq!(taps(0.0f64).first, [-0.5, 0.0, 0.5, 0.0]);
        assert_eq!(taps(0.5f64).first, [0.125, -1.375, 1.375, -0.125]);
        assert_eq!(taps(1.0f64).first, [0.0, -0.5, 0.0, 0.5]);
    }

    /// Σ|w| is largest at ½, where it is 1¼: in three dimensions the spline leaves the middle of its samples by at most
    /// 1.25³ ≈ 1.9531 half-ranges, the bound of [RAY-2].
    #[test]
    fn the_overshoot_that_brick_ranges_assume() {
        let reach = |t: f64| taps(t).value.iter().map(|w| w.abs()).sum::<f64>();
        assert_eq!(reach(0.5), 1.25);
        assert!((0..=1000).all(|i| reach(i as f64 / 1000.0) <= 1.25));
    }
}
