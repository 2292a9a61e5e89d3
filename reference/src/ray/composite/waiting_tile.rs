//! The rays of one tile, which wait between chunks of planes. Each has its path and its place on it.

use super::cast::Cast;
use super::path::Step;
use super::ray_state::RayState;
use crate::field::Field;
use crate::number::Real;
use crate::ray::prepared::Prepared;
use crate::ray::sample::need::Anything;
use crate::ray::tile_work::TileRays;
use crate::volumetric_halos::{HaloPlanes, Tint};
use drypoint_scene::counts::Counts;

/// Stands for no plane: the ray, the tile or the picture has ended.
pub(super) const ENDED: i64 = i64::MAX;

/// Rays of one tile.
pub(super) struct WaitingTile<'p, 'v, R: Real> {
    rays: Vec<WaitingRay<'p, 'v, R>>,
    /// The next plane and the index of each ray that has steps left. They are stored apart from the rays, which most
    /// chunks then need not touch.
    open: Vec<(i64, usize)>,
    /// The nearest plane in `open`.
    pub(super) next: i64,
    /// Whether something behind one of the tile's rays could still be seen.
    pub(super) is_open: bool,
    counts: Counts,
}

/// A ray that waits for its next plane.
struct WaitingRay<'p, 'v, R: Real> {
    state: RayState<'p, 'v, R, Field<'v, R>>,
    /// Column and row among the rays of the region.
    place: [usize; 2],
    path: Vec<Step<'p>>,
    /// Index of the next step.
    at: usize,
    /// The largest intensities of the halos that layers show.
    intensities: Box<[f64]>,
}

impl<'p, 'v, R: Real> WaitingTile<'p, 'v, R> {
    /// Bytes of a ray with a path of two steps.
    pub(super) const BYTES_OF_RAY: u64 = (size_of::<WaitingRay<'_, '_, R>>() + 2 * size_of::<Step<'_>>() + 32) as u64;

    /// Aims the rays of a tile. `watched` is the number of halos that layers show.
    pub(super) fn new(prepared: &'p Prepared<'v, R>, mut tile: TileRays, watched: usize) -> Self {
        let mut counts = Counts::default();
        let rays = tile.points.iter().zip(&tile.places).map(|(&point, &place)| {
            let mut state = RayState::new(prepared, &prepared.object.field, point);
            let mut path = Vec::new();
            state.path(point, tile.boxes.as_mut(), &mut path, &mut counts);
            path.shrink_to_fit();
            WaitingRay { state, place, path, at: 0, intensities: vec![0.0; watched].into() }
        });
        let rays: Vec<_> = rays.collect();
        let open: Vec<_> =
            rays.iter().enumerate().filter_map(|(i, ray)| Some((ray.path.first()?.plane(), i))).collect();
        Self { next: nearest(&open), rays, open, is_open: true, counts }
    }

    /// Visits the planes of the tile's rays up to `last`, without halos.
    pub(super) fn visit(&mut self, last: i64) {
        self.visit_with(last, |_| None);
    }

    /// Visits the planes of the tile's rays up to `last`, under the tints of the previous groups.
    pub(super) fn visit_tinted(&mut self, last: i64, halos: &HaloPlanes<'_>) {
        self.visit_with(last, |place| halos.tint(halos.place(place)));
        self.is_open = self.rays.iter().any(|ray| ray.state.is_open());
    }

    /// Visits the planes of the tile's rays up to `last`, each ray under its tint.
    fn visit_with(&mut self, last: i64, tint: impl Fn([usize; 2]) -> Option<Tint>) {
        self.open.retain_mut(|(next, i)| {
            if *next <= last {
                let ray = &mut self.rays[*i];
                *next = ray.visit([*next, last], tint(ray.place).as_ref(), &mut self.counts);
            }
            *next != ENDED
        });
        self.next = nearest(&self.open);
    }

    /// Visits the planes first..=last of the tile's rays under the tints of the previous groups. The glow of the
    /// previous group follows each plane.
    pub(super) fn visit_glowing(&mut self, [first, last]: [i64; 2], halos: &HaloPlanes<'_>) {
        let mut open = std::mem::take(&mut self.open).into_iter().peekable();
        for (i, ray) in self.rays.iter_mut().enumerate() {
            // Both lists are in the order of the rays.
            let mut next = open.next_if(|(_, ray)| *ray == i).map_or(ENDED, |(next, _)| next);
            if !ray.state.is_open() {
                continue;
            }
            let place = halos.place(ray.place);
            for (largest, h) in ray.intensities.iter_mut().zip(halos.watched(place)) {
                *largest = largest.max(h);
            }
            let tint = if next <= last { halos.tint(place) } else { None };
            match halos.glow(place, |alpha| ray.state.corrected(alpha)) {
                None => next = ray.visit([next, last], tint.as_ref(), &mut self.counts),
                Some(glow) => {
                    for k in first..=last {
                        next = ray.visit([next, k], tint.as_ref(), &mut self.counts);
                        if ray.state.is_open() {
                            ray.state.lay_glow(glow);
                        }
                        if !ray.state.is_open() {
                            break;
                        }
                    }
                }
            }
            // A ray that is opaque sees nothing that follows.
            if ray.state.is_open() && next != ENDED {
                self.open.push((next, i));
            }
        }
        self.next = nearest(&self.open);
        self.is_open = self.rays.iter().any(|ray| ray.state.is_open());
    }

    /// The last plane of any path.
    pub(super) fn last(&self) -> Option<i64> {
        let last = |ray: &WaitingRay<'_, '_, R>| match *ray.path.last()? {
            Step::Samples([_, last]) => Some(last),
            step => Some(step.plane()),
        };
        self.rays.iter().filter_map(last).max()
    }

    /// Bytes of the states of the tile's rays.
    pub(super) fn bytes(&self) -> u64 {
        let own = |ray: &WaitingRay<'_, '_, R>| {
            let objects = ray.state.objects.as_ref().map_or(0, |objects| objects.bytes());
            (size_of_val(ray.path.as_slice()) + size_of_val(&*ray.intensities)) as u64 + objects
        };
        size_of_val(self.rays.as_slice()) as u64 + self.rays.iter().map(own).sum::<u64>()
    }

    /// Ends the rays and returns their results.
    pub(super) fn finish(mut self) -> (Vec<Cast>, Counts) {
        let finish = |ray: WaitingRay<'_, '_, R>| {
            let cast = ray.state.finish(&mut self.counts);
            Cast { intensities: ray.intensities, ..cast }
        };
        let casts = self.rays.into_iter().map(finish).collect();
        (casts, self.counts)
    }
}

impl<R: Real> WaitingRay<'_, '_, R> {
    /// Takes the ray's steps on the planes up to `last`, where `next` is its next plane. Returns the plane of the step
    /// after these.
    fn visit(&mut self, [mut next, last]: [i64; 2], tint: Option<&Tint>, counts: &mut Counts) -> i64 {
        while next <= last {
            let whole = self.path[self.at];
            let step = match whole {
                Step::Samples([_, end]) => Step::Samples([next, end.min(last)]),
                other => other,
            };
            if !self.state.take::<Anything>(&step, tint, counts) {
                return ENDED;
            }
            match whole {
                Step::Samples([_, end]) if last < end => return last + 1,
                _ => {
                    self.at += 1;
                    next = self.path.get(self.at).map_or(ENDED, Step::plane);
                }
            }
        }
        next
    }
}

/// The nearest of the rays' next planes.
fn nearest(open: &[(i64, usize)]) -> i64 {
    open.iter().map(|(next, _)| *next).min().unwrap_or(ENDED)
}
