//! `skin`: living skin with blood under it.

use super::light::{KEY, highlight, outline, reflected, wrapped};
use super::paint::{Paint, Ramp};
use crate::number::Vec3;

/// The shadow line is the most saturated place, since light that has wandered through tissue comes out red.
pub(super) fn shade(n: Vec3<f64>) -> (Paint, f64) {
    let body = Ramp::new(&[
        (0.0, 0x55221f),
        (0.2, 0x97443a),
        (0.4, 0xcd7258),
        (0.62, 0xe8a688),
        (0.84, 0xf5cdb2),
        (1.0, 0xfde4d0),
    ]);
    let paint = body
        .at(wrapped(n, KEY, 0.45))
        .over(Paint::hex(0xc08a8b), 0.65 * reflected(n))
        .over(Paint::hex(0xfff1e6), 0.30 * highlight(n, KEY, 18.0))
        .over(Paint::hex(0xfffaf5), 0.42 * highlight(n, KEY, 60.0));
    (outline(paint, n, 0x3c1413, 0x7d3a2b), 1.0)
}
