//! The shading normal in lanes ([NORM-1], [PREC-3]).

use crate::number::Vec3;
use crate::ray::prepared::Prepared;
use drypoint_scene::shot::{NormalDirection, Outside};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, mask64x8};

/// Normals, and what is known with them.
pub(super) struct Normals<S: Simd> {
    /// N, in world space.
    pub(super) n: Vec3<f64x8<S>>,
    /// Lanes that have one.
    pub(super) has: mask64x8<S>,
    /// ‖g‖.
    pub(super) length: f64x8<S>,
}

impl<S: Simd> Normals<S> {
    /// [`outward`](crate::field::normal::outward) and [`NormalDirection::turn`] of gradients seen from v.
    #[inline(always)]
    pub(super) fn new(prepared: &Prepared<'_, f64>, v: Vec3<f64x8<S>>, g: Vec3<f64x8<S>>) -> Self {
        let one = f64x8::splat(g.x.simd, 1.0);
        let length = g.length();
        let scale = one / length;
        let outward = g * match prepared.object.outside {
            Outside::Low => -scale,
            Outside::High => scale,
        };
        let n = match prepared.object.normal {
            NormalDirection::Outward => outward,
            NormalDirection::Facing => outward * outward.dot(v).simd_lt(0.0).select(-one, one),
            NormalDirection::Inward => outward * -one,
        };
        Self { n, has: length.simd_gt(prepared.object.no_normal_below), length }
    }
}
