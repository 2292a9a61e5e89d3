//! `muscle`: burgundy satin, whose threads smear the light across them.

use super::super::light::mirrored;
use super::super::noise::{Draw, fractal, on_fibres};
use super::super::paint::{Paint, linear};
use super::super::room::{diffuse, exposed, flagged, room};
use drypoint_reference::number::Vec3;

/// Threads run across the picture; a fold shines where the thread lies between light and eye.
pub(super) fn muscle(n: Vec3<f64>) -> (Paint, f64) {
    let (along, across) = on_fibres(n);
    let threads = 1.0 + 0.26 * fractal(1.8 * along, 17.0 * across, 2, Draw::Fibre);
    let (body, light) = (linear(0xa82a2c), diffuse(n, [0.36, 0.10, 0.08]));
    let seen = room(mirrored(n), 0.55);
    let shine = std::array::from_fn(|c| threads * (body[c] * light[c] + 0.10 * seen[c] * (0.35 + 0.65 * body[c])));
    (flagged(exposed(shine), n, 0x1c0406), 1.0)
}
