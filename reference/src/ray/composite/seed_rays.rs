//! Rays on which samples are asked for the seeds of halos ([HALO-2], [HALO-4], [RAY-2]).
//!
//! A seed depends on the field at its sample alone, not on what is visible in front of it. So seeds have rays of their own,
//! in the guard band about the picture too, with samples on the same planes.

use super::waiting_tile::ENDED;
use crate::field::Sampler;
use crate::number::{Real, Vec3};
use crate::ray::brick_occupancy::Beam;
use crate::ray::draw::{Region, ray_point};
use crate::ray::lattice::IndexRay;
use crate::ray::prepared::Prepared;
use crate::ray::prepared_halos::PreparedHalos;
use crate::ray::sample::{Evaluator, Sample, SampleAttributes};
use crate::style_transfer_functions::contour;
use crate::transfer::over::SampleQuantities;
use crate::volumetric_halos::seed::{SeedNormal, SeedPlace};
use crate::volumetric_halos::{HaloPlanes, SeedStrip};
use drypoint_scene::counts::Counts;
use drypoint_scene::glam::DVec3;
use rayon::prelude::*;
use std::ops::Range;

/// Rays along the side of a tile.
const SIDE: usize = 8;

/// The seed rays of a region and its guard band, in strips of tiles.
pub(super) struct SeedRays<'p, 'v, R: Real, S> {
    prepared: &'p Prepared<'v, R>,
    halos: &'p PreparedHalos<'v>,
    strips: Vec<Vec<SeedTile<'p, 'v, R, S>>>,
    region: Region,
    /// Rays across and down, with the guard band.
    size: [usize; 2],
    /// The tiles of the region that were open when rays were dropped last.
    open: Vec<bool>,
}

/// Seed rays of one tile.
struct SeedTile<'p, 'v, R: Real, S> {
    rays: Vec<SeedRay<'p, 'v, R, S>>,
    /// The next plane of each ray and the last one of the range that it is in: apart from the rays, which most chunks then
    /// need not touch.
    planes: Vec<[i64; 2]>,
    /// Ranges of samples in bricks that can seed, ray after ray, of each nearest first.
    ranges: Vec<[i64; 2]>,
    /// The nearest of all next planes.
    next: i64,
}

/// A ray on which samples are asked for seeds.
struct SeedRay<'p, 'v, R: Real, S> {
    evaluator: Evaluator<'p, 'v, R, S>,
    /// Its place in the strip.
    place: usize,
    /// The ranges of the tile that come after the one it is in.
    ranges: Range<usize>,
}

impl<'p, 'v, R: Real, S: Sampler<R>> SeedRays<'p, 'v, R, S> {
    /// Bytes of a ray with two ranges of samples.
    pub(super) const BYTES_OF_RAY: u64 = (size_of::<SeedRay<'_, '_, R, S>>() + 3 * size_of::<[i64; 2]>()) as u64;

    /// Aims the rays of a region; `size` is that of the images, with the guard band.
    pub(super) fn new(
        prepared: &'p Prepared<'v, R>,
        halos: &'p PreparedHalos<'v>,
        sampler: &'p S,
        region: Region,
        size: [usize; 2],
    ) -> Self {
        let aim = |strip: usize| {
            let tile = |column: usize| SeedTile::new(prepared, halos, sampler, region, size, [column, strip]);
            (0..size[0].div_ceil(SIDE)).map(tile).collect()
        };
        let strips = (0..size[1].div_ceil(SIDE)).into_par_iter().map(aim).collect();
        Self { prepared, halos, strips, region, size, open: Vec::new() }
    }

    /// The nearest plane with a sample that can seed.
    pub(super) fn next(&self) -> i64 {
        self.strips.iter().flatten().map(|tile| tile.next).min().unwrap_or(ENDED)
    }

    /// Drops the rays whose seeds reach no pixel that is open, of which `open` tells the tiles of the region.
    pub(super) fn keep_near(&mut self, open: Vec<bool>) {
        if open == self.open {
            return;
        }
        let (guard, across) = ((self.size[0] - self.region.size[0]) / 2, self.size[0].div_ceil(SIDE));
        let mut near = vec![false; across * self.strips.len()];
        for (tile, _) in open.iter().enumerate().filter(|(_, open)| **open) {
            let [columns, rows] = self.region.tile(tile).map(|[from, to]| {
                // The reach of a pixel begins a guard band before it, which is where the images begin.
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
        let visit = |(tiles, mut strip): (&mut Vec<SeedTile<'_, '_, R, S>>, SeedStrip<'_>)| {
            let (mut counts, mut scratch) = (Counts::default(), vec![0.0; halos.list.len()]);
            for tile in tiles.iter_mut().filter(|tile| tile.next <= last) {
                for (planes, ray) in tile.planes.iter_mut().zip(&mut tile.rays).filter(|(planes, _)| planes[0] <= last)
                {
                    while planes[0] <= last {
                        for k in planes[0]..=planes[1].min(last) {
                            ray.seed(k, (prepared, halos), &mut strip, &mut scratch, &mut counts);
                        }
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
        let done: Vec<(Vec<bool>, Counts)> = self.strips.par_iter_mut().zip(strips).map(visit).collect();
        for (seeded, own) in done {
            planes.note_seeded(&seeded);
            counts.add(&own);
        }
    }

    /// Bytes of the states of all rays.
    pub(super) fn bytes(&self) -> u64 {
        let of = |tile: &SeedTile<'_, '_, R, S>| {
            let planes = size_of_val(tile.planes.as_slice()) + size_of_val(tile.ranges.as_slice());
            (size_of_val(tile.rays.as_slice()) + planes) as u64
        };
        self.strips.iter().flatten().map(of).sum()
    }
}

impl<'p, 'v, R: Real, S: Sampler<R>> SeedTile<'p, 'v, R, S> {
    /// Aims the rays of a tile of the images that can meet a brick with seeds.
    fn new(
        prepared: &'p Prepared<'v, R>,
        halos: &'p PreparedHalos<'v>,
        sampler: &'p S,
        region: Region,
        size: [usize; 2],
        [column, strip]: [usize; 2],
    ) -> Self {
        let guard = (size[0] - region.size[0]) / 2;
        let first = [column * SIDE, strip * SIDE];
        let [columns, rows] = [0, 1].map(|a| SIDE.min(size[a] - first[a]));
        // The first ray among those of the picture; those of the guard band stand before 0 or beyond the last.
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
        if boxes.as_ref().is_some_and(|boxes| boxes.is_empty()) {
            return tile;
        }
        for (x, y) in (0..rows).flat_map(|y| (0..columns).map(move |x| (x, y))) {
            let [i, j] = ray_point(prepared.rays_across, ray_at([first[0] + x, first[1] + y]));
            let pixel = view.ray(i, j);
            let ray = IndexRay::<R>::new(&pixel, view, &prepared.lattice, grid);
            let from = tile.ranges.len();
            tile.ranges.extend(ray.visits(object.ends, &object.clip.planes, ray.intervals(boxes.as_mut())));
            let mut ranges = from..tile.ranges.len();
            let Some(first_range) = ranges.next() else { continue };
            tile.planes.push(tile.ranges[first_range]);
            let (v, v_eye) = (Vec3::from_glam(view.direction_to_world(pixel.v)), Vec3::from_glam(pixel.v));
            let dirs = object.shader.view_dirs(v, v_eye);
            let evaluator = Evaluator::new(object, sampler, ray, dirs, &prepared.eye_axes);
            tile.rays.push(SeedRay { evaluator, place: y * size[0] + first[0] + x, ranges });
        }
        tile.next = nearest(&tile.planes);
        tile
    }

    /// A tile without rays.
    fn ended() -> Self {
        Self { rays: Vec::new(), planes: Vec::new(), ranges: Vec::new(), next: ENDED }
    }
}

impl<R: Real, S: Sampler<R>> SeedRay<'_, '_, R, S> {
    /// Adds the seeds of sample k. `h` has a place for each halo.
    #[inline]
    fn seed(
        &mut self,
        k: i64,
        (prepared, halos): (&Prepared<'_, R>, &PreparedHalos<'_>),
        strip: &mut SeedStrip<'_>,
        h: &mut [f64],
        counts: &mut Counts,
    ) {
        let object = self.evaluator.object;
        let position = self.evaluator.ray.position(k);
        let at = self.evaluator.sampler.place(position);
        // A masked sample is transparent and seeds nothing.
        if object.volume.mask().is_some_and(|mask| mask.touches_cell(at.cell)) {
            return;
        }
        let sample = Sample { k, at, s: self.evaluator.sampler.value_at(at) };
        counts.halo_samples += 1;
        // h_v, h_l and h_p, and with a function over two quantities what α_u needs.
        let mut attributes = SampleAttributes::neutral();
        let alpha_u = if halos.reads_opacity { self.alpha_u(sample, position, &mut attributes, counts) } else { 0.0 };
        let place = SeedPlace {
            value: sample.s.to_f64(),
            alpha_u,
            world: if halos.reads_places { object.volume.grid().to_world(position.to_glam()) } else { DVec3::ZERO },
            label: halos.labels.as_ref().map_or(0, |labels| labels.id_at(position)),
        };
        let mut any = false;
        for (h, halo) in h.iter_mut().zip(&halos.list) {
            *h = halo.seeding.before_gradient(&place);
            any |= *h > 0.0;
        }
        if !any {
            return;
        }
        // s, of samples that have a normal.
        let rest = if halos.reads_opacity { halos.rest } else { halos.query };
        let attributes = self.evaluator.evaluate(sample, rest, attributes, counts);
        if attributes.normal.is_none() {
            return;
        }
        let cut = self.evaluator.cut_at(k);
        let attributes = cut.map_or(attributes, |cut| cut.attributes(attributes));
        let Some(n) = attributes.normal else { return };
        let eye = prepared.eye_axes.normal(&attributes, &self.evaluator.dirs);
        let mut normal = SeedNormal {
            in_picture: [eye.x.to_f64(), eye.y.to_f64()],
            n_dot_v: n.dot(self.evaluator.dirs.v).to_f64().abs(),
            magnitude: attributes.magnitude.to_f64(),
            tau: 0.0,
        };
        for (i, (&h, halo)) in h.iter().zip(&halos.list).enumerate().filter(|(_, (h, _))| **h > 0.0) {
            normal.tau = halo.seeding.thickness().map_or(0.0, |t| contour::root(attributes.kappa.to_f64().abs() * t));
            let s = halo.seeding.strength(h, &normal);
            if s > 0.0 {
                strip.add(i, self.place, s);
            }
        }
    }

    /// α_u of a sample. What a function over two quantities asks for it becomes part of the attributes.
    #[inline]
    fn alpha_u(
        &mut self,
        sample: Sample<R>,
        position: Vec3<R>,
        attributes: &mut SampleAttributes<R>,
        counts: &mut Counts,
    ) -> f64 {
        let object = self.evaluator.object;
        let Some(place) = object.function.locate(sample.s) else { return 0.0 };
        let Some(over_two) = &object.over_two else { return place.alpha_u.to_f64() };
        *attributes = self.evaluator.evaluate(sample, over_two.first, *attributes, counts);
        let of_normal = |x: R| if attributes.normal.is_some() { x } else { R::ZERO };
        let here = SampleQuantities {
            position,
            place: sample.at,
            value: sample.s,
            gradient: of_normal(attributes.gradient.length()),
            magnitude: of_normal(attributes.magnitude),
            principal: attributes.principal,
            kappa: attributes.kappa,
        };
        over_two.locate(&here).map_or(0.0, |patch| patch.alpha_u.to_f64())
    }
}

/// The nearest of the next planes of rays.
fn nearest(planes: &[[i64; 2]]) -> i64 {
    planes.iter().map(|&[next, _]| next).min().unwrap_or(ENDED)
}
