//! One ray, front to back ([VAL-3], [VAL-4], [RAY-1], [RAY-2]).

use super::lattice::IndexRay;
use super::layers::{Seen, Sums};
use super::opacity::Correction;
use super::over_two::OverTwo;
use super::prepared::{Calls, KappaSource, Prepared};
use super::sample::{Facts, Sight};
use super::skip::{Boxes, Skip};
use crate::field::{Place, Sampler, curvature};
use crate::number::{Real, Vec3};
use crate::style_transfer_functions::curvature_along_ray;
use crate::transfer;
use crate::transfer::over::Here;
use drypoint_scene::color;
use drypoint_scene::counts::Counts;

/// What comes out of one ray.
pub(super) struct Cast {
    /// Premultiplied colour and opacity in the blend space, without the background.
    pub(super) rgba: [f64; 4],
    /// Sums for the other layers.
    pub(super) sums: Sums,
    /// Samples evaluated.
    pub(super) samples: u64,
}

/// The state of a ray on its way.
struct Walk<'p, 'v, R: Real, S> {
    prepared: &'p Prepared<'v, R>,
    sampler: &'p S,
    ray: IndexRay<R>,
    sight: Sight<R>,
    /// To the opacity of one step on this ray.
    correction: Correction<R>,
    /// The last sample whose normal is known, and that normal.
    previous: Option<(i64, Option<Vec3<R>>)>,
    /// The last opacity that was corrected, and what it became: levels of a function repeat along a ray.
    corrected: [R; 2],
    rgb: [R; 3],
    opacity: R,
    sums: Sums,
}

/// Casts the ray through a point of the picture, in pixels from the top left corner.
pub(super) fn cast<R: Real, S: Sampler<R>>(
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
        previous: None,
        corrected: [R::ZERO; 2],
        rgb: [R::ZERO; 3],
        opacity: R::ZERO,
        sums: Sums::new(),
    };
    let inside = ray.inside(prepared.ends);
    let mut samples = 0;
    if inside[0] <= inside[1] {
        samples = match (&prepared.skip, boxes) {
            (Some(skip), Some(boxes)) => walk.run_in(inside, skip, boxes, counts),
            _ => walk.run(inside, |_| true, counts).0,
        };
    }
    counts.rays += 1;
    counts.rays_skipped += u64::from(samples == 0);
    counts.samples += samples;
    let [r, g, b] = walk.rgb.map(Real::to_f64);
    Cast { rgba: [r, g, b, walk.opacity.to_f64()], sums: walk.sums, samples }
}

impl<R: Real, S: Sampler<R>> Walk<'_, '_, R, S> {
    /// Visits the samples of a range that lie in visible bricks. Returns how many were evaluated.
    #[inline]
    fn run_in(&mut self, inside: [i64; 2], skip: &Skip, boxes: &mut Boxes, counts: &mut Counts) -> u64 {
        let (mut samples, mut next) = (0, inside[0]);
        for &[near, far] in boxes.intervals(self.ray.line(), R::EPSILON.to_f64()) {
            let first = self.ray.first_at_or_after(near).max(next);
            let last = self.ray.last_at_or_before(far).min(inside[1]);
            let (n, open) = self.run([first, last], |cell| skip.sees(cell), counts);
            samples += n;
            next = next.max(last + 1);
            if !open {
                break;
            }
        }
        samples
    }

    /// Visits the samples first..=last whose cell passes the test. Returns how many were evaluated and whether the ray
    /// is still open.
    #[inline]
    fn run(&mut self, [first, last]: [i64; 2], sees: impl Fn([usize; 3]) -> bool, counts: &mut Counts) -> (u64, bool) {
        let prepared = self.prepared;
        let mask = prepared.volume.mask();
        let mut samples = 0;
        for k in first..=last {
            let at = self.sampler.place(self.ray.position(k));
            if !sees(at.cell) {
                continue;
            }
            if let Some(mask) = mask
                && mask.touches_cell(at.cell)
            {
                counts.masked += 1;
                continue;
            }
            samples += 1;
            let s = self.sampler.value_at(at);
            if let Some(place) = prepared.function.locate(s) {
                self.show(k, at, s, &place, counts);
                if self.opacity >= prepared.stop_at {
                    return (samples, false);
                }
            }
        }
        (samples, true)
    }

    /// Shows a sample whose value can be seen.
    fn show(&mut self, k: i64, at: Place<R>, s: R, place: &transfer::Place<R>, counts: &mut Counts) {
        let prepared = self.prepared;
        if let Some(over_two) = &prepared.over_two {
            return self.show_over_two(over_two, k, at, s, counts);
        }
        let mut facts = Facts::none();
        self.learn(k, at, prepared.calls, &mut facts, counts);
        counts.without_normal += u64::from(prepared.calls.gradient && facts.normal.is_none());
        let (rgb, alpha) = match &prepared.table {
            None => prepared.look.color(place, &facts, &self.sight, counts),
            Some(table) => prepared.look.color(&table.between_nodes(place), &facts, &self.sight, counts),
        };
        self.composite(k, at, s, (rgb, alpha), &mut facts, counts);
    }

    /// The same where the function is over two quantities: what they need is asked first, and the rest only where α_u > 0.
    fn show_over_two(&mut self, over_two: &OverTwo<'_, R>, k: i64, at: Place<R>, s: R, counts: &mut Counts) {
        let prepared = self.prepared;
        let mut facts = Facts::none();
        self.learn(k, at, over_two.first, &mut facts, counts);
        let of_normal = |x: R| if facts.normal.is_some() { x } else { R::ZERO };
        let here = Here {
            position: self.ray.position(k),
            place: at,
            value: s,
            gradient: of_normal(facts.gradient.length()),
            magnitude: of_normal(facts.magnitude),
            principal: facts.principal,
            kappa: facts.kappa,
        };
        let Some(patch) = over_two.locate(&here) else { return };
        self.learn(k, at, over_two.rest, &mut facts, counts);
        counts.without_normal += u64::from(prepared.calls.gradient && facts.normal.is_none());
        let (rgb, alpha) = prepared.look.color(&patch, &facts, &self.sight, counts);
        self.composite(k, at, s, (rgb, alpha), &mut facts, counts);
    }

    /// Composites a sample: C ← C + (1 − A)·c·α(Δ), A ← A + (1 − A)·α(Δ).
    #[inline(always)]
    fn composite(
        &mut self,
        k: i64,
        at: Place<R>,
        s: R,
        (rgb, alpha): ([R; 3], R),
        facts: &mut Facts<R>,
        counts: &mut Counts,
    ) {
        let prepared = self.prepared;
        if alpha != self.corrected[0] {
            self.corrected = [alpha, self.correction.apply(alpha)];
        }
        let w = (R::ONE - self.opacity) * self.corrected[1];
        let rgb = if prepared.encode { rgb.map(encoded) } else { rgb };
        self.rgb = [self.rgb[0] + w * rgb[0], self.rgb[1] + w * rgb[1], self.rgb[2] + w * rgb[2]];
        self.opacity += w;
        if prepared.collects && alpha > R::ZERO {
            if let (Some(first), true) = (prepared.first, self.sums.is_empty()) {
                self.learn(k, at, first, facts, counts);
                counts.without_normal += u64::from(first.gradient && facts.normal.is_none());
            }
            self.collect(k, s, w, facts);
        }
    }

    /// Adds what is called for to what is known of a sample beyond its value.
    #[inline(always)]
    fn learn(&mut self, k: i64, at: Place<R>, calls: Calls, facts: &mut Facts<R>, counts: &mut Counts) {
        let prepared = self.prepared;
        if calls.gradient {
            let g = self.sampler.gradient_at(at);
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
                self.curvatures(at, calls, facts, counts);
            }
            if calls.kappa == KappaSource::AlongRay {
                facts.kappa = self.kappa_along_ray(k, n, counts);
            }
        }
        if calls.kappa == KappaSource::AlongRay {
            self.previous = Some((k, facts.normal));
        }
    }

    /// The normal that shades ([NORM-1]): the outward one, or as the scene turns it.
    #[inline]
    fn normal(&self, g: Vec3<R>) -> Option<Vec3<R>> {
        self.prepared.outward(g).map(|n| self.prepared.side.turn(n, self.sight.v))
    }

    /// κ_v from the normal of the sample before on this ray ([STF-5]); 0 where there is none.
    fn kappa_along_ray(&mut self, k: i64, n: Vec3<R>, counts: &mut Counts) -> R {
        let prepared = self.prepared;
        let before = match self.previous {
            Some((at, normal)) if at == k - 1 => normal,
            _ if self.ray.has(k - 1, prepared.ends) => {
                let g = self.sampler.gradient(self.ray.position(k - 1));
                counts.gradients += 1;
                self.normal(g)
            }
            _ => None,
        };
        curvature_along_ray::kappa(prepared.turn, n, before, R::from_f64(self.ray.step))
    }

    /// What needs the Hessian: κ_v ([CUR-2]), κ₁ and κ₂ ([CUR-1]); 0 where H's own field has no normal.
    fn curvatures(&self, at: Place<R>, calls: Calls, facts: &mut Facts<R>, counts: &mut Counts) {
        let prepared = self.prepared;
        counts.hessians += 1;
        let (g, h) = self.sampler.hessian_at(at);
        if g.length() <= prepared.no_normal_below {
            return;
        }
        if calls.kappa == KappaSource::Exact {
            facts.kappa = curvature::along_view(g, h, self.sight.v, prepared.outside);
        }
        if calls.principal {
            let c = curvature::principal(g, h, prepared.outside);
            facts.principal = [c.k1, c.k2];
        }
    }

    /// Adds a sample with α > 0 to the layers.
    fn collect(&mut self, k: i64, s: R, w: R, facts: &Facts<R>) {
        let prepared = self.prepared;
        let seen = Seen {
            weight: w.to_f64(),
            depth: self.ray.depth(k).to_f64(),
            value: s.to_f64(),
            normal: prepared.eye_axes.normal(facts, &self.sight).to_glam().to_array(),
            gradient: facts.gradient.to_glam().to_array(),
            curvature: [facts.principal[0], facts.principal[1], facts.kappa].map(Real::to_f64),
        };
        self.sums.add(&seen, self.opacity.to_f64());
    }
}

/// One linear channel encoded for `blend_space = "srgb"`.
fn encoded<R: Real>(c: R) -> R {
    R::from_f64(color::linear_to_srgb(c.to_f64()))
}
