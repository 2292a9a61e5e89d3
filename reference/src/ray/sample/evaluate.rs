//! The attributes of the samples of one ray.

use super::{CutFace, CutSample, EyeAxes, PreparedObject, SampleAttributes, ViewDirs};
use crate::field::{CellPosition, Sampler, curvature};
use crate::number::{Real, Sym3, Vec3};
use crate::ray::lattice::IndexRay;
use crate::style_transfer_functions::curvature_along_ray;
use drypoint_scene::counts::Counts;
use drypoint_scene::shot::{KappaSource, SampleQuery};

/// A sample: its plane, its place, its value.
#[derive(Clone, Copy)]
pub(crate) struct Sample<R> {
    /// k.
    pub(crate) k: i64,
    /// The sample's place in the field.
    pub(crate) at: CellPosition<R>,
    /// The sample's value.
    pub(crate) s: R,
}

/// The last sample of a ray for which a normal was evaluated.
#[derive(Clone, Copy)]
pub(crate) enum Previous<R> {
    /// There is no such sample.
    None,
    /// The sample has no normal ([PREC-3]).
    WithoutNormal(i64),
    /// The sample and its normal.
    Normal(i64, Vec3<R>),
}

/// Evaluates the samples of one ray through an object.
pub(crate) struct Evaluator<'p, 'v, R: Real, S> {
    pub(crate) object: &'p PreparedObject<'v, R>,
    pub(crate) sampler: &'p S,
    pub(crate) ray: IndexRay<R>,
    pub(crate) dirs: ViewDirs<R>,
    pub(crate) previous: Previous<R>,
    /// The first sample behind a cut ([RAY-8]), if there is one.
    pub(crate) cut: Option<CutSample<R>>,
}

impl<'p, 'v, R: Real, S: Sampler<R>> Evaluator<'p, 'v, R, S> {
    /// An evaluator of the samples of a ray with these directions.
    #[inline(always)]
    pub(crate) fn new(
        object: &'p PreparedObject<'v, R>,
        sampler: &'p S,
        ray: IndexRay<R>,
        dirs: ViewDirs<R>,
        eye_axes: &EyeAxes<R>,
    ) -> Self {
        let clip = &object.clip;
        let cut = ray.cut_sample(&clip.planes, object.ends);
        let cut = cut.map(|cut| {
            let face = clip.face(cut.plane, &dirs, eye_axes);
            CutSample { k: cut.k, depth: R::from_f64(cut.depth), face }
        });
        Self { object, sampler, ray, dirs, previous: Previous::None, cut }
    }

    /// The cut on which sample k lies, if there is one.
    #[inline(always)]
    pub(crate) fn cut_at(&self, k: i64) -> Option<CutFace<R>> {
        self.cut.filter(|cut| cut.k == k).map(|cut| cut.face)
    }

    /// The eye depth of the cut on which sample k lies, if there is one.
    #[inline(always)]
    pub(crate) fn cut_depth(&self, k: i64) -> Option<R> {
        self.cut.filter(|cut| cut.k == k).map(|cut| cut.depth)
    }

    /// The eye depth at which sample k is evaluated: that of its plane or, on a cut, that of the cut.
    #[inline(always)]
    pub(crate) fn depth(&self, k: i64) -> R {
        self.cut_depth(k).unwrap_or_else(|| self.ray.depth(k))
    }

    /// The index position at which sample k is evaluated.
    #[inline(always)]
    pub(crate) fn position(&self, k: i64) -> Vec3<R> {
        match self.cut_depth(k) {
            // It lies between two samples in the box, and rounding is monotonic.
            Some(depth) => self.ray.position_at(depth),
            None => self.ray.position(k),
        }
    }

    /// Adds the quantities of a query to the known attributes of a sample.
    ///
    /// Attributes are passed and returned by value, so that those of a scene that needs few of them stay in registers.
    /// On a cut they are the field's, except that κ is 0.
    #[inline(always)]
    pub(crate) fn evaluate(
        &mut self,
        sample: Sample<R>,
        query: SampleQuery,
        known: SampleAttributes<R>,
        counts: &mut Counts,
    ) -> SampleAttributes<R> {
        let Sample { k, at, .. } = sample;
        let mut attributes = known;
        // A Hessian comes with the gradient of its own field, which often is the shading gradient.
        let together = query.gradient && query.hessian && self.sampler.has_one_gradient();
        let second = if together { Some(self.sampler.hessian_at(at)) } else { None };
        if query.gradient {
            let g = second.map_or_else(|| self.sampler.gradient_at(at), |(g, _)| g);
            counts.gradients += 1;
            attributes.gradient = g;
            attributes.depth = self.depth(k);
            if let Some((lo, width)) = self.object.gradient_range {
                attributes.magnitude = if width > R::ZERO { ((g.length() - lo) / width).clamp_01() } else { R::ZERO };
            }
            attributes.normal = self.normal(g);
        }
        // Curvatures, for samples that have a normal.
        if let Some(n) = attributes.normal {
            if query.hessian {
                let second = second.unwrap_or_else(|| self.sampler.hessian_at(at));
                let known = (attributes.kappa, attributes.principal);
                (attributes.kappa, attributes.principal) = self.curvatures(second, query, known, counts);
            }
            if self.cut.is_some_and(|cut| cut.k == k) {
                attributes.kappa = R::ZERO;
            } else if query.kappa == KappaSource::AlongRay {
                attributes.kappa = self.kappa_along_ray(k, n, counts);
            }
        }
        if query.kappa == KappaSource::AlongRay {
            // The next sample looks back to the lattice, which a cut is beside.
            self.previous = match attributes.normal {
                _ if self.cut_at(k).is_some() => Previous::None,
                Some(n) => Previous::Normal(k, n),
                None => Previous::WithoutNormal(k),
            };
        }
        attributes
    }

    /// Evaluates a query at a depth on the ray that need not be a sample's.
    pub(crate) fn evaluate_at_depth(
        &self,
        depth: f64,
        query: SampleQuery,
        perspective: bool,
        counts: &mut Counts,
    ) -> SampleAttributes<R> {
        self.evaluate_at(self.inside(depth), self.before(depth, perspective), query, counts)
    }

    /// The place one step before a depth. Returns none outside the box and behind the eye.
    pub(crate) fn before(&self, depth: f64, perspective: bool) -> Option<Vec3<R>> {
        let before = depth - self.ray.depth_step.to_f64();
        let position = self.inside(before);
        (position == self.at(before) && !(perspective && before <= 0.0)).then_some(position)
    }

    /// Evaluates a query at a place on the ray. `before` is the place one step before it, if that is in the box.
    pub(crate) fn evaluate_at(
        &self,
        position: Vec3<R>,
        before: Option<Vec3<R>>,
        query: SampleQuery,
        counts: &mut Counts,
    ) -> SampleAttributes<R> {
        let mut attributes = SampleAttributes::neutral();
        if !query.gradient {
            return attributes;
        }
        let at = self.sampler.place(position);
        counts.gradients += 1;
        attributes.gradient = self.sampler.gradient_at(at);
        attributes.normal = self.normal(attributes.gradient);
        let Some(n) = attributes.normal else { return attributes };
        if query.hessian {
            let known = (attributes.kappa, attributes.principal);
            (attributes.kappa, attributes.principal) =
                self.curvatures(self.sampler.hessian_at(at), query, known, counts);
        }
        if query.kappa == KappaSource::AlongRay {
            let before = before.map(|position| {
                counts.gradients += 1;
                self.sampler.gradient(position)
            });
            let before = before.and_then(|g| self.normal(g));
            attributes.kappa = curvature_along_ray::kappa(
                self.object.turn,
                n,
                before.unwrap_or(n),
                before.is_some(),
                R::from_f64(self.ray.step),
            );
        }
        attributes
    }

    /// The shading normal, seen along the ray ([NORM-1]).
    #[inline]
    fn normal(&self, g: Vec3<R>) -> Option<Vec3<R>> {
        self.object.normal(g, self.dirs.v)
    }

    /// κ_v from the normal of the previous sample on this ray ([STF-5]); 0 if it has no normal.
    fn kappa_along_ray(&mut self, k: i64, n: Vec3<R>, counts: &mut Counts) -> R {
        let before = match self.previous {
            Previous::Normal(at, normal) if at == k - 1 => Some(normal),
            Previous::WithoutNormal(at) if at == k - 1 => None,
            _ if self.ray.has(k - 1, self.object.ends) => {
                let g = self.sampler.gradient(self.ray.position(k - 1));
                counts.gradients += 1;
                self.normal(g)
            }
            _ => None,
        };
        curvature_along_ray::kappa(
            self.object.turn,
            n,
            before.unwrap_or(n),
            before.is_some(),
            R::from_f64(self.ray.step),
        )
    }

    /// Curvatures from the Hessian: κ_v ([CUR-2]), κ₁ and κ₂ ([CUR-1]). Returns `known` if the Hessian's own field has
    /// no normal.
    #[inline(always)]
    fn curvatures(
        &self,
        (g, h): (Vec3<R>, Sym3<R>),
        query: SampleQuery,
        known: (R, [R; 2]),
        counts: &mut Counts,
    ) -> (R, [R; 2]) {
        let object = self.object;
        counts.hessians += 1;
        let (mut kappa, mut principal) = known;
        if g.length().exceeds(object.no_normal_below) {
            // For a moved field: g' = L_Tᵀg and H' = L_TᵀHL_T ([VS-2]).
            let (g, h) = object.moved.as_ref().map_or((g, h), |moved| (moved.apply(g), moved.congruence(h)));
            if query.kappa == KappaSource::Exact {
                kappa = curvature::along_view(g, h, self.dirs.v, object.outside);
            }
            if query.principal {
                let c = curvature::principal(g, h, object.outside);
                principal = [c.k1, c.k2];
            }
        }
        (kappa, principal)
    }

    /// The index position at a depth.
    pub(crate) fn at(&self, depth: f64) -> Vec3<R> {
        let [origin, along] = self.ray.line();
        Vec3::from_glam(origin + along * depth)
    }

    /// The index position at a depth, clamped to the box against rounding.
    pub(crate) fn inside(&self, depth: f64) -> Vec3<R> {
        let (p, [lo, hi]) = (self.at(depth), self.object.ends);
        Vec3::new(p.x.max(lo.x).min(hi.x), p.y.max(lo.y).min(hi.y), p.z.max(lo.z).min(hi.z))
    }
}
