//! Things before the camera: a body that scatters light, and a coat that mirrors the room.

use super::super::light::mirrored;
use super::super::noise::{Draw, fractal, on_form};
use super::super::paint::{Linear, Paint, linear};
use super::super::room::{diffuse, exposed, flagged, fresnel, room};
use drypoint_reference::number::Vec3;

/// A dull or translucent body under a coat.
pub(super) struct Glossy {
    /// The body's own colour.
    pub(super) body: u32,
    /// How far red, green and blue wander in it before they leave: 0 dull, 0.6 as wax.
    pub(super) scatter: Linear,
    /// The coat's reflectance head on: 0 none, 0.04 glass, 0.08 lacquer.
    pub(super) coat: f64,
    /// How much the coat spreads what it mirrors.
    pub(super) blur: f64,
    /// Unevenness of the body, as a share of its light.
    pub(super) mottle: f64,
    /// The dark that its edge reflects.
    pub(super) dark: u32,
}

impl Glossy {
    /// The colour at a normal.
    pub(super) fn paint(&self, n: Vec3<f64>) -> Paint {
        let (x, y) = on_form(n);
        let mottle = 1.0 + self.mottle * fractal(7.0 * x, 7.0 * y, 3, Draw::Mottle);
        let (body, light) = (linear(self.body), diffuse(n, self.scatter));
        // A coat that mirrors much lets less through.
        let coat = if self.coat > 0.0 { fresnel(n, self.coat).min(0.5) } else { 0.0 };
        let seen = room(mirrored(n), self.blur);
        let sum = std::array::from_fn(|c| (1.0 - coat) * mottle * body[c] * light[c] + coat * seen[c]);
        flagged(exposed(sum), n, self.dark)
    }
}
