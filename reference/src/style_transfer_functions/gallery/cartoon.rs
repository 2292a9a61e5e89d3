//! `cartoon`: three flat tones and a highlight.

use super::light::{KEY, outline, radius, smoothstep};
use super::paint::Paint;
use crate::number::Vec3;
use drypoint_scene::math;

/// The borders are a few texels wide, so that they stay smooth where the picture is magnified. The highlight is one
/// stroke of the brush along the upper left, an ellipse bent round the middle.
pub(super) fn shade(n: Vec3<f64>) -> (Paint, f64) {
    let lit = n.dot(KEY);
    let border = |at: f64| smoothstep(at - 0.022, at + 0.022, lit);
    let turn = math::atan2(n.y * KEY.x - n.x * KEY.y, n.x * KEY.x + n.y * KEY.y);
    let (across, along) = ((radius(n) - 0.66) / 0.075, turn / 0.46);
    let stroke = 1.0 - smoothstep(0.82, 1.18, (across * across + along * along).sqrt());
    let paint = Paint::hex(0x2d5a58)
        .over(Paint::hex(0x5b9a88), border(0.02))
        .over(Paint::hex(0xa3ceb0), border(0.52))
        .over(Paint::hex(0xf8fbee), stroke);
    (outline(paint, n, 0x0f2a2b, 0x234b46), 1.0)
}
