//! A ray of the picture as an f32 renderer aims it.

use super::moved_ray::{MovedRay, with_errors_of};
use super::positions::RayOrigin;
use crate::number::{Bounded, Real, Vec3};
use crate::ray::composite::FieldEvaluator;
use crate::ray::lattice::IndexRay;
use crate::ray::prepared::Prepared;
use crate::ray::sample::{Evaluator, PreparedObject};
use drypoint_scene::space::Grid;
use drypoint_scene::view::Ray;

/// A ray in any grid, with the errors of its numbers.
pub(super) struct AimedRay<'p, 'v> {
    prepared: &'p Prepared<'v, Bounded>,
    pixel: Ray,
    point: [f64; 2],
    origin: RayOrigin,
    /// The depth of the plane from which rays of shaders start, in steps.
    middle: f64,
    v: Vec3<Bounded>,
    v_eye: Vec3<Bounded>,
    /// Δ_ray/Δ₀.
    pub(super) steps: Bounded,
    /// Eye depth between samples.
    pub(super) depth_step: Bounded,
}

impl<'p, 'v> AimedRay<'p, 'v> {
    /// The ray through a point of the picture, in pixels from the top left corner.
    #[inline]
    pub(super) fn new(prepared: &'p Prepared<'v, Bounded>, point: [f64; 2], origin: RayOrigin) -> Self {
        let (view, object) = (&prepared.view, &prepared.object);
        let pixel = view.ray(point[0], point[1]);
        let middle = MovedRay::middle(view, &prepared.lattice, &object.grid);
        let (v, v_eye) = (Vec3::from_glam(view.direction_to_world(pixel.v)), Vec3::from_glam(pixel.v));
        let ray = IndexRay::<Bounded>::new(&pixel, view, &prepared.lattice, &object.grid);
        let (steps, depth_step) = (Bounded::from_f64(ray.step / object.reference_length), ray.depth_step);
        let mut ray = Self { prepared, pixel, point, origin, middle, v, v_eye, steps, depth_step };
        if let Some(moved) = ray.moved_in(&object.grid) {
            (ray.v, ray.v_eye) = (with_errors_of(v, moved.v), with_errors_of(v_eye, moved.v_eye));
            let steps = moved.step / Bounded::from_f64(object.reference_length);
            ray.steps = Bounded::new(ray.steps.value(), steps.error());
            ray.depth_step = Bounded::new(depth_step.value(), moved.depth_step.error());
        }
        ray
    }

    #[inline]
    fn moved_in(&self, grid: &Grid) -> Option<MovedRay> {
        let (view, lattice) = (&self.prepared.view, &self.prepared.lattice);
        (self.origin == RayOrigin::Middle).then(|| MovedRay::new(view, lattice, (grid, self.middle), self.point))
    }

    /// The ray in a grid, with the errors of its positions in a box.
    #[inline]
    pub(super) fn in_grid(&self, grid: &Grid, ends: [Vec3<Bounded>; 2]) -> IndexRay<Bounded> {
        let ray = IndexRay::<Bounded>::new(&self.pixel, &self.prepared.view, &self.prepared.lattice, grid);
        ray.with_errors(ends, self.moved_in(grid).as_ref())
    }

    /// The evaluator of an object on the ray.
    #[inline]
    pub(super) fn evaluator(&self, object: &'p PreparedObject<'v, Bounded>) -> FieldEvaluator<'p, 'v, Bounded> {
        let dirs = object.shader.view_dirs(self.v, self.v_eye);
        let ray = self.in_grid(&object.grid, object.ends);
        let mut evaluator = Evaluator::new(object, &object.field, ray, dirs, &self.prepared.eye_axes);
        let place = ray.cut_sample(&object.clip.planes, object.ends);
        if let Some((cut, place)) = evaluator.cut.as_mut().zip(place) {
            let (_, error) = ray.crossing(&object.clip.planes.0[place.plane]);
            cut.depth = Bounded::new(place.depth, error);
        }
        evaluator
    }

    /// The depth from which rays of shaders start.
    pub(super) fn start(&self) -> f64 {
        self.middle * self.prepared.lattice.step
    }
}
