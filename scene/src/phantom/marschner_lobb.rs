//! The test signal of S. R. Marschner, R. J. Lobb: An evaluation of reconstruction filters for volume rendering.
//! Visualization '94, equation 2, on q = p / s:
//!
//! ρ(q) = (1 − sin(πz/2) + α (1 + ρᵣ(√(x² + y²)))) / (2 (1 + α)), ρᵣ(r) = cos(2π f_M cos(πr/2)), f = high · ρ.
//!
//! With f_M = 6 and α = ¼ almost all of the signal's spectrum lies below the Nyquist frequency of 40 voxels along [−1,
//! 1].

use super::jet::{Scalar, length_squared};
use super::params::{About, Allowed, HIGH, Param, Preset};
use super::placed::Formula;
use std::f64::consts::{PI, TAU};

pub(super) const MARSCHNER_LOBB: About = About {
    name: "marschner-lobb",
    doc: "Marschner and Lobb's test signal, in 0…high",
    params: &[
        Param { name: "f_M", doc: "frequency", default: Preset::Number(6.0), allowed: Allowed::NonNegative },
        Param {
            name: "alpha",
            doc: "weight of the rings",
            default: Preset::Number(0.25),
            allowed: Allowed::NonNegative,
        },
        Param {
            name: "s",
            doc: "world length of the paper's 1",
            default: Preset::Side(0.5),
            allowed: Allowed::Positive,
        },
        HIGH,
    ],
    build: |args| {
        let [frequency, alpha, scale, high] = args.values();
        Ok(args.field(MarschnerLobb { frequency, alpha, scale, high }))
    },
};

struct MarschnerLobb {
    frequency: f64,
    alpha: f64,
    scale: f64,
    high: f64,
}

impl Formula for MarschnerLobb {
    fn at<S: Scalar>(&self, p: [S; 3]) -> S {
        let [x, y, z] = p.map(|x| x * (1.0 / self.scale));
        // cos(πr/2) through r², which is smooth on the axis, where r is not.
        let inner = (length_squared([x, y]) * (0.25 * PI * PI)).cos_of_root();
        let rings = (inner * (TAU * self.frequency)).cos();
        let sum = -(z * (0.5 * PI)).sin() + rings * self.alpha + (1.0 + self.alpha);
        sum * (self.high / (2.0 * (1.0 + self.alpha)))
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{assert_near, made};
    use crate::math;
    use glam::DVec3;
    use std::f64::consts::PI;

    #[test]
    fn values_by_hand() {
        let (signal, centre) = made("marschner-lobb", &[("s", 1.0), ("high", 1.0)]);
        // On the axis ρᵣ = cos 12π = 1: ρ = (1 − sin(πz/2) + ½) / 2.5.
        assert_near(signal.value(centre), 0.6, 1e-14);
        assert_near(signal.value(centre + DVec3::new(0.0, 0.0, 1.0)), 0.2, 1e-14);
        assert_near(signal.value(centre - DVec3::new(0.0, 0.0, 1.0)), 1.0, 1e-14);
        // r = 1: cos(π/2) = 0, ρᵣ = 1. r = 2/3: cos(π/3) = ½, ρᵣ = cos 6π = 1.
        assert_near(signal.value(centre + DVec3::new(0.6, 0.8, 0.0)), 0.6, 1e-14);
        assert_near(signal.value(centre + DVec3::new(0.0, 2.0 / 3.0, 0.0)), 0.6, 1e-14);
        // As printed, at an arbitrary point; the phase of 12π rounds to 10⁻¹⁴.
        let (x, y, z) = (0.31, -0.42, 0.17);
        let rings = math::cos(12.0 * PI * math::cos(0.5 * PI * f64::hypot(x, y)));
        let rho = (1.0 - math::sin(0.5 * PI * z) + 0.25 * (1.0 + rings)) / 2.5;
        assert_near(signal.value(centre + DVec3::new(x, y, z)), rho, 1e-14);
    }

    #[test]
    fn the_axis_is_smooth() {
        // With u = πr/2 small, cos u ≈ 1 − u²/2 and ρᵣ ≈ cos(12π (1 − u²/2)) ≈ 1 − ½ (6π u²)²: no second derivative
        // at r = 0 for f_M = 6, but for f_M = ¼, ρᵣ = cos(π/2 (1 − u²/2)) ≈ π u²/4, so ∂²ρ/∂x² = α · 2 · π³/16 / 2.5.
        let (even, centre) = made("marschner-lobb", &[("s", 1.0), ("high", 1.0), ("f_M", 0.25)]);
        assert_near(even.hessian(centre).x_axis.x, 0.25 * PI * PI * PI / 8.0 / 2.5, 1e-15);
        let (signal, _) = made("marschner-lobb", &[("s", 1.0), ("high", 1.0)]);
        assert_near(signal.hessian(centre).x_axis.x, 0.0, 1e-12);
    }
}
