//! Body colour laid on with a brush, as plates of anatomy are painted: most of the theme is this.

use super::super::light::{KEY, dab, highlight, outline, reflected, wrapped};
use super::super::noise::{Draw, fractal, on_form};
use super::super::paint::{Paint, Ramp};
use drypoint::scene::math;
use drypoint_reference::number::Vec3;
use std::f64::consts::TAU;

/// What one material looks like in gouache.
pub(super) struct Gouache {
    /// From the core shadow to the light at wrapped N·L of 0, 0.2, 0.42, 0.64, 0.85 and 1.
    pub(super) body: [u32; 6],
    /// How far light wanders in it: the wrap of the cosine.
    pub(super) wrap: f64,
    /// The light that comes back from the page, and how strong.
    pub(super) bounce: (u32, f64),
    /// A broad soft sheen: colour, strength, exponent.
    pub(super) sheen: (u32, f64, f64),
    /// How wet it is: the strength of a highlight in one crisp stroke.
    pub(super) wet: f64,
    /// How unevenly it is coloured, as a share of the ramp.
    pub(super) mottle: f64,
    /// The line's colours in the shade and in the light.
    pub(super) line: (u32, u32),
}

/// Where the colours of a body stand.
const STOPS: [f64; 6] = [0.0, 0.2, 0.42, 0.64, 0.85, 1.0];

impl Gouache {
    /// The colour at a normal.
    pub(super) fn paint(&self, n: Vec3<f64>) -> Paint {
        self.textured(n, 0.0)
    }

    /// The colour at a normal where something of the material's own makes it lighter or darker by a share of the ramp.
    pub(super) fn textured(&self, n: Vec3<f64>, lighter: f64) -> Paint {
        let stops: Vec<(f64, u32)> = STOPS.into_iter().zip(self.body).collect();
        let (x, y) = on_form(n);
        let hand = 0.030 * fractal(2.4 * x, 2.4 * y, 3, Draw::Hand);
        let mottle = self.mottle * fractal(7.0 * x, 7.0 * y, 3, Draw::Mottle);
        let sheen = Paint::hex(self.sheen.0);
        let paint = Ramp::new(&stops)
            .at(strokes(wrapped(n, KEY, self.wrap) + hand + mottle + lighter))
            .over(Paint::hex(self.bounce.0), self.bounce.1 * reflected(n))
            .over(sheen, self.sheen.1 * highlight(n, KEY, self.sheen.2));
        let bristles = 1.0 + 0.30 * fractal(9.0 * x, 9.0 * y, 2, Draw::Pressure);
        let stroke = dab(n, 0.60, 0.075, 0.40, 0.35);
        let paint = paint.over(Paint::hex(0xfffdf9), (self.wet * stroke * bristles).clamp(0.0, 1.0));
        outline(paint, n, self.line.0, self.line.1)
    }
}

/// The tone t laid on in strokes side by side: it rises in soft steps, never back, and keeps its ends.
fn strokes(t: f64) -> f64 {
    const STROKES: f64 = 6.0;
    t - 0.55 * math::sin(TAU * STROKES * t) / (TAU * STROKES)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strokes_rise_and_keep_their_ends() {
        assert_eq!(strokes(0.0), 0.0);
        assert!((strokes(1.0) - 1.0).abs() < 1e-15);
        let tones: Vec<f64> = (0..=1000).map(|k| strokes(f64::from(k) / 1000.0)).collect();
        // The slope lies between 1 − 0.55 and 1 + 0.55.
        assert!(tones.windows(2).all(|pair| (0.449..1.551).contains(&((pair[1] - pair[0]) * 1000.0))));
    }
}
