//! Saddle, a quadratic field: f = −z − ½ (x²/a − y²/b).
//!
//! The surface f = 0 is z = −½ (x²/a − y²/b), with its inside below. At the centre, and on the z axis, κ₁ = 1/a and
//! κ₂ = −1/b. Elsewhere Gaussian and mean curvature are those of a graph (do Carmo 1976, 3-3, example 5), with
//! q² = 1 + x²/a² + y²/b²: K = −1 / (a b q⁴), H = ((1 + y²/b²)/a − (1 + x²/a²)/b) / (2 q³).
//! ‖∇f‖ = q, so f is the distance to the surface only in first order around the centre.

use super::jet::Scalar;
use super::params::{About, Allowed, HIGH, Param, Preset, W};
use super::placed::Formula;

pub(super) const SADDLE: About = About {
    name: "saddle",
    doc: "quadratic field with curvatures 1/a and −1/b at the centre: −z − ½ (x²/a − y²/b)",
    params: &[
        Param { name: "a", doc: "radius of curvature along x", default: Preset::Side(0.5), allowed: Allowed::Positive },
        Param { name: "b", doc: "radius of curvature along y", default: Preset::Side(0.5), allowed: Allowed::Positive },
        W,
        HIGH,
    ],
    build: |args| {
        let [a, b, w, high] = args.values();
        Ok(args.distance(Saddle { a, b }, w, high))
    },
};

struct Saddle {
    a: f64,
    b: f64,
}

impl Formula for Saddle {
    fn at<S: Scalar>(&self, [x, y, z]: [S; 3]) -> S {
        -z - x.squared() * (0.5 / self.a) + y.squared() * (0.5 / self.b)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{assert_near, made};
    use glam::DVec3;

    #[test]
    fn curvatures_at_the_centre_and_off_it() {
        let (a, b) = (0.5, 0.25);
        let (saddle, centre) = made("saddle", &[("a", a), ("b", b)]);
        assert_eq!(saddle.value(centre + DVec3::new(0.5, 0.25, 0.0)), -0.125);
        let [k1, k2] = saddle.curvatures(centre).unwrap();
        assert_near(k1, 2.0, 1e-15);
        assert_near(k2, -4.0, 1e-15);
        let (x, y) = (0.3, -0.2);
        let [k1, k2] = saddle.curvatures(centre + DVec3::new(x, y, 0.1)).unwrap();
        let q2 = 1.0 + (x / a).powi(2) + (y / b).powi(2);
        assert_near(k1 * k2, -1.0 / (a * b * q2 * q2), 1e-14);
        let mean = ((1.0 + (y / b).powi(2)) / a - (1.0 + (x / a).powi(2)) / b) / (2.0 * q2 * q2.sqrt());
        assert_near(0.5 * (k1 + k2), mean, 1e-14);
    }
}
