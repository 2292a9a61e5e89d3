//! `tone`: cool to warm, after Gooch et al. 1998.

use super::light::{KEY, highlight, outline};
use super::paint::{Paint, Ramp};
use crate::number::Vec3;

/// Hue carries the shape, so lightness stays in the middle and lines and highlights keep the ends to themselves.
pub(super) fn shade(n: Vec3<f64>) -> (Paint, f64) {
    let body = Ramp::new(&[
        (0.0, 0x2f4a84),
        (0.22, 0x50699b),
        (0.45, 0x8c8ea6),
        (0.65, 0xc0aa9b),
        (0.83, 0xe3c596),
        (1.0, 0xf6dfae),
    ]);
    let paint = body
        .at(0.5 + 0.5 * n.dot(KEY))
        .over(Paint::hex(0xfff7e3), 0.30 * highlight(n, KEY, 20.0))
        .over(Paint::hex(0xfffdf4), 0.80 * highlight(n, KEY, 110.0));
    (outline(paint, n, 0x141a33, 0x4a3c3c), 1.0)
}
