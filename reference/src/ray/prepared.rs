//! A scene prepared for casting: everything that is decided once a picture, not at samples.

use super::cells::Cells;
use super::lattice::Lattice;
use super::need::Needs;
use super::over_two::OverTwo;
use super::sample::{EyeAxes, Look};
use super::skip::Skip;
use super::surface::Surface;
use crate::field::Field;
use crate::number::{Arithmetic, Real, Vec3};
use crate::style_transfer_functions::curvature_along_ray::Turn;
use crate::transfer::{Piecewise, Table};
use drypoint_scene::fragments::{Fragment, Fragments};
use drypoint_scene::picture::LayerKind;
use drypoint_scene::tables::{NormalSide, Outside};
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
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Calls {
    /// The gradient and the normal.
    pub(super) gradient: bool,
    /// The Hessian.
    pub(super) hessian: bool,
    /// κ₁ and κ₂, for a layer or an axis.
    pub(super) principal: bool,
    /// κ.
    pub(super) kappa: KappaSource,
}

impl Calls {
    /// The value is enough.
    pub(super) const NONE: Self = Self { gradient: false, hessian: false, principal: false, kappa: KappaSource::None };
    /// The normal, which comes with the gradient.
    pub(super) const NORMAL: Self = Self { gradient: true, ..Self::NONE };
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
    pub(super) fn new(normal: NormalSide, outside: Outside) -> Self {
        match (normal, outside) {
            (NormalSide::Outward, _) | (NormalSide::Gradient, Outside::High) => Self::Outward,
            (NormalSide::Facing, _) => Self::Facing,
            (NormalSide::Gradient, Outside::Low) => Self::Inward,
        }
    }

    /// The shading normal for an outward one.
    #[inline(always)]
    pub(super) fn turn<A: Arithmetic>(self, outward: Vec3<A>, v: Vec3<A>) -> Vec3<A> {
        let one = outward.x.one();
        match self {
            Self::Outward => outward,
            // A product and no branch: along a ray the side is anyone's guess.
            Self::Facing => outward * A::select(outward.dot(v).below(one.zero()), -one, one),
            Self::Inward => outward * -one,
        }
    }
}

/// A scene ready to be cast.
pub(super) struct Prepared<'v, R> {
    pub(super) volume: &'v Volume,
    pub(super) field: Field<'v, R>,
    pub(super) view: View,
    pub(super) lattice: Lattice,
    /// Lowest and highest index position ([SPACE-1]).
    pub(super) ends: [Vec3<R>; 2],
    pub(super) skip: Option<Skip>,
    /// None: values are so cheap that all in visible bricks are computed, or nothing is skipped.
    pub(super) cells: Option<Cells<'v>>,
    /// Lines on the rays, at their depths; none: none.
    pub(super) lines: Option<Fragments>,
    /// An opaque iso-surface; none: none.
    pub(super) surface: Option<Surface<R>>,
    /// α_u over the value; with two quantities, the values at which it can be above 0.
    pub(super) function: Piecewise<R>,
    /// From entries to nodes, where the function is read from a table.
    pub(super) table: Option<Table<R>>,
    /// The function itself where it is over two quantities.
    pub(super) over_two: Option<OverTwo<'v, R>>,
    pub(super) look: Look<R>,
    pub(super) calls: Calls,
    pub(super) needs: Needs,
    /// What the first visible sample of a ray has to know beyond that, for the layers `first.*`; none if nothing.
    pub(super) first: Option<Calls>,
    /// lo and hi − lo of [VAL-2], times the power of two of [SPACE-4]; none where nothing reads |g|.
    pub(super) gradient_range: Option<(R, R)>,
    /// Δ₀ in world units.
    pub(super) reference_length: f64,
    /// A at which a ray ends: 1 − ε ([RAY-2]).
    pub(super) stop_at: R,
    /// Whether colours are composited encoded ([VAL-3]).
    pub(super) encode: bool,
    /// Whether a layer beyond the beauty is asked for.
    pub(super) collects: bool,
    pub(super) layers: Vec<LayerKind>,
    pub(super) outside: Outside,
    pub(super) side: Side,
    /// The angle that κ along the ray is made of ([STF-5]).
    pub(super) turn: Turn,
    /// ‖g‖ at or below which there is no normal ([PREC-3]).
    pub(super) no_normal_below: R,
    pub(super) eye_axes: EyeAxes<R>,
    /// n of the n×n rays of a pixel.
    pub(super) samples: usize,
}

impl<R> Prepared<'_, R> {
    /// The lines on the ray through a point of the picture, in pixels from the top left corner.
    #[inline]
    pub(super) fn lines_at(&self, point: [f64; 2]) -> &[Fragment] {
        self.lines.as_ref().map_or(&[], |lines| lines.at(point))
    }
}

impl<R: Real> Prepared<'_, R> {
    /// N of [NORM-1] in world space; none where ‖g‖ is rounding ([PREC-3]).
    #[inline]
    pub(super) fn outward(&self, g: Vec3<R>) -> Option<Vec3<R>> {
        crate::field::normal::outward(g, self.outside, self.no_normal_below)
    }
}
