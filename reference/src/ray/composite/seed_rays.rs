//! Rays along which samples are evaluated for the seeds of halos ([HALO-2], [HALO-4], [RAY-2]).
//!
//! A seed depends on the field at its sample alone, and not on the visibility in front of it. So seeds have rays of
//! their own, also in the guard band about the picture, with samples on the same planes.

use super::object_ray::ObjectRay;
use super::object_seeds::SeedScratch;
use super::waiting_tile::ENDED;
use crate::field::{Field, Sampler};
use crate::number::{Real, Vec3};
use crate::ray::brick_occupancy::Beam;
use crate::ray::draw::{RayRect, ray_point};
use crate::ray::lattice::IndexRay;
use crate::ray::prepared::Prepared;
use crate::ray::prepared_halos::PreparedHalos;
use crate::ray::prepared_seeds::PreparedSeeds;
use crate::ray::sample::{Evaluator, EyeAxes, Sample};
use crate::volumetric_halos::{HaloPlanes, SeedStrip};
use drypoint_scene::counts::Counts;
use drypoint_scene::parallel;
use std::ops::Range;

/// Rays along the side of a tile.
const SIDE: usize = 8;

/// The seed rays of a region and its guard band, in strips of tiles.
pub(super) struct SeedRays<'p, 'v, R: Real> {
    prepared: &'p Prepared<'v, R>,
    halos: &'p PreparedHalos<'v>,
    strips: Vec<Vec<SeedTile<'p, 'v, R>>>,
    region: RayRect,
    /// Rays across and down, with the guard band.
    size: [usize; 2],
    /// The tiles of the region that were open when rays were last dropped.
    open: Vec<bool>,
}

/// Seed rays of one tile.
struct SeedTile<'p, 'v, R: Real> {
    rays: Vec<SeedRay<'p, 'v, R>>,
    /// The next plane of each ray, and the last plane of its current range. They are stored apart from the rays, which
    /// most chunks then need not touch.
    planes: Vec<[i64; 2]>,
    /// Ranges of samples in bricks that can seed, ray by ray, nearest first.
    ranges: Vec<[i64; 2]>,
    /// The objects on each ray that meets some; empty in a picture without objects.
    objects: Vec<Option<Box<ObjectRay<'p, 'v, R>>>>,
    /// The nearest of all next planes.
    next: i64,
}

/// A ray along which samples are evaluated for seeds.
struct SeedRay<'p, 'v, R: Real> {
    evaluator: Evaluator<'p, 'v, R, Field<'v, R>>,
    /// Its place in the strip.
    place: usize,
    /// The ranges of the tile that follow the ray's current range.
    ranges: Range<usize>,
}

impl<'p, 'v, R: Real> SeedRays<'p, 'v, R> {
    /// Bytes of a ray with two ranges of samples.
    pub(super) const BYTES_OF_RAY: u64 = (size_of::<SeedRay<'_, '_, R>>() + 3 * size_of::<[i64; 2]>()) as u64;

    /// Aims the rays of a region. `size` is that of the images, guard band included. Adds the evaluations that find
    /// cutaways to the counts.
    pub(super) fn new(
        prepared: &'p Prepared<'v, R>,
        halos: &'p PreparedHalos<'v>,
        region: RayRect,
        size: [usize; 2],
        counts: &mut Counts,
    ) -> Self {
        let aim = |strip: usize| {
            let mut counts = Counts::default();
            let tile = |column: usize| SeedTile::new((prepared, halos), region, size, [column, strip], &mut counts);
            let tiles: Vec<_> = (0..size[0].div_ceil(SIDE)).map(tile).collect();
            (tiles, counts)
        };
        let aimed: Vec<(Vec<_>, Counts)> = parallel::map(size[1].div_ceil(SIDE), &aim);
        let add = |(tiles, own): (Vec<_>, Counts)| {
            counts.add(&own);
            tiles
        };
        let strips = aimed.into_iter().map(add).collect();
        Self { prepared, halos, strips, region, size, open: Vec::new() }
    }

    /// The nearest plane with a sample that can seed.
    pub(super) fn next(&self) -> i64 {
        self.strips.iter().flatten().map(|tile| tile.next).min().unwrap_or(ENDED)
    }

    /// Drops the rays whose seeds reach no open pixel. `open` tells which tiles of the region have open pixels.
    pub(super) fn keep_near(&mut self, open: Vec<bool>) {
        if open == self.open {
            return;
        }
        let (guard, across) = ((self.size[0] - self.region.size[0]) / 2, self.size[0].div_ceil(SIDE));
        let mut near = vec![false; across * self.strips.len()];
        for (tile, _) in open.iter().enumerate().filter(|(_, open)| **open) {
            let [columns, rows] = self.region.tile(tile).map(|[from, to]| {
                // Images begin a guard band before the region, and so does the reach of a pixel.
                [from / SIDE, (to + 2 * guard) / SIDE]
            });
            for row in rows[0]..=rows[1].min(self.strips.len() - 1) {
                near[row * across + columns[0]..=row * across + columns[1].min(across - 1)].fill(true);
            }
        }
        for (tile, near) in self.strips.iter_mut().flatten().zip(near) {
            if !near {
                *tile = SeedTile::ended();
            }
        }
        self.open = open;
    }

    /// Adds the seeds of the samples on planes up to `last`.
    pub(super) fn visit(&mut self, last: i64, planes: &mut HaloPlanes<'_>, counts: &mut Counts) {
        let (prepared, halos) = (self.prepared, self.halos);
        let strips = planes.seed_strips(SIDE);
        let visit = |_, (tiles, mut strip): (&mut Vec<SeedTile<'_, '_, R>>, SeedStrip<'_>)| {
            let (mut counts, mut scratch) = (Counts::default(), SeedScratch::new(halos.list.len()));
            for tile in tiles.iter_mut().filter(|tile| tile.next <= last) {
                let rays = tile.planes.iter_mut().zip(&mut tile.rays).enumerate();
                for (i, (planes, ray)) in rays.filter(|(_, (planes, _))| planes[0] <= last) {
                    let mut objects = tile.objects.get_mut(i).and_then(Option::as_deref_mut);
                    while planes[0] <= last {
                        let run = [planes[0], planes[1].min(last)];
                        let together = (prepared, halos);
                        ray.seed_run(run, objects.as_deref_mut(), together, &mut strip, &mut scratch, &mut counts);
                        *planes = if last < planes[1] {
                            [last + 1, planes[1]]
                        } else {
                            ray.ranges.next().map_or([ENDED; 2], |range| tile.ranges[range])
                        };
                    }
                }
                tile.next = nearest(&tile.planes);
            }
            (strip.seeded(), counts)
        };
        let done = parallel::map_of(self.strips.iter_mut().zip(strips).collect(), &visit);
        for (seeded, own) in done {
            planes.note_seeded(&seeded);
            counts.add(&own);
        }
    }

    /// Bytes of the states of all rays.
    pub(super) fn bytes(&self) -> u64 {
        let of = |tile: &SeedTile<'_, '_, R>| {
            let planes = size_of_val(tile.planes.as_slice()) + size_of_val(tile.ranges.as_slice());
            let objects: u64 = tile.objects.iter().flatten().map(|objects| objects.bytes()).sum();
            (size_of_val(tile.rays.as_slice()) + size_of_val(tile.objects.as_slice()) + planes) as u64 + objects
        };
        self.strips.iter().flatten().map(of).sum()
    }
}

impl<'p, 'v, R: Real> SeedTile<'p, 'v, R> {
    /// Aims the rays of a tile of the images that can meet a brick with seeds, or a part that seeds.
    fn new(
        (prepared, halos): (&'p Prepared<'v, R>, &'p PreparedHalos<'v>),
        region: RayRect,
        size: [usize; 2],
        [column, strip]: [usize; 2],
        counts: &mut Counts,
    ) -> Self {
        let guard = (size[0] - region.size[0]) / 2;
        let first = [column * SIDE, strip * SIDE];
        let [columns, rows] = [0, 1].map(|a| SIDE.min(size[a] - first[a]));
        // The first ray among those of the picture. Rays of the guard band have places below 0 or beyond the last one.
        let ray_at = |place: [usize; 2]| [0, 1].map(|a| (place[a] + region.first[a]) as i64 - guard as i64);
        let (view, object) = (&prepared.view, &prepared.object);
        let grid = object.volume.grid();
        let mut boxes = halos.skip.as_ref().map(|skip| {
            let [left, top] = ray_at(first);
            let corner = |x: i64, y: i64| {
                let [x, y] = [x, y].map(|ray| ray as f64 / prepared.rays_across as f64);
                IndexRay::<R>::new(&view.ray(x, y), view, &prepared.lattice, grid).rounded()
            };
            let (right, bottom) = (left + columns as i64, top + rows as i64);
            let corners = [corner(left, top), corner(right, top), corner(right, bottom), corner(left, bottom)];
            skip.boxes_in(&Beam::new(corners))
        });
        let mut tile = Self::ended();
        let (seeds, combination) = (halos.seeds.is_some(), prepared.combination.is_some());
        if !combination && boxes.as_ref().is_some_and(|boxes| boxes.is_empty()) {
            return tile;
        }
        for (x, y) in (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y))) {
            let point = ray_point(prepared.rays_across, ray_at([first[0] + x, first[1] + y]));
            let pixel = view.ray(point[0], point[1]);
            let ray = IndexRay::<R>::new(&pixel, view, &prepared.lattice, grid);
            let from = tile.ranges.len();
            let visits = ray.visits(object.ends, &object.clip.planes, ray.intervals(boxes.as_mut())).filter(|_| seeds);
            let objects = if combination {
                let background: Vec<[i64; 2]> = visits.collect();
                let places = (background.iter().copied(), ray.inside(object.ends));
                let objects = ObjectRay::new(prepared, point, places, counts);
                tile.ranges.extend(objects.as_ref().map_or(background, |objects| objects.seed_visits()));
                objects
            } else {
                tile.ranges.extend(visits);
                None
            };
            let mut ranges = from..tile.ranges.len();
            let Some(first_range) = ranges.next() else { continue };
            if combination {
                tile.objects.push(objects.map(Box::new));
            }
            tile.planes.push(tile.ranges[first_range]);
            let (v, v_eye) = (Vec3::from_glam(view.direction_to_world(pixel.v)), Vec3::from_glam(pixel.v));
            let dirs = object.shader.view_dirs(v, v_eye);
            let evaluator = Evaluator::new(object, &object.field, ray, dirs, &prepared.eye_axes);
            tile.rays.push(SeedRay { evaluator, place: y * size[0] + first[0] + x, ranges });
        }
        tile.next = nearest(&tile.planes);
        tile
    }

    /// A tile without rays.
    fn ended() -> Self {
        Self { rays: Vec::new(), planes: Vec::new(), ranges: Vec::new(), objects: Vec::new(), next: ENDED }
    }
}

impl<R: Real> SeedRay<'_, '_, R> {
    /// Adds the seeds of the samples first..=last. Runs without objects use the volume alone, other samples the
    /// combined sets.
    #[inline]
    fn seed_run(
        &mut self,
        [mut next, last]: [i64; 2],
        objects: Option<&mut ObjectRay<'_, '_, R>>,
        (prepared, halos): (&Prepared<'_, R>, &PreparedHalos<'_>),
        strip: &mut SeedStrip<'_>,
        scratch: &mut SeedScratch,
        counts: &mut Counts,
    ) {
        let seeds = halos.seeds.as_ref().map(|seeds| (seeds, &prepared.eye_axes));
        let Some(objects) = objects else {
            let Some(seeds) = seeds else { return };
            (next..=last).for_each(|k| self.seed(k, seeds, strip, &mut scratch.h, counts));
            return;
        };
        while next <= last {
            let ([first, end], is_mixed) = objects.run_from([next, last]);
            if is_mixed {
                for k in first..=end {
                    objects.seed(k, (prepared, halos), scratch, counts);
                    let together = scratch.together.iter().enumerate().filter(|(_, s)| **s > 0.0);
                    together.for_each(|(halo, &s)| strip.add(halo, self.place, s));
                }
            } else if let Some(seeds) = seeds {
                let alone = objects.background_in([first, end]).flat_map(|[first, last]| first..=last);
                alone.for_each(|k| self.seed(k, seeds, strip, &mut scratch.h, counts));
            }
            next = end + 1;
        }
    }

    /// Adds the seeds of sample k of the volume. `h` has a place for each halo.
    #[inline]
    fn seed(
        &mut self,
        k: i64,
        (seeds, eye_axes): (&PreparedSeeds<'_>, &EyeAxes<R>),
        strip: &mut SeedStrip<'_>,
        h: &mut [f64],
        counts: &mut Counts,
    ) {
        let evaluator = &mut self.evaluator;
        let at = evaluator.sampler.place(evaluator.position(k));
        // A masked sample is transparent and seeds nothing.
        if evaluator.object.volume.mask().is_some_and(|mask| mask.touches_cell(at.cell)) {
            return;
        }
        let sample = Sample { k, at, s: evaluator.sampler.value_at(at) };
        counts.halo_samples += 1;
        evaluator.seed(sample, (seeds, eye_axes), h, counts, |halo, s| strip.add(halo, self.place, s));
    }
}

/// The nearest of the rays' next planes.
fn nearest(planes: &[[i64; 2]]) -> i64 {
    planes.iter().map(|&[next, _]| next).min().unwrap_or(ENDED)
}
