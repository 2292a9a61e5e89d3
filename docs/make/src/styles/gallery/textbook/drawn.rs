//! Ways of drawing: pen, pencil, chalk, the burin and the wash, each on white paper.

use super::super::light::{self, KEY, dab, edge, outline, radius, reflected, smoothstep};
use super::super::noise::{Draw, fractal, on_form};
use super::super::paint::{Paint, Ramp, linear};
use super::super::stroke::Hatching;
use super::super::wash::{Wash, as_paint, tooth, under};
use drypoint_reference::number::Vec3;

/// The white of the page.
const WHITE: u32 = 0xfefdfa;

/// How dark a place is drawn, in [0, 1]: light, half-tone, core shadow, and the page's light behind it.
fn darkness(n: Vec3<f64>) -> f64 {
    light::darkness(n, 0.30, 0.42)
}

/// Washes of Indian ink, each with a border that dries a little darker than its inside, and a firm line round it all.
pub(super) fn ink(n: Vec3<f64>) -> (Paint, f64) {
    let (x, y) = on_form(n);
    let lit = n.dot(KEY) + 0.07 * fractal(2.1 * x + 5.0, 2.1 * y, 3, Draw::Hand);
    let mut paint = Paint::hex(WHITE);
    for (at, colour, strength) in [(0.76, 0xdcd8d3, 0.95), (0.40, 0x9b9792, 0.78), (0.02, 0x35322f, 0.90)] {
        let wash = smoothstep(at + 0.045, at - 0.045, lit);
        let pooled = smoothstep(at - 0.30, at - 0.02, lit);
        paint = paint.over(Paint::hex(colour), wash * strength * (0.84 + 0.16 * pooled));
    }
    paint = paint.over(Paint::hex(0x9a958f), 0.55 * reflected(n));
    (paint.over(Paint::hex(0x120f0e), edge(n)), 1.0)
}

/// Soft graphite, laid in slanting strokes and half rubbed away with a stump.
pub(super) fn pencil(n: Vec3<f64>) -> (Paint, f64) {
    let dark = darkness(n);
    let strokes = Hatching { axis: Vec3::new(0.6, 0.8, 0.0), lines: 26.0, stray: 0.55, soft: 0.22 };
    let pressure = 1.0 + 0.5 * fractal(4.0 * n.x, 4.0 * n.y, 2, Draw::Pressure);
    let lines = strokes.coverage(n, 0.75 * dark * pressure);
    let grain = 1.0 + 0.16 * tooth(n);
    let graphite = (0.70 * dark + 0.24 * lines * smoothstep(0.08, 0.45, dark)) * grain;
    let paint = Ramp::new(&[(0.0, WHITE), (0.25, 0xd4d3d2), (0.55, 0x8c8b8d), (1.0, 0x3a3a3e)]).at(graphite);
    (outline(paint, n, 0x1f1f24, 0x4a4a50), 1.0)
}

/// Red chalk: the grain of the paper shows in the half-tones, and the shadow is rubbed in.
pub(super) fn chalk(n: Vec3<f64>) -> (Paint, f64) {
    let dark = darkness(n);
    let strokes = Hatching { axis: Vec3::new(0.8, 0.6, 0.0), lines: 18.0, stray: 0.8, soft: 0.3 };
    let lines = strokes.coverage(n, 0.8 * dark) - 0.8 * dark;
    // Chalk takes on the heights of the paper first: where half of it is covered, the grain is strongest.
    let grain = 0.24 * tooth(n) * (4.0 * dark * (1.0 - dark));
    let cover = (dark + grain + 0.16 * lines).clamp(0.0, 1.0);
    let paint =
        Ramp::new(&[(0.0, 0xfdf8f0), (0.22, 0xeec6ac), (0.5, 0xc97b58), (0.78, 0x9c4a2e), (1.0, 0x642a1b)]).at(cover);
    (outline(paint, n, 0x45170f, 0x8a3b24), 1.0)
}

/// A steel engraving: fine parallels that swell into the shade, and a second set across them where it is deep.
pub(super) fn engraving(n: Vec3<f64>) -> (Paint, f64) {
    let dark = darkness(n);
    let first = Hatching { axis: Vec3::new(0.75, 0.6, 0.28), lines: 34.0, stray: 0.06, soft: 0.16 };
    let second = Hatching { axis: Vec3::new(-0.36, 0.85, 0.384), lines: 34.0, stray: 0.06, soft: 0.16 };
    let a = first.coverage(n, 0.12 + 0.62 * dark);
    let b = second.coverage(n, 0.75 * smoothstep(0.38, 1.0, dark));
    let ink = 0.80 * (1.0 - (1.0 - a) * (1.0 - b));
    // The burr between the lines keeps some ink, which holds the tone where lines blur.
    let tone = 0.46 * dark + 0.42 * ink * smoothstep(0.02, 0.22, dark) + 0.10 * dark * dark;
    let paint = Ramp::new(&[(0.0, 0xfffefb), (0.5, 0x8f8c88), (1.0, 0x1d1b1a)]).at(tone);
    (paint.over(Paint::hex(0x121110), edge(n)), 1.0)
}

/// Ultramarine in three glazes on white paper, the highest light left bare.
pub(super) fn watercolour(n: Vec3<f64>) -> (Paint, f64) {
    let wash = Wash { glazes: [(0.86, 0.20), (0.50, 0.34), (0.06, 0.50)], soft: 0.05, edge: 0.22, grain: 0.10 };
    let light = under(linear(WHITE), 0x2b4fa6, wash.density(n));
    (outline(as_paint(light), n, 0x111c4e, 0x2d4a8f), 1.0)
}

/// A flat tint: the colour of unshaded volume rendering.
pub(super) fn constant(_: Vec3<f64>) -> (Paint, f64) {
    (Paint::hex(0xd8b98a), 1.0)
}

/// Cool to warm, after Gooch et al. 1998: hue carries the shape, so lightness stays in the middle, and lines and
/// highlights keep the ends to themselves.
pub(super) fn tone(n: Vec3<f64>) -> (Paint, f64) {
    let body = Ramp::new(&[
        (0.0, 0x2c4686),
        (0.22, 0x4f689f),
        (0.45, 0x8f8fa8),
        (0.65, 0xc7ab99),
        (0.83, 0xe8c894),
        (1.0, 0xf8e3b0),
    ]);
    let shine = dab(n, 0.52, 0.09, 0.34, 0.5);
    let paint = body.at(0.5 + 0.5 * n.dot(KEY)).over(Paint::hex(0xfffcf0), 0.75 * shine);
    (outline(paint, n, 0x141a33, 0x4a3c3c), 1.0)
}

/// Three flat tones and a stroke of light.
pub(super) fn cartoon(n: Vec3<f64>) -> (Paint, f64) {
    let lit = n.dot(KEY);
    let border = |at: f64| smoothstep(at - 0.022, at + 0.022, lit);
    let paint = Paint::hex(0x2b5c5b)
        .over(Paint::hex(0x5a9e8b), border(0.02))
        .over(Paint::hex(0xa6d2b3), border(0.52))
        .over(Paint::hex(0xf9fcef), dab(n, 0.66, 0.075, 0.46, 0.18));
    (outline(paint, n, 0x0f2a2b, 0x0f2a2b), 1.0)
}

/// Two flat tones.
pub(super) fn cartoon_2(n: Vec3<f64>) -> (Paint, f64) {
    let paint = Paint::hex(0xc4583c).over(Paint::hex(0xf6bf84), smoothstep(0.208, 0.252, n.dot(KEY)));
    (outline(paint, n, 0x3d1219, 0x3d1219), 1.0)
}

/// What an X-ray shows of a shell: nothing in the middle, where little lies in the way, and all at the rim.
pub(super) fn xray(n: Vec3<f64>) -> (Paint, f64) {
    let way = 1.0 - n.z;
    let body = Ramp::new(&[(0.0, 0x9fb3e6), (0.3, 0x6f83cf), (0.7, 0x39429a), (1.0, 0x1a1a56)]);
    let alpha = 0.03 + 0.97 * smoothstep(0.0, 1.0, way * (0.55 + 0.45 * way));
    let paint = outline(body.at(way), n, 0x0f0f3c, 0x1c1c5e);
    (paint, alpha + (1.0 - alpha) * smoothstep(0.93, 0.985, radius(n)))
}
