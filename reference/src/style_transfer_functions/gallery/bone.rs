//! `bone`: dry bone, ivory in the light and cool in the shade.

use super::light::{KEY, highlight, outline, reflected, wrapped};
use super::paint::{Paint, Ramp};
use crate::number::Vec3;

/// Matt: no sharp highlight, a long half-tone of ochre, a shadow that turns to violet grey.
pub(super) fn shade(n: Vec3<f64>) -> (Paint, f64) {
    let body = Ramp::new(&[
        (0.0, 0x3a3140),
        (0.2, 0x6e5d62),
        (0.42, 0xad937e),
        (0.63, 0xdcc6a8),
        (0.84, 0xf4e9d4),
        (1.0, 0xfefaf0),
    ]);
    let paint = body
        .at(wrapped(n, KEY, 0.42))
        .over(Paint::hex(0xb9adab), 0.75 * reflected(n))
        .over(Paint::hex(0xfffdf8), 0.42 * highlight(n, KEY, 16.0));
    (outline(paint, n, 0x271a17, 0x5c4632), 1.0)
}
