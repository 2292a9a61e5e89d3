//! `wax`: honey-coloured anatomical wax.

use super::light::{KEY, highlight, outline, reflected, wrapped};
use super::paint::{Paint, Ramp};
use crate::number::Vec3;

/// Light enters wax and comes out elsewhere: the shadow line is soft and orange, and the far edge glows.
pub(super) fn shade(n: Vec3<f64>) -> (Paint, f64) {
    let body = Ramp::new(&[
        (0.0, 0x6e3318),
        (0.2, 0xa2572a),
        (0.42, 0xd39556),
        (0.64, 0xedc58a),
        (0.84, 0xf8e2bb),
        (1.0, 0xfef2dc),
    ]);
    let paint = body
        .at(wrapped(n, KEY, 0.48))
        .over(Paint::hex(0xf29a4c), 0.85 * reflected(n))
        .over(Paint::hex(0xfff3dc), 0.38 * highlight(n, KEY, 22.0))
        .over(Paint::hex(0xfffdf8), 0.80 * highlight(n, KEY, 130.0));
    (outline(paint, n, 0x3f1c0a, 0x7a431d), 1.0)
}
