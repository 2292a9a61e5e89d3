//! The contour of a lighting transfer function: where c·(N·Ĥ) = N·L (Bruckner and Gröller 2005, 5; [VS-5]).
//!
//! L + v = c·Ĥ with c = ‖L + v‖ = √(2 + 2 L·v), so that N·v = c·(N·Ĥ) − N·L for every normal.

use crate::document::declare::choices;
use crate::math;

choices! {
    /// The factor c of the contours of a lighting preset, which are dark where c·(N·Ĥ) − N·L is near 0.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
    pub enum ContourRule {
        /// c = ‖L + v‖, so that contours lie where N·v = 0. In perspective v is that of the picture's centre.
        Exact = "exact",
        /// c = 2, as in the paper. Contours lie on the silhouette only for light that comes from the eye.
        Printed = "printed",
    }
}

impl ContourRule {
    /// Returns c for light and eye with the given L·v.
    pub fn factor(self, l_dot_v: f64) -> f64 {
        match self {
            Self::Exact => (2.0 + 2.0 * l_dot_v).max(0.0).sqrt(),
            Self::Printed => 2.0,
        }
    }

    /// Returns the angle, in degrees, between the silhouette and contours with the given factor c and L·v.
    ///
    /// With c₁ = ‖L + v‖ the contour's normals are perpendicular to c·Ĥ − L, which points along c·v + (c − c₁)·L. The
    /// error is the angle between this direction and v.
    pub fn error(factor: f64, l_dot_v: f64) -> f64 {
        let aside = factor - Self::Exact.factor(l_dot_v);
        let across = aside * (1.0 - l_dot_v * l_dot_v).max(0.0).sqrt();
        math::atan2(across.abs(), factor + aside * l_dot_v).to_degrees()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    /// N·v = c·(N·Ĥ) − N·L for the exact factor, whatever the directions.
    #[test]
    fn the_exact_factor_gives_the_cosine_to_the_eye() {
        let unit = |x: f64, y: f64, z: f64| DVec3::new(x, y, z).normalize();
        for (n, l, v) in [
            (unit(1.0, 2.0, 3.0), unit(-1.0, 0.5, 0.2), unit(0.3, -0.2, 1.0)),
            (unit(0.0, 1.0, 0.0), unit(0.0, 0.1, -1.0), unit(0.0, 0.0, 1.0)),
            (unit(-1.0, 0.0, 0.3), unit(0.0, 0.0, 1.0), unit(0.0, 0.0, 1.0)),
        ] {
            let half = (l + v).normalize();
            let c = ContourRule::Exact.factor(l.dot(v));
            // 2 + 2 L·v carries four roundings of 1, and its root 1/c times as much.
            assert!((c * n.dot(half) - n.dot(l) - n.dot(v)).abs() < 4.0 * f64::EPSILON / c.min(1.0));
        }
        assert_eq!([1.0, -1.0, -1.0 - 1e-15].map(|x| ContourRule::Exact.factor(x)), [2.0, 0.0, 0.0]);
    }

    /// The error against a search over normals in the plane of L and v.
    #[test]
    fn the_error_is_where_the_band_is_by_search() {
        for degrees in [1.0f64, 20.0, 45.0, 90.0, 120.0, 150.0, 170.0] {
            let (v, l) = (DVec3::Z, DVec3::new(degrees.to_radians().sin(), 0.0, degrees.to_radians().cos()));
            let half = (l + v).normalize();
            for factor in [2.0, 1.5] {
                let off = |t: f64| {
                    let n = DVec3::new(t.to_radians().cos(), 0.0, t.to_radians().sin());
                    factor * n.dot(half) - n.dot(l)
                };
                // The root nearest to the silhouette, at t = 0.
                let steps = || (0..180_000).map(|i| f64::from(i) * 0.0005);
                let found = steps().find(|&t| off(t) * off(t + 0.0005) <= 0.0 || off(-t) * off(-t - 0.0005) <= 0.0);
                let error = ContourRule::error(factor, l.dot(v));
                assert!((found.unwrap() - error).abs() < 0.001, "{degrees} {factor}: {found:?} {error}");
            }
        }
        for l_dot_v in [-0.99, -0.5, 0.0, 0.7, 1.0] {
            assert!(ContourRule::error(ContourRule::Exact.factor(l_dot_v), l_dot_v) < 1e-13);
        }
    }

    /// At θ between light and eye contours are perpendicular to 2Ĥ − L.
    #[test]
    fn the_printed_factor_by_hand() {
        let error = |degrees: f64| ContourRule::error(2.0, degrees.to_radians().cos());
        // At 90°, 2Ĥ − L = (√2 − 1, √2): atan((√2 − 1)/√2). At 120°, 2Ĥ − L is 30° from v.
        assert!((error(90.0) - ((2f64.sqrt() - 1.0) / 2f64.sqrt()).atan().to_degrees()).abs() < 1e-12);
        assert!((error(120.0) - 30.0).abs() < 1e-12);
        assert!(error(0.0) < 1e-12);
    }
}
