//! Nested spherical shells with labels: n steps from 0 to `high` at equally spaced radii.
//!
//! f = (high / n) Σᵢ σ((Rᵢ − ‖p‖) / w), Rᵢ = R (n − i) / n, i = 0 … n − 1, σ the logistic function; w = 0: steps.
//! From outside to the centre the value only rises, so every interval of values belongs to one shell or one edge.
//! Label: the number of radii Rᵢ ≥ ‖p‖: 0 outside, 1 the outermost shell, n the core.

use super::jet::{Scalar, length};
use super::params::{About, Allowed, HIGH, Param, Preset, W};
use super::placed::Formula;
use glam::DVec3;

pub(super) const SHELLS: About = About {
    name: "shells",
    doc: "nested spherical shells, values rising in n equal steps to the core; labelled 1…n from outside",
    params: &[
        Param { name: "R", doc: "outer radius", default: Preset::Side(0.45), allowed: Allowed::Positive },
        Param { name: "n", doc: "shells", default: Preset::Number(4.0), allowed: Allowed::Whole(1.0, 1000.0) },
        Param { doc: "edge width in world units; 0: steps", ..W },
        HIGH,
    ],
    build: |args| {
        let [radius, n, w, high] = args.values();
        Ok(args.field(Shells { radius, n: n as u16, w, high }))
    },
};

struct Shells {
    radius: f64,
    n: u16,
    w: f64,
    high: f64,
}

impl Shells {
    /// R₀ > R₁ > …
    fn radii(&self) -> impl Iterator<Item = f64> {
        (0..self.n).map(|i| self.radius * f64::from(self.n - i) / f64::from(self.n))
    }
}

impl Formula for Shells {
    fn at<S: Scalar>(&self, p: [S; 3]) -> S {
        let r = length(p);
        let step = |radius: f64| {
            if self.w == 0.0 {
                S::constant(f64::from(u8::from(radius >= r.real())))
            } else {
                ((S::constant(radius) - r) * (1.0 / self.w)).logistic()
            }
        };
        self.radii().fold(S::constant(0.0), |sum, radius| sum + step(radius)) * (self.high / f64::from(self.n))
    }

    fn label(&self, p: DVec3) -> u16 {
        let r = length(p.to_array());
        self.radii().filter(|&radius| radius >= r).count() as u16
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{assert_near, made};
    use glam::DVec3;

    #[test]
    fn values_and_labels_by_hand() {
        let given = [("R", 0.4), ("n", 4.0), ("high", 200.0)];
        let (steps, centre) = made("shells", &given);
        for (r, label) in [(0.0, 4), (0.05, 4), (0.15, 3), (0.25, 2), (0.35, 1), (0.45, 0)] {
            let p = centre + DVec3::new(0.0, r, 0.0);
            assert_eq!((steps.label(p), steps.value(p)), (label, 50.0 * f64::from(label)));
            assert_eq!(steps.curvatures(p), None);
        }
        let (smooth, _) = made("shells", &[given[0], given[1], given[2], ("w", 0.002)]);
        // Mid-edge is halfway up; the next edges are 50 w away and add e^−50.
        assert_near(smooth.value(centre + DVec3::new(0.3, 0.0, 0.0)), 75.0, 1e-12);
        let [k1, k2] = smooth.curvatures(centre + DVec3::new(0.3, 0.0, 0.0)).unwrap();
        assert_near(k1, 1.0 / 0.3, 1e-13);
        assert_near(k2, 1.0 / 0.3, 1e-13);
    }
}
