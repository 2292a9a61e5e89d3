//! Plane order: all rays of a picture, plane by plane, each with a path on which it can go on ([HALO-1]).
//!
//! Rays of one tile lie together, and the tiles that have something on a plane are visited in parallel. Between planes all
//! threads meet, since an effect may read what its neighbours left on the planes before.

use super::cast::Cast;
use super::path::Step;
use super::plane_effect::{Hook, LayBehind, PlaneEffect, RayOnPlane};
use super::ray_state::RayState;
use crate::field::Sampler;
use crate::number::Real;
use crate::ray::prepared::Prepared;
use crate::ray::sample::need::{self, Need, Needs};
use crate::ray::tile_work::TileRays;
use drypoint_scene::counts::Counts;
use rayon::prelude::*;

/// A ray that waits for its next plane.
struct WaitingRay<'p, 'v, R: Real, S> {
    state: RayState<'p, 'v, R, S>,
    place: [usize; 2],
    path: Vec<Step<'p>>,
    /// The step that comes next.
    at: usize,
    /// The plane that comes next; the largest number where the ray has ended.
    next: i64,
    /// The numbers that an effect keeps.
    own: Vec<f64>,
}

/// No plane: the ray, the tile or the picture has ended.
const ENDED: i64 = i64::MAX;

/// Rays of one tile.
struct WaitingTile<'p, 'v, R: Real, S> {
    rays: Vec<WaitingRay<'p, 'v, R, S>>,
    /// The nearest plane of any of its rays.
    next: i64,
    counts: Counts,
}

/// Casts the rays of tiles plane by plane, with an effect if one is given. Returns what comes out of the rays of each tile, in
/// their order. `progress` hears the share of planes that is done.
pub(crate) fn cast_tiles<R: Real, S: Sampler<R> + Sync>(
    prepared: &Prepared<'_, R>,
    sampler: &S,
    tiles: Vec<TileRays>,
    effect: Option<&mut dyn PlaneEffect>,
    progress: &(dyn Fn(f64) + Sync),
) -> Vec<(Vec<Cast>, Counts)> {
    match prepared.object.needs {
        _ if effect.is_some() => cast_with::<need::Anything, R, S>(prepared, sampler, tiles, effect, progress),
        Needs::Value => cast_with::<need::Value, R, S>(prepared, sampler, tiles, effect, progress),
        Needs::Normal => cast_with::<need::Normal, R, S>(prepared, sampler, tiles, effect, progress),
        Needs::Anything => cast_with::<need::Anything, R, S>(prepared, sampler, tiles, effect, progress),
    }
}

fn cast_with<N: Need, R: Real, S: Sampler<R> + Sync>(
    prepared: &Prepared<'_, R>,
    sampler: &S,
    tiles: Vec<TileRays>,
    mut effect: Option<&mut dyn PlaneEffect>,
    progress: &(dyn Fn(f64) + Sync),
) -> Vec<(Vec<Cast>, Counts)> {
    let numbers = effect.as_ref().map_or(0, |effect| effect.numbers());
    let aim = |tile: TileRays| WaitingTile::new(prepared, sampler, tile, numbers);
    let mut tiles: Vec<WaitingTile<'_, '_, R, S>> = tiles.into_par_iter().map(aim).collect();
    let last = tiles.iter().flat_map(|tile| &tile.rays).filter_map(WaitingRay::last).max().unwrap_or(0);
    let first = tiles.iter().map(|tile| tile.next).min().unwrap_or(ENDED);
    let mut k = first;
    while k != ENDED {
        let seen: Option<&dyn PlaneEffect> = effect.as_deref();
        tiles.par_iter_mut().filter(|tile| tile.next == k).for_each(|tile| tile.visit::<N>(k, seen));
        let is_due = effect.as_deref_mut().is_some_and(|effect| {
            effect.end_of_plane(k, &mut tiles.iter_mut().flat_map(|tile| &mut tile.rays).map(WaitingRay::on_plane))
        });
        let next = tiles.iter().map(|tile| tile.next).min().unwrap_or(ENDED);
        k = if is_due { k + 1 } else { next };
        progress((k.min(last) - first) as f64 / (last - first).max(1) as f64);
    }
    tiles.into_par_iter().map(WaitingTile::finish).collect()
}

impl<'p, 'v, R: Real, S: Sampler<R>> WaitingTile<'p, 'v, R, S> {
    fn new(prepared: &'p Prepared<'v, R>, sampler: &'p S, mut tile: TileRays, numbers: usize) -> Self {
        let rays = tile.points.iter().zip(&tile.places).map(|(&point, &place)| {
            let state = RayState::new(prepared, sampler, point);
            let mut path = Vec::new();
            state.path(point, tile.boxes.as_mut(), &mut path);
            path.shrink_to_fit();
            let next = path.first().map_or(ENDED, Step::plane);
            WaitingRay { state, place, path, at: 0, next, own: vec![0.0; numbers] }
        });
        let rays: Vec<_> = rays.collect();
        let next = rays.iter().map(|ray| ray.next).min().unwrap_or(ENDED);
        Self { rays, next, counts: Counts::default() }
    }

    /// Visits what its rays have on a plane.
    fn visit<N: Need>(&mut self, k: i64, effect: Option<&dyn PlaneEffect>) {
        let mut next = ENDED;
        for ray in &mut self.rays {
            if ray.next == k {
                ray.visit::<N>(k, effect, &mut self.counts);
            }
            next = next.min(ray.next);
        }
        self.next = next;
    }

    /// Ends the rays and returns their results.
    fn finish(mut self) -> (Vec<Cast>, Counts) {
        let own = |ray: &WaitingRay<'_, '_, R, S>| size_of_val(ray.path.as_slice()) + size_of_val(ray.own.as_slice());
        let bytes = size_of_val(self.rays.as_slice()) + self.rays.iter().map(own).sum::<usize>();
        self.counts.bytes.insert("rays".into(), bytes as u64);
        let casts = self.rays.into_iter().map(|ray| ray.state.finish(&mut self.counts)).collect();
        (casts, self.counts)
    }
}

impl<R: Real, S: Sampler<R>> WaitingRay<'_, '_, R, S> {
    /// Takes all its steps on a plane.
    fn visit<N: Need>(&mut self, k: i64, effect: Option<&dyn PlaneEffect>, counts: &mut Counts) {
        if effect.is_some() && !self.state.is_open() {
            // What the effect laid behind hides all that follows.
            self.next = ENDED;
        }
        let mut hook = effect.map(|effect| Hook { effect, ray: self.place, own: &mut self.own });
        while self.next == k {
            let whole = self.path[self.at];
            let step = if let Step::Samples(_) = whole { Step::Samples([k, k]) } else { whole };
            if !self.state.take::<N>(&step, &mut hook, counts) {
                self.next = ENDED;
                return;
            }
            match whole {
                Step::Samples([_, last]) if k < last => self.next = k + 1,
                _ => {
                    self.at += 1;
                    self.next = self.path.get(self.at).map_or(ENDED, Step::plane);
                }
            }
        }
    }

    /// The last plane of its path.
    fn last(&self) -> Option<i64> {
        self.path.last().map(|step| if let Step::Samples([_, last]) = *step { last } else { step.plane() })
    }

    fn on_plane(&mut self) -> RayOnPlane<'_> {
        let is_open = self.state.is_open();
        RayOnPlane { ray: self.place, is_open, own: &mut self.own, front: &mut self.state }
    }
}

impl<R: Real, S: Sampler<R>> LayBehind for RayState<'_, '_, R, S> {
    fn over(&mut self, rgb: [f64; 3], alpha: f64) {
        self.lay_behind(rgb.map(R::from_f64), R::from_f64(alpha));
    }
}
