//! The shading normal ([NORM-1]) and when there is none ([PREC-3]).

use crate::number::{Arithmetic, Real, Vec3};
use drypoint_scene::tables::Outside;

/// A shading normal, or one for each lane.
#[derive(Clone, Copy)]
pub(crate) struct Normal<A: Arithmetic> {
    /// N.
    pub(crate) n: Vec3<A>,
    /// Whether there is one.
    pub(crate) has: A::Mask,
    /// ‖g‖.
    pub(crate) length: A,
}

impl<A: Arithmetic> Normal<A> {
    /// N, the unit normal that points outwards, in world space: −g/‖g‖ for `outside = "low"`, g/‖g‖ for `"high"`; none
    /// where ‖g‖ ≤ `no_normal_below`.
    #[inline(always)]
    pub(crate) fn outward(gradient: Vec3<A>, outside: Outside, no_normal_below: A::Number) -> Self {
        let length = gradient.length();
        let has = length.constant(no_normal_below).below(length);
        Self { n: gradient * outwards(length, outside), has, length }
    }
}

/// ∓1/‖g‖: what makes the outward normal of a gradient.
#[inline(always)]
pub(super) fn outwards<A: Arithmetic>(length: A, outside: Outside) -> A {
    let inverse = length.one() / length;
    match outside {
        Outside::Low => -inverse,
        Outside::High => inverse,
    }
}

/// [`Normal::outward`] of one gradient. The bound is [`Field::no_normal_below`](super::Field::no_normal_below) for gradients
/// as a field gives them.
#[inline(always)]
pub fn outward<R: Real>(gradient: Vec3<R>, outside: Outside, no_normal_below: R) -> Option<Vec3<R>> {
    let Normal { n, has, .. } = Normal::outward(gradient, outside, no_normal_below);
    has.then_some(n)
}
