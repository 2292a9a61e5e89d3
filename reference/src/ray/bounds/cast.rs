//! One ray of a picture, with bounds of its errors.

use super::moved_ray::{MovedRay, with_errors_of};
use super::positions::{Answer, RayOrigin};
use super::surface::{BoundedHit, Met, SurfaceErrors, at_depth};
use crate::accumulator::Accumulator;
use crate::field::{Field, Sampler};
use crate::number::ways::{self, Ways};
use crate::number::{Bounded, Decision, Real, Vec3};
use crate::ray::lattice::IndexRay;
use crate::ray::opacity::correct;
use crate::ray::prepared::Prepared;
use crate::ray::sample::{Evaluator, Previous, Sample, need};
use drypoint_scene::color;
use drypoint_scene::counts::Counts;

/// The result of a ray.
pub(super) struct Traced {
    /// Premultiplied colour in the blend space, and opacity, without the background.
    pub(super) front: Accumulator<Bounded>,
    /// The first decision that errors leave open and that shows in the result, if there is one.
    pub(super) undecided: Option<Decision>,
}

/// A sample as it is composited: straight colour in the blend space, and the opacity of its step.
#[derive(Clone, Copy)]
struct Shown {
    rgb: [Bounded; 3],
    alpha: Bounded,
}

/// Casts the ray through a point of the picture, in pixels from the top left corner.
#[inline]
pub(super) fn trace(
    prepared: &Prepared<'_, Bounded>,
    [i, j]: [f64; 2],
    origin: RayOrigin,
    surface: Option<&SurfaceErrors>,
) -> Traced {
    let (view, object) = (&prepared.view, &prepared.object);
    let pixel = view.ray(i, j);
    let ray = IndexRay::<Bounded>::new(&pixel, view, &prepared.lattice, object.volume.grid());
    let grid = object.volume.grid();
    let moved = (origin == RayOrigin::Middle).then(|| MovedRay::new(view, &prepared.lattice, grid, [i, j]));
    let ray = ray.with_errors(object.ends, moved.as_ref());
    let (mut v, mut v_eye) = (Vec3::from_glam(view.direction_to_world(pixel.v)), Vec3::from_glam(pixel.v));
    let mut steps = Bounded::from_f64(ray.step / object.reference_length);
    if let Some(moved) = &moved {
        (v, v_eye) = (with_errors_of(v, moved.v), with_errors_of(v_eye, moved.v_eye));
        steps = Bounded::new(steps.value(), (moved.step / Bounded::from_f64(object.reference_length)).error());
    }
    let dirs = object.shader.view_dirs(v, v_eye);
    let evaluator = Evaluator::new(object, &object.field, ray, dirs, &prepared.eye_axes);
    let mut tracer = Tracer {
        prepared,
        evaluator,
        steps,
        traced: Traced { front: Accumulator::empty(Bounded::ZERO), undecided: None },
    };
    if ray.cut_is_open(&object.clip.planes, v) {
        tracer.mark(Decision::Cut);
    }
    let hit = surface.and_then(|errors| tracer.hit(errors));
    let is_alone = prepared.surface.as_ref().is_some_and(|surface| surface.alone);
    if (is_alone || tracer.samples(hit))
        && let Some(hit) = hit
    {
        tracer.surface(hit);
    }
    tracer.traced
}

/// The state of a ray.
struct Tracer<'p, 'v> {
    prepared: &'p Prepared<'v, Bounded>,
    evaluator: Evaluator<'p, 'v, Bounded, Field<'v, Bounded>>,
    /// Δ_ray/Δ₀.
    steps: Bounded,
    traced: Traced,
}

impl Tracer<'_, '_> {
    /// The place at which the ray ends on the iso-surface, if there is one.
    #[inline]
    fn hit(&mut self, errors: &SurfaceErrors) -> Option<BoundedHit> {
        let ray = &self.evaluator.ray;
        match errors.first(self.prepared, ray, ray.errors()) {
            Met::Nowhere => None,
            Met::At(hit) => Some(hit),
            Met::Open(t) => {
                self.mark(Decision::Surface);
                t.map(|t| BoundedHit { t, error: 0.0 })
            }
        }
    }

    /// Visits all samples that an f32 renderer may visit, up to the iso-surface. Returns whether the ray is still open.
    #[inline]
    fn samples(&mut self, hit: Option<BoundedHit>) -> bool {
        let (object, ray) = (&self.prepared.object, self.evaluator.ray);
        let [first, last] = ray.candidates(object.ends);
        let [from, to] = ray.left_by(&object.clip.planes, object.ends, ray.inside(object.ends));
        // `last_of_all` stands for the way up to the surface. In f32 the next sample may do so.
        let last_of_all = hit.map_or(i64::MAX - 1, |hit| ray.last_before(hit.t));
        let [last, to] = [last.min(last_of_all + 1), to.min(last_of_all)];
        // Whether errors leave open which side of a clip plane the previous sample is on. If so, this sample may be the
        // first behind the cut.
        let mut after_cut = false;
        for k in first..=last {
            let (inside, cut) = (ray.is_inside(k, object.ends), ray.is_cut(k, &object.clip.planes));
            let hangs_on_cut = cut == Answer::Open || after_cut;
            after_cut = cut == Answer::Open;
            if inside == Answer::No || cut == Answer::Yes {
                continue;
            }
            let steps = hit.filter(|_| k == last_of_all).map_or(self.steps, |hit| self.share(k, hit));
            let Some(shown) = self.shown(k, steps) else { continue };
            let (depth, slack) = (ray.depth(k), hit.map_or(0.0, |hit| hit.error + ray.depth(k).error()));
            if hit.is_some_and(|hit| (depth.value() - hit.t).abs() <= slack) {
                self.mark(Decision::Surface);
            }
            if inside == Answer::Open {
                self.mark(Decision::Inside);
            }
            if hangs_on_cut {
                self.mark(Decision::Cut);
            }
            if k < from || k > to {
                continue;
            }
            self.traced.front.over(shown.rgb, shown.alpha);
            if !self.is_open() {
                return false;
            }
        }
        true
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

    /// Composites the iso-surface behind the samples.
    #[inline]
    fn surface(&mut self, hit: BoundedHit) {
        let Some(surface) = &self.prepared.surface else { return };
        let (ray, v) = (self.evaluator.ray, self.evaluator.dirs.v);
        let position = at_depth(self.evaluator.inside(hit.t), &ray, ray.errors(), hit.error);
        let sampler = self.evaluator.sampler;
        let shown = self.merged(|tracer| {
            let g = surface.query.gradient.then(|| sampler.gradient(position));
            let normal = g.and_then(|g| tracer.prepared.object.normal(g, v));
            let rgb = surface.lit.color(surface.rgb, normal, [v, surface.lit.half_vector(v)]);
            Some(Shown { rgb: tracer.in_blend_space(rgb), alpha: Bounded::ONE })
        });
        if let Some(shown) = shown {
            self.traced.front.end(shown.rgb);
        }
    }

    /// Converts a linear colour to the blend space ([VAL-3]).
    fn in_blend_space(&self, rgb: [Bounded; 3]) -> [Bounded; 3] {
        let encoded = |c| Bounded::monotone([c], |[c]| color::linear_to_srgb(c));
        if self.prepared.encode { rgb.map(encoded) } else { rgb }
    }

    /// Whether the ray goes on. Behind an opaque end, samples change no value, but A need not be 1 in f32.
    fn is_open(&mut self) -> bool {
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
    fn merged(&mut self, mut shown: impl FnMut(&mut Self) -> Option<Shown>) -> Option<Shown> {
        let Ways { by_value, others, too_many } = ways::follow(|| shown(self));
        if too_many {
            self.mark(Decision::Many);
        }
        let mut merged = by_value;
        for (other, decision) in others {
            if self.parts(by_value, other) {
                self.mark(decision);
            }
            merged = union(merged, other);
        }
        merged
    }

    /// A sample on one way.
    #[inline]
    fn shaded(&mut self, k: i64, steps: Bounded) -> Option<Shown> {
        let (object, counts) = (&self.prepared.object, &mut Counts::default());
        // The previous normal would be that of a single way.
        self.evaluator.previous = Previous::None;
        let at = self.evaluator.sampler.place(self.evaluator.ray.position(k));
        if object.volume.mask().is_some_and(|mask| mask.touches_cell(at.cell)) {
            return None;
        }
        let sample = Sample { k, at, s: self.evaluator.sampler.value_at(at) };
        let place = object.function.locate(sample.s)?;
        let ((rgb, alpha), _) = match &object.over_two {
            Some(over_two) => self.evaluator.shaded_over_two(over_two, sample, counts)?,
            None => self.evaluator.shaded::<need::Anything>(sample, &place, counts),
        };
        Some(Shown {
            rgb: self.in_blend_space(rgb),
            alpha: Bounded::monotone([alpha, steps], |[alpha, steps]| correct(alpha, steps)),
        })
    }

    /// Whether the results of two ways differ visibly: the formula jumps between them by more than the bound that the
    /// ray already has.
    fn parts(&self, a: Option<Shown>, b: Option<Shown>) -> bool {
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

    fn mark(&mut self, decision: Decision) {
        self.traced.undecided.get_or_insert(decision);
    }
}

/// The values of a sample, with a bound that also covers another way.
fn union(sample: Option<Shown>, other: Option<Shown>) -> Option<Shown> {
    let joined = |a: Bounded, b: Bounded| {
        let away = (a.value() - b.value()).abs() + b.error();
        Bounded::new(a.value(), if away.is_nan() { away } else { a.error().max(away) })
    };
    match (sample, other) {
        (Some(a), Some(b)) => {
            Some(Shown { rgb: [0, 1, 2].map(|c| joined(a.rgb[c], b.rgb[c])), alpha: joined(a.alpha, b.alpha) })
        }
        (Some(a), None) => Some(Shown { alpha: joined(a.alpha, Bounded::ZERO), ..a }),
        (None, Some(b)) => Some(Shown { alpha: joined(Bounded::ZERO, b.alpha), ..b }),
        (None, None) => None,
    }
}
