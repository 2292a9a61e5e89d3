//! What a visible sample looks like: its straight colour and its opacity per reference length.

use crate::number::{Real, Vec3};
use crate::shading::Phong;
use crate::style_transfer_functions::{Contour, Spheres, StyleIndex, contour, frame, transparency};
use crate::transfer::Place;
use drypoint_scene::counts::Counts;
use drypoint_scene::tables::{SphereFrame, Transparency};

/// What is known of a visible sample. Quantities that the scene does not call for keep their neutral values.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facts<R> {
    /// The value.
    pub(super) value: R,
    /// World gradient, times the power of two of [SPACE-4].
    pub(super) gradient: Vec3<R>,
    /// |g| of [VAL-2], in [0, 1].
    pub(super) magnitude: R,
    /// Whether there is a normal ([PREC-3]).
    pub(super) has_normal: bool,
    /// N in eye space; v where there is none.
    pub(super) normal: Vec3<R>,
    /// v in eye space.
    pub(super) v: Vec3<R>,
    /// |N·v|; 1 where there is no normal.
    pub(super) n_dot_v: R,
    /// The scene's κ; 0 where there is no normal.
    pub(super) kappa: R,
    /// κ₁ and κ₂.
    pub(super) principal: [R; 2],
}

impl<R: Real> Facts<R> {
    /// A sample without a normal: N = v, |N·v| = 1, κ = 0 ([PREC-3]).
    #[inline]
    pub(super) fn without_normal(value: R, v: Vec3<R>) -> Self {
        Self {
            value,
            gradient: Vec3::zero(),
            magnitude: R::ZERO,
            has_normal: false,
            normal: v,
            v,
            n_dot_v: R::ONE,
            kappa: R::ZERO,
            principal: [R::ZERO; 2],
        }
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
    /// Styles (Bruckner and Gröller 2007).
    Style {
        /// ift.
        index: StyleIndex,
        /// sft.
        spheres: Spheres<R>,
        /// [STF-7], [STF-8].
        contour: Option<Contour<R>>,
        /// [STF-9].
        transparency: Transparency,
        /// [STF-1].
        frame: SphereFrame,
    },
}

impl<R: Real> Look<R> {
    /// Straight colour and opacity per reference length.
    #[inline]
    pub(super) fn color(&self, place: &Place<R>, facts: &Facts<R>, counts: &mut Counts) -> ([R; 3], R) {
        match self {
            Self::Regular { colors, phong } => {
                let rgb = mixed(colors, place);
                let rgb = match phong {
                    Some(phong) if facts.has_normal => phong.shade(rgb, facts.normal, facts.v),
                    _ => rgb,
                };
                (rgb, place.alpha_u)
            }
            Self::Style { index, spheres, contour, transparency, frame } => {
                let n = frame::on_sphere(*frame, facts.normal, facts.v);
                // Without contours T = 0, so τ = 0 ([STF-9]).
                let tau = contour.as_ref().map_or(R::ZERO, |c| c.tau(facts.kappa, facts.magnitude));
                // A sample without a normal is on no contour, whatever the threshold ([PREC-3]).
                let on = contour.is_some() && facts.has_normal;
                let (x, y) = if on { contour::push(n.x, n.y, facts.n_dot_v, tau) } else { (n.x, n.y) };
                let blend = index.blend(place);
                counts.style_lookups += blend.lookups();
                let [r, g, b, alpha_d] = spheres.lookup(&blend, x, y);
                if alpha_d == R::ZERO {
                    return ([R::ZERO; 3], R::ZERO);
                }
                let share = transparency::share(*transparency, place.alpha_u, facts.n_dot_v, tau, facts.magnitude);
                ([r / alpha_d, g / alpha_d, b / alpha_d], alpha_d * share)
            }
        }
    }
}

/// The colour between two nodes: linear straight colours interpolate by themselves ([VAL-3]).
#[inline]
fn mixed<R: Real>(colors: &[[R; 3]], place: &Place<R>) -> [R; 3] {
    let a = colors[place.node];
    if place.w == R::ZERO {
        return a;
    }
    let b = colors[place.node + 1];
    std::array::from_fn(|i| R::lerp(a[i], b[i], place.w))
}
