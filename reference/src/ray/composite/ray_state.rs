//! The state of a ray, advanced sample by sample, front to back ([VAL-3], [VAL-4], [RAY-2]).

use super::cast::Cast;
use super::layers::{LayerSample, Sums};
use super::object_ray::{Largest, ObjectRay, Together};
use super::path::Step;
use crate::accumulator::Accumulator;
use crate::field::{CellPosition, Sampler};
use crate::mesh::MeshHit;
use crate::number::{Real, Vec3};
use crate::ray::cell_mask::CellMask;
use crate::ray::lattice::IndexRay;
use crate::ray::opacity::Correction;
use crate::ray::prepared::Prepared;
use crate::ray::sample::need::{self, Need};
use crate::ray::sample::{Evaluator, OverTwo, Previous, Sample, SampleAttributes};
use crate::surface::SurfaceHit;
use crate::transfer;
use crate::volumetric_halos::Tint;
use drypoint_scene::color;
use drypoint_scene::counts::Counts;
use drypoint_scene::fragments::Fragment;

/// The fractions of objects where only the background shows.
const OF_BACKGROUND: &[f64] = &[1.0];

/// The largest number of values that are computed at once.
const MOST_AT_ONCE: usize = 8;

/// The state of a ray.
pub(crate) struct RayState<'p, 'v, R: Real, S> {
    pub(crate) prepared: &'p Prepared<'v, R>,
    pub(crate) evaluator: Evaluator<'p, 'v, R, S>,
    /// Converts an opacity per reference length to that of one step on this ray.
    correction: Correction,
    /// The sample before the one whose shares are visited.
    before_shares: Previous<R>,
    pub(crate) front: Front<R>,
    /// A of the samples alone, without lines and glows. Layers use it.
    of_samples: R,
    /// A of the lines alone. Lines belong to no object, and hide what is behind them.
    of_lines: R,
    /// Sums for the layers; none before the first sample with an opacity.
    sums: Option<Box<Sums>>,
    /// Samples evaluated.
    pub(crate) samples: u64,
    /// The objects on the ray; none if there is only the background.
    pub(super) objects: Option<Box<ObjectRay<'p, 'v, R>>>,
}

/// Colour and opacity in front on a ray. The loop over samples holds them in registers.
#[derive(Clone, Copy)]
pub(crate) struct Front<R> {
    pub(crate) accumulator: Accumulator<R>,
    /// The last opacity before and after its correction. Opacities of a function repeat along a ray.
    corrected: [R; 2],
}

impl<'p, 'v, R: Real, S: Sampler<R>> RayState<'p, 'v, R, S> {
    /// The ray through a point of the picture, in pixels from the top left corner.
    #[inline(always)]
    pub(crate) fn new(prepared: &'p Prepared<'v, R>, sampler: &'p S, [i, j]: [f64; 2]) -> Self {
        let (view, object) = (&prepared.view, &prepared.object);
        let pixel = view.ray(i, j);
        let ray = IndexRay::<R>::new(&pixel, view, &prepared.lattice, object.volume.grid());
        let (v, v_eye) = (Vec3::from_glam(view.direction_to_world(pixel.v)), Vec3::from_glam(pixel.v));
        Self {
            prepared,
            correction: Correction::new(ray.step / object.reference_length),
            evaluator: Evaluator::new(object, sampler, ray, object.shader.view_dirs(v, v_eye), &prepared.eye_axes),
            before_shares: Previous::None,
            front: Front { accumulator: Accumulator::empty(R::ZERO), corrected: [R::ZERO; 2] },
            of_samples: R::ZERO,
            of_lines: R::ZERO,
            sums: None,
            samples: 0,
            objects: None,
        }
    }

    /// Ends the ray and returns its result.
    pub(crate) fn finish(self, counts: &mut Counts) -> Cast {
        counts.rays += 1;
        counts.rays_skipped += u64::from(self.samples == 0);
        counts.samples += self.samples;
        let Accumulator { rgb: [r, g, b], opacity } = self.front.accumulator;
        Cast {
            rgba: [r, g, b, opacity].map(Real::to_f64),
            sums: self.sums,
            samples: self.samples,
            intensities: Box::default(),
        }
    }

    /// Takes a step of the path. Returns whether the ray is still open.
    #[inline(always)]
    pub(crate) fn take<N: Need>(&mut self, step: &Step<'_>, tint: Option<&Tint>, counts: &mut Counts) -> bool {
        match *step {
            Step::Samples(range) => self.run::<N>(range, tint, counts),
            Step::Share { k, steps, again } => self.run_share::<N>((k, steps, again), tint, counts),
            Step::Line { line, .. } => self.meet_line(line, tint),
            Step::Surface { hit, .. } => {
                self.meet_surface(hit, tint, counts);
                false
            }
            Step::Mesh { hit, .. } => {
                self.meet_mesh(&hit, tint);
                false
            }
        }
    }

    /// Visits a share of a sample, `steps` steps long.
    #[inline(never)]
    fn run_share<N: Need>(
        &mut self,
        (k, steps, again): (i64, f64, bool),
        tint: Option<&Tint>,
        counts: &mut Counts,
    ) -> bool {
        // All shares of a sample have the same predecessor.
        match again {
            true => self.evaluator.previous = self.before_shares,
            false => self.before_shares = self.evaluator.previous,
        }
        let whole = self.correction;
        self.correct_by(Correction::new(steps * self.evaluator.ray.step / self.prepared.object.reference_length));
        let open = self.run::<N>([k, k], tint, counts);
        self.correct_by(whole);
        open
    }

    /// Sets the correction for the following samples.
    fn correct_by(&mut self, correction: Correction) {
        self.correction = correction;
        self.front.corrected = [R::ZERO; 2];
    }

    /// Composites a line behind the front. Returns whether the ray is still open.
    fn meet_line(&mut self, line: &Fragment, tint: Option<&Tint>) -> bool {
        let rgb = tinted(self.in_blend_space(line.rgb.map(R::from_f64)), tint);
        let alpha = R::from_f64(line.opacity);
        if alpha >= R::ONE {
            self.front.accumulator.end(rgb);
            return false;
        }
        self.front.accumulator.over(rgb, alpha);
        self.of_lines = self.of_lines.laid_before(alpha).1;
        self.is_open()
    }

    /// Composites the glow of a plane, premultiplied in the blend space, behind the front.
    pub(crate) fn lay_glow(&mut self, glow: [f64; 4]) {
        self.front.accumulator.over_premultiplied(glow.map(R::from_f64));
    }

    /// Converts an opacity per reference length to that of one step on this ray ([VAL-4]).
    pub(crate) fn corrected(&self, alpha: f64) -> f64 {
        self.correction.apply(alpha)
    }

    /// A.
    pub(crate) fn opacity(&self) -> R {
        self.front.accumulator.opacity
    }

    /// Whether something behind the front could still be seen.
    pub(crate) fn is_open(&self) -> bool {
        self.opacity() < self.prepared.stop_at
    }

    /// Composites the iso-surface, of opacity 1, at its own depth or on a cut.
    #[inline(never)]
    fn meet_surface(&mut self, hit: SurfaceHit, tint: Option<&Tint>, counts: &mut Counts) {
        let prepared = self.prepared;
        let Some(surface) = &prepared.surface else { return };
        let query = if self.sums.is_none() { surface.query.and(surface.first) } else { surface.query };
        let mut attributes = self.evaluator.evaluate_at_depth(hit.t, query, prepared.view.perspective, counts);
        counts.without_normal += u64::from(query.gradient && attributes.normal.is_none());
        let cut = hit.cut.map(|plane| prepared.object.clip.face(plane, &self.evaluator.dirs, &prepared.eye_axes));
        if let Some(cut) = &cut {
            attributes = cut.attributes(attributes);
        }
        let v = self.evaluator.dirs.v;
        let rgb = surface.lit.color(surface.rgb, attributes.normal, [v, surface.lit.half_vector(v)]);
        let rgb = cut.map_or(rgb, |cut| cut.over(rgb));
        let rgb = tinted(self.in_blend_space(rgb), tint);
        self.front.accumulator.end(rgb);
        if prepared.collects {
            self.add_to_layers(R::ONE, hit.t, surface.roots.iso(), &attributes, OF_BACKGROUND);
        }
    }

    /// Composites a mesh, of opacity 1, at its own depth. A mesh has no value, gradient or curvature; layers show 0 for
    /// these. It belongs to no object.
    #[inline(never)]
    fn meet_mesh(&mut self, hit: &MeshHit, tint: Option<&Tint>) {
        let prepared = self.prepared;
        let Some(meshes) = &prepared.meshes else { return };
        let (normal, rgb) = meshes.seen(hit, self.evaluator.dirs.v);
        self.front.accumulator.end(tinted(self.in_blend_space(rgb), tint));
        if prepared.collects {
            let attributes = SampleAttributes { normal, ..SampleAttributes::neutral() };
            self.add_to_layers(R::ONE, hit.t, 0.0, &attributes, &[]);
        }
    }

    /// Converts a linear colour to the blend space ([VAL-3]).
    #[inline(always)]
    fn in_blend_space(&self, rgb: [R; 3]) -> [R; 3] {
        if self.prepared.encode { rgb.map(|c| R::monotone([c], |[c]| color::linear_to_srgb(c))) } else { rgb }
    }

    /// Visits the samples first..=last. Returns whether the ray is still open.
    #[inline(never)]
    fn run<N: Need>(&mut self, visit: [i64; 2], tint: Option<&Tint>, counts: &mut Counts) -> bool {
        match self.objects.take() {
            None => self.run_background::<N>(visit, tint, counts),
            Some(mut objects) => {
                let open = self.run_with::<N>(&mut objects, visit, tint, counts);
                self.objects = Some(objects);
                open
            }
        }
    }

    /// Visits samples among objects. Runs of the background alone are visited as in a picture without objects, other
    /// samples one by one.
    #[inline(never)]
    fn run_with<N: Need>(
        &mut self,
        objects: &mut ObjectRay<'p, 'v, R>,
        [mut next, last]: [i64; 2],
        tint: Option<&Tint>,
        counts: &mut Counts,
    ) -> bool {
        while next <= last {
            let ([first, end], is_mixed) = objects.run_from([next, last]);
            if is_mixed {
                for k in first..=end {
                    let before = counts.samples;
                    let together = objects.together(k, self.prepared, counts);
                    self.samples += std::mem::replace(&mut counts.samples, before) - before;
                    let Some(together) = together else { continue };
                    self.composite_together(objects, &together, tint, counts);
                    if !self.is_open() {
                        return false;
                    }
                }
            } else {
                for range in objects.background_in([first, end]) {
                    if !self.run_background::<N>(range, tint, counts) {
                        return false;
                    }
                }
            }
            next = end + 1;
        }
        true
    }

    /// The value and the normal of the set with the largest μ at sample k. Returns none without objects.
    pub(crate) fn seen_of_objects(&mut self, k: i64) -> Option<(f64, Option<Vec3<R>>)> {
        let objects = self.objects.as_mut()?;
        let Largest { sample, attributes, .. } = objects.together(k, self.prepared, &mut Counts::default())?.largest;
        Some((sample.s.to_f64(), attributes.normal))
    }

    /// Composites the combined sets of a sample.
    fn composite_together(
        &mut self,
        objects: &mut ObjectRay<'p, 'v, R>,
        together: &Together<R>,
        tint: Option<&Tint>,
        counts: &mut Counts,
    ) {
        let Together { rgb, alpha, largest } = together;
        let corrected = self.correction.apply(*alpha);
        self.front.accumulator.over(tinted(self.in_blend_space(*rgb), tint), corrected);
        if !self.prepared.collects || *alpha <= R::ZERO {
            return;
        }
        let exponent = self.prepared.object.field.scale_exponent();
        match objects.for_layers(largest, self.sums.is_none(), exponent, counts) {
            None => self.collect(largest.sample, corrected, largest.attributes, objects.fractions(), counts),
            Some((depth, attributes)) => {
                self.add_to_layers(corrected, depth, largest.sample.s.to_f64(), &attributes, objects.fractions());
            }
        }
    }

    /// Visits samples of the background, or of a picture without objects. Returns whether the ray is still open.
    #[inline(always)]
    fn run_background<N: Need>(&mut self, visit: [i64; 2], tint: Option<&Tint>, counts: &mut Counts) -> bool {
        if self.evaluator.sampler.at_once() > 1 {
            self.run_ahead::<N>(visit, tint, counts)
        } else {
            self.run_by_cells::<N>(visit, tint, counts)
        }
    }

    /// Visits samples, computing values a few samples ahead. Values beyond the end of a ray are not counted.
    #[inline(always)]
    fn run_ahead<N: Need>(&mut self, [first, last]: [i64; 2], tint: Option<&Tint>, counts: &mut Counts) -> bool {
        let (prepared, object) = (self.prepared, &self.prepared.object);
        let mut samples = 0;
        let mut front = self.front;
        let mut open = true;
        let mut values = [R::ZERO; MOST_AT_ONCE];
        let mut k = first;
        'samples: while k <= last {
            let n = (last - k + 1).min(self.evaluator.sampler.at_once() as i64) as usize;
            let values = &mut values[..n.min(MOST_AT_ONCE)];
            self.evaluator.sampler.values(|i| self.evaluator.position(k + i as i64), values);
            for (k, &s) in (k..).zip(&*values) {
                let at = || self.evaluator.sampler.place(self.evaluator.position(k));
                if object.volume.mask().is_some() && self.is_masked(at(), counts) {
                    continue;
                }
                samples += 1;
                if let Some(place) = object.function.locate(s) {
                    self.visit::<N>(Sample { k, at: at(), s }, &place, &mut front, tint, counts);
                    if front.accumulator.opacity >= prepared.stop_at {
                        open = false;
                        break 'samples;
                    }
                }
            }
            k += values.len() as i64;
        }
        (self.front, self.samples) = (front, self.samples + samples);
        open
    }

    /// Visits samples, computing values only in cells that can show something.
    #[inline(always)]
    fn run_by_cells<N: Need>(&mut self, [first, last]: [i64; 2], tint: Option<&Tint>, counts: &mut Counts) -> bool {
        let (prepared, object) = (self.prepared, &self.prepared.object);
        let mut samples = 0;
        let mut front = self.front;
        let mut open = true;
        for k in first..=last {
            let at = self.evaluator.sampler.place(self.evaluator.position(k));
            let can_show = |cells: &CellMask| cells.can_show(&object.field, at.cell);
            if !prepared.cells.as_ref().is_none_or(can_show) || self.is_masked(at, counts) {
                continue;
            }
            samples += 1;
            let s = self.evaluator.sampler.value_at(at);
            if let Some(place) = object.function.locate(s) {
                self.visit::<N>(Sample { k, at, s }, &place, &mut front, tint, counts);
                if front.accumulator.opacity >= prepared.stop_at {
                    open = false;
                    break;
                }
            }
        }
        (self.front, self.samples) = (front, self.samples + samples);
        open
    }

    /// Whether a voxel of a sample's cell is masked. Counts it if so.
    #[inline(always)]
    fn is_masked(&self, at: CellPosition<R>, counts: &mut Counts) -> bool {
        let is_masked = self.prepared.object.volume.mask().is_some_and(|mask| mask.touches_cell(at.cell));
        counts.masked += u64::from(is_masked);
        is_masked
    }

    /// Evaluates, shades and composites a sample whose value can be seen.
    #[inline(always)]
    fn visit<N: Need>(
        &mut self,
        sample: Sample<R>,
        place: &transfer::NodePlace<R>,
        front: &mut Front<R>,
        tint: Option<&Tint>,
        counts: &mut Counts,
    ) {
        let object = &self.prepared.object;
        if let (true, Some(over_two)) = (N::MORE, &object.over_two) {
            return self.visit_over_two(over_two, sample, front, tint, counts);
        }
        let (shaded, attributes) = self.evaluator.shaded::<N>(sample, place, counts);
        self.composite::<N>(sample, shaded, attributes, front, tint, counts);
    }

    /// Visits a sample of a function over two quantities. These quantities are evaluated first, the rest only if α_u >
    /// 0.
    #[inline(never)]
    fn visit_over_two(
        &mut self,
        over_two: &OverTwo<'_, R>,
        sample: Sample<R>,
        front: &mut Front<R>,
        tint: Option<&Tint>,
        counts: &mut Counts,
    ) {
        let Some((shaded, attributes)) = self.evaluator.shaded_over_two(over_two, sample, counts) else { return };
        self.composite::<need::Anything>(sample, shaded, attributes, front, tint, counts);
    }

    /// Composites a shaded sample, whose opacity is per reference length.
    #[inline(always)]
    fn composite<N: Need>(
        &mut self,
        sample: Sample<R>,
        (rgb, alpha): ([R; 3], R),
        attributes: SampleAttributes<R>,
        front: &mut Front<R>,
        tint: Option<&Tint>,
        counts: &mut Counts,
    ) {
        let prepared = self.prepared;
        if alpha != front.corrected[0] {
            front.corrected = [alpha, self.correction.apply(alpha)];
        }
        let rgb = if N::MORE { tinted(self.in_blend_space(rgb), tint) } else { rgb };
        front.accumulator.over(rgb, front.corrected[1]);
        if N::MORE && prepared.collects && alpha > R::ZERO {
            self.collect(sample, front.corrected[1], attributes, OF_BACKGROUND, counts);
        }
    }

    /// Adds a sample with α > 0 to the layers, by its α(Δ).
    #[inline(never)]
    fn collect(
        &mut self,
        sample: Sample<R>,
        alpha: R,
        attributes: SampleAttributes<R>,
        fractions: &[f64],
        counts: &mut Counts,
    ) {
        let mut attributes = attributes;
        if let (Some(first), true) = (self.prepared.object.first, self.sums.is_none()) {
            attributes = self.evaluator.evaluate(sample, first, attributes, counts);
            counts.without_normal += u64::from(first.gradient && attributes.normal.is_none());
        }
        if let Some(cut) = self.evaluator.cut_at(sample.k) {
            attributes = cut.attributes(attributes);
        }
        let depth = self.evaluator.depth(sample.k).to_f64();
        self.add_to_layers(alpha, depth, sample.s.to_f64(), &attributes, fractions);
    }

    /// Adds a value at a depth to the layers, weighted by its α(Δ). A is here the opacity of the samples alone
    /// ([IO-6]). `fractions` are those of the background and of the objects, whose coverage is what lines leave of it.
    fn add_to_layers(&mut self, alpha: R, depth: f64, value: f64, attributes: &SampleAttributes<R>, fractions: &[f64]) {
        let w = (R::ONE - self.of_samples) * alpha;
        self.of_samples = if alpha < R::ONE { self.of_samples + w } else { R::ONE };
        let sample = LayerSample {
            weight: w.to_f64(),
            depth,
            value,
            normal: self.prepared.eye_axes.normal(attributes, &self.evaluator.dirs).to_glam().to_array(),
            gradient: attributes.gradient.to_glam().to_array(),
            curvature: [attributes.principal[0], attributes.principal[1], attributes.kappa].map(Real::to_f64),
        };
        let through = 1.0 - self.of_lines.to_f64();
        let fractions = fractions.iter().take(self.prepared.covering).map(|fraction| through * fraction);
        self.sums.get_or_insert_with(|| Box::new(Sums::new())).add(&sample, self.of_samples.to_f64(), fractions);
    }
}

/// A colour in the blend space under a tint.
#[inline(always)]
fn tinted<R: Real>(rgb: [R; 3], tint: Option<&Tint>) -> [R; 3] {
    tint.map_or(rgb, |tint| tint.apply(rgb.map(Real::to_f64)).map(R::from_f64))
}
