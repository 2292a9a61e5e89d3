//! Illustrative transparency (3.4, eq. 2; [STF-9]).

use crate::number::{Elementary, Mask};
use drypoint_scene::shot::Transparency;

/// α/α_d: the factor of the style's premultiplied colour and directional opacity. All opacities here are per reference
/// length. The correction for the step ([VAL-4]) comes after.
///
/// Illustrative: α_u^(0.5 + max(0, |N·v| − τ)(1 − |g|)), eq. 2. On a contour, and where the gradient is strong, the
/// exponent is ½ and the structure keeps more of its opacity. Flat and homogeneous places lose opacity first. α_u = 1
/// gives exactly 1 and α_u = 0 exactly 0, which are the paper's two constraints. Plain: α_u.
///
/// α_u, τ and |g| are in [0, 1]. Without contours τ = 0.
#[inline(always)]
pub fn share<A: Elementary>(transparency: Transparency, alpha_u: A, n_dot_v: A, tau: A, g: A) -> A {
    let (zero, one) = (alpha_u.zero(), alpha_u.one());
    let between = !(alpha_u.equals(zero) | alpha_u.equals(one));
    if transparency == Transparency::Plain || !between.any() {
        return alpha_u;
    }
    let away_from_contour = (n_dot_v.abs() - tau).max(zero);
    let exponent = away_from_contour * (one - g) + one.half();
    A::select(between, alpha_u.power(exponent, between), alpha_u)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::lanes::LANES;
    use crate::number::lanes::testing::{column, numbers, same};
    use Transparency::{Illustrative, Plain};
    use fearless_simd::prelude::*;
    use fearless_simd::{Level, dispatch, f64x8};
    use proptest::prelude::*;

    fn illustrative(alpha_u: f64, n_dot_v: f64, tau: f64, g: f64) -> f64 {
        share(Illustrative, alpha_u, n_dot_v, tau, g)
    }

    #[test]
    fn by_hand() {
        // On the contour the exponent is ½: √0.25.
        assert!((illustrative(0.25, 0.3, 0.6, 0.0) - 0.5).abs() < 1e-16);
        // |N·v| − τ = ½ and |g| = 0: exponent 1. |N·v| = 1, τ = 0, |g| = 0: exponent 3/2, 0.25^1.5 = 1/8.
        assert_eq!(illustrative(0.25, 0.75, 0.25, 0.0), 0.25);
        assert!((illustrative(0.25, -1.0, 0.0, 0.0) - 0.125).abs() < 1e-16);
        // |g| = ½ halves what is above ½: exponent 1.
        assert_eq!(illustrative(0.25, 1.0, 0.0, 0.5), 0.25);
        // |g| = 1: ½ again.
        assert!((illustrative(0.25, 1.0, 0.0, 1.0) - 0.5).abs() < 1e-16);
        assert_eq!(share(Plain, 0.25, 1.0, 0.0, 0.0), 0.25);
    }

    #[test]
    fn the_two_constraints_hold_exactly() {
        for transparency in [Illustrative, Plain] {
            for (n_dot_v, tau, g) in [(0.0, 0.0, 0.0), (1.0, 0.0, 0.0), (0.3, 0.6, 0.9), (-0.7, 0.1, 0.2)] {
                assert_eq!(share(transparency, 1.0, n_dot_v, tau, g), 1.0);
                assert_eq!(share(transparency, 0.0, n_dot_v, tau, g), 0.0);
                assert_eq!(share(transparency, 0f32, n_dot_v as f32, tau as f32, g as f32), 0.0);
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(400))]
        /// The opacity lies between α_u^1.5 and α_u^0.5, and is monotone in everything it depends on.
        #[test]
        fn laws(
            a in 0.0..=1.0f64, more in 0.0..=1.0f64, n_dot_v in -1.0..=1.0f64, tau in 0.0..=1.0f64, g in 0.0..=1.0f64,
        ) {
            let here = illustrative(a, n_dot_v, tau, g);
            // A power rounds to within an ulp or two.
            let slack = 1.0 + 1e-15;
            prop_assert!(here >= a * a.sqrt() / slack && here <= a.sqrt() * slack);
            let towards = |x: f64| x + more * (1.0 - x);
            prop_assert!(illustrative(towards(a), n_dot_v, tau, g) * slack >= here);
            prop_assert!(illustrative(a, n_dot_v, towards(tau), g) * slack >= here);
            prop_assert!(illustrative(a, n_dot_v, tau, towards(g)) * slack >= here);
            prop_assert!(illustrative(a, towards(n_dot_v.abs()), tau, g) <= here * slack);
            prop_assert_eq!(illustrative(a, -n_dot_v, tau, g), here);
        }
    }

    #[test]
    fn lanes_are_those_of_one() {
        let level = Level::new();
        let [mut a, mut b, mut c, mut d] = [5, 6, 7, 8].map(numbers);
        for transparency in [Illustrative, Plain].into_iter().cycle().take(2000) {
            let (alpha_u, n_dot_v, tau, g) = (column(&mut a), column(&mut b), column(&mut c), column(&mut d));
            let got: [f64; LANES] = dispatch!(level, simd => {
                let (alpha_u, n_dot_v): (f64x8<_>, f64x8<_>) = (alpha_u.simd_into(simd), n_dot_v.simd_into(simd));
                share(transparency, alpha_u, n_dot_v, tau.simd_into(simd), g.simd_into(simd)).into()
            });
            same(got, |lane| share(transparency, alpha_u[lane], n_dot_v[lane], tau[lane], g[lane]));
        }
    }
}
