//! Plane order: all rays of a picture, group of planes by group, each with a path on which it can go on ([HALO-1], [HALO-8]).
//!
//! Rays of one tile lie together, and the tiles that have something in a group are visited in parallel. Between groups all
//! threads meet, since an effect may read what its neighbours left on the groups before. Without an effect tiles need not wait
//! for each other: each is visited plane by plane by itself, and the state of its rays alone is in memory.

use super::cast::Cast;
use super::path::Step;
use super::plane_effect::{Hook, LayBehind, PlaneEffect, RayOnPlane};
use super::ray_state::RayState;
use crate::field::Sampler;
use crate::number::Real;
use crate::ray::prepared::Prepared;
use crate::ray::sample::need::Anything;
use crate::ray::tile_work::TileRays;
use drypoint_scene::counts::Counts;
use rayon::prelude::*;
use std::sync::atomic::{AtomicUsize, Ordering};

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
    /// Rays that have not ended.
    open: Vec<usize>,
    /// The nearest plane of any of its rays.
    next: i64,
    counts: Counts,
}

/// Casts the rays of tiles plane by plane, with an effect if one is given. Returns what comes out of the rays of each tile, in
/// their order. `progress` hears the share of tiles or planes that is done.
pub(crate) fn cast_tiles<R: Real, S: Sampler<R>>(
    prepared: &Prepared<'_, R>,
    sampler: &S,
    tiles: Vec<TileRays>,
    effect: Option<&mut dyn PlaneEffect>,
    progress: &(dyn Fn(f64) + Sync),
) -> Vec<(Vec<Cast>, Counts)> {
    let Some(effect) = effect else {
        let done = AtomicUsize::new(0);
        let all = tiles.len() as f64;
        let alone = |tile| {
            let mut tile = WaitingTile::new(prepared, sampler, tile, 0);
            while tile.next != ENDED {
                tile.visit(tile.next, None);
            }
            progress((1 + done.fetch_add(1, Ordering::Relaxed)) as f64 / all);
            tile.finish()
        };
        return tiles.into_par_iter().map(alone).collect();
    };
    let planes = effect.planes_per_group().max(1);
    let aim = |tile: TileRays| WaitingTile::new(prepared, sampler, tile, effect.numbers());
    let mut tiles: Vec<WaitingTile<'_, '_, R, S>> = tiles.into_par_iter().map(aim).collect();
    for tile in &mut tiles {
        let bytes = tile.bytes();
        tile.counts.bytes.insert("rays".into(), bytes);
    }
    let last = tiles.iter().flat_map(|tile| &tile.rays).filter_map(WaitingRay::last).max().unwrap_or(0);
    let first = tiles.iter().map(|tile| tile.next).min().unwrap_or(ENDED);
    let (mut next, mut is_due) = (first, false);
    let mut group = first.div_euclid(planes);
    while next != ENDED || is_due {
        let range = [group * planes, group * planes + planes - 1];
        let mut visited: Vec<&mut WaitingTile<'_, '_, R, S>> = if effect.lays_behind(group) {
            tiles.par_iter_mut().for_each(|tile| tile.visit_with(range, effect));
            tiles.iter_mut().collect()
        } else {
            let mut visited: Vec<_> = tiles.iter_mut().filter(|tile| tile.next <= range[1]).collect();
            visited.par_iter_mut().for_each(|tile| tile.visit(range[1], Some(effect)));
            visited
        };
        let rays = visited.iter_mut().flat_map(|tile| &mut tile.rays);
        is_due = effect.end_of_group(group, &mut rays.map(WaitingRay::on_plane));
        next = tiles.iter().map(|tile| tile.next).min().unwrap_or(ENDED);
        group = if is_due { group + 1 } else { next.div_euclid(planes) };
        progress((next.min(last) - first) as f64 / (last - first).max(1) as f64);
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
        let open = (0..rays.len()).filter(|&i| rays[i].next != ENDED).collect();
        Self { rays, open, next, counts: Counts::default() }
    }

    /// Visits the planes of its rays up to `last`.
    fn visit(&mut self, last: i64, effect: Option<&dyn PlaneEffect>) {
        let mut next = ENDED;
        self.open.retain(|&i| {
            let ray = &mut self.rays[i];
            if ray.next <= last {
                ray.visit(last, effect, &mut self.counts);
            }
            next = next.min(ray.next);
            ray.next != ENDED
        });
        self.next = next;
    }

    /// Visits the planes first..=last of its rays, each followed by what an effect lays behind it.
    fn visit_with(&mut self, [first, last]: [i64; 2], effect: &dyn PlaneEffect) {
        for k in first..=last {
            self.visit(k, Some(effect));
            for ray in &mut self.rays {
                if ray.state.is_open() {
                    effect.behind(k, ray.on_plane());
                }
                if !ray.state.is_open() {
                    // What lies in front hides all that follows.
                    ray.next = ENDED;
                }
            }
        }
        self.next = self.rays.iter().map(|ray| ray.next).min().unwrap_or(ENDED);
    }

    /// Bytes of the states of its rays.
    fn bytes(&self) -> u64 {
        let own = |ray: &WaitingRay<'_, '_, R, S>| size_of_val(ray.path.as_slice()) + size_of_val(ray.own.as_slice());
        (size_of_val(self.rays.as_slice()) + self.rays.iter().map(own).sum::<usize>()) as u64
    }

    /// Ends the rays and returns their results.
    fn finish(mut self) -> (Vec<Cast>, Counts) {
        let casts = self.rays.into_iter().map(|ray| ray.state.finish(&mut self.counts)).collect();
        (casts, self.counts)
    }
}

impl<R: Real, S: Sampler<R>> WaitingRay<'_, '_, R, S> {
    /// Takes all its steps on the planes up to `last`.
    fn visit(&mut self, last: i64, effect: Option<&dyn PlaneEffect>, counts: &mut Counts) {
        let mut hook = effect.map(|effect| Hook { effect, ray: self.place, own: &mut self.own });
        while self.next <= last {
            let whole = self.path[self.at];
            let step = match whole {
                Step::Samples([_, end]) => Step::Samples([self.next, end.min(last)]),
                other => other,
            };
            if !self.state.take::<Anything>(&step, &mut hook, counts) {
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
