//! How it is drawn: with crayon on stone, printed in one warm black on paper.

use super::room::smooth;
use drypoint::scene::math::{cos, sin};
use drypoint::scene::philox::uniform;

/// Steps from paper to ink.
const STEPS: usize = 14;

/// Codes of the paper and of the full ink, sRGB.
const PAPER: [f64; 3] = [237.0, 228.0, 210.0];
const INK: [f64; 3] = [36.0, 31.0, 28.0];

/// How much the grain of the stone shows.
const GRAIN: f64 = 0.42;

/// Which step a pixel of a tone from 0 (ink) to 1 (paper) is printed in. Crayon takes to the tips of the stone's grain
/// first: middle tones are broken up, full ink and bare paper are not. `coarse` from 0 to 1 says how much of that shows,
/// `stroke` in which direction the crayon went, in radians.
pub(super) fn printed(x: f64, y: f64, tone: f64, coarse: f64, stroke: f64) -> u8 {
    let dark = (1.0 - tone).clamp(0.0, 1.0);
    let (sin, cos) = (sin(stroke), cos(stroke));
    let (along, across) = (cos * x + sin * y, cos * y - sin * x);
    let grain = 0.5 * noise(x / 1.5, y / 1.5, 1) + 0.5 * noise(along / 11.0, across / 1.9, 2) - 0.5;
    let ink = dark + GRAIN * coarse * grain * (4.0 * dark * (1.0 - dark)).sqrt();
    (ink.clamp(0.0, 1.0) * (STEPS - 1) as f64).round() as u8
}

/// The red, green and blue of each step.
pub(super) fn palette() -> Vec<u8> {
    (0..STEPS)
        .map(|k| k as f64 / (STEPS - 1) as f64)
        .flat_map(|t| [0, 1, 2].map(|c| (PAPER[c] + t * (INK[c] - PAPER[c])).round() as u8))
        .collect()
}

/// The step that comes nearest to a colour, in sRGB codes.
pub(super) fn nearest(color: [f64; 3]) -> u8 {
    let [along, whole] = [color, INK].map(|to| (0..3).map(|c| (to[c] - PAPER[c]) * (INK[c] - PAPER[c])).sum::<f64>());
    (((along / whole).clamp(0.0, 1.0)) * (STEPS - 1) as f64).round() as u8
}

/// Smooth noise in [0, 1) over a lattice of unit cells.
pub(super) fn noise(u: f64, v: f64, draw: u32) -> f64 {
    let value = |i: f64, j: f64| uniform(1898, [i as i64 as u32, j as i64 as u32, 0], draw);
    let [s, t] = [u, v].map(|w| smooth(0.0, 1.0, w - w.floor()));
    let row = |j: f64| value(u.floor(), j) * (1.0 - s) + value(u.floor() + 1.0, j) * s;
    row(v.floor()) * (1.0 - t) + row(v.floor() + 1.0) * t
}
