//! Ray order: one ray after the other, each to its end.

use super::path::{self, End, Step};
use super::ray_state::RayState;
use crate::field::Sampler;
use crate::number::Real;
use crate::ray::brick_occupancy::RayIntervals;
use crate::ray::prepared::Prepared;
use crate::ray::sample::need::{self, Need, Needs};
use crate::ray::tile_work::TileWork;
use crate::surface::Clipped;
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
        state.path(point, boxes.as_deref_mut(), &mut steps);
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
    pub(crate) fn path(&self, point: [f64; 2], boxes: Option<&mut RayIntervals>, steps: &mut Vec<Step<'p>>) {
        self.path_among(self.prepared.lines_at(point), boxes, steps);
    }

    /// Appends the steps of the ray among lines that lie on it.
    pub(crate) fn path_among(
        &self,
        lines: &'p [Fragment],
        boxes: Option<&mut RayIntervals>,
        steps: &mut Vec<Step<'p>>,
    ) {
        let (prepared, ray) = (self.prepared, &self.evaluator.ray);
        let object = &prepared.object;
        let visits = |boxes| ray.visits(object.ends, &object.clip.planes, ray.intervals(boxes));
        if prepared.surface.is_none() && prepared.meshes.is_none() {
            return path::steps(ray, visits(boxes), lines, None, steps);
        }
        let near = match prepared.view.perspective {
            // Of shells near is the radius.
            true => prepared.lattice.near * (ray.depth_step.to_f64() / prepared.lattice.step),
            false => f64::NEG_INFINITY,
        };
        let on_surface = prepared.surface.as_ref().and_then(|surface| {
            let mask = prepared.object.volume.mask();
            let clipped = Clipped { clip: &object.clip.planes, outside: object.outside };
            let (sampler, range) = (self.evaluator.sampler, [near, f64::INFINITY]);
            surface.roots.first_left(sampler, mask, ray.line(), range, clipped)
        });
        let on_mesh = prepared.meshes.as_ref().and_then(|meshes| meshes.nearest(ray, near));
        let end = End::nearer(on_surface, on_mesh);
        if prepared.surface.as_ref().is_some_and(|surface| surface.alone) {
            path::steps(ray, std::iter::empty(), lines, end, steps);
        } else {
            path::steps(ray, visits(boxes), lines, end, steps);
        }
    }
}
