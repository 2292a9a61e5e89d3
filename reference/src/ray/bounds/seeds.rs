//! The seeds of halos on a ray, with their errors ([HALO-2], [HALO-3]).
//!
//! Each quantity that a seed depends on has errors by the reference's formulas. s is monotone in most of them, so its
//! ends are at theirs ([`Seeding::range`](crate::volumetric_halos::seed::Seeding)).

use super::aimed_ray::AimedRay;
use super::positions::{Answer, RayOrigin};
use crate::field::{Field, Sampler};
use crate::number::ways::{self, Ways};
use crate::number::{Arithmetic, Bounded, Real};
use crate::ray::lattice::IndexRay;
use crate::ray::prepared::Prepared;
use crate::ray::prepared_halos::PreparedHalos;
use crate::ray::prepared_seeds::PreparedSeeds;
use crate::ray::sample::{Evaluator, EyeAxes, Previous, Sample, SampleAttributes};
use crate::style_transfer_functions::contour;
use crate::volumetric_halos::seed::{SeedNormal, SeedPlace, SeedRanges, Seeding};
use drypoint_scene::counts::Counts;
use drypoint_scene::glam::DVec3;

/// A seed at a place of the images: by the values, and at least and at most.
pub(super) struct SeedAt {
    pub(super) k: i64,
    pub(super) halo: usize,
    pub(super) place: usize,
    pub(super) s: [f64; 3],
}

/// A ray on which samples seed.
struct SeedRay<'p, 'v> {
    evaluator: Evaluator<'p, 'v, Bounded, Field<'v, Bounded>>,
    seeds: &'p PreparedSeeds<'v>,
    eye_axes: &'p EyeAxes<Bounded>,
}

/// The seeds of all samples on the ray through a point.
#[inline]
pub(super) fn seeds_of_ray<'p, 'v>(
    (prepared, halos): (&'p Prepared<'v, Bounded>, &'p PreparedHalos<'v>),
    origin: RayOrigin,
    point: [f64; 2],
    place: usize,
) -> Vec<SeedAt> {
    let Some(seeds) = &halos.seeds else { return Vec::new() };
    let object = &prepared.object;
    let planes = &object.clip.planes;
    let evaluator = AimedRay::new(prepared, point, origin).evaluator(object);
    let mut seed_ray = SeedRay { evaluator, seeds, eye_axes: &prepared.eye_axes };
    let ray: IndexRay<Bounded> = seed_ray.evaluator.ray;
    let [from, to] = ray.left_by(planes, object.ends, ray.inside(object.ends));
    let [first, last] = ray.candidates(object.ends);
    let mut found = Vec::new();
    let mut after_cut = false;
    for k in first..=last {
        let (inside, cut) = (ray.is_inside(k, object.ends), ray.is_cut(k, planes));
        let hangs_on_cut = cut == Answer::Open || after_cut;
        after_cut = cut == Answer::Open || (cut == Answer::Yes && inside == Answer::Open);
        if inside == Answer::No || cut == Answer::Yes {
            continue;
        }
        let is_there = from <= k && k <= to;
        for (halo, [value, least, most]) in seed_ray.on_all_ways(k).into_iter().enumerate() {
            let s = match (hangs_on_cut, inside == Answer::Open) {
                (true, _) if most > 0.0 => [value, 0.0, 1.0],
                (_, true) => [value, 0.0, most],
                _ => [value, least, most],
            };
            if s[2] > 0.0 {
                found.push(SeedAt { k, halo, place, s: if is_there { s } else { [0.0, 0.0, s[2]] } });
            }
        }
    }
    found
}

impl SeedRay<'_, '_> {
    /// s of each halo at sample k, on all ways together.
    #[inline]
    fn on_all_ways(&mut self, k: i64) -> Vec<[f64; 3]> {
        let Ways { by_value: mut all, others, too_many } = ways::follow(|| self.on_one_way(k));
        for (i, [value, least, most]) in all.iter_mut().enumerate() {
            for (other, _) in &others {
                let [_, low, high] = other[i];
                (*least, *most) = (least.min(low), most.max(high));
            }
            if too_many {
                (*least, *most) = (0.0, 1.0);
            }
            (*least, *most) = (least.min(*value), most.max(*value));
        }
        all
    }

    #[inline]
    fn on_one_way(&mut self, k: i64) -> Vec<[f64; 3]> {
        let (evaluator, seeds, counts) = (&mut self.evaluator, self.seeds, &mut Counts::default());
        let none = vec![[0.0; 3]; seeds.list.len()];
        evaluator.previous = Previous::None;
        let position = evaluator.position(k);
        let at = evaluator.sampler.place(position);
        if evaluator.object.volume.mask().is_some_and(|mask| mask.touches_cell(at.cell)) {
            return none;
        }
        let sample = Sample { k, at, s: evaluator.sampler.value_at(at) };
        // h_v, h_l and h_p.
        let mut attributes = SampleAttributes::neutral();
        let (alpha_u, asked) = match seeds.reads_opacity {
            true => evaluator.alpha_u(sample, &mut attributes, counts),
            false => (Bounded::exact(0.0), false),
        };
        let grid = &evaluator.object.grid;
        let place = SeedPlace {
            value: sample.s.value(),
            alpha_u: alpha_u.value(),
            world: if seeds.reads_places { grid.to_world(position.to_glam()) } else { DVec3::ZERO },
            label: seeds.labels.as_ref().map_or(0, |labels| labels.id_at(position)),
        };
        let axes = grid.axes();
        let moved = |axis: DVec3, x: Bounded| axis.length() * x.error();
        let displaced =
            moved(axes.x_axis, position.x) + moved(axes.y_axis, position.y) + moved(axes.z_axis, position.z);
        // Places are counted from the first voxel, and rounded in sums of products.
        let displaced = displaced + 32.0 * f64::from(f32::EPSILON) * 4.0 * grid.radius();
        let mut ranges = SeedRanges {
            value: sample.s.ends(),
            alpha_u: alpha_u.ends(),
            displaced,
            turned: 0.0,
            n_dot_v: [0.0; 2],
            magnitude: [1.0; 2],
            tau: [1.0; 2],
        };
        let best = SeedNormal { in_picture: [0.0; 2], n_dot_v: 0.0, magnitude: 1.0, tau: 1.0 };
        // The largest s of any normal.
        ranges.turned = 1.0;
        if seeds.list.iter().all(|seeding| seeding.range(&place, &best, &ranges)[1] == 0.0) {
            return none;
        }
        // The normal.
        let rest = if asked { seeds.rest } else { seeds.query };
        let attributes = evaluator.evaluate(sample, rest, attributes, counts);
        if attributes.normal.is_none() {
            return none;
        }
        let cut = evaluator.cut_at(k);
        let attributes = cut.map_or(attributes, |cut| cut.attributes(attributes));
        let Some(n) = attributes.normal else { return none };
        let eye = self.eye_axes.normal(&attributes, &evaluator.dirs);
        let n_dot_v = n.dot(evaluator.dirs.v).abs();
        let positive = |ends: [f64; 2]| ends.map(|x| x.max(0.0));
        ranges.turned = eye.x.error().hypot(eye.y.error());
        ranges.n_dot_v = positive(n_dot_v.ends());
        ranges.magnitude = positive(attributes.magnitude.ends());
        let of_seeding = |seeding: &Seeding| {
            let tau = seeding
                .thickness()
                .map_or(Bounded::exact(0.0), |t| contour::root(attributes.kappa.abs() * Bounded::from_f64(t)));
            let normal = SeedNormal {
                in_picture: [eye.x.value(), eye.y.value()],
                n_dot_v: n_dot_v.value(),
                magnitude: attributes.magnitude.value(),
                tau: tau.value(),
            };
            let h = seeding.before_gradient(&place);
            let s = if h > 0.0 { seeding.strength(h, &normal) } else { 0.0 };
            let ranges = SeedRanges { tau: positive(tau.ends()), ..ranges };
            let [least, most] = seeding.range(&place, &normal, &ranges);
            [s, least.min(s), most.max(s)]
        };
        seeds.list.iter().map(of_seeding).collect()
    }
}
