//! Ring torus about the z axis: d = r − √((√(x² + y²) − R)² + z²).
//!
//! With θ the angle round the tube, 0 on the outer side, the iso-surface at distance ρ from the ring of radius R has
//! the curvatures 1/ρ and cos θ / (R + ρ cos θ): both are positive on the outer side, and of opposite signs on the
//! inner side. f has no derivative on the ring and the axis.

use super::jet::{Scalar, length};
use super::params::{About, Allowed, HIGH, Param, Preset, W};
use super::placed::Formula;

pub(super) const TORUS: About = About {
    name: "torus",
    doc: "distance to a torus about z: r − √((√(x² + y²) − R)² + z²)",
    params: &[
        Param { name: "R", doc: "radius of the ring", default: Preset::Side(0.3), allowed: Allowed::Positive },
        Param {
            name: "r",
            doc: "radius of the tube, below R",
            default: Preset::Side(0.12),
            allowed: Allowed::Positive,
        },
        W,
        HIGH,
    ],
    build: |args| {
        let [ring, tube, w, high] = args.values();
        if tube >= ring {
            return Err(format!("r = {tube} must be below R = {ring}, or the torus meets itself"));
        }
        Ok(args.distance(Torus { ring, tube }, w, high))
    },
};

struct Torus {
    ring: f64,
    tube: f64,
}

impl Formula for Torus {
    fn at<S: Scalar>(&self, [x, y, z]: [S; 3]) -> S {
        S::constant(self.tube) - length([length([x, y]) - self.ring, z])
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{assert_near, made};
    use glam::DVec3;

    #[test]
    fn curvatures_outside_inside_and_on_top() {
        let (torus, centre) = made("torus", &[("R", 0.3), ("r", 0.1)]);
        // A bound of 16 ε κ: two roots, each followed by a subtraction of numbers of like size.
        for (at, k) in [
            (DVec3::new(0.4, 0.0, 0.0), [1.0 / 0.1, 1.0 / 0.4]),
            (DVec3::new(0.0, 0.2, 0.0), [1.0 / 0.1, -1.0 / 0.2]),
            (DVec3::new(0.3, 0.0, -0.1), [1.0 / 0.1, 0.0]),
            // cos θ = 0.6: on the tube of radius 0.05 about the ring.
            (DVec3::new(0.33, 0.0, 0.04), [1.0 / 0.05, 0.6 / 0.33]),
        ] {
            let got = torus.curvatures(centre + at).unwrap();
            assert_near(got[0], k[0], 1e-13);
            assert_near(got[1], k[1], 1e-13);
        }
        assert_near(torus.value(centre + DVec3::new(0.33, 0.0, 0.04)), 0.05, 1e-16);
        assert_near(torus.value(centre), -0.2, 1e-16);
    }
}
