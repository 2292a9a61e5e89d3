//! One ray of a picture, with bounds of its errors.

use super::layers::{LayerSums, Quantities};
use super::positions::{Answer, is_in_box};
use super::ray_halos::RayHalos;
use super::surface::{BoundedHit, Met, SurfaceErrors, at_depth};
use crate::accumulator::Accumulator;
use crate::field::{Field, Sampler};
use crate::number::ways::{self, Ways};
use crate::number::{Bounded, Decision, Real};
use crate::ray::opacity::correct;
use crate::ray::prepared::Prepared;
use crate::ray::sample::{Evaluator, Previous, Sample, SampleAttributes, need};
use drypoint_scene::color;
use drypoint_scene::counts::Counts;
use drypoint_scene::fragments::Fragment;

/// The result of a ray.
pub(super) struct Traced {
    /// Premultiplied colour in the blend space, and opacity, without the background.
    pub(super) front: Accumulator<Bounded>,
    /// The first decision that errors leave open and that shows in the result, if there is one.
    pub(super) undecided: Option<Decision>,
    /// Whether the errors of `front` enclose the results of all outcomes of open decisions.
    pub(super) is_enclosed: bool,
    /// Sums for the other layers; none if there are no such layers.
    pub(super) sums: Option<LayerSums>,
}

/// A sample as it is composited: straight colour in the blend space, and the opacity of its step.
#[derive(Clone, Copy)]
pub(super) struct Shown {
    rgb: [Bounded; 3],
    alpha: Bounded,
    /// Quantities for the layers, if there are any.
    quantities: Option<Quantities>,
}

/// A sample that an f32 renderer may visit, and what is known of it before it is evaluated.
#[derive(Clone, Copy)]
pub(super) struct Visit {
    pub(super) k: i64,
    /// Whether the reference visits it.
    is_visited: bool,
    /// Whether errors leave open whether it lies in the box.
    is_inside_open: bool,
    /// Whether its cut is open, or whether the surface lies before it.
    open: Option<Decision>,
    /// Whether it is the last sample before the surface.
    pub(super) is_last: bool,
}

/// The state of a ray.
pub(super) struct Tracer<'p, 'v> {
    pub(super) prepared: &'p Prepared<'v, Bounded>,
    pub(super) evaluator: Evaluator<'p, 'v, Bounded, Field<'v, Bounded>>,
    /// Δ_ray/Δ₀.
    pub(super) steps: Bounded,
    /// Eye depth between samples.
    depth_step: Bounded,
    /// The lines that are left.
    pub(super) lines: &'p [Fragment],
    /// The last sample among lines, and the depth at which its step ends.
    pub(super) before: Option<(Visit, f64)>,
    /// A of the lines alone.
    pub(super) of_lines: Bounded,
    pub(super) traced: Traced,
    /// The halos on the ray, if there are any.
    halos: Option<RayHalos<'p>>,
}

impl<'p, 'v> Tracer<'p, 'v> {
    /// A ray before its first sample. Its steps are `steps` reference lengths long, `depth_step` of them along the eye's
    /// axis.
    pub(super) fn new(
        prepared: &'p Prepared<'v, Bounded>,
        evaluator: Evaluator<'p, 'v, Bounded, Field<'v, Bounded>>,
        [steps, depth_step]: [Bounded; 2],
        halos: Option<RayHalos<'p>>,
    ) -> Self {
        let traced = Traced {
            front: Accumulator::empty(Bounded::ZERO),
            undecided: None,
            is_enclosed: true,
            sums: prepared.collects.then(LayerSums::new),
        };
        Self {
            prepared,
            evaluator,
            steps,
            depth_step,
            lines: &[],
            before: None,
            of_lines: Bounded::ZERO,
            traced,
            halos,
        }
    }
}

impl Tracer<'_, '_> {
    /// The place at which the ray ends on the iso-surface, if there is one.
    #[inline]
    pub(super) fn hit(&mut self, errors: &SurfaceErrors) -> Option<BoundedHit> {
        self.found(errors.first(self.prepared, &self.evaluator.ray))
    }

    /// The reference's intersection. Marks one that errors leave open.
    pub(super) fn found(&mut self, met: Met) -> Option<BoundedHit> {
        match met {
            Met::Nowhere => None,
            Met::At(hit) => Some(hit),
            Met::Open(hit) => {
                self.mark(Decision::Surface);
                hit.map(|hit| BoundedHit { t: hit.t, error: 0.0, cut: hit.cut })
            }
        }
    }

    /// Visits all samples that an f32 renderer may visit, up to the iso-surface, on a ray with or without lines. Returns
    /// whether the ray is still open.
    #[inline]
    pub(super) fn samples(&mut self, hit: Option<BoundedHit>, has_lines: bool) -> bool {
        let (object, ray) = (&self.prepared.object, self.evaluator.ray);
        let [first, last] = ray.candidates(object.ends);
        let [from, to] = ray.left_by(&object.clip.planes, object.ends, ray.inside(object.ends));
        // `last_of_all` stands for the way up to the surface. In f32 the next sample may do so.
        let last_of_all = hit.map_or(i64::MAX - 1, |hit| ray.last_before(hit.t));
        let [last, to] = [last.min(last_of_all + 1), to.min(last_of_all)];
        // Whether errors leave open which side of a clip plane the previous sample is on, or whether that sample is there.
        // If so, this sample may be the first behind the cut.
        let mut after_cut = false;
        for k in first..=last {
            let (inside, cut) = (ray.is_inside(k, object.ends), ray.is_cut(k, &object.clip.planes));
            let hangs_on_cut = cut == Answer::Open || after_cut;
            after_cut = cut == Answer::Open || (cut == Answer::Yes && inside == Answer::Open);
            if inside == Answer::No || cut == Answer::Yes {
                continue;
            }
            let (depth, slack) = (ray.depth(k), hit.map_or(0.0, |hit| hit.error + ray.depth(k).error()));
            let is_at_surface = hit.is_some_and(|hit| (depth.value() - hit.t).abs() <= slack);
            let last = hit.filter(|_| k == last_of_all);
            let visit = Visit {
                k,
                is_visited: (from..=to).contains(&k),
                is_inside_open: inside == Answer::Open,
                open: is_at_surface.then_some(Decision::Surface).or(hangs_on_cut.then_some(Decision::Cut)),
                is_last: last.is_some(),
            };
            let is_open = if has_lines {
                let step = ray.depth_step.value();
                let until = last.map_or(((k + 1) as f64 * step, 0.0), |hit| (hit.t, hit.error / step));
                self.lay_among_lines(visit, until)
            } else {
                self.lay(&visit, self.steps_of(k, hit, last_of_all))
            };
            if !is_open {
                return false;
            }
        }
        true
    }

    /// Composites a sample, `steps` reference lengths long. Returns whether the ray is still open.
    #[inline]
    pub(super) fn lay(&mut self, visit: &Visit, steps: Bounded) -> bool {
        let Some(shown) = self.shown(visit.k, steps) else { return true };
        if let Some(decision) = visit.open {
            self.mark(decision);
        }
        // The reference ends at A = 1. In f32 A may be less.
        let has_ended = self.traced.front.opacity.value() >= self.prepared.stop_at.value();
        if visit.is_inside_open {
            self.mark_enclosed(Decision::Inside);
        }
        // A share of length 0 is none for the reference.
        let is_laid = visit.is_visited && !has_ended && steps.value() > 0.0;
        let shown = match (is_laid, visit.is_inside_open) {
            (true, false) => Some(shown),
            (true, true) => union(Some(shown), None),
            (false, true) => union(None, Some(shown)),
            (false, false) if visit.is_visited => union(None, Some(shown)),
            (false, false) => None,
        };
        let Some(shown) = shown else { return true };
        self.collect(&shown, shown.alpha, self.depth(visit.k));
        self.put(visit.k, &shown)
    }

    /// Composites a sample among objects, which the reference visits or not. Returns whether the ray is still open.
    #[inline]
    pub(super) fn composite(&mut self, k: i64, shown: &Shown, hit: Option<BoundedHit>, visits: bool) -> bool {
        let depth = self.evaluator.ray.depth(k);
        if hit.is_some_and(|hit| (depth.value() - hit.t).abs() <= hit.error + depth.error()) {
            self.mark(Decision::Surface);
        }
        !visits || self.put(k, shown)
    }

    /// Composites a sample behind the glow of the planes before it. Returns whether the ray is still open.
    #[inline]
    fn put(&mut self, k: i64, shown: &Shown) -> bool {
        if !self.pass_planes(k) {
            return false;
        }
        self.traced.front.over(self.tinted(shown.rgb), shown.alpha);
        self.is_open()
    }

    /// Δ/Δ₀ of sample k. That of the last sample before the surface differs.
    #[inline]
    pub(super) fn steps_of(&self, k: i64, hit: Option<BoundedHit>, last_of_all: i64) -> Bounded {
        hit.filter(|_| k == last_of_all).map_or(self.steps, |hit| self.share(k, hit))
    }

    /// The eye depth at which sample k is evaluated.
    fn depth(&self, k: i64) -> Bounded {
        let of_plane = || Bounded::exact(k as f64 + 0.5) * self.depth_step;
        let of_cut = self.evaluator.cut_depth(k).map(|depth| self.depth_at(depth.value(), depth.error()));
        of_cut.unwrap_or_else(of_plane)
    }

    /// An eye depth that is known up to an error in steps that are exact. d/Δ, the plane and the depth are rounded.
    fn depth_at(&self, t: f64, error: f64) -> Bounded {
        let rounded = 8.0 * f64::from(f32::EPSILON) * t.abs();
        let of_step = self.depth_step.error() * (t / self.depth_step.value()).abs();
        Bounded::new(t, error + rounded + of_step)
    }

    /// Adds a sample to the layers. A renderer whose ray may have ended may not add it.
    #[inline]
    fn collect(&mut self, shown: &Shown, alpha: Bounded, depth: Bounded) {
        let through = Bounded::ONE - self.of_lines;
        let may_have_ended = self.traced.front.opacity.ends()[1] >= self.prepared.stop_at.value();
        let alpha = if may_have_ended { alpha.joined(Bounded::ZERO) } else { alpha };
        if let (Some(sums), Some(quantities)) = (&mut self.traced.sums, &shown.quantities) {
            sums.add(alpha, depth, quantities, through);
        }
    }

    /// Δ/Δ₀ of the last sample before the surface. The sample stands for the way from the beginning of its own share to
    /// the surface.
    fn share(&self, k: i64, hit: BoundedHit) -> Bounded {
        let (ray, reference) = (&self.evaluator.ray, self.prepared.object.reference_length);
        let step = ray.depth_step.value();
        let share = hit.t / step - k as f64;
        // The rounding of the quotient in f32 is relative to the depth.
        let error = hit.error / step + 4.0 * f64::from(f32::EPSILON) * (hit.t / step).abs();
        Bounded::new(share * ray.step / reference, error * ray.step / reference)
    }

    /// Composites the iso-surface, or a cut of it, behind the samples.
    #[inline]
    pub(super) fn surface(&mut self, hit: BoundedHit) {
        let prepared = self.prepared;
        let (Some(surface), object) = (&prepared.surface, &prepared.object) else { return };
        let (ray, dirs) = (self.evaluator.ray, self.evaluator.dirs);
        let is_first = self.traced.sums.as_ref().is_some_and(LayerSums::is_empty);
        let query = if is_first { surface.query.and(surface.first) } else { surface.query };
        let with_errors = |position| at_depth(position, &ray, hit.error);
        let place = with_errors(self.evaluator.inside(hit.t));
        let before = self.evaluator.before(hit.t, prepared.view.perspective).map(with_errors);
        let is_before_open = is_in_box(with_errors(self.evaluator.at(hit.t - ray.depth_step.value())), object.ends);
        let shown = self.merged(|tracer| {
            let cut = hit.cut.map(|plane| object.clip.face(plane, &dirs, &prepared.eye_axes));
            let counts = &mut Counts::default();
            let mut attributes = tracer.evaluator.evaluate_at(place, before, query, counts);
            if let Some(cut) = &cut {
                attributes = cut.attributes(attributes);
            }
            let rgb = surface.lit.color(surface.rgb, attributes.normal, [dirs.v, surface.lit.half_vector(dirs.v)]);
            let rgb = tracer.in_blend_space(cut.map_or(rgb, |cut| cut.over(rgb)));
            let iso = Bounded::from_f64(surface.roots.iso());
            let quantities = Quantities::new(iso, &attributes, (&prepared.eye_axes, &dirs));
            let is_open = is_before_open == Answer::Open && cut.is_none();
            let quantities = if is_open { quantities.with_open_kappa() } else { quantities };
            Some(Shown { rgb, alpha: Bounded::ONE, quantities: Some(quantities) })
        });
        if let Some(shown) = shown {
            let depth = self.depth_at(hit.t, hit.error);
            let has_ended = self.traced.front.opacity.value() >= prepared.stop_at.value();
            let alpha = if has_ended { Bounded::new(0.0, 1.0) } else { Bounded::ONE };
            self.collect(&shown, alpha, depth);
            self.end(&shown, hit);
        }
    }

    /// A linear colour of opacity 1.
    #[inline]
    pub(super) fn opaque(&self, rgb: [Bounded; 3]) -> Shown {
        Shown { rgb: self.in_blend_space(rgb), alpha: Bounded::ONE, quantities: None }
    }

    /// Lays the glow behind each plane before plane k. Returns whether the ray is still open.
    #[inline]
    fn pass_planes(&mut self, k: i64) -> bool {
        let Some(mut halos) = self.halos.take() else { return true };
        let is_open = halos.pass(k, &mut |glow| {
            self.traced.front.over_premultiplied(glow);
            self.is_open()
        });
        self.halos = Some(halos);
        is_open
    }

    /// Lays the glow behind all planes that follow the last sample.
    #[inline]
    pub(super) fn leave_halos(&mut self) {
        if let Some(end) = self.halos.as_ref().map(RayHalos::end) {
            self.pass_planes(end);
        }
    }

    /// A colour under the tint of the next plane.
    fn tinted(&self, rgb: [Bounded; 3]) -> [Bounded; 3] {
        self.halos.as_ref().map_or(rgb, |halos| halos.tinted(rgb))
    }

    /// Composites what ends the ray at a hit.
    #[inline]
    pub(super) fn end(&mut self, shown: &Shown, hit: BoundedHit) {
        if self.pass_planes(self.evaluator.ray.last_before(hit.t) + 1) {
            self.traced.front.end(self.tinted(shown.rgb));
        }
    }

    /// Converts a linear colour to the blend space ([VAL-3]).
    pub(super) fn in_blend_space(&self, rgb: [Bounded; 3]) -> [Bounded; 3] {
        let encoded = |c| Bounded::monotone([c], |[c]| color::linear_to_srgb(c));
        if self.prepared.encode { rgb.map(encoded) } else { rgb }
    }

    /// Whether the ray goes on. Behind an opaque end, samples change no value, but A need not be 1 in f32.
    pub(super) fn is_open(&mut self) -> bool {
        let (a, stop_at) = (self.traced.front.opacity, self.prepared.stop_at.value());
        if stop_at >= 1.0 {
            return a.ends()[0] < 1.0;
        }
        let [lo, hi] = a.ends();
        if lo < stop_at && hi >= stop_at {
            self.mark(Decision::End);
        }
        a.value() < stop_at
    }

    /// A sample, `steps` reference lengths long, on all ways that open comparisons leave. None if it is transparent on
    /// all ways.
    #[inline]
    fn shown(&mut self, k: i64, steps: Bounded) -> Option<Shown> {
        self.merged(|tracer| tracer.shaded(k, steps))
    }

    /// The union of a sample on all ways. Marks the decisions at which ways differ visibly.
    #[inline]
    pub(super) fn merged(&mut self, mut shown: impl FnMut(&mut Self) -> Option<Shown>) -> Option<Shown> {
        let Ways { by_value, others, too_many } = ways::follow(|| shown(self));
        if too_many {
            self.mark(Decision::Many);
        }
        let mut merged = by_value;
        for (other, decision) in others {
            if self.parts(by_value, other) {
                self.mark_enclosed(decision);
            }
            merged = union(merged, other);
        }
        merged
    }

    /// A sample on one way.
    #[inline]
    pub(super) fn shaded(&mut self, k: i64, steps: Bounded) -> Option<Shown> {
        let (object, counts) = (&self.prepared.object, &mut Counts::default());
        // The previous normal would be that of a single way.
        self.evaluator.previous = Previous::None;
        let at = self.evaluator.sampler.place(self.evaluator.position(k));
        if object.volume.mask().is_some_and(|mask| mask.touches_cell(at.cell)) {
            return None;
        }
        let sample = Sample { k, at, s: self.evaluator.sampler.value_at(at) };
        let place = object.function.locate(sample.s)?;
        let (shaded, attributes) = match &object.over_two {
            Some(over_two) => self.evaluator.shaded_over_two(over_two, sample, counts)?,
            None => self.evaluator.shaded::<need::Anything>(sample, &place, counts),
        };
        let quantities = self.quantities(sample, attributes);
        Some(Shown { quantities, ..self.corrected(shaded, steps) })
    }

    /// A sample as it is composited, `steps` reference lengths long, from its linear colour and its opacity per
    /// reference length.
    #[inline]
    pub(super) fn corrected(&self, (rgb, alpha): ([Bounded; 3], Bounded), steps: Bounded) -> Shown {
        Shown {
            rgb: self.in_blend_space(rgb),
            // No share is shorter than 0, whatever its error.
            alpha: Bounded::monotone([alpha, steps], |[alpha, steps]| correct(alpha, steps.max(0.0))),
            quantities: None,
        }
    }

    /// The quantities of a sample for the layers, if there are any.
    #[inline]
    fn quantities(&mut self, sample: Sample<Bounded>, attributes: SampleAttributes<Bounded>) -> Option<Quantities> {
        let is_empty = self.traced.sums.as_ref()?.is_empty();
        let mut attributes = attributes;
        if let (Some(first), true) = (self.prepared.object.first, is_empty) {
            attributes = self.evaluator.evaluate(sample, first, attributes, &mut Counts::default());
        }
        if let Some(cut) = self.evaluator.cut_at(sample.k) {
            attributes = cut.attributes(attributes);
        }
        Some(Quantities::new(sample.s, &attributes, (&self.prepared.eye_axes, &self.evaluator.dirs)))
    }

    /// Whether the results of two ways differ visibly: the formula jumps between them by more than the bound that the
    /// ray already has.
    pub(super) fn parts(&self, a: Option<Shown>, b: Option<Shown>) -> bool {
        let of = |shown: Option<Shown>| shown.map_or(Bounded::ZERO, |shown| shown.alpha);
        let apart = |a: Bounded, b: Bounded| {
            let gap = (a.value() - b.value()).abs() - a.error() - b.error();
            if gap.is_nan() { f64::INFINITY } else { gap.max(0.0) }
        };
        let mut jump = apart(of(a), of(b));
        if let (Some(a), Some(b)) = (a, b) {
            let most = a.alpha.ends()[1].max(b.alpha.ends()[1]);
            for c in 0..3 {
                jump = jump.max(most * apart(a.rgb[c], b.rgb[c]));
            }
        }
        self.shows(jump)
    }

    /// Whether a change by this share at the sample exceeds the ray's bound.
    fn shows(&self, share: f64) -> bool {
        let Accumulator { rgb, opacity } = &self.traced.front;
        let through = 1.0 - opacity.ends()[0];
        let bound = rgb.iter().chain([opacity]).fold(0.0, |most: f64, c| most.max(c.error()));
        through * share > bound
    }

    /// Notes an open decision, some of whose outcomes are not evaluated.
    pub(super) fn mark(&mut self, decision: Decision) {
        self.traced.is_enclosed = false;
        self.mark_enclosed(decision);
    }

    /// Notes an open decision whose outcomes all lie within the errors.
    fn mark_enclosed(&mut self, decision: Decision) {
        self.traced.undecided.get_or_insert(decision);
    }
}

/// The values of a sample, with a bound that also covers another way.
#[inline]
pub(super) fn union(sample: Option<Shown>, other: Option<Shown>) -> Option<Shown> {
    match (sample, other) {
        (Some(a), Some(b)) => Some(Shown {
            rgb: [0, 1, 2].map(|c| a.rgb[c].joined(b.rgb[c])),
            alpha: a.alpha.joined(b.alpha),
            quantities: a.quantities.zip(b.quantities).map(|(a, b)| a.joined(&b)),
        }),
        (Some(a), None) => Some(Shown { alpha: a.alpha.joined(Bounded::ZERO), ..a }),
        (None, Some(b)) => Some(Shown { alpha: Bounded::ZERO.joined(b.alpha), ..b }),
        (None, None) => None,
    }
}
