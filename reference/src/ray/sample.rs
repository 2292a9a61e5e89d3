//! What a visible sample looks like: its straight colour and its opacity per reference length.

use super::lit::Lit;
use super::opacity::Correction;
use crate::interactive_volume_illustration::ViewOpacity;
use crate::number::{Real, Vec3};
use crate::shading::Phong;
use crate::style_transfer_functions::{Blend2, Contour, Detail, Spheres, StyleIndex, contour, frame, transparency};
use crate::transfer::{Patch, Place};
use drypoint_scene::counts::Counts;
use drypoint_scene::tables::{SphereFrame, Transparency};

/// What is known of a visible sample. Quantities that the scene does not call for keep their neutral values.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facts<R> {
    /// Eye depth.
    pub(super) depth: R,
    /// World gradient, times the power of two of [SPACE-4].
    pub(super) gradient: Vec3<R>,
    /// N in world space; none where the gradient is negligible ([PREC-3]) or not asked for.
    pub(super) normal: Option<Vec3<R>>,
    /// |g| of [VAL-2], in [0, 1].
    pub(super) magnitude: R,
    /// The scene's κ; 0 where there is no normal.
    pub(super) kappa: R,
    /// κ₁ and κ₂.
    pub(super) principal: [R; 2],
}

impl<R: Real> Facts<R> {
    /// A sample without a normal: κ = 0 ([PREC-3]).
    #[inline(always)]
    pub(super) fn none() -> Self {
        let zero = R::ZERO;
        Self { depth: zero, gradient: Vec3::zero(), normal: None, magnitude: zero, kappa: zero, principal: [zero; 2] }
    }
}

/// Directions that are constant along a ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sight<R> {
    /// v, towards the eye, in world space.
    pub(super) v: Vec3<R>,
    /// v in eye space.
    pub(super) v_eye: Vec3<R>,
    /// Ĥ in world space, where there is Phong shading; else 0.
    pub(super) half: Vec3<R>,
}

/// World to eye space, for directions.
#[derive(Clone, Copy, Debug)]
pub(super) struct EyeAxes<R>(pub(super) [Vec3<R>; 3]);

impl<R: Real> EyeAxes<R> {
    /// N in eye space; a sample without a normal has N = v ([PREC-3]).
    #[inline]
    pub(super) fn normal(&self, facts: &Facts<R>, sight: &Sight<R>) -> Vec3<R> {
        facts.normal.map_or(sight.v_eye, |n| Vec3::new(n.dot(self.0[0]), n.dot(self.0[1]), n.dot(self.0[2])))
    }
}

/// How visible samples are coloured. Chosen once for a picture.
pub(super) enum Look<R> {
    /// Colours, unshaded or shaded ([STF-11]).
    Regular {
        /// Linear straight colour of each node.
        colors: Vec<[R; 3]>,
        /// Material and light.
        phong: Option<Phong<R>>,
    },
    /// Colours with more than Phong: tones, silhouettes, view-dependent opacity ([HATCH-15]).
    Illustrated(Illustrated<R>),
    /// Styles (Bruckner and Gröller 2007).
    Style(Styled<R>),
}

/// A regular function with more than Phong.
pub(super) struct Illustrated<R> {
    /// Linear straight colour of each node.
    pub(super) colors: Vec<[R; 3]>,
    pub(super) lit: Lit<R>,
    /// None: opacities are as they are.
    pub(super) view_opacity: Option<ViewOpacity>,
}

/// What a style transfer function needs.
pub(super) struct Styled<R> {
    /// ift.
    pub(super) index: StyleIndex,
    /// sft.
    pub(super) spheres: Spheres<R>,
    /// [STF-10]; none: each lookup reads the style itself.
    pub(super) detail: Option<Detail<R>>,
    /// [STF-7], [STF-8].
    pub(super) contour: Option<Contour<R>>,
    /// [STF-9].
    pub(super) transparency: Transparency,
    /// [STF-1].
    pub(super) frame: SphereFrame,
    pub(super) eye_axes: EyeAxes<R>,
}

impl<R: Real> Look<R> {
    /// Directions of a ray towards whose eye v points, in world and eye space.
    pub(super) fn sight(&self, v: Vec3<R>, v_eye: Vec3<R>) -> Sight<R> {
        let half = match self {
            Self::Regular { phong: Some(phong), .. } => phong.half_vector(v),
            Self::Illustrated(illustrated) => illustrated.lit.half_vector(v),
            _ => Vec3::zero(),
        };
        Sight { v, v_eye, half }
    }

    /// Straight colour and opacity per reference length. Place and facts come as values: only the arm of styles then needs
    /// them in memory.
    #[inline(always)]
    pub(super) fn color(
        &self,
        place: impl Between<R>,
        facts: Facts<R>,
        sight: &Sight<R>,
        counts: &mut Counts,
    ) -> ([R; 3], R) {
        match self {
            Self::Regular { colors, phong } => {
                let rgb = place.color(colors);
                let rgb = match (phong, facts.normal) {
                    (Some(phong), Some(n)) => phong.shade(rgb, n, sight.half),
                    _ => rgb,
                };
                (rgb, place.alpha_u())
            }
            Self::Illustrated(illustrated) => illustrated.color(place, facts, sight),
            Self::Style(styled) => styled.color(place, facts, sight, counts),
        }
    }
}

impl<R: Real> Illustrated<R> {
    #[inline(never)]
    fn color(&self, place: impl Between<R>, facts: Facts<R>, sight: &Sight<R>) -> ([R; 3], R) {
        let rgb = self.lit.color(place.color(&self.colors), facts.normal, [sight.v, sight.half]);
        let alpha = match (self.view_opacity, facts.normal) {
            // |N·v| counts as 1 where there is no normal ([PREC-3]), and then the exponent is 1.
            (Some(view_opacity), Some(n)) => {
                Correction::new(view_opacity.exponent(n.dot(sight.v))).apply(place.alpha_u())
            }
            _ => place.alpha_u(),
        };
        (rgb, alpha)
    }
}

impl<R: Real> Styled<R> {
    #[inline(never)]
    fn color(&self, place: impl Between<R>, facts: Facts<R>, sight: &Sight<R>, counts: &mut Counts) -> ([R; 3], R) {
        let n = frame::on_sphere(self.frame, self.eye_axes.normal(&facts, sight), sight.v_eye);
        // |N·v| counts as 1 where there is no normal ([PREC-3]).
        let n_dot_v = facts.normal.map_or(R::ONE, |n| n.dot(sight.v).abs());
        // Without contours T = 0, so τ = 0 ([STF-9]).
        let tau = self.contour.as_ref().map_or(R::ZERO, |c| c.tau(facts.kappa, facts.magnitude));
        // A sample without a normal is on no contour, whatever the threshold.
        let on = self.contour.is_some() && facts.normal.is_some();
        let (x, y) = if on { contour::push(n.x, n.y, n_dot_v, tau) } else { (n.x, n.y) };
        let level = self.detail.as_ref().map(|d| d.below_last(facts.depth, facts.kappa, facts.magnitude));
        let [r, g, b, alpha_d] = place.style(&self.index, &self.spheres, [x, y], level, counts);
        if alpha_d == R::ZERO {
            return ([R::ZERO; 3], R::ZERO);
        }
        let share = transparency::share(self.transparency, place.alpha_u(), n_dot_v, tau, facts.magnitude);
        // What follows would change no bit.
        if alpha_d == R::ONE {
            return ([r, g, b], share);
        }
        ([r / alpha_d, g / alpha_d, b / alpha_d], alpha_d * share)
    }
}

/// A place between the nodes of a function over one quantity or two.
pub(super) trait Between<R: Real> {
    /// α_u, above 0.
    fn alpha_u(&self) -> R;

    /// The colour between the nodes' linear straight colours, which interpolate by themselves ([VAL-3]).
    fn color(&self, colors: &[[R; 3]]) -> [R; 3];

    /// The style between the nodes' styles, looked up at (N_x, N_y): linear, premultiplied. `level` is that of
    /// [`Detail::below_last`] in the mip chains; none: the styles themselves.
    fn style(
        &self,
        index: &StyleIndex,
        spheres: &Spheres<R>,
        n: [R; 2],
        level: Option<R>,
        counts: &mut Counts,
    ) -> [R; 4];
}

impl<R: Real> Between<R> for Place<R> {
    #[inline(always)]
    fn alpha_u(&self) -> R {
        self.alpha_u
    }

    #[inline(always)]
    fn color(&self, colors: &[[R; 3]]) -> [R; 3] {
        self.color(colors)
    }

    #[inline(always)]
    fn style(
        &self,
        index: &StyleIndex,
        spheres: &Spheres<R>,
        [x, y]: [R; 2],
        level: Option<R>,
        counts: &mut Counts,
    ) -> [R; 4] {
        let blend = index.blend(self);
        counts.style_lookups += blend.lookups();
        match level {
            None => spheres.lookup(&blend, x, y),
            Some(level) => spheres.lookup_level(&blend, x, y, level),
        }
    }
}

impl<R: Real> Between<R> for Patch<R> {
    #[inline]
    fn alpha_u(&self) -> R {
        self.alpha_u
    }

    #[inline]
    fn color(&self, colors: &[[R; 3]]) -> [R; 3] {
        let [a, b] = &self.rows;
        if self.w == R::ZERO { a.color(colors) } else { mixed(a.color(colors), b.color(colors), self.w) }
    }

    #[inline]
    fn style(
        &self,
        index: &StyleIndex,
        spheres: &Spheres<R>,
        [x, y]: [R; 2],
        level: Option<R>,
        counts: &mut Counts,
    ) -> [R; 4] {
        let blend = Blend2::new(index, self);
        counts.style_lookups += blend.lookups();
        match level {
            None => spheres.lookup2(&blend, x, y),
            Some(level) => spheres.lookup2_level(&blend, x, y, level),
        }
    }
}

/// Channel by channel, a + w(b − a).
#[inline(always)]
fn mixed<R: Real>(a: [R; 3], b: [R; 3], w: R) -> [R; 3] {
    [R::lerp(a[0], b[0], w), R::lerp(a[1], b[1], w), R::lerp(a[2], b[2], w)]
}
