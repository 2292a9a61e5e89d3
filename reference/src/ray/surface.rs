//! Where a ray ends at an opaque iso-surface ([HATCH-14]): what lies before it counts, what lies behind it does not.

use super::cast::Walk;
use super::layers::Seen;
use super::lit::Lit;
use super::need::{self, Need, Needs};
use super::opacity::Correction;
use super::prepared::{Calls, KappaSource};
use super::render::Inputs;
use super::sample::Facts;
use super::skip::Boxes;
use crate::field::{Field, Sampler};
use crate::number::{Real, Vec3};
use crate::style_transfer_functions::curvature_along_ray;
use crate::suggest;
use crate::surface::Roots;
use drypoint_scene::counts::Counts;
use drypoint_scene::fragments::Fragment;
use drypoint_scene::picture::LayerKind;
use drypoint_scene::plan::Quantity;
use drypoint_scene::tables::contours::{Measured, measured_curvature};
use drypoint_scene::tables::{Iso, Scene, SurfaceLook};
use drypoint_scene::view::View;
use drypoint_scene::volume::Bricks;

/// The iso-surface of a picture.
pub(super) struct Surface<R> {
    roots: Roots,
    /// Linear.
    rgb: [R; 3],
    lit: Lit<R>,
    /// What a place on it has to know.
    calls: Calls,
    /// What it has to know beyond that where nothing lies before it, for the layers `first.*`.
    first: Calls,
    /// Whether it is drawn alone, without the volume.
    alone: bool,
}

impl<R: Real> Surface<R> {
    /// The surface that a scene draws, if it draws one.
    pub(super) fn new(
        inputs: &Inputs<'_>,
        field: &Field<'_, R>,
        bricks: Option<&Bricks>,
        view: &View,
        counts: &mut Counts,
    ) -> Option<Self> {
        let scene = inputs.scene;
        let surface = scene.surface.as_ref().filter(|surface| surface.look != SurfaceLook::None)?;
        let iso = match surface.iso {
            Iso::Value(value) => value,
            Iso::Auto => suggest::iso(inputs.volume, &scene.volume, counts),
        };
        let roots = Roots::new(field, iso, bricks);
        counts.bytes.insert("surface".into(), roots.bytes() as u64);
        let colored = surface.look != SurfaceLook::White;
        let lit = inputs.plan.needs(Quantity::SurfaceNormal);
        let layers = |layers: [LayerKind; 4]| {
            let [normal, gradient, curvature, along_view] = layers.map(|layer| scene.picture.layers.contains(&layer));
            calls(scene, normal || gradient, curvature, along_view)
        };
        use LayerKind::{Curvature, CurvatureAlongView, Gradient, Normal};
        use LayerKind::{FirstCurvature, FirstCurvatureAlongView, FirstNormal};
        Some(Self {
            roots,
            rgb: if colored { [0, 1, 2].map(|c| R::from_f64(surface.color[c])) } else { [R::ONE; 3] },
            lit: Lit::of_surface(surface, scene, view),
            calls: if lit { Calls::NORMAL } else { Calls::NONE }.and(layers([
                Normal,
                Gradient,
                Curvature,
                CurvatureAlongView,
            ])),
            first: layers([FirstNormal, FirstNormal, FirstCurvature, FirstCurvatureAlongView]),
            alone: scene.transfer.is_none(),
        })
    }

    /// Lights it for another camera.
    pub(super) fn turn(&mut self, scene: &Scene, view: &View) {
        if let Some(surface) = &scene.surface {
            self.lit = Lit::of_surface(surface, scene, view);
        }
    }

    /// Looks for roots in every cell: the bricks are not those of the field.
    pub(super) fn look_everywhere(&mut self) {
        self.roots.look_everywhere();
    }
}

/// What layers of normals, of curvatures, and of κ alone need.
fn calls(scene: &Scene, normal: bool, curvature: bool, along_view: bool) -> Calls {
    let kappa = match measured_curvature(scene) {
        _ if !(curvature || along_view) => KappaSource::None,
        Measured::Exact => KappaSource::Exact,
        Measured::AlongRay => KappaSource::AlongRay,
    };
    Calls {
        gradient: normal || curvature || along_view,
        hessian: curvature || kappa == KappaSource::Exact,
        principal: curvature,
        kappa,
    }
}

impl Calls {
    /// What both ask for.
    fn and(self, other: Self) -> Self {
        Self {
            gradient: self.gradient || other.gradient,
            hessian: self.hessian || other.hessian,
            principal: self.principal || other.principal,
            kappa: if other.kappa == KappaSource::None { self.kappa } else { other.kappa },
        }
    }
}

impl<R: Real, S: Sampler<R>> Walk<'_, '_, R, S> {
    /// Visits the samples before the surface and then the surface itself. Returns how many samples were evaluated.
    ///
    /// A sample counts if its plane lies before the root. Of those the last one stands for all the way from where its own
    /// share of the ray begins to the root, from half a step to one and a half: so the way through a volume that is
    /// translucent before a surface grows evenly with the surface's depth, and there are no terraces on it.
    pub(super) fn run_to(
        &mut self,
        surface: &Surface<R>,
        lines: &[Fragment],
        boxes: Option<&mut Boxes>,
        counts: &mut Counts,
    ) -> u64 {
        let prepared = self.prepared;
        let near = match prepared.view.perspective {
            // Of shells near is the radius.
            true => prepared.lattice.near * (self.ray.depth_step.to_f64() / prepared.lattice.step),
            false => f64::NEG_INFINITY,
        };
        let range = [near, f64::INFINITY];
        let root = surface.roots.first(self.sampler, prepared.volume.mask(), self.ray.line(), range);
        let (samples, open) = match prepared.needs {
            _ if surface.alone => (0, self.put_all(lines, root)),
            _ if !lines.is_empty() => self.run_among(lines, root, boxes, counts),
            Needs::Value => self.run_before::<need::Value>(root, boxes, counts),
            Needs::Normal => self.run_before::<need::Normal>(root, boxes, counts),
            Needs::Anything => self.run_before::<need::Anything>(root, boxes, counts),
        };
        if let (true, Some(depth)) = (open, root) {
            self.meet(surface, depth, counts);
        }
        samples
    }

    /// Visits the samples before a depth. Returns how many were evaluated and whether the ray is still open.
    fn run_before<N: Need>(
        &mut self,
        root: Option<f64>,
        boxes: Option<&mut Boxes>,
        counts: &mut Counts,
    ) -> (u64, bool) {
        let end = root.map_or(i64::MAX, |depth| self.ray.last_before(depth));
        let mut samples = 0;
        for [first, last] in self.ray.visits(self.prepared.ends, self.ray.intervals(boxes)) {
            if first < end {
                let (n, open) = self.run::<N>([first, last.min(end - 1)], counts);
                samples += n;
                if !open {
                    return (samples, false);
                }
            }
            if let (true, Some(depth)) = (first <= end && end <= last, root) {
                let steps = depth / self.ray.depth_step.to_f64() - end as f64;
                self.correct_for(Correction::new(steps * self.ray.step / self.prepared.reference_length));
                let (n, open) = self.run::<N>([end, end], counts);
                return (samples + n, open);
            }
        }
        (samples, true)
    }

    /// Composites the surface, of opacity 1, at its own depth.
    fn meet(&mut self, surface: &Surface<R>, depth: f64, counts: &mut Counts) {
        let prepared = self.prepared;
        let calls = if self.sums.is_empty() { surface.calls.and(surface.first) } else { surface.calls };
        let facts = self.learn_at(depth, calls, counts);
        counts.without_normal += u64::from(calls.gradient && facts.normal.is_none());
        let v = self.sight.v;
        let rgb = surface.lit.color(surface.rgb, facts.normal, [v, surface.lit.half_vector(v)]);
        let w = self.end_at(rgb);
        if prepared.collects {
            let seen = Seen {
                weight: w.to_f64(),
                depth,
                value: surface.roots.iso(),
                normal: prepared.eye_axes.normal(&facts, &self.sight).to_glam().to_array(),
                gradient: facts.gradient.to_glam().to_array(),
                curvature: [facts.principal[0], facts.principal[1], facts.kappa].map(Real::to_f64),
            };
            self.sums.add(&seen, 1.0);
        }
    }

    /// What is called for at a depth on the ray that need not be a sample's.
    fn learn_at(&mut self, depth: f64, calls: Calls, counts: &mut Counts) -> Facts<R> {
        let prepared = self.prepared;
        let mut facts = Facts::none();
        if !calls.gradient {
            return facts;
        }
        let at = self.sampler.place(self.inside(depth));
        counts.gradients += 1;
        facts.gradient = self.sampler.gradient_at(at);
        facts.normal = self.normal(facts.gradient);
        let Some(n) = facts.normal else { return facts };
        if calls.hessian {
            (facts.kappa, facts.principal) =
                self.curvatures(self.sampler.hessian_at(at), calls, (facts.kappa, facts.principal), counts);
        }
        if calls.kappa == KappaSource::AlongRay {
            let before = depth - self.ray.depth_step.to_f64();
            let position = self.inside(before);
            let is_before = position == self.at(before) && !(prepared.view.perspective && before <= 0.0);
            let before = is_before.then(|| {
                counts.gradients += 1;
                self.sampler.gradient(position)
            });
            let before = before.and_then(|g| self.normal(g));
            let (known, before) = (before.is_some(), before.unwrap_or(n));
            facts.kappa = curvature_along_ray::kappa(prepared.turn, n, before, known, R::from_f64(self.ray.step));
        }
        facts
    }

    /// The index position at a depth.
    fn at(&self, depth: f64) -> Vec3<R> {
        let [origin, along] = self.ray.line();
        Vec3::from_glam(origin + along * depth)
    }

    /// The same, in the box also where rounding leaves it.
    fn inside(&self, depth: f64) -> Vec3<R> {
        let (p, [lo, hi]) = (self.at(depth), self.prepared.ends);
        Vec3::new(p.x.max(lo.x).min(hi.x), p.y.max(lo.y).min(hi.y), p.z.max(lo.z).min(hi.z))
    }
}
