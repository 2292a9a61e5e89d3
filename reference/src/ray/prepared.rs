//! A scene prepared for casting: everything that is decided once a picture, not at samples.

use super::lattice::Lattice;
use super::piecewise::Piecewise;
use super::sample::Look;
use super::skip::Skip;
use crate::field::Field;
use crate::number::{Real, Vec3};
use drypoint_scene::glam::DVec3;
use drypoint_scene::math;
use drypoint_scene::picture::LayerKind;
use drypoint_scene::tables::{NormalSide, Outside, Scene, SignFlip};
use drypoint_scene::view::View;
use drypoint_scene::volume::Volume;

/// Where κ comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum KappaSource {
    /// Nothing asks for it.
    None,
    /// [STF-5].
    AlongRay,
    /// [CUR-2].
    Exact,
}

/// What a visible sample has to know; from the plan.
#[derive(Clone, Copy, Debug)]
pub(super) struct Calls {
    /// The gradient and the normal.
    pub gradient: bool,
    /// The Hessian.
    pub hessian: bool,
    /// κ₁ and κ₂, for a layer.
    pub principal: bool,
    /// κ.
    pub kappa: KappaSource,
}

/// Which way the shading normal points ([NORM-1]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Side {
    /// As it is.
    Outward,
    /// Flipped to N·v ≥ 0.
    Facing,
    /// g/‖g‖, the opposite of the outward normal of a bright object.
    Inward,
}

impl Side {
    /// The side for a scene's setting; `gradient` is the outward normal itself where values rise outwards.
    pub fn new(normal: NormalSide, outside: Outside) -> Self {
        match (normal, outside) {
            (NormalSide::Outward, _) | (NormalSide::Gradient, Outside::High) => Self::Outward,
            (NormalSide::Facing, _) => Self::Facing,
            (NormalSide::Gradient, Outside::Low) => Self::Inward,
        }
    }

    /// The shading normal for an outward one.
    #[inline]
    pub fn turn<R: Real>(self, outward: Vec3<R>, v: Vec3<R>) -> Vec3<R> {
        let flip = match self {
            Self::Outward => false,
            Self::Facing => outward.dot(v) < R::ZERO,
            Self::Inward => true,
        };
        if flip { -outward } else { outward }
    }
}

/// A scene ready to be cast.
pub(super) struct Prepared<'v, R> {
    pub volume: &'v Volume,
    pub field: Field<'v, R>,
    pub view: View,
    pub lattice: Lattice,
    /// Lowest and highest index position ([SPACE-1]).
    pub ends: [Vec3<R>; 2],
    pub skip: Option<Skip>,
    pub function: Piecewise<R>,
    pub look: Look<R>,
    pub calls: Calls,
    /// lo and hi − lo of [VAL-2], times the power of two of [SPACE-4]; none where nothing reads |g|.
    pub gradient_range: Option<(R, R)>,
    /// Δ₀ in world units.
    pub reference_length: f64,
    /// A at which a ray ends: 1 − ε ([RAY-2]).
    pub stop_at: R,
    /// Whether colours are composited encoded ([VAL-3]).
    pub encode: bool,
    /// Whether a layer beyond the beauty is asked for.
    pub collects: bool,
    pub layers: Vec<LayerKind>,
    pub outside: Outside,
    pub side: Side,
    /// Whether κ along the ray is between lines, not directions ([STF-5]).
    pub sign_flip: SignFlip,
    /// ‖g‖ at or below which there is no normal ([PREC-3]).
    pub no_normal_below: R,
    /// Rows of the rotation from world to eye space.
    pub eye_axes: [Vec3<R>; 3],
    /// n of the n×n rays of a pixel.
    pub samples: usize,
}

impl<R: Real> Prepared<'_, R> {
    /// N of [NORM-1] in world space; none where ‖g‖ is rounding ([PREC-3]).
    #[inline]
    pub fn outward(&self, g: Vec3<R>) -> Option<Vec3<R>> {
        crate::field::normal::outward(g, self.outside, self.no_normal_below)
    }

    /// A world direction in eye space.
    #[inline]
    pub fn to_eye(&self, n: Vec3<R>) -> Vec3<R> {
        Vec3::new(n.dot(self.eye_axes[0]), n.dot(self.eye_axes[1]), n.dot(self.eye_axes[2]))
    }

    /// A gradient with the power of two of [SPACE-4] undone.
    pub fn true_gradient(&self, g: Vec3<R>) -> DVec3 {
        let e = self.field.scale_exponent();
        let [x, y, z] = g.to_glam().to_array();
        DVec3::new(
            math::scale_by_power_of_two(x, e),
            math::scale_by_power_of_two(y, e),
            math::scale_by_power_of_two(z, e),
        )
    }
}

/// How the angle between two normals counts: lines only act with `normal = "facing"` ([STF-5]).
pub(super) fn flip_rule(scene: &Scene) -> SignFlip {
    let rule = scene.contours.as_ref().map_or(SignFlip::TwoSided, |c| c.sign_flip);
    if scene.sampling.normal == NormalSide::Facing { rule } else { SignFlip::Literal }
}
