//! Rays of one tile that wait for their next planes, each with a path on which it can go on.

use super::cast::Cast;
use super::path::Step;
use super::ray_state::RayState;
use crate::field::Sampler;
use crate::number::Real;
use crate::ray::prepared::Prepared;
use crate::ray::sample::need::Anything;
use crate::ray::tile_work::TileRays;
use crate::volumetric_halos::{HaloPlanes, Tint};
use drypoint_scene::counts::Counts;

/// No plane: the ray, the tile or the picture has ended.
pub(super) const ENDED: i64 = i64::MAX;

/// Rays of one tile.
pub(super) struct WaitingTile<'p, 'v, R: Real, S> {
    rays: Vec<WaitingRay<'p, 'v, R, S>>,
    /// Rays that have steps left.
    open: Vec<usize>,
    /// The nearest plane of any of its rays.
    pub(super) next: i64,
    /// Whether anything behind one of its rays would be seen.
    pub(super) is_open: bool,
    counts: Counts,
}

/// A ray that waits for its next plane.
struct WaitingRay<'p, 'v, R: Real, S> {
    state: RayState<'p, 'v, R, S>,
    /// Column and row among the rays of the region.
    place: [usize; 2],
    path: Vec<Step<'p>>,
    /// The step that comes next.
    at: usize,
    /// The plane that comes next; the largest number where the ray has ended.
    next: i64,
    /// The largest intensities of the halos that layers show.
    intensities: Box<[f64]>,
}

impl<'p, 'v, R: Real, S: Sampler<R>> WaitingTile<'p, 'v, R, S> {
    /// Aims the rays of a tile, with so many halos that layers show.
    pub(super) fn new(prepared: &'p Prepared<'v, R>, sampler: &'p S, mut tile: TileRays, watched: usize) -> Self {
        let rays = tile.points.iter().zip(&tile.places).map(|(&point, &place)| {
            let state = RayState::new(prepared, sampler, point);
            let mut path = Vec::new();
            state.path(point, tile.boxes.as_mut(), &mut path);
            path.shrink_to_fit();
            let next = path.first().map_or(ENDED, Step::plane);
            WaitingRay { state, place, path, at: 0, next, intensities: vec![0.0; watched].into() }
        });
        let rays: Vec<_> = rays.collect();
        let next = rays.iter().map(|ray| ray.next).min().unwrap_or(ENDED);
        let open = (0..rays.len()).filter(|&i| rays[i].next != ENDED).collect();
        Self { rays, open, next, is_open: true, counts: Counts::default() }
    }

    /// Visits the planes of its rays up to `last`, without halos.
    pub(super) fn visit(&mut self, last: i64) {
        let mut next = ENDED;
        self.open.retain(|&i| {
            let ray = &mut self.rays[i];
            if ray.next <= last {
                ray.visit(last, None, &mut self.counts);
            }
            next = next.min(ray.next);
            ray.next != ENDED
        });
        self.next = next;
    }

    /// Visits the planes of its rays up to `last` under the tints of the groups before.
    pub(super) fn visit_tinted(&mut self, last: i64, halos: &HaloPlanes<'_>) {
        let mut next = ENDED;
        self.open.retain(|&i| {
            let ray = &mut self.rays[i];
            if ray.next <= last {
                let tint = halos.tint(halos.place(ray.place));
                ray.visit(last, tint.as_ref(), &mut self.counts);
            }
            next = next.min(ray.next);
            ray.next != ENDED
        });
        self.next = next;
        self.is_open = self.rays.iter().any(|ray| ray.state.is_open());
    }

    /// Visits the planes first..=last of its rays under the tints of the groups before, each plane followed by the glow of
    /// the group before.
    pub(super) fn visit_glowing(&mut self, [first, last]: [i64; 2], halos: &HaloPlanes<'_>) {
        self.next = ENDED;
        for ray in &mut self.rays {
            if !ray.state.is_open() {
                continue;
            }
            let place = halos.place(ray.place);
            for (largest, h) in ray.intensities.iter_mut().zip(halos.watched(place)) {
                *largest = largest.max(h);
            }
            let tint = if ray.next <= last { halos.tint(place) } else { None };
            match halos.glow(place, |alpha| ray.state.corrected(alpha)) {
                None => ray.visit(last, tint.as_ref(), &mut self.counts),
                Some(glow) => {
                    for k in first..=last {
                        ray.visit(k, tint.as_ref(), &mut self.counts);
                        if !ray.state.is_open() {
                            break;
                        }
                        ray.state.lay_glow(glow);
                    }
                }
            }
            if !ray.state.is_open() {
                // What lies in front hides all that follows.
                ray.next = ENDED;
            }
            self.next = self.next.min(ray.next);
        }
        self.open.retain(|&i| self.rays[i].next != ENDED);
        self.is_open = self.rays.iter().any(|ray| ray.state.is_open());
    }

    /// The last plane of any of its paths.
    pub(super) fn last(&self) -> Option<i64> {
        let last = |ray: &WaitingRay<'_, '_, R, S>| match *ray.path.last()? {
            Step::Samples([_, last]) => Some(last),
            step => Some(step.plane()),
        };
        self.rays.iter().filter_map(last).max()
    }

    /// Bytes of the states of its rays.
    pub(super) fn bytes(&self) -> u64 {
        let own = |ray: &WaitingRay<'_, '_, R, S>| size_of_val(ray.path.as_slice()) + size_of_val(&*ray.intensities);
        (size_of_val(self.rays.as_slice()) + self.rays.iter().map(own).sum::<usize>()) as u64
    }

    /// Ends the rays and returns their results.
    pub(super) fn finish(mut self) -> (Vec<Cast>, Counts) {
        let finish = |ray: WaitingRay<'_, '_, R, S>| {
            let cast = ray.state.finish(&mut self.counts);
            Cast { intensities: ray.intensities, ..cast }
        };
        let casts = self.rays.into_iter().map(finish).collect();
        (casts, self.counts)
    }
}

impl<R: Real, S: Sampler<R>> WaitingRay<'_, '_, R, S> {
    /// Takes all its steps on the planes up to `last`.
    fn visit(&mut self, last: i64, tint: Option<&Tint>, counts: &mut Counts) {
        while self.next <= last {
            let whole = self.path[self.at];
            let step = match whole {
                Step::Samples([_, end]) => Step::Samples([self.next, end.min(last)]),
                other => other,
            };
            if !self.state.take::<Anything>(&step, tint, counts) {
                self.next = ENDED;
                return;
            }
            match whole {
                Step::Samples([_, end]) if last < end => self.next = last + 1,
                _ => {
                    self.at += 1;
                    self.next = self.path.get(self.at).map_or(ENDED, Step::plane);
                }
            }
        }
    }
}
