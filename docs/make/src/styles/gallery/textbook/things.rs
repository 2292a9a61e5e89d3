//! Things that people make, or that light goes through: metals and glass.

use super::super::light::{
    KEY, dab, edge, highlight, mirrored_height, outline, radius, reflected, smoothstep, wrapped,
};
use super::super::noise::{Draw, fractal, on_form};
use super::super::paint::{Paint, Ramp};
use drypoint::scene::math;
use drypoint_reference::number::Vec3;

/// What a polished ball reflects, painted in bands over the height of the mirrored ray.
fn bands(n: Vec3<f64>, stops: &[(f64, u32)]) -> Paint {
    let (x, y) = on_form(n);
    let hand = 0.014 * fractal(2.6 * x, 2.6 * y, 2, Draw::Hand);
    Ramp::new(stops).at(0.5 + 0.5 * mirrored_height(n).clamp(-1.0, 1.0) + hand)
}

/// Steel: a bright sky, a dark horizon, a warm floor. Towards the edge all of it pales, as at grazing angles.
pub(super) fn metal(n: Vec3<f64>) -> (Paint, f64) {
    let paint = bands(
        n,
        &[
            (0.0, 0x77716a),
            (0.13, 0xb5afa5),
            (0.24, 0x8f8b87),
            (0.315, 0x3f4249),
            (0.375, 0x2c3139),
            (0.47, 0x5d6773),
            (0.64, 0x9eaab5),
            (0.84, 0xdbe2e8),
            (1.0, 0xf7fafb),
        ],
    );
    let paint = paint
        .over(Paint::hex(0xb4bec8), 0.5 * smoothstep(0.72, 0.93, radius(n)))
        .over(Paint::hex(0xf4f7f9), 0.24 * highlight(n, KEY, 16.0))
        .over(Paint::hex(0xffffff), 0.90 * dab(n, 0.47, 0.10, 0.36, 0.5));
    (outline(paint, n, 0x131316, 0x33363c), 1.0)
}

/// Copper, its reflections coloured by itself.
pub(super) fn copper(n: Vec3<f64>) -> (Paint, f64) {
    let paint = bands(
        n,
        &[
            (0.0, 0x8a4a2c),
            (0.13, 0xcf8653),
            (0.24, 0xa35a34),
            (0.315, 0x4f2018),
            (0.375, 0x3a1513),
            (0.47, 0x7d3a22),
            (0.64, 0xc07546),
            (0.84, 0xeebd8c),
            (1.0, 0xfbe3c4),
        ],
    );
    let paint = paint
        .over(Paint::hex(0xdb9a70), 0.5 * smoothstep(0.72, 0.93, radius(n)))
        .over(Paint::hex(0xffe6cb), 0.26 * highlight(n, KEY, 16.0))
        .over(Paint::hex(0xfffaf2), 0.90 * dab(n, 0.47, 0.10, 0.36, 0.5));
    (outline(paint, n, 0x280c0a, 0x5f2a1a), 1.0)
}

/// A clear shell: α_d grows towards the edge with the way that light takes through it, and the highlight lies on top.
pub(super) fn glass(n: Vec3<f64>) -> (Paint, f64) {
    let body = Ramp::new(&[(0.0, 0x0b6f92), (0.35, 0x1f93ad), (0.7, 0x4db9c8), (1.0, 0x98dfe1)]);
    let glow = body.at(wrapped(n, KEY, 0.6)).over(Paint::hex(0x6fd6d4), 0.8 * reflected(n));
    let shell = 0.06 + 0.90 * math::pow(1.0 - n.z, 0.95);
    let shine = 0.95 * dab(n, 0.58, 0.075, 0.42, 0.4);
    let alpha = shine + (1.0 - shine) * shell;
    let paint = glow.over(Paint::hex(0xffffff), shine / alpha);
    (outline(paint, n, 0x0b2c40, 0x17566b), alpha + (1.0 - alpha) * edge(n))
}
