//! `glass`: a clear shell that is dense only at its edges.

use super::light::{KEY, edge, highlight, outline, reflected, wrapped};
use super::paint::{Paint, Ramp};
use crate::number::Vec3;
use drypoint_scene::math;

/// α_d grows towards the edge with the way that light takes through a shell, and the highlight lies on top.
pub(super) fn shade(n: Vec3<f64>) -> (Paint, f64) {
    let body = Ramp::new(&[(0.0, 0x0b7395), (0.35, 0x1f93ad), (0.7, 0x49b6c6), (1.0, 0x8fdade)]);
    let glow = body.at(wrapped(n, KEY, 0.6)).over(Paint::hex(0x66d0d4), 0.8 * reflected(n));
    let shell = 0.06 + 0.90 * math::pow(1.0 - n.z, 0.95);
    let shine = 0.95 * highlight(n, KEY, 150.0);
    let alpha = shine + (1.0 - shine) * shell;
    let paint = glow.over(Paint::hex(0xffffff), shine / alpha);
    (outline(paint, n, 0x0b2c40, 0x17566b), alpha + (1.0 - alpha) * edge(n))
}
