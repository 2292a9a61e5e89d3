//! What a visible sample looks like: its straight colour and its opacity per reference length.

use super::piecewise::Place;
use crate::number::{Real, Vec3};
use crate::shading::Phong;
use drypoint_scene::counts::Counts;

/// What is known of a visible sample. Quantities that the scene does not call for keep their neutral values.
#[derive(Clone, Copy, Debug)]
pub(super) struct Facts<R> {
    /// The value.
    pub value: R,
    /// World gradient, times the power of two of [SPACE-4].
    pub gradient: Vec3<R>,
    /// |g| of [VAL-2], in [0, 1].
    pub magnitude: R,
    /// Whether there is a normal ([PREC-3]).
    pub has_normal: bool,
    /// N in eye space; v where there is none.
    pub normal: Vec3<R>,
    /// v in eye space.
    pub v: Vec3<R>,
    /// |N·v|; 1 where there is no normal.
    pub n_dot_v: R,
    /// The scene's κ; 0 where there is no normal.
    pub kappa: R,
    /// κ₁ and κ₂.
    pub principal: [R; 2],
}

impl<R: Real> Facts<R> {
    /// A sample without a normal: N = v, |N·v| = 1, κ = 0 ([PREC-3]).
    #[inline]
    pub fn without_normal(value: R, v: Vec3<R>) -> Self {
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
}

impl<R: Real> Look<R> {
    /// Straight colour and opacity per reference length.
    #[inline]
    pub fn color(&self, place: &Place<R>, facts: &Facts<R>, _counts: &mut Counts) -> ([R; 3], R) {
        match self {
            Self::Regular { colors, phong } => {
                let rgb = mixed(colors, place);
                let rgb = match phong {
                    Some(phong) if facts.has_normal => phong.shade(rgb, facts.normal, facts.v),
                    _ => rgb,
                };
                (rgb, place.alpha_u)
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
