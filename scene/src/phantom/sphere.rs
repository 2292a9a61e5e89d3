//! Sphere: d = R − ‖p‖.
//!
//! Both curvatures of the iso-surface at radius ρ are 1/ρ. At the centre, f has no derivative.

use super::jet::{Scalar, length};
use super::params::{About, Allowed, HIGH, Param, Preset, W};
use super::placed::Formula;

pub(super) const SPHERE: About = About {
    name: "sphere",
    doc: "distance to a sphere: R − ‖p‖",
    params: &[Param { name: "R", doc: "radius", default: Preset::Side(0.3), allowed: Allowed::Positive }, W, HIGH],
    build: |args| {
        let [radius, w, high] = args.values();
        Ok(args.distance(Sphere { radius }, w, high))
    },
};

struct Sphere {
    radius: f64,
}

impl Formula for Sphere {
    fn at<S: Scalar>(&self, p: [S; 3]) -> S {
        S::constant(self.radius) - length(p)
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{assert_near, made, unit_grid};
    use glam::DVec3;

    #[test]
    fn distance_and_curvature_by_hand() {
        let (sphere, centre) = made("sphere", &[("R", 0.25)]);
        assert_eq!(sphere.value(centre), 0.25);
        // ‖(0.3, 0, 0.4)‖ = 0.5, and both curvatures are 1/0.5.
        let p = centre + DVec3::new(0.3, 0.0, 0.4);
        assert_near(sphere.value(p), -0.25, 1e-16);
        assert!((sphere.gradient(p) - DVec3::new(-0.6, 0.0, -0.8)).length() < 1e-15);
        assert_near(sphere.curvatures(p).unwrap()[0], 2.0, 1e-14);
        assert_near(sphere.curvatures(p).unwrap()[1], 2.0, 1e-14);
        assert_eq!(sphere.curvatures(centre), None);
    }

    #[test]
    fn the_default_fits_the_box() {
        let grid = unit_grid();
        assert_eq!(super::super::by_name("sphere", &grid, &[]).unwrap().value(grid.centre()), 0.3);
    }
}
