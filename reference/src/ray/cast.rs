//! One ray, front to back ([VAL-3], [VAL-4], [RAY-1], [RAY-2]).

use super::cells::Cells;
use super::lattice::IndexRay;
use super::layers::{Seen, Sums};
use super::need::{self, Need, Needs};
use super::opacity::Correction;
use super::over_two::OverTwo;
use super::prepared::{Calls, KappaSource, Prepared};
use super::sample::{Facts, Sight};
use super::skip::Boxes;
use crate::field::{Place, Sampler, curvature};
use crate::number::{Real, Sym3, Vec3};
use crate::style_transfer_functions::curvature_along_ray;
use crate::transfer;
use crate::transfer::over::Here;
use drypoint_scene::color;
use drypoint_scene::counts::Counts;

/// What comes out of one ray.
pub(super) struct Cast {
    /// Premultiplied colour and opacity in the blend space, without the background.
    pub(super) rgba: [f64; 4],
    /// Sums for the other layers; none where there are none, or nothing was seen.
    pub(super) sums: Option<Box<Sums>>,
    /// Samples evaluated.
    pub(super) samples: u64,
}

/// The most values that are computed at once.
const MOST_AT_ONCE: usize = 8;

/// A sample: its number on the ray, its place, its value.
#[derive(Clone, Copy)]
struct Sample<R> {
    k: i64,
    at: Place<R>,
    s: R,
}

/// The last sample on a ray that was asked for a normal.
#[derive(Clone, Copy)]
pub(super) enum Previous<R> {
    /// There was none.
    None,
    /// The sample has no normal ([PREC-3]).
    WithoutNormal(i64),
    /// The sample and its normal.
    Normal(i64, Vec3<R>),
}

/// The state of a ray on its way.
pub(super) struct Walk<'p, 'v, R: Real, S> {
    pub(super) prepared: &'p Prepared<'v, R>,
    pub(super) sampler: &'p S,
    pub(super) ray: IndexRay<R>,
    pub(super) sight: Sight<R>,
    /// To the opacity of one step on this ray.
    correction: Correction,
    pub(super) previous: Previous<R>,
    light: Light<R>,
    pub(super) sums: Sums,
}

/// What has come together on a ray. The loop over samples holds it in registers.
#[derive(Clone, Copy)]
struct Light<R> {
    rgb: [R; 3],
    /// A.
    opacity: R,
    /// The last opacity that was corrected, and what it became: levels of a function repeat along a ray.
    corrected: [R; 2],
}

/// Casts the rays through points of the picture one by one, and appends what comes out of each.
pub(super) fn cast_all<R: Real, S: Sampler<R>>(
    prepared: &Prepared<'_, R>,
    sampler: &S,
    points: &[[f64; 2]],
    mut boxes: Option<&mut Boxes>,
    counts: &mut Counts,
    casts: &mut Vec<Cast>,
) {
    casts.extend(points.iter().map(|&point| cast(prepared, sampler, point, boxes.as_deref_mut(), counts)));
}

/// Casts the ray through a point of the picture, in pixels from the top left corner.
fn cast<R: Real, S: Sampler<R>>(
    prepared: &Prepared<'_, R>,
    sampler: &S,
    [i, j]: [f64; 2],
    boxes: Option<&mut Boxes>,
    counts: &mut Counts,
) -> Cast {
    let view = &prepared.view;
    let pixel = view.ray(i, j);
    let ray = IndexRay::<R>::new(&pixel, view, &prepared.lattice, prepared.volume.grid());
    let mut walk = Walk {
        prepared,
        sampler,
        sight: prepared.look.sight(Vec3::from_glam(view.direction_to_world(pixel.v)), Vec3::from_glam(pixel.v)),
        correction: Correction::new(ray.step / prepared.reference_length),
        ray,
        previous: Previous::None,
        light: Light { rgb: [R::ZERO; 3], opacity: R::ZERO, corrected: [R::ZERO; 2] },
        sums: Sums::new(),
    };
    let lines = prepared.lines_at([i, j]);
    let samples = match (&prepared.surface, prepared.needs) {
        (Some(surface), _) => walk.run_to(surface, lines, boxes, counts),
        _ if !lines.is_empty() => walk.run_among(lines, None, boxes, counts).0,
        (None, Needs::Value) => walk.run_in::<need::Value>(boxes, counts),
        (None, Needs::Normal) => walk.run_in::<need::Normal>(boxes, counts),
        (None, Needs::Anything) => walk.run_in::<need::Anything>(boxes, counts),
    };
    counts.rays += 1;
    counts.rays_skipped += u64::from(samples == 0);
    counts.samples += samples;
    let [r, g, b] = walk.light.rgb.map(Real::to_f64);
    let sums = (!walk.sums.is_empty()).then(|| Box::new(walk.sums));
    Cast { rgba: [r, g, b, walk.light.opacity.to_f64()], sums, samples }
}

impl<R: Real, S: Sampler<R>> Walk<'_, '_, R, S> {
    /// Visits the samples of a ray. Returns how many were evaluated.
    fn run_in<N: Need>(&mut self, boxes: Option<&mut Boxes>, counts: &mut Counts) -> u64 {
        let mut samples = 0;
        for visit in self.ray.visits(self.prepared.ends, self.ray.intervals(boxes)) {
            let (n, open) = self.run::<N>(visit, counts);
            samples += n;
            if !open {
                break;
            }
        }
        samples
    }

    /// Takes another correction for the samples that follow.
    pub(super) fn correct_for(&mut self, correction: Correction) {
        self.correction = correction;
        self.light.corrected = [R::ZERO; 2];
    }

    /// Composites something of a linear colour that is no sample, and returns whether the ray is still open.
    pub(super) fn put(&mut self, rgb: [R; 3], alpha: R) -> bool {
        if alpha >= R::ONE {
            self.end_at(rgb);
            return false;
        }
        let rgb = if self.prepared.encode { rgb.map(encoded) } else { rgb };
        let Light { rgb: before, opacity, .. } = self.light;
        let w = (R::ONE - opacity) * alpha;
        self.light.rgb = [before[0] + w * rgb[0], before[1] + w * rgb[1], before[2] + w * rgb[2]];
        self.light.opacity += w;
        self.light.opacity < self.prepared.stop_at
    }

    /// Ends the ray at something opaque of a linear colour, and returns its w = 1 − A.
    pub(super) fn end_at(&mut self, rgb: [R; 3]) -> R {
        let rgb = if self.prepared.encode { rgb.map(encoded) } else { rgb };
        let Light { rgb: before, opacity, .. } = self.light;
        let w = R::ONE - opacity;
        self.light.rgb = [before[0] + w * rgb[0], before[1] + w * rgb[1], before[2] + w * rgb[2]];
        self.light.opacity = R::ONE;
        w
    }

    /// Visits the samples first..=last. Returns how many were evaluated and whether the ray is still open.
    #[inline(never)]
    pub(super) fn run<N: Need>(&mut self, visit: [i64; 2], counts: &mut Counts) -> (u64, bool) {
        if S::AT_ONCE > 1 { self.run_ahead::<N>(visit, counts) } else { self.run_by_cells::<N>(visit, counts) }
    }

    /// Values are computed a few samples ahead. Where a ray ends early those left over count for nothing.
    #[inline(always)]
    fn run_ahead<N: Need>(&mut self, [first, last]: [i64; 2], counts: &mut Counts) -> (u64, bool) {
        let prepared = self.prepared;
        let mut samples = 0;
        let mut light = self.light;
        let mut values = [R::ZERO; MOST_AT_ONCE];
        let mut k = first;
        while k <= last {
            let n = (last - k + 1).min(S::AT_ONCE as i64) as usize;
            let values = &mut values[..n.min(MOST_AT_ONCE)];
            self.sampler.values(|i| self.ray.position(k + i as i64), values);
            for (k, &s) in (k..).zip(&*values) {
                let at = || self.sampler.place(self.ray.position(k));
                if prepared.volume.mask().is_some() && self.is_masked(at(), counts) {
                    continue;
                }
                samples += 1;
                if let Some(place) = prepared.function.locate(s) {
                    self.show::<N>(Sample { k, at: at(), s }, &place, &mut light, counts);
                    if light.opacity >= prepared.stop_at {
                        self.light = light;
                        return (samples, false);
                    }
                }
            }
            k += values.len() as i64;
        }
        self.light = light;
        (samples, true)
    }

    /// Values are computed only in cells that can show something.
    #[inline(always)]
    fn run_by_cells<N: Need>(&mut self, [first, last]: [i64; 2], counts: &mut Counts) -> (u64, bool) {
        let prepared = self.prepared;
        let mut samples = 0;
        let mut light = self.light;
        for k in first..=last {
            let at = self.sampler.place(self.ray.position(k));
            let can_show = |cells: &Cells<'_>| cells.can_show(&prepared.field, at.cell);
            if !prepared.cells.as_ref().is_none_or(can_show) || self.is_masked(at, counts) {
                continue;
            }
            samples += 1;
            let s = self.sampler.value_at(at);
            if let Some(place) = prepared.function.locate(s) {
                self.show::<N>(Sample { k, at, s }, &place, &mut light, counts);
                if light.opacity >= prepared.stop_at {
                    self.light = light;
                    return (samples, false);
                }
            }
        }
        self.light = light;
        (samples, true)
    }

    /// Whether a voxel of a sample's cell is masked, which is counted.
    #[inline(always)]
    fn is_masked(&self, at: Place<R>, counts: &mut Counts) -> bool {
        let is_masked = self.prepared.volume.mask().is_some_and(|mask| mask.touches_cell(at.cell));
        counts.masked += u64::from(is_masked);
        is_masked
    }

    /// Shows a sample whose value can be seen.
    #[inline(always)]
    fn show<N: Need>(
        &mut self,
        sample: Sample<R>,
        place: &transfer::Place<R>,
        light: &mut Light<R>,
        counts: &mut Counts,
    ) {
        let prepared = self.prepared;
        if let (true, Some(over_two)) = (N::MORE, &prepared.over_two) {
            return self.show_over_two(over_two, sample, light, counts);
        }
        let calls = N::calls(prepared);
        let facts = self.learn(sample, calls, Facts::none(), counts);
        counts.without_normal += u64::from(calls.gradient && facts.normal.is_none());
        let color = match &prepared.table {
            Some(table) if N::MORE => prepared.look.color(table.between_nodes(place), facts, &self.sight, counts),
            _ => prepared.look.color(*place, facts, &self.sight, counts),
        };
        self.composite::<N>(sample, color, facts, light, counts);
    }

    /// The same where the function is over two quantities: what they need is asked first, and the rest only where α_u > 0.
    #[inline(never)]
    fn show_over_two(
        &mut self,
        over_two: &OverTwo<'_, R>,
        sample: Sample<R>,
        light: &mut Light<R>,
        counts: &mut Counts,
    ) {
        let prepared = self.prepared;
        let facts = self.learn(sample, over_two.first, Facts::none(), counts);
        let of_normal = |x: R| if facts.normal.is_some() { x } else { R::ZERO };
        let here = Here {
            position: self.ray.position(sample.k),
            place: sample.at,
            value: sample.s,
            gradient: of_normal(facts.gradient.length()),
            magnitude: of_normal(facts.magnitude),
            principal: facts.principal,
            kappa: facts.kappa,
        };
        let Some(patch) = over_two.locate(&here) else { return };
        let facts = self.learn(sample, over_two.rest, facts, counts);
        counts.without_normal += u64::from(prepared.calls.gradient && facts.normal.is_none());
        let color = prepared.look.color(patch, facts, &self.sight, counts);
        self.composite::<need::Anything>(sample, color, facts, light, counts);
    }

    /// Composites a sample: C ← C + (1 − A)·c·α(Δ), A ← A + (1 − A)·α(Δ).
    #[inline(always)]
    fn composite<N: Need>(
        &mut self,
        sample: Sample<R>,
        (rgb, alpha): ([R; 3], R),
        facts: Facts<R>,
        light: &mut Light<R>,
        counts: &mut Counts,
    ) {
        let prepared = self.prepared;
        if alpha != light.corrected[0] {
            light.corrected = [alpha, self.correction.apply(alpha)];
        }
        let w = (R::ONE - light.opacity) * light.corrected[1];
        let rgb = if N::MORE && prepared.encode { rgb.map(encoded) } else { rgb };
        light.rgb = [light.rgb[0] + w * rgb[0], light.rgb[1] + w * rgb[1], light.rgb[2] + w * rgb[2]];
        light.opacity += w;
        if N::MORE && prepared.collects && alpha > R::ZERO {
            self.collect(sample, [w, light.opacity], facts, counts);
        }
    }

    /// Adds what is called for to what is known of a sample beyond its value.
    ///
    /// Facts go in and out as values, so that those of a scene that needs few of them stay in registers.
    #[inline(always)]
    fn learn(&mut self, sample: Sample<R>, calls: Calls, facts: Facts<R>, counts: &mut Counts) -> Facts<R> {
        let Sample { k, at, .. } = sample;
        let prepared = self.prepared;
        let mut facts = facts;
        let together = calls.gradient && calls.hessian && self.sampler.has_one_gradient();
        let second = if together { Some(self.sampler.hessian_at(at)) } else { None };
        if calls.gradient {
            let g = second.map_or_else(|| self.sampler.gradient_at(at), |(g, _)| g);
            counts.gradients += 1;
            facts.gradient = g;
            facts.depth = self.ray.depth(k);
            if let Some((lo, width)) = prepared.gradient_range {
                facts.magnitude = if width > R::ZERO { ((g.length() - lo) / width).clamp_01() } else { R::ZERO };
            }
            facts.normal = self.normal(g);
        }
        if let Some(n) = facts.normal {
            if calls.hessian {
                let second = second.unwrap_or_else(|| self.sampler.hessian_at(at));
                (facts.kappa, facts.principal) = self.curvatures(second, calls, (facts.kappa, facts.principal), counts);
            }
            if calls.kappa == KappaSource::AlongRay {
                facts.kappa = self.kappa_along_ray(k, n, counts);
            }
        }
        if calls.kappa == KappaSource::AlongRay {
            self.previous = facts.normal.map_or(Previous::WithoutNormal(k), |n| Previous::Normal(k, n));
        }
        facts
    }

    /// The normal that shades ([NORM-1]): the outward one, or as the scene turns it.
    #[inline]
    pub(super) fn normal(&self, g: Vec3<R>) -> Option<Vec3<R>> {
        self.prepared.outward(g).map(|n| self.prepared.side.turn(n, self.sight.v))
    }

    /// κ_v from the normal of the sample before on this ray ([STF-5]); 0 where there is none.
    fn kappa_along_ray(&mut self, k: i64, n: Vec3<R>, counts: &mut Counts) -> R {
        let prepared = self.prepared;
        let before = match self.previous {
            Previous::Normal(at, normal) if at == k - 1 => Some(normal),
            Previous::WithoutNormal(at) if at == k - 1 => None,
            _ if self.ray.has(k - 1, prepared.ends) => {
                let g = self.sampler.gradient(self.ray.position(k - 1));
                counts.gradients += 1;
                self.normal(g)
            }
            _ => None,
        };
        let (known, before) = (before.is_some(), before.unwrap_or(n));
        curvature_along_ray::kappa(prepared.turn, n, before, known, R::from_f64(self.ray.step))
    }

    /// What needs the Hessian: κ_v ([CUR-2]), κ₁ and κ₂ ([CUR-1]); `known`, as it is, where H's own field has no normal.
    #[inline(always)]
    pub(super) fn curvatures(
        &self,
        (g, h): (Vec3<R>, Sym3<R>),
        calls: Calls,
        known: (R, [R; 2]),
        counts: &mut Counts,
    ) -> (R, [R; 2]) {
        let prepared = self.prepared;
        counts.hessians += 1;
        let (mut kappa, mut principal) = known;
        if g.length() > prepared.no_normal_below {
            if calls.kappa == KappaSource::Exact {
                kappa = curvature::along_view(g, h, self.sight.v, prepared.outside);
            }
            if calls.principal {
                let c = curvature::principal(g, h, prepared.outside);
                principal = [c.k1, c.k2];
            }
        }
        (kappa, principal)
    }

    /// Adds a sample with α > 0 to the layers, by its w and the A after it.
    #[inline(never)]
    fn collect(&mut self, sample: Sample<R>, [w, opacity]: [R; 2], facts: Facts<R>, counts: &mut Counts) {
        let prepared = self.prepared;
        let mut facts = facts;
        if let (Some(first), true) = (prepared.first, self.sums.is_empty()) {
            facts = self.learn(sample, first, facts, counts);
            counts.without_normal += u64::from(first.gradient && facts.normal.is_none());
        }
        let seen = Seen {
            weight: w.to_f64(),
            depth: self.ray.depth(sample.k).to_f64(),
            value: sample.s.to_f64(),
            normal: prepared.eye_axes.normal(&facts, &self.sight).to_glam().to_array(),
            gradient: facts.gradient.to_glam().to_array(),
            curvature: [facts.principal[0], facts.principal[1], facts.kappa].map(Real::to_f64),
        };
        self.sums.add(&seen, opacity.to_f64());
    }
}

/// One linear channel encoded for `blend_space = "srgb"`.
fn encoded<R: Real>(c: R) -> R {
    R::from_f64(color::linear_to_srgb(c.to_f64()))
}
