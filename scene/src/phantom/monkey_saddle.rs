//! Monkey saddle, a cubic field: f = −z − (x³ − 3 x y²) / a².
//!
//! The surface f = 0 falls three times and rises three times round its centre, a flat umbilic: κ₁ = κ₂ = 0 there.
//! Elsewhere, with ρ² = x² + y² and q² = 1 + 9 ρ⁴/a⁴, its Gaussian curvature is K = −36 ρ² / (a⁴ q⁴) (do Carmo 1976,
//! 3-3). ‖∇f‖ = q, so f is the distance to the surface only in first order around the centre.

use super::jet::Scalar;
use super::params::{About, Allowed, HIGH, Param, Preset, W};
use super::placed::Formula;

pub(super) const MONKEY_SADDLE: About = About {
    name: "monkey-saddle",
    doc: "cubic field with a flat umbilic at the centre: −z − (x³ − 3 x y²) / a²",
    params: &[
        Param {
            name: "a",
            doc: "scale: at x = a the surface has fallen by a",
            default: Preset::Side(0.7),
            allowed: Allowed::Positive,
        },
        W,
        HIGH,
    ],
    build: |args| {
        let [a, w, high] = args.values();
        Ok(args.distance(MonkeySaddle { a }, w, high))
    },
};

struct MonkeySaddle {
    a: f64,
}

impl Formula for MonkeySaddle {
    fn at<S: Scalar>(&self, [x, y, z]: [S; 3]) -> S {
        -z - x * (x.squared() - y.squared() * 3.0) * (1.0 / (self.a * self.a))
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{assert_near, made};
    use glam::DVec3;

    #[test]
    fn the_umbilic_and_the_gaussian_curvature() {
        let a = 0.5;
        let (monkey, centre) = made("monkey-saddle", &[("a", a)]);
        assert_near(monkey.value(centre + DVec3::new(a, 0.0, -a)), 0.0, 1e-16);
        assert_eq!(monkey.curvatures(centre), Some([0.0, 0.0]));
        for (x, y) in [(0.3, 0.0), (-0.1, 0.25), (0.0, 0.4)] {
            let [k1, k2] = monkey.curvatures(centre + DVec3::new(x, y, -0.2)).unwrap();
            let rho2: f64 = x * x + y * y;
            let q2 = 1.0 + 9.0 * rho2 * rho2 / a.powi(4);
            assert_near(k1 * k2, -36.0 * rho2 / (a.powi(4) * q2 * q2), 1e-13);
            assert!(k1 > 0.0 && k2 < 0.0);
        }
    }
}
