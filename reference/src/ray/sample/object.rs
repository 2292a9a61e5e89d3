//! An object prepared for its samples: everything that is decided once for each picture.

use super::need::Needs;
use super::{OverTwo, PreparedClip, SampleShader};
use crate::field::Field;
use crate::number::{Arithmetic, Decision, Mat3, Real, Vec3};
use crate::transfer::{IndexTable, Piecewise};
use drypoint_scene::shot::{NormalDirection, Outside, SampleQuery, Turn};
use drypoint_scene::space::Grid;
use drypoint_scene::volume::Volume;

/// A volume with its function and its material, prepared for samples.
pub(crate) struct PreparedObject<'v, R> {
    pub(crate) volume: &'v Volume,
    /// The grid of the volume where it is drawn.
    pub(crate) grid: Grid,
    /// L_Tᵀ of [VS-2], which maps gradients of the volume to those of the moved field; none if the volume is not moved.
    pub(crate) moved: Option<Mat3<R>>,
    pub(crate) field: Field<'v, R>,
    /// Lowest and highest index position ([SPACE-1]).
    pub(crate) ends: [Vec3<R>; 2],
    /// Planes that cut parts of the object away ([RAY-8]).
    pub(crate) clip: PreparedClip<R>,
    /// α_u over the value. With two quantities, a function that is above 0 where α_u can be.
    pub(crate) function: Piecewise<R>,
    /// The map from table entries to nodes, if the function is read from a table.
    pub(crate) table: Option<IndexTable<R>>,
    /// The function itself, if it is over two quantities.
    pub(crate) over_two: Option<OverTwo<'v, R>>,
    pub(crate) shader: SampleShader<R>,
    pub(crate) query: SampleQuery,
    pub(crate) needs: Needs,
    /// The further query of the first visible sample of a ray, for the layers `first.*`; none if there is nothing to
    /// add.
    pub(crate) first: Option<SampleQuery>,
    /// The further query of a sample that shades an intersection with another object; none if there is nothing to add.
    pub(crate) meeting: Option<SampleQuery>,
    /// lo and hi − lo of [VAL-2], times the power of two of [SPACE-4]; none if nothing reads |g|.
    pub(crate) gradient_range: Option<(R, R)>,
    /// Δ₀ in world units.
    pub(crate) reference_length: f64,
    pub(crate) outside: Outside,
    pub(crate) normal: NormalDirection,
    /// The measure of the angle in κ along the ray ([STF-5]).
    pub(crate) turn: Turn,
    /// The bound on ‖g‖ at or below which there is no normal ([PREC-3]).
    pub(crate) no_normal_below: R,
}

impl<R: Real> PreparedObject<'_, R> {
    /// The shading normal ([NORM-1]): the outward one, turned as the shot says, seen from v. Returns none if ‖g‖ is
    /// rounding error ([PREC-3]). For a moved volume the normal is the moved field's, but ‖g‖ is the volume's own
    /// ([VS-2]).
    #[inline]
    pub(crate) fn normal(&self, g: Vec3<R>, v: Vec3<R>) -> Option<Vec3<R>> {
        let outward = match &self.moved {
            None => crate::field::normal::outward(g, self.outside, self.no_normal_below),
            Some(moved) if g.length().exceeds(self.no_normal_below) => {
                crate::field::normal::outward(moved.apply(g), self.outside, R::ZERO)
            }
            Some(_) => None,
        };
        outward.map(|n| turned(self.normal, n, v))
    }
}

/// Turns an outward normal into the shading normal, seen from v.
#[inline(always)]
pub(crate) fn turned<A: Arithmetic>(direction: NormalDirection, outward: Vec3<A>, v: Vec3<A>) -> Vec3<A> {
    let one = outward.x.one();
    match direction {
        NormalDirection::Outward => outward,
        // A product instead of a branch: along a ray the side is unpredictable.
        NormalDirection::Facing => {
            outward * A::select(outward.dot(v).deciding(Decision::Facing).below(one.zero()), -one, one)
        }
        NormalDirection::Inward => outward * -one,
    }
}
