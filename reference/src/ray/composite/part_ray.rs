//! A part of an object on a ray: a selection or a ghost, and its set at a sample (eqs. 2, 3; [VS-2], [VS-7]).

use super::selection_ray::{EMPTY, PlacedSelection, SelectionRay};
use crate::field::{Field, Sampler};
use crate::number::{Real, Vec3};
use crate::ray::lattice::IndexRay;
use crate::ray::prepared::Prepared;
use crate::ray::prepared_combination::{PreparedCombination, PreparedMembership, PreparedPart, PreparedSelection};
use crate::ray::sample::{Evaluator, PreparedObject, Sample, SampleAttributes};
use crate::volumeshop::far_side::through_box;
use crate::volumeshop::fuzzy;
use drypoint_scene::counts::Counts;
use drypoint_scene::shot::{Cut, Fuzzy};
use drypoint_scene::view::Ray;

/// An evaluator of a field of any kernel.
pub(in crate::ray) type FieldEvaluator<'p, 'v, R> = Evaluator<'p, 'v, R, Field<'v, R>>;

/// A part on a ray.
pub(in crate::ray) struct PartRay<'p, 'v, R: Real> {
    pub(in crate::ray) part: &'p PreparedPart<'v, R>,
    pub(in crate::ray) evaluator: FieldEvaluator<'p, 'v, R>,
    /// The samples at which the part can show something.
    pub(in crate::ray) range: [i64; 2],
}

/// A part's selection set on a ray.
#[derive(Clone, Copy)]
pub(super) struct SelectionSet<'a, 'v, R: Real> {
    pub(super) selection: &'a PreparedSelection<'v, R>,
    /// The selection at the place where the part is drawn.
    pub(super) placed: &'a PlacedSelection<R>,
    /// The factor of f_S: 1, or the share of a piece of the background.
    pub(super) share: R,
}

/// A part's set at a sample.
#[derive(Clone, Copy)]
pub(super) struct FoundPart<R> {
    pub(super) sample: Sample<R>,
    pub(super) attributes: SampleAttributes<R>,
    pub(super) rgb: [R; 3],
    /// The membership of the part's selection set.
    pub(super) weight: R,
    /// μ of eq. 3.
    pub(super) mu: R,
    /// The factor by which ghosting faded the part's opacity.
    pub(super) faded: R,
}

impl<'p, 'v, R: Real> PartRay<'p, 'v, R> {
    pub(super) fn new(
        part: &'p PreparedPart<'v, R>,
        selection: &SelectionRay<R>,
        prepared: &'p Prepared<'v, R>,
        pixel: &Ray,
    ) -> Self {
        let object = &part.object;
        let evaluator = evaluator(object, prepared, pixel);
        let ray = evaluator.ray;
        let placed = if part.is_moved { &selection.there } else { &selection.here };
        let [first, last] = ray.left_by(&object.clip.planes, object.ends, ray.inside(object.ends));
        let range = [first.max(placed.range[0]), last.min(placed.range[1])];
        Self { part, evaluator, range: if range[0] <= range[1] { range } else { EMPTY } }
    }

    /// The part's set at sample k. Returns none if μ = 0.
    pub(super) fn found(
        &mut self,
        k: i64,
        set: SelectionSet<'_, '_, R>,
        here: &mut Here<R>,
        background: &FieldEvaluator<'_, '_, R>,
        fuzzy: Fuzzy,
        counts: &mut Counts,
    ) -> Option<FoundPart<R>> {
        let can_show = |at: [usize; 3]| self.part.can_show(at);
        let (sample, weight) = self.member(k, set, can_show, here, background, counts)?;
        let ((rgb, alpha), attributes) = self.evaluator.shaded_by_any(sample, counts)?;
        let mu = fuzzy::intersection(fuzzy, weight, alpha);
        let seen = self.evaluator.cut_at(k).map_or(attributes, |cut| cut.attributes(attributes));
        (mu > R::ZERO).then_some(FoundPart { sample, attributes: seen, rgb, weight, mu, faded: R::ONE })
    }

    /// Sample k and the membership of the selection set. Returns none if the membership is 0, or if `is_asked` excludes
    /// the cell.
    pub(super) fn member(
        &self,
        k: i64,
        set: SelectionSet<'_, '_, R>,
        is_asked: impl Fn([usize; 3]) -> bool,
        here: &mut Here<R>,
        background: &FieldEvaluator<'_, '_, R>,
        counts: &mut Counts,
    ) -> Option<(Sample<R>, R)> {
        // What is taken from the background is taken where the background is.
        let is_taken = set.selection.takes && !self.part.is_moved;
        let cut_depth = if is_taken { background.cut_depth(k) } else { self.evaluator.cut_depth(k) };
        let mut look_up = || self.look_up(k, &is_asked, here, background, counts);
        let mut sample = None;
        if matches!(set.selection.membership, PreparedMembership::Value(_)) {
            sample = Some(look_up()?);
        }
        let weight = set.placed.membership(set.selection, (k, cut_depth), || sample.map(|sample: Sample<R>| sample.s));
        let weight = weight * set.share;
        if weight <= R::ZERO {
            return None;
        }
        let sample = match sample {
            Some(sample) => sample,
            None => look_up()?,
        };
        Some((sample, weight))
    }

    /// The part's sample k. It is the background's if both are one volume at one place under the same planes.
    fn look_up(
        &self,
        k: i64,
        is_asked: impl Fn([usize; 3]) -> bool,
        here: &mut Here<R>,
        background: &FieldEvaluator<'_, '_, R>,
        counts: &mut Counts,
    ) -> Option<Sample<R>> {
        if !is_asked(self.evaluator.sampler.place(self.evaluator.position(k)).cell) {
            return None;
        }
        if self.part.is_of_background { here.sample(background, counts) } else { look_up(&self.evaluator, k, counts) }
    }

    /// Whether μ > 0 at sample k.
    pub(in crate::ray) fn is_member(
        &mut self,
        k: i64,
        (selection, placed): (&PreparedSelection<'_, R>, &PlacedSelection<R>),
        counts: &mut Counts,
    ) -> bool {
        let mut found = || {
            let sample = look_up(&self.evaluator, k, counts)?;
            let weight = placed.membership(selection, (k, self.evaluator.cut_depth(k)), || Some(sample.s));
            let ((_, alpha), _) = self.evaluator.shaded_by_any(sample, counts).filter(|_| weight > R::ZERO)?;
            (alpha > R::ZERO).then_some(())
        };
        found().is_some()
    }

    /// d: the depth of the far side of the part's box, or of its last sample with μ > 0. Returns −∞ if the ray misses
    /// the part ([VS-7]).
    pub(super) fn depth(
        &mut self,
        selection: &PreparedSelection<'_, R>,
        ray: &SelectionRay<R>,
        cut: Cut,
        counts: &mut Counts,
    ) -> f64 {
        let placed = if self.part.is_moved { &ray.there } else { &ray.here };
        match cut {
            Cut::Bounds => {
                let through = placed.ray.zip(selection.index_box).and_then(|(ray, ends)| through_box(ray.line(), ends));
                through.map_or(f64::NEG_INFINITY, |[_, far]| far)
            }
            Cut::Object => {
                let [first, last] = self.range;
                let is_member = |k: &i64| self.is_member(*k, (selection, placed), counts);
                let last = (first..=last).rev().find(is_member);
                last.map_or(f64::NEG_INFINITY, |k| self.evaluator.ray.depth(k).to_f64())
            }
        }
    }

    /// Applies the part's light to a colour and an opacity.
    pub(super) fn light(&self, unlit: ([R; 3], R), attributes: &SampleAttributes<R>) -> ([R; 3], R) {
        self.part.object.shader.light(unlit, attributes, &self.evaluator.dirs)
    }
}

/// d of a part on the ray through a point of the picture or of a guard band about it. Returns −∞ if the ray misses the
/// part ([VS-7]).
pub(in crate::ray) fn depth_of_part<R: Real>(
    prepared: &Prepared<'_, R>,
    combination: &PreparedCombination<'_, R>,
    point: [f64; 2],
    (part, cut): (usize, Cut),
    counts: &mut Counts,
) -> f64 {
    let part = &combination.parts[part];
    let selection = &combination.selections[part.selection];
    let pixel = prepared.view.ray(point[0], point[1]);
    let ray = SelectionRay::new(selection, prepared, &pixel);
    PartRay::new(part, &ray, prepared, &pixel).depth(selection, &ray, cut, counts)
}

impl<R: Real> FieldEvaluator<'_, '_, R> {
    /// The attributes of a sample that shades an intersection ([VS-4]).
    pub(super) fn shading(&mut self, found: &FoundPart<R>, counts: &mut Counts) -> SampleAttributes<R> {
        let Some(beyond) = self.object.meeting else { return found.attributes };
        let attributes = self.evaluate(found.sample, beyond, found.attributes, counts);
        self.cut_at(found.sample.k).map_or(attributes, |cut| cut.attributes(attributes))
    }
}

/// A sample of the background's volume that is evaluated at most once.
pub(super) struct Here<R> {
    pub(super) k: i64,
    pub(super) is_inside: bool,
    /// None: not evaluated yet. The inner value is none if the sample is masked.
    pub(super) sample: Option<Option<Sample<R>>>,
}

impl<R: Real> Here<R> {
    pub(super) fn sample(&mut self, evaluator: &FieldEvaluator<'_, '_, R>, counts: &mut Counts) -> Option<Sample<R>> {
        if !self.is_inside {
            return None;
        }
        *self.sample.get_or_insert_with(|| look_up(evaluator, self.k, counts))
    }
}

/// The sample of an evaluator's field on plane k. Returns none if it is masked.
fn look_up<R: Real>(evaluator: &FieldEvaluator<'_, '_, R>, k: i64, counts: &mut Counts) -> Option<Sample<R>> {
    let at = evaluator.sampler.place(evaluator.position(k));
    if evaluator.object.volume.mask().is_some_and(|mask| mask.touches_cell(at.cell)) {
        counts.masked += 1;
        return None;
    }
    counts.samples += 1;
    Some(Sample { k, at, s: evaluator.sampler.value_at(at) })
}

/// The evaluator of an object on a ray.
pub(super) fn evaluator<'p, 'v, R: Real>(
    object: &'p PreparedObject<'v, R>,
    prepared: &Prepared<'_, R>,
    pixel: &Ray,
) -> FieldEvaluator<'p, 'v, R> {
    let view = &prepared.view;
    let ray = IndexRay::<R>::new(pixel, view, &prepared.lattice, &object.grid);
    let (v, v_eye) = (Vec3::from_glam(view.direction_to_world(pixel.v)), Vec3::from_glam(pixel.v));
    let dirs = object.shader.view_dirs(v, v_eye);
    Evaluator::new(object, &object.field, ray, dirs, &prepared.eye_axes)
}
