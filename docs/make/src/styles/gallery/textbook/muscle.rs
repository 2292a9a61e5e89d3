//! `muscle`: red flesh in bundles of fibres.

use super::super::noise::{Draw, fractal, on_fibres};
use super::super::paint::Paint;
use super::tissue::MUSCLE;
use drypoint_reference::number::Vec3;

/// Long fibres across the picture. Over a rounded muscle the normal turns across its length, so that whatever varies
/// on the sphere becomes stripes along it.
pub(super) fn shade(n: Vec3<f64>) -> (Paint, f64) {
    let (along, across) = on_fibres(n);
    let fibres = fractal(1.6 * along, 15.0 * across + 0.8 * along * along, 2, Draw::Fibre);
    (MUSCLE.textured(n, 0.085 * fibres), 1.0)
}
