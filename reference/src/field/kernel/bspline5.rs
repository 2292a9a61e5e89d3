//! The quintic B-spline on prefiltered coefficients: the most exact kernel on smooth data ([REC-1]). Four times
//! continuously differentiable.

use crate::field::Field;
use crate::field::coefficients::Coefficients;
use crate::field::kernel::Interpolant;
use crate::field::place::CellPosition;
use crate::field::tensor::{self, RowsFn, Taps};
use crate::number::lanes::widely;
use crate::number::{Real, Sym3, Vec3};

/// The prefiltered quintic B-spline.
#[derive(Clone, Copy, Debug)]
pub struct Bspline5<'f, R>(pub(in crate::field) &'f Coefficients<R>);

/// The polynomial with coefficients `c`, highest power first, divided by `over`.
#[inline(always)]
fn horner<R: Real, const N: usize>(c: [f64; N], t: R, over: f64) -> R {
    let mut sum = R::from_f64(c[0]);
    for &next in &c[1..] {
        sum = sum * t + R::from_f64(next);
    }
    sum * R::from_f64(1.0 / over)
}

/// β⁵ at t + 2 … t − 3 for 0 ≤ t ≤ 1, with first and second derivatives.
///
/// 120 times the pieces, from the outermost: t⁵; 1 + 5t + 10t² + 10t³ + 5t⁴ − 5t⁵; 26 + 50t + 20t² − 20t³ − 20t⁴ + 10t⁵,
/// each with its mirror image in 1 − t.
#[inline(always)]
pub(in crate::field) fn taps<R: Real>(t: R) -> Taps<R, 6> {
    let u = R::ONE - t;
    let piece = |t: R| {
        let square = t * t;
        let outer = square * square * t * R::from_f64(1.0 / 120.0);
        let middle = horner([-5.0, 5.0, 10.0, 10.0, 5.0, 1.0], t, 120.0);
        let inner = horner([10.0, -20.0, -20.0, 20.0, 50.0, 26.0], t, 120.0);
        [inner, middle, outer]
    };
    let first = |t: R| {
        let square = t * t;
        let outer = square * square * R::from_f64(1.0 / 24.0);
        let middle = horner([-5.0, 4.0, 6.0, 4.0, 1.0], t, 24.0);
        let inner = horner([5.0, -8.0, -6.0, 4.0, 5.0], t, 12.0);
        [inner, middle, outer]
    };
    let second = |t: R| {
        let outer = t * t * t * R::from_f64(1.0 / 6.0);
        let middle = horner([-5.0, 3.0, 3.0, 1.0], t, 6.0);
        let inner = horner([5.0, -6.0, -3.0, 1.0], t, 3.0);
        [inner, middle, outer]
    };
    let even = |[a, b, c]: [R; 3], [d, e, f]: [R; 3]| [f, e, d, a, b, c];
    let odd = |[a, b, c]: [R; 3], [d, e, f]: [R; 3]| [-f, -e, -d, a, b, c];
    Taps { value: even(piece(t), piece(u)), first: odd(first(t), first(u)), second: even(second(t), second(u)) }
}

impl<R: Real> Interpolant<R> for Bspline5<'_, R> {
    #[inline]
    fn value(&self, _: &Field<'_, R>, at: CellPosition<R>) -> R {
        widely(
            #[inline(always)]
            || self.0.base() + tensor::value(&RowsFn(self.0.rows(at.cell)), &at.w.map(taps)),
        )
    }

    #[inline]
    fn gradient(&self, _: &Field<'_, R>, at: CellPosition<R>) -> Vec3<R> {
        widely(
            #[inline(always)]
            || tensor::gradient(&RowsFn(self.0.rows(at.cell)), &at.w.map(taps)),
        )
    }

    #[inline]
    fn second(&self, _: &Field<'_, R>, at: CellPosition<R>) -> (Vec3<R>, Sym3<R>) {
        widely(
            #[inline(always)]
            || tensor::second(&RowsFn(self.0.rows(at.cell)), &at.w.map(taps)),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// β⁵ from its definition, the fifth convolution power of the box: Σ_k (−1)^k C(6, k) (x + 3 − k)₊⁵ / 120, and
    /// its derivatives.
    fn definition(x: f64, derivative: i32) -> f64 {
        let binomial = [1.0, -6.0, 15.0, -20.0, 15.0, -6.0, 1.0];
        let factor = [1.0, 5.0, 20.0][derivative as usize] / 120.0;
        let term = |k: usize| binomial[k] * (x + 3.0 - k as f64).max(0.0).powi(5 - derivative);
        (0..7).map(term).sum::<f64>() * factor
    }

    #[test]
    fn the_pieces_are_the_quintic_b_spline() {
        for t in [0.0, 0.125, 0.3, 0.5, 0.77, 1.0] {
            let got = taps(t);
            for i in 0..6 {
                let x = t + 2.0 - i as f64;
                // The definition cancels terms of up to 15 · 6⁵ / 120 ≈ 972.
                let bound = 7.0 * 972.0 * f64::EPSILON;
                for (got, derivative) in [(got.value[i], 0), (got.first[i], 1), (got.second[i], 2)] {
                    let want = definition(x, derivative);
                    assert!((got - want).abs() <= bound, "t = {t}, tap {i}, derivative {derivative}: {got} {want}");
                }
            }
        }
    }

    #[test]
    fn at_a_knot() {
        assert_eq!(taps(0.0).value.map(|w| (w * 120.0f64).round()), [1.0, 26.0, 66.0, 26.0, 1.0, 0.0]);
        assert_eq!(taps(0.0).first.map(|w| (w * 24.0f64).round()), [-1.0, -10.0, 0.0, 10.0, 1.0, 0.0]);
        assert_eq!(taps(0.0).second.map(|w| (w * 6.0f64).round()), [1.0, 2.0, -6.0, 2.0, 1.0, 0.0]);
    }
}
