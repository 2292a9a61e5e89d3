//! Ray order: each ray is followed to its end before the next one.

use super::object_ray::ObjectRay;
use super::path::{self, End, Step};
use super::ray_state::RayState;
use crate::field::Sampler;
use crate::number::Real;
use crate::ray::brick_occupancy::RayIntervals;
use crate::ray::prepared::Prepared;
use crate::ray::sample::need::{self, Need, Needs};
use crate::ray::tile_work::TileWork;
use crate::surface::Clipped;
use drypoint_scene::counts::Counts;
use drypoint_scene::fragments::Fragment;

/// Casts rays of a tile one by one.
pub(crate) fn cast_all<R: Real, S: Sampler<R>>(prepared: &Prepared<'_, R>, sampler: &S, work: TileWork<'_>) {
    match prepared.object.needs {
        Needs::Value => cast_with::<need::Value, R, S>(prepared, sampler, work),
        Needs::Normal | Needs::Anything => cast_with::<need::Anything, R, S>(prepared, sampler, work),
    }
}

fn cast_with<N: Need, R: Real, S: Sampler<R>>(prepared: &Prepared<'_, R>, sampler: &S, work: TileWork<'_>) {
    let TileWork { points, mut boxes, counts, casts, .. } = work;
    let mut steps: Vec<Step> = Vec::new();
    for &point in points {
        let mut state = RayState::new(prepared, sampler, point);
        steps.clear();
        state.path(point, boxes.as_deref_mut(), &mut steps, counts);
        for step in &steps {
            if !state.take::<N>(step, None, counts) {
                break;
            }
        }
        casts.push(state.finish(counts));
    }
}

impl<'p, R: Real, S: Sampler<R>> RayState<'p, '_, R, S> {
    /// Appends the steps of the ray, which goes through a point of the picture.
    pub(crate) fn path(
        &mut self,
        point: [f64; 2],
        boxes: Option<&mut RayIntervals>,
        steps: &mut Vec<Step<'p>>,
        counts: &mut Counts,
    ) {
        self.path_among((point, self.prepared.lines_at(point)), boxes, steps, counts);
    }

    /// Appends the steps of the ray among lines that lie on it.
    pub(crate) fn path_among(
        &mut self,
        (point, lines): ([f64; 2], &'p [Fragment]),
        boxes: Option<&mut RayIntervals>,
        steps: &mut Vec<Step<'p>>,
        counts: &mut Counts,
    ) {
        if self.prepared.combination.is_some() {
            return self.path_with_objects((point, lines), boxes, steps, counts);
        }
        let (object, ray) = (&self.prepared.object, &self.evaluator.ray);
        let visits = |boxes| ray.visits(object.ends, &object.clip.planes, ray.intervals(boxes));
        let end = self.end();
        if self.prepared.surface.as_ref().is_some_and(|surface| surface.alone) {
            path::steps(ray, std::iter::empty(), lines, end, steps);
        } else {
            path::steps(ray, visits(boxes), lines, end, steps);
        }
    }

    /// Appends the steps of the ray, and finds the objects on it. The samples are those of the background and of all
    /// parts.
    #[inline(never)]
    fn path_with_objects(
        &mut self,
        (point, lines): ([f64; 2], &'p [Fragment]),
        boxes: Option<&mut RayIntervals>,
        steps: &mut Vec<Step<'p>>,
        counts: &mut Counts,
    ) {
        let (object, ray) = (&self.prepared.object, self.evaluator.ray);
        let alone = self.prepared.surface.as_ref().is_some_and(|surface| surface.alone);
        let visits = ray.visits(object.ends, &object.clip.planes, ray.intervals(boxes)).filter(|_| !alone);
        let background: Vec<[i64; 2]> = visits.collect();
        let places = (background.iter().copied(), ray.inside(object.ends));
        self.objects = ObjectRay::new(self.prepared, point, places, counts).map(Box::new);
        let visits = self.objects.as_ref().map_or(background, |objects| objects.visits());
        path::steps(&ray, visits.into_iter(), lines, self.end(), steps);
    }

    /// The place where the ray meets the iso-surface or a mesh.
    fn end(&self) -> Option<End> {
        let (prepared, ray) = (self.prepared, &self.evaluator.ray);
        let object = &prepared.object;
        let near = prepared.near_of(ray);
        let on_surface = prepared.surface.as_ref().and_then(|surface| {
            let mask = object.volume.mask();
            let clipped = Clipped { clip: &object.clip.planes, outside: object.outside };
            surface.roots.first_left(&object.field, mask, ray.line(), [near, f64::INFINITY], clipped)
        });
        let on_mesh = prepared.meshes.as_ref().and_then(|meshes| meshes.nearest(ray, near));
        End::nearer(on_surface, on_mesh)
    }
}
