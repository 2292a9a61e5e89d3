//! The shading normal ([NORM-1]) and when there is none ([PREC-3]).

use crate::number::{Real, Vec3};
use drypoint_scene::tables::Outside;

/// N, the unit normal that points outwards, in world space: −g/‖g‖ for `outside = "low"`, g/‖g‖ for `"high"`; none
/// where ‖g‖ ≤ `no_normal_below`, which is [`Field::no_normal_below`](super::Field::no_normal_below) for gradients as
/// a field gives them.
#[inline(always)]
pub fn outward<R: Real>(gradient: Vec3<R>, outside: Outside, no_normal_below: R) -> Option<Vec3<R>> {
    let length = gradient.length();
    (length > no_normal_below).then(|| {
        let scale = R::ONE / length;
        match outside {
            Outside::Low => gradient * -scale,
            Outside::High => gradient * scale,
        }
    })
}
