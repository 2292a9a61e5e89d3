//! Rays as shaders compute them: for each pixel, in f32, starting from a plane in the middle of the volume.

use crate::number::{Arithmetic, Bounded, Real, Vec3};
use drypoint_scene::glam::DVec3;
use drypoint_scene::shot::{Lattice, StepAlong};
use drypoint_scene::space::Grid;
use drypoint_scene::view::View;

/// A ray whose numbers carry the errors of the computation in shaders.
#[derive(Clone, Copy, Debug)]
pub(super) struct MovedRay {
    /// Index position at the plane in the middle.
    origin: Vec3<Bounded>,
    /// Index displacement for one unit of depth.
    along: Vec3<Bounded>,
    /// Eye depth between samples.
    pub(super) depth_step: Bounded,
    /// Depth of the plane in the middle, in steps.
    middle: f64,
    /// World distance between samples.
    pub(super) step: Bounded,
    /// v in world space.
    pub(super) v: Vec3<Bounded>,
    /// v in eye space.
    pub(super) v_eye: Vec3<Bounded>,
}

impl MovedRay {
    /// The depth of the plane through the middle of a picture's volume, in steps.
    pub(super) fn middle(view: &View, lattice: &Lattice, grid: &Grid) -> f64 {
        let by_ray = view.perspective && lattice.along == StepAlong::Ray;
        let centre = view.to_eye(grid.centre());
        let away = if by_ray { centre.length() } else { -centre.z };
        (away / lattice.step).floor() + 0.5
    }

    /// The ray through a point of the picture, in pixels from the top left corner. `middle` is the depth of the plane
    /// from which it starts.
    #[inline]
    pub(super) fn new(view: &View, lattice: &Lattice, (grid, middle): (&Grid, f64), [i, j]: [f64; 2]) -> Self {
        let number = Bounded::from_f64;
        let vector = |v: DVec3| Vec3::<Bounded>::from_glam(v);
        let by_ray = view.perspective && lattice.along == StepAlong::Ray;
        let from_middle = number(lattice.step) * number(middle);
        // The point of the picture, from its middle, and the direction.
        let (x, y) = (number(i - view.size[0] as f64 / 2.0), number(view.size[1] as f64 / 2.0 - j));
        let inverse = grid.inverse_axes();
        let right = vector(inverse * view.right * view.pixel);
        let off = right * x + vector(inverse * view.up * view.pixel) * y;
        let forward = vector(inverse * view.forward);
        let at_middle = vector(grid.to_index(view.eye + view.forward * (middle * lattice.step)));
        let step = number(lattice.step);
        if !view.perspective {
            let v = vector(-view.forward);
            let v_eye = vector(DVec3::Z);
            return Self { origin: at_middle + off, along: forward, depth_step: step, middle, step, v, v_eye };
        }
        let pixel = number(view.pixel);
        let e = Vec3::new(-x * pixel, -y * pixel, Bounded::ONE);
        let cosine = Bounded::ONE / Arithmetic::sqrt(e.dot(e));
        let v_eye = e * cosine;
        let [to_right, up, ahead] = [view.right, view.up, view.forward].map(vector);
        let v = to_right * v_eye.x + up * v_eye.y - ahead * v_eye.z;
        let along = forward + off;
        if by_ray {
            let depth_step = step * cosine;
            let origin = vector(grid.to_index(view.eye)) + along * (number(middle) * depth_step);
            return Self { origin, along, depth_step, middle, step, v, v_eye };
        }
        let origin = at_middle + off * from_middle;
        Self { origin, along, depth_step: step, middle, step: step / cosine, v, v_eye }
    }

    /// Errors of positions along each axis, at a depth.
    pub(super) fn errors_at(&self, depth: f64) -> [f64; 3] {
        let k = Bounded::exact(depth / self.depth_step.value() - self.middle);
        let p = self.origin + self.along * (k * self.depth_step);
        [p.x, p.y, p.z].map(Bounded::error)
    }
}

/// The numbers of `v` with the errors of `other`.
pub(super) fn with_errors_of(v: Vec3<Bounded>, other: Vec3<Bounded>) -> Vec3<Bounded> {
    let with = |a: Bounded, b: Bounded| Bounded::new(a.value(), b.error());
    Vec3::new(with(v.x, other.x), with(v.y, other.y), with(v.z, other.z))
}
