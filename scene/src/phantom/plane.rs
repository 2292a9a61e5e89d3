//! Half-space: d = o − n·p, n the unit outward normal. Both curvatures are 0.

use super::jet::Scalar;
use super::params::{About, Allowed, HIGH, Param, Preset, W};
use super::placed::Formula;
use glam::DVec3;

pub(super) const PLANE: About = About {
    name: "plane",
    doc: "distance to a plane: o − n·p",
    params: &[
        Param { name: "nx", doc: "outward normal, x", default: Preset::Number(0.0), allowed: Allowed::Any },
        Param { name: "ny", doc: "outward normal, y", default: Preset::Number(0.0), allowed: Allowed::Any },
        Param { name: "nz", doc: "outward normal, z; any length", default: Preset::Number(1.0), allowed: Allowed::Any },
        Param {
            name: "o",
            doc: "distance of the plane from the centre, along n",
            default: Preset::Number(0.0),
            allowed: Allowed::Any,
        },
        W,
        HIGH,
    ],
    build: |args| {
        let [x, y, z, offset, w, high] = args.values();
        let normal = DVec3::new(x, y, z).try_normalize().ok_or("the normal (nx, ny, nz) has no direction")?;
        Ok(args.distance(Plane { normal, offset }, w, high))
    },
};

struct Plane {
    normal: DVec3,
    offset: f64,
}

impl Formula for Plane {
    fn at<S: Scalar>(&self, [x, y, z]: [S; 3]) -> S {
        let n = self.normal;
        S::constant(self.offset) - (x * n.x + y * n.y + z * n.z)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{assert_near, made};
    use glam::{DMat3, DVec3};

    #[test]
    fn distance_by_hand() {
        // n = (2, 3, 6) / 7 and p = (0.7, 0, 0.7) · ½: n·p = 0.4.
        let (plane, centre) = made("plane", &[("nx", 2.0), ("ny", 3.0), ("nz", 6.0), ("o", 0.1)]);
        let p = centre + DVec3::new(0.35, 0.0, 0.35);
        assert_near(plane.value(p), -0.3, 1e-16);
        assert!((plane.gradient(p) + DVec3::new(2.0, 3.0, 6.0) / 7.0).length() < 1e-16);
        assert_eq!(plane.hessian(p), DMat3::ZERO);
        assert_eq!(plane.curvatures(p), Some([0.0, 0.0]));
    }
}
