//! Metals as a wash drawing has them: hard borders between the lights and the dark, the highest light bare paper.

use super::super::light::{mirrored_height, smoothstep};
use super::super::noise::{Draw, fractal, on_form};
use super::super::paint::Paint;
use super::super::stroke::Hatching;
use super::super::wash::{as_paint, paper, under};
use super::tinted::{PAPER, bare, darkness, pen};
use drypoint_reference::number::Vec3;

/// A metal of two pigments: its own, and what it takes from the dark of the room.
struct Metal {
    own: u32,
    dark: u32,
}

impl Metal {
    /// The height of the mirrored ray decides: sky, a dark horizon with a hard upper border, a floor that fades.
    fn paint(&self, n: Vec3<f64>) -> Paint {
        let (x, y) = on_form(n);
        let hand = 0.07 * fractal(2.0 * x + 1.0, 2.0 * y, 3, Draw::Hand);
        let height = mirrored_height(n) + hand;
        let horizon = smoothstep(-0.16, -0.24, height) * smoothstep(-0.75, -0.28, height);
        let sky = smoothstep(0.75, -0.1, height) * smoothstep(-0.26, -0.18, height);
        let floor = smoothstep(-0.20, -0.5, height);
        let free = 1.0 - 0.9 * bare(n);
        let sheet = under(paper(n, PAPER), self.own, (0.22 + 0.55 * sky + 0.40 * floor) * free);
        let sheet = under(sheet, self.dark, 1.05 * horizon + 0.30 * sky * sky + 0.12 * floor);
        let strokes = Hatching { axis: Vec3::new(0.62, 0.74, 0.26), lines: 30.0, stray: 0.25, soft: 0.2 };
        let lines = strokes.coverage(n, 0.55 * darkness(n)) * smoothstep(0.2, 0.7, darkness(n));
        pen(as_paint(under(sheet, 0x55504c, 0.18 * lines)), n)
    }
}

/// Steel in Payne's grey.
pub(super) fn metal(n: Vec3<f64>) -> (Paint, f64) {
    (Metal { own: 0x7f97b3, dark: 0x2b3648 }.paint(n), 1.0)
}

/// Copper in burnt sienna and umber.
pub(super) fn copper(n: Vec3<f64>) -> (Paint, f64) {
    (Metal { own: 0xc9813f, dark: 0x5e2c1c }.paint(n), 1.0)
}
