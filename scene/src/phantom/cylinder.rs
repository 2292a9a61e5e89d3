//! Endless circular cylinder: d = R − ‖p − (p·a) a‖, a the unit vector along the axis.
//!
//! The iso-surface at distance ρ from the axis has the curvatures 1/ρ and 0. On the axis, f has no derivative.

use super::jet::{Scalar, length};
use super::params::{About, Allowed, HIGH, Param, Preset, W};
use super::placed::Formula;
use glam::DVec3;

pub(super) const CYLINDER: About = About {
    name: "cylinder",
    doc: "distance to an endless cylinder: R − ‖p − (p·a) a‖",
    params: &[
        Param { name: "R", doc: "radius", default: Preset::Side(0.3), allowed: Allowed::Positive },
        Param { name: "ax", doc: "axis, x", default: Preset::Number(0.0), allowed: Allowed::Any },
        Param { name: "ay", doc: "axis, y", default: Preset::Number(0.0), allowed: Allowed::Any },
        Param { name: "az", doc: "axis, z; any length", default: Preset::Number(1.0), allowed: Allowed::Any },
        W,
        HIGH,
    ],
    build: |args| {
        let [radius, x, y, z, w, high] = args.values();
        let axis = DVec3::new(x, y, z).try_normalize().ok_or("the axis (ax, ay, az) has no direction")?;
        Ok(args.distance(Cylinder { radius, axis }, w, high))
    },
};

struct Cylinder {
    radius: f64,
    axis: DVec3,
}

impl Formula for Cylinder {
    fn at<S: Scalar>(&self, [x, y, z]: [S; 3]) -> S {
        let a = self.axis;
        let along = x * a.x + y * a.y + z * a.z;
        S::constant(self.radius) - length([x - along * a.x, y - along * a.y, z - along * a.z])
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{assert_near, made};
    use glam::DVec3;

    #[test]
    fn distance_and_curvatures_by_hand() {
        let (upright, centre) = made("cylinder", &[("R", 0.2)]);
        let p = centre + DVec3::new(0.3, 0.4, 0.17);
        assert_near(upright.value(p), -0.3, 1e-16);
        let [k1, k2] = upright.curvatures(p).unwrap();
        assert_near(k1, 2.0, 1e-14);
        assert_near(k2, 0.0, 1e-14);
        // Axis (1, 1, 0): (0.3, −0.3, 0.1) is √0.19 away from it.
        let (tilted, _) = made("cylinder", &[("R", 0.2), ("ax", 5.0), ("ay", 5.0), ("az", 0.0)]);
        let p = centre + DVec3::new(0.3, -0.3, 0.1);
        assert_near(tilted.value(p), 0.2 - 0.19f64.sqrt(), 1e-16);
        let [k1, k2] = tilted.curvatures(p).unwrap();
        assert_near(k1, 1.0 / 0.19f64.sqrt(), 1e-14);
        assert_near(k2, 0.0, 1e-14);
    }
}
