//! Style contours (3.3): the threshold of eq. 1 ([STF-7]) and the push along the radius of the sphere ([STF-8]).

use crate::number::{Arithmetic, Mask, Real};
use drypoint_scene::shot::Kappa;

/// The contour threshold τ of a scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contour<R> {
    pub(super) thickness: R,
    pub(super) threshold: Option<R>,
    pub(super) fade: Option<[R; 2]>,
}

impl<R: Real> Contour<R> {
    /// T in world units, which κ_v is used, and lo and hi of |g| between which contours fade in.
    pub fn new(thickness: f64, kappa: Kappa, fade: Option<[f64; 2]>) -> Self {
        let threshold = match kappa {
            Kappa::Ray | Kappa::Exact => None,
            Kappa::None { threshold } => Some(R::from_f64(threshold)),
        };
        Self { thickness: R::from_f64(thickness), threshold, fade: fade.map(|ends| ends.map(R::from_f64)) }
    }

    /// τ, which contour test, push and eq. 2 share. It is the constant threshold, or √(Tκ(2 − Tκ)) of |κ_v| in
    /// reciprocal world units, times the fade by |g| in [0, 1].
    #[inline(always)]
    pub fn tau<A: Arithmetic<Number = R>>(&self, kappa: A, g: A) -> A {
        let tau = match self.threshold {
            Some(threshold) => kappa.constant(threshold),
            None => root(kappa.abs() * kappa.constant(self.thickness)),
        };
        match self.fade {
            Some([lo, hi]) => tau * fade(g, lo, hi),
            None => tau,
        }
    }
}

/// √(x(2 − x)), x = Tκ clamped to [0, 1]. Past 1 the printed root falls again, and past 2 it is not real, but a
/// structure thinner than T is contour throughout. With the clamp, the radicand is never negative ([CUR-3]).
#[inline(always)]
pub fn root<A: Arithmetic>(t_kappa: A) -> A {
    let one = t_kappa.one();
    // In this order of operands NaN (0 · ∞) counts as 0.
    let x = t_kappa.zero().max(t_kappa).min(one);
    (x * (one + one - x)).sqrt()
}

/// Smoothstep t²(3 − 2t) of t = clamp₀₁((|g| − lo)/(hi − lo)). For hi = lo it is a step, which is 1 at |g| = lo.
#[inline(always)]
pub fn fade<A: Arithmetic>(g: A, lo: A::Number, hi: A::Number) -> A {
    let one = g.one();
    if lo == hi {
        return A::select(g.below(g.constant(lo)), g.zero(), one);
    }
    let t = ((g - g.constant(lo)) / g.constant(hi - lo)).clamp_01();
    t * t * (one + one + one - (t + t))
}

/// Pushes (N_x, N_y) outwards along the radius if the sample is on a contour, |N·v| ≤ τ: r' = min(1, r/δ), δ = 1 −
/// min(1, (τ − |N·v|)/τ).
///
/// δ falls from 1 at |N·v| = τ, where nothing moves, to 0 at the silhouette, where r' = 1. There is no push for τ = 0.
/// r = 0 stays 0, because it has no direction.
#[inline(always)]
pub fn push<A: Arithmetic>(nx: A, ny: A, n_dot_v: A, tau: A) -> (A, A) {
    let (d, zero) = (n_dot_v.abs(), tau.zero());
    let on_contour = d.at_most(tau) & !tau.equals(zero);
    if !on_contour.any() {
        return (nx, ny);
    }
    let r = (nx * nx + ny * ny).sqrt();
    let pushed = on_contour & !r.equals(zero);
    // The printed δ, without its two cancellations.
    let delta = d / tau;
    let scale = A::select(r.below(delta), delta, r);
    (A::select(pushed, nx / scale, nx), A::select(pushed, ny / scale, ny))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::Vec3;
    use crate::number::lanes::LANES;
    use crate::number::lanes::testing::{column, numbers, same};
    use crate::style_transfer_functions::curvature_along_ray;
    use drypoint_scene::shot::Turn;
    use fearless_simd::prelude::*;
    use fearless_simd::{Level, dispatch, f64x8};
    use proptest::prelude::*;

    #[test]
    fn roots_by_hand() {
        // x = 0.2: √(0.2 · 1.8) = 0.6. x = 0.4: √(0.4 · 1.6) = 0.8. Three roundings, two of them under the root.
        assert!((root(0.2f64) - 0.6).abs() < f64::EPSILON);
        assert!((root(0.4f64) - 0.8).abs() < f64::EPSILON);
        // From x = 1 on everything is contour.
        assert_eq!(
            [0.0, 1.0, 1.5, 2.0, 1e9, f64::INFINITY, -0.5, f64::NAN].map(root),
            [0.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0]
        );
    }

    #[test]
    fn the_threshold_is_that_of_the_scene() {
        let exact = Contour::<f64>::new(2.0, Kappa::Exact, None);
        assert!((exact.tau(0.1, 0.0) - 0.6).abs() < f64::EPSILON);
        assert_eq!(exact.tau(-0.1, 0.0), exact.tau(0.1, 0.0));
        assert_eq!(exact.tau(0.0, 1.0), 0.0);
        let none = Contour::<f64>::new(2.0, Kappa::None { threshold: 0.3 }, None);
        assert_eq!(none.tau(123.0, 0.5), 0.3);
        assert_eq!(Contour::<f64>::new(0.0, Kappa::Ray, None).tau(1e9, 1.0), 0.0);
        // t = ½: smoothstep ½.
        let faded = Contour::<f64>::new(2.0, Kappa::None { threshold: 0.3 }, Some([0.25, 0.75]));
        assert_eq!([0.1, 0.25, 0.5, 0.75, 0.9].map(|g| faded.tau(0.0, g)), [0.0, 0.0, 0.15, 0.3, 0.3]);
    }

    #[test]
    fn fades_by_hand() {
        // t = ¼: (1/16)(3 − ½) = 5/32.
        assert_eq!(fade(0.25, 0.0, 1.0), 0.15625);
        assert_eq!([0.49, 0.5, 0.51].map(|g| fade(g, 0.5, 0.5)), [0.0, 1.0, 1.0]);
        // Both ends 0: nothing fades.
        assert_eq!(fade(0.0, 0.0, 0.0), 1.0);
    }

    #[test]
    fn pushes_by_hand() {
        // |N·v| = 0.3 = τ/2, so δ = ½ and r doubles: 0.4 to 0.8.
        assert_eq!(push(0.4f64, 0.0, 0.3, 0.6), (0.8, 0.0));
        assert_eq!(push(0.0f64, -0.4, -0.3, 0.6), (0.0, -0.8));
        // r/δ past 1 stops at the circumference.
        for (nx, ny) in [(0.6f64, 0.8), (0.48, 0.64)] {
            let (x, y) = push(nx, ny, 0.3, 0.6);
            assert!((x - 0.6).abs() < f64::EPSILON && (y - 0.8).abs() < f64::EPSILON);
        }
        // Off the contour nothing moves.
        assert_eq!(push(0.4f64, 0.1, 0.61, 0.6), (0.4, 0.1));
    }

    #[test]
    fn limits_of_the_push() {
        // δ = 0: onto the circumference, whatever r.
        assert_eq!(push(1e-9f64, 0.0, 0.0, 0.6), (1.0, 0.0));
        // At the threshold itself δ = 1.
        assert_eq!(push(0.4f64, 0.3, 0.6, 0.6), (0.4, 0.3));
        // τ = 0, also exactly at a silhouette; r = 0, also with δ = 0.
        assert_eq!(push(0.6f64, 0.8, 0.0, 0.0), (0.6, 0.8));
        assert_eq!(push(0.0f64, 0.0, 0.0, 0.6), (0.0, 0.0));
        // A sample without a normal has N = v and |N·v| = 1: it stays where it is even for τ = 1.
        assert_eq!(push(0.0f64, 0.0, 1.0, 1.0), (0.0, 0.0));
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(400))]

        #[test]
        fn the_root_is_monotone_and_never_leaves_the_unit_interval(x in 0.0..3.0f64, more in 0.0..1.0f64) {
            prop_assert!(root(x) <= root(x + more));
            prop_assert!((0.0..=1.0).contains(&root(x)));
        }

        /// Outwards, along the radius, never past the circumference, and as printed.
        #[test]
        fn the_push_is_the_printed_one(
            r in 1e-6..=1.0f64, angle in 0.0..6.3f64, d in 0.0..=1.0f64, tau in 1e-6..=1.0f64,
        ) {
            let (nx, ny) = (r * angle.cos(), r * angle.sin());
            let (x, y) = push(nx, ny, d, tau);
            let pushed = x.hypot(y);
            prop_assert!(pushed >= r * (1.0 - 1e-15) && pushed <= 1.0 + 4e-16);
            prop_assert!((x * ny - y * nx).abs() < 1e-15);
            if d <= tau {
                let delta = 1.0 - ((tau - d) / tau).min(1.0);
                let printed = (r / delta).min(1.0);
                // δ as printed carries rounding of 1 into a quotient; r/δ ≤ 1 keeps it relative to r/δ².
                prop_assert!((pushed - printed).abs() <= 1e-15 * (1.0 + 1.0 / delta.max(r)));
            } else {
                prop_assert_eq!((x, y), (nx, ny));
            }
        }
    }

    /// An opaque ball of radius R under orthographic rays along z: what is seen at the distance ρ from its middle is
    /// the first sample inside, on planes Δ apart. Normals are those of the distance field, exact everywhere.
    struct Ball {
        radius: f64,
        delta: f64,
        /// The offset of the planes, in [0, Δ).
        shift: f64,
    }

    impl Ball {
        /// The sample seen at ρ; none if the ray slips between two planes or misses.
        fn sample(&self, rho: f64) -> Option<Vec3<f64>> {
            let surface = (self.radius * self.radius - rho * rho).max(0.0).sqrt();
            let z = self.shift + ((surface - self.shift) / self.delta).floor() * self.delta;
            (z >= -surface).then(|| Vec3::new(rho, 0.0, z))
        }

        /// κ_v at a sample of this ball.
        fn kappa(&self, kappa: Kappa, p: Vec3<f64>) -> f64 {
            let unit = |q: Vec3<f64>| q * (1.0 / q.length());
            let before = p + Vec3::new(0.0, 0.0, self.delta);
            match kappa {
                Kappa::Exact => 1.0 / p.length(),
                _ => curvature_along_ray::kappa(Turn::OfNormals, unit(p), unit(before), true, self.delta),
            }
        }

        /// The ring in world units: the summed width of what is contour, and how far inwards it reaches.
        fn ring(&self, thickness: f64, kappa: Kappa) -> (f64, f64) {
            let contour = Contour::<f64>::new(thickness, kappa, None);
            let (mut width, mut reach) = (0.0, 0.0f64);
            let parts = 4000;
            for i in 0..parts {
                let rho = self.radius * (f64::from(i) + 0.5) / f64::from(parts);
                let Some(p) = self.sample(rho) else { continue };
                if (p.z / p.length()).abs() <= contour.tau(self.kappa(kappa, p), 1.0) {
                    width += self.radius / f64::from(parts);
                    reach = reach.max(self.radius - rho);
                }
            }
            (width, reach)
        }
    }

    /// Every ball, step and lattice position of the ring tests, with T = 2.
    fn balls() -> impl Iterator<Item = Ball> {
        let shifts = [0.0, 0.21, 0.5, 0.83];
        [2.0, 3.0, 4.0, 10.0, 40.0, 100.0].into_iter().flat_map(move |radius| {
            [0.5, 0.25, 0.125].into_iter().flat_map(move |delta| {
                shifts.into_iter().map(move |shift| Ball { radius, delta, shift: shift * delta })
            })
        })
    }

    const T: f64 = 2.0;

    /// Δ√(x(2 − x)), x = min(1, (T + Δ)/R): how much farther in a sample can see that lies up to Δ under the surface.
    fn one_step(ball: &Ball) -> f64 {
        let x = ((T + ball.delta) / ball.radius).min(1.0);
        ball.delta * (x * (2.0 - x)).sqrt()
    }

    #[test]
    fn rings_of_exact_curvature_are_as_wide_as_the_thickness() {
        for ball in balls() {
            let (width, reach) = ball.ring(T, Kappa::Exact);
            // Rays that slip between two planes take up to Δ²/8R; the ring is counted in parts of R/4000.
            let part = ball.radius / 4000.0;
            let least = T - ball.delta * ball.delta / (8.0 * ball.radius);
            assert!(width >= least - part, "R {} Δ {}: {width}", ball.radius, ball.delta);
            assert!(reach <= T + one_step(&ball) + part, "R {} Δ {}: {reach}", ball.radius, ball.delta);
        }
    }

    #[test]
    fn rings_of_ray_curvature_thin_out_with_the_structure() {
        for ball in balls() {
            let (width, reach) = ball.ring(T, Kappa::Ray);
            // dN/ds along the ray is κ sinθ, so the rim 1 − Tκ sinθ = sinθ lies at R/(R + T).
            let ideal = T * ball.radius / (ball.radius + T);
            let part = ball.radius / 4000.0;
            let least = ideal - ball.delta * ball.delta / (8.0 * ball.radius) - one_step(&ball);
            assert!(width >= least - part, "R {} Δ {}: {width}, ideal {ideal}", ball.radius, ball.delta);
            assert!(
                reach <= ideal + one_step(&ball) + part,
                "R {} Δ {}: {reach}, ideal {ideal}",
                ball.radius,
                ball.delta
            );
        }
        // At R = T the ring is half as wide as the structure allows.
        let (width, _) = Ball { radius: T, delta: 1e-3, shift: 0.0 }.ring(T, Kappa::Ray);
        assert!((width - 1.0).abs() < 2e-3, "{width}");
    }

    #[test]
    fn a_ball_thinner_than_the_thickness_is_contour_throughout() {
        let (width, reach) = Ball { radius: 1.5, delta: 0.01, shift: 0.0 }.ring(T, Kappa::Exact);
        assert!(width > 1.499 && reach > 1.499, "{width}, {reach}");
    }

    #[test]
    fn lanes_are_those_of_one() {
        let level = Level::new();
        let [mut a, mut b, mut c, mut d] = [1, 2, 3, 4].map(numbers);
        let contours = [
            Contour::new(2.0, Kappa::Ray, None),
            Contour::new(0.7, Kappa::Ray, Some([0.2, 0.6])),
            Contour::new(0.7, Kappa::Ray, Some([0.5, 0.5])),
            Contour::new(0.0, Kappa::Ray, None),
            Contour::new(1.0, Kappa::None { threshold: 0.4 }, Some([0.0, 0.3])),
        ];
        for contour in contours.iter().cycle().take(2000) {
            let (kappa, g, d_v) = (column(&mut a).map(|k| 3.0 * k), column(&mut b), column(&mut c));
            let (x, y) = (column(&mut d), column(&mut a).map(|y| 0.5 - y));
            let [tau, px, py]: [[f64; LANES]; 3] = dispatch!(level, simd => {
                let (kappa, g): (f64x8<_>, f64x8<_>) = (kappa.simd_into(simd), g.simd_into(simd));
                let tau = contour.tau(kappa, g);
                let (x, y): (f64x8<_>, f64x8<_>) = (x.simd_into(simd), y.simd_into(simd));
                let (px, py) = push(x, y, d_v.simd_into(simd), tau);
                [tau.into(), px.into(), py.into()]
            });
            same(tau, |lane| contour.tau(kappa[lane], g[lane]));
            let one = |lane: usize| push(x[lane], y[lane], d_v[lane], tau[lane]);
            same(px, |lane| one(lane).0);
            same(py, |lane| one(lane).1);
        }
    }
}
