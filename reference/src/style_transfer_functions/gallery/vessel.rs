//! `vessel`: arterial red, wet.

use super::light::{KEY, highlight, outline, reflected, wrapped};
use super::paint::{Paint, Ramp};
use crate::number::Vec3;

/// The crimson of plates of the circulation, with the small sharp highlight of a wet surface.
pub(super) fn shade(n: Vec3<f64>) -> (Paint, f64) {
    let body = Ramp::new(&[
        (0.0, 0x33060d),
        (0.22, 0x6d0f17),
        (0.46, 0xa81e20),
        (0.70, 0xcd3b2e),
        (0.88, 0xe16a50),
        (1.0, 0xee8f70),
    ]);
    let paint = body
        .at(wrapped(n, KEY, 0.36))
        .over(Paint::hex(0xc55148), 0.75 * reflected(n))
        .over(Paint::hex(0xffc9b0), 0.34 * highlight(n, KEY, 26.0))
        .over(Paint::hex(0xfff6f0), 0.92 * highlight(n, KEY, 190.0));
    (outline(paint, n, 0x23040a, 0x5c0f12), 1.0)
}
