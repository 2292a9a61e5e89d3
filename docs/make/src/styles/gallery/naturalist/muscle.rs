//! `muscle`: madder over fibres drawn in pencil.

use super::super::noise::{Draw, fractal, on_fibres};
use super::super::paint::Paint;
use super::body::MUSCLE;
use super::tinted::Tinted;
use drypoint_reference::number::Vec3;

/// The load of pigment varies in long fibres across the picture.
pub(super) fn shade(n: Vec3<f64>) -> (Paint, f64) {
    let (along, across) = on_fibres(n);
    let fibres = fractal(1.6 * along, 13.0 * across + 0.8 * along * along, 2, Draw::Fibre);
    (Tinted { load: MUSCLE.load * (1.0 + 0.30 * fibres), ..MUSCLE }.paint(n), 1.0)
}
