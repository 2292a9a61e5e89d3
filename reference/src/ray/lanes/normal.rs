//! The shading normal in lanes ([NORM-1], [PREC-3]).

use crate::field::normal::Normal;
use crate::number::Vec3;
use crate::ray::prepared::Prepared;
use crate::ray::sample::turned;
use fearless_simd::{Simd, f64x8};

/// The shading normals of gradients seen from v.
#[inline(always)]
pub(super) fn shading<S: Simd>(prepared: &Prepared<'_, f64>, v: Vec3<f64x8<S>>, g: Vec3<f64x8<S>>) -> Normal<f64x8<S>> {
    let outward = Normal::outward(g, prepared.object.outside, prepared.object.no_normal_below);
    Normal { n: turned(prepared.object.normal, outward.n, v), ..outward }
}
