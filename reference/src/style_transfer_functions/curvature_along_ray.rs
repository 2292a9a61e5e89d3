//! κ_v from two normals along a ray (3.3, Fig. 6; [STF-5]): no second derivative is reconstructed.

use crate::number::{Elementary, Mask, Vec3};
use drypoint_scene::shot::Turn;

/// κ_v ≈ angle(N here, N at plane k − 1) / Δ_ray, in reciprocal world units, never negative; 0 unless both normals are
/// `known`.
///
/// The normal `before` is unknown if the previous plane's sample has none, lies outside the box, or is not beyond
/// `near`. On a surface whose normal turns at the rate |dN/ds| along the ray, the error is of first order in Δ_ray.
#[inline(always)]
pub fn kappa<A: Elementary>(turn: Turn, n: Vec3<A>, before: Vec3<A>, known: A::Mask, delta_ray: A) -> A {
    let zero = delta_ray.zero();
    if !known.any() {
        return zero;
    }
    let cosine = n.dot(before);
    let cosine = match turn {
        Turn::OfNormals => cosine,
        Turn::OfLines => cosine.abs(),
    };
    A::select(known, n.cross(before).length().angle(cosine) / delta_ray, zero)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::lanes::LANES;
    use crate::number::lanes::testing::{numbers, same, side_by_side, units};
    use fearless_simd::prelude::*;
    use fearless_simd::{Level, dispatch, f64x8, mask64x8};
    use std::f64::consts::{FRAC_PI_2, PI};

    fn unit(x: f64, y: f64, z: f64) -> Vec3<f64> {
        let v = Vec3::new(x, y, z);
        v * (1.0 / v.length())
    }

    #[test]
    fn by_hand() {
        // 30° in two world units.
        let (a, b) = (Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.75f64.sqrt(), 0.5, 0.0));
        assert!((kappa(Turn::OfNormals, a, b, true, 2.0) - PI / 12.0).abs() < 1e-16);
        assert_eq!(kappa(Turn::OfNormals, a, b, false, 2.0), 0.0);
        // A flat wall turns nothing, exactly.
        assert_eq!(kappa(Turn::OfNormals, b, b, true, 2.0), 0.0);
    }

    #[test]
    fn a_thin_sheet_turns_its_normal_round() {
        let n = unit(0.3, -0.2, 0.9);
        assert!((kappa(Turn::OfNormals, n, -n, true, 0.5) - 2.0 * PI).abs() < 1e-15);
        assert!(kappa(Turn::OfLines, n, -n, true, 0.5).abs() < 1e-15);
        let across = unit(0.2, 0.3, 0.0);
        assert!((kappa(Turn::OfLines, n, across, true, 1.0) - FRAC_PI_2).abs() < 1e-15);
    }

    /// A step Δ along the ray on a sphere of radius r, from a point at angle θ between N and v, turns the normal by
    /// atan2(Δ sinθ, r + Δ cosθ). The rate is sinθ/r.
    #[test]
    fn spheres_in_closed_form() {
        for (r, theta) in [(4.0, 0.3), (4.0, FRAC_PI_2), (100.0, 1.2)] {
            let p = Vec3::new(r * f64::sin(theta), 0.0, r * f64::cos(theta));
            let mut errors = Vec::new();
            for delta in [0.5, 0.25, 0.125] {
                let q = p + Vec3::new(0.0, 0.0, delta);
                let found = kappa(Turn::OfNormals, unit(p.x, p.y, p.z), unit(q.x, q.y, q.z), true, delta);
                let closed = (delta * theta.sin()).atan2(r + delta * theta.cos()) / delta;
                assert!((found - closed).abs() < 1e-14, "{r}, {theta}, {delta}");
                errors.push((found - theta.sin() / r).abs());
            }
            assert!(errors[1] < 0.55 * errors[0] && errors[2] < 0.55 * errors[1], "first order or better: {errors:?}");
        }
    }

    /// A cylinder of radius r whose axis is at ψ to the view plane, at its silhouette. The exact normal curvature in
    /// the view direction is cos²ψ/r, the turn along the ray |cosψ|/r.
    #[test]
    fn a_tilted_cylinder_has_the_ratio_one_to_cos_psi() {
        let r = 5.0;
        for psi in [0.0f64, 0.4, 1.0, 1.4] {
            let axis = Vec3::new(0.0, psi.cos(), psi.sin());
            let normal = |p: Vec3<f64>| {
                let across = p - axis * axis.dot(p);
                across * (1.0 / across.length())
            };
            let p = Vec3::new(r, 0.0, 0.0);
            let delta = 1e-4;
            let ray = kappa(Turn::OfNormals, normal(p), normal(p + Vec3::new(0.0, 0.0, delta)), true, delta);
            // CUR-2 with G = e eᵀ/r on the tangent plane, e across the axis, and t = v at the silhouette.
            let v = Vec3::new(0.0, 0.0, 1.0);
            let across = v - axis * axis.dot(v);
            let exact = across.dot(across) / r;
            // The turn is atan(Δ|cosψ|/r), so the ratio's error is below (Δ/r)².
            assert!((exact / ray - psi.cos()).abs() < 1e-8, "{psi}");
        }
    }

    #[test]
    fn small_angles_keep_their_digits() {
        let (a, b) = (Vec3::new(1.0f64, 0.0, 0.0), Vec3::new(1.0, 1e-12, 0.0));
        assert!((kappa(Turn::OfNormals, a, b, true, 1.0) / 1e-12 - 1.0).abs() < 1e-12);
    }

    #[test]
    fn lanes_are_those_of_one() {
        let level = Level::new();
        let [mut a, mut b] = [1, 2].map(numbers);
        for turn in [Turn::OfNormals, Turn::OfLines].into_iter().cycle().take(2000) {
            let (n, before) = (units(&mut a), units(&mut b));
            let got: [f64; LANES] = dispatch!(level, simd => {
                let known = mask64x8::from_bitmask(simd, 0b0111_1111);
                let (n, before) = (side_by_side(simd, n), side_by_side(simd, before));
                kappa(turn, n, before, known, f64x8::splat(simd, 0.3)).into()
            });
            same(got, |lane| kappa(turn, n[lane], before[lane], lane < 7, 0.3));
        }
    }
}
