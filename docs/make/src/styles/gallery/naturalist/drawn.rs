//! The pages of the notebook that are not tinted: pen, pencil, chalk, plate and stencil.

use super::super::light::{KEY, dab, edge, outline, radius, reflected, smoothstep};
use super::super::noise::{Draw, fractal, on_form};
use super::super::paint::{Paint, Ramp, linear};
use super::super::stroke::Hatching;
use super::super::wash::{Wash, as_paint, paper, tooth, under};
use super::tinted::{INK, PAPER, bare, darkness, pen};
use drypoint::scene::math;
use drypoint_reference::number::Vec3;

/// Iron-gall ink from a quill: parallels around two axes over a thin wash of the same ink.
pub(super) fn ink(n: Vec3<f64>) -> (Paint, f64) {
    let dark = darkness(n);
    let first = Hatching { axis: Vec3::new(0.70, 0.66, 0.2725), lines: 22.0, stray: 0.30, soft: 0.16 };
    let second = Hatching { axis: Vec3::new(-0.45, 0.80, 0.3969), lines: 22.0, stray: 0.30, soft: 0.16 };
    let lines = first.coverage(n, 0.66 * smoothstep(0.10, 0.95, dark));
    let across = second.coverage(n, 0.62 * smoothstep(0.48, 1.05, dark));
    let wash = Wash { glazes: [(0.42, 0.22), (0.02, 0.34), (-0.3, 0.25)], soft: 0.10, edge: 0.20, grain: 0.10 };
    let sheet = under(paper(n, PAPER), 0x6f5238, wash.density(n));
    let drawn = 0.62 * (1.0 - (1.0 - lines) * (1.0 - across));
    (pen(as_paint(sheet).over(Paint::hex(INK), drawn), n), 1.0)
}

/// A hard pencil: hatching in two directions on cream paper, nothing rubbed.
pub(super) fn pencil(n: Vec3<f64>) -> (Paint, f64) {
    let dark = darkness(n);
    let grain = 1.0 + 0.30 * tooth(n);
    let set = |axis, lines, from: f64| {
        let hatching = Hatching { axis, lines, stray: 0.40, soft: 0.24 };
        hatching.coverage(n, 0.72 * smoothstep(from, from + 0.85, dark)) * grain
    };
    let lines = 0.55 * set(Vec3::new(0.62, 0.74, 0.26), 30.0, 0.06)
        + 0.38 * set(Vec3::new(0.96, 0.18, 0.2145), 30.0, 0.36)
        + 0.34 * dark * grain;
    let sheet = under(paper(n, PAPER), 0x4b4b52, 1.25 * lines);
    let line = Paint::hex(0x2b2b30).over(Paint::hex(0x6a665f), 0.6 * smoothstep(0.1, 0.95, n.dot(KEY)));
    (as_paint(sheet).over(line, edge(n)), 1.0)
}

/// Black and white chalk on blue paper: the paper is the half-tone.
pub(super) fn chalk(n: Vec3<f64>) -> (Paint, f64) {
    let lit = n.dot(KEY);
    let dark = darkness(n);
    let grain = tooth(n);
    let strokes = Hatching { axis: Vec3::new(0.8, 0.6, 0.0), lines: 18.0, stray: 0.8, soft: 0.3 };
    let hatched = 0.22 * (strokes.coverage(n, 0.6) - 0.6);
    let patchy = |cover: f64| (cover + (0.30 * grain + hatched) * 4.0 * cover * (1.0 - cover)).clamp(0.0, 1.0);
    let black = patchy(0.92 * smoothstep(0.42, 1.0, dark));
    let white = patchy(0.96 * smoothstep(0.42, 1.0, lit));
    let sheet = as_paint(paper(n, 0x9aa7b0));
    let paint = sheet.over(Paint::hex(0x23262e), black).over(Paint::hex(0xfcfaf2), white);
    (outline(paint, n, 0x14161c, 0x2e3440), 1.0)
}

/// A copper plate, coloured by hand: lines around two axes printed in sepia, green laid over them.
pub(super) fn engraving(n: Vec3<f64>) -> (Paint, f64) {
    let dark = darkness(n);
    let first = Hatching { axis: Vec3::new(0.30, -0.66, 0.6889), lines: 30.0, stray: 0.08, soft: 0.17 };
    let second = Hatching { axis: Vec3::new(0.75, 0.52, 0.4088), lines: 30.0, stray: 0.08, soft: 0.17 };
    let a = first.coverage(n, 0.10 + 0.60 * dark);
    let b = second.coverage(n, 0.70 * smoothstep(0.40, 1.05, dark));
    let lines = 0.48 * (1.0 - (1.0 - a) * (1.0 - b)) * smoothstep(0.02, 0.3, dark);
    let wash = Wash { glazes: [(0.80, 0.30), (0.30, 0.40), (-0.1, 0.42)], soft: 0.12, edge: 0.15, grain: 0.10 };
    let sheet = under(paper(n, PAPER), 0x93a26a, wash.density(n));
    (pen(as_paint(sheet).over(Paint::hex(0x33231a), lines), n), 1.0)
}

/// Green earth and indigo in three glazes, which settle in the grain of the paper; the light is bare paper.
pub(super) fn watercolour(n: Vec3<f64>) -> (Paint, f64) {
    let (x, y) = on_form(n);
    let first = Wash { glazes: [(0.82, 0.26), (0.42, 0.36), (0.0, 0.42)], soft: 0.05, edge: 0.30, grain: 0.20 };
    let second = Wash { glazes: [(0.16, 0.3), (-0.16, 0.3), (-0.4, 0.1)], soft: 0.14, edge: 0.10, grain: 0.26 };
    let bloom = 1.0 + 0.35 * fractal(1.9 * x + 7.0, 1.9 * y, 2, Draw::Pool);
    let sheet = under(paper(n, PAPER), 0x4f8c7a, 1.05 * first.density(n) * bloom);
    let sheet = under(sheet, 0x3c4a86, second.density(n));
    (outline(as_paint(sheet), n, 0x10302f, 0x2f6b60), 1.0)
}

/// A flat tint of the paper box's ochre.
pub(super) fn constant(_: Vec3<f64>) -> (Paint, f64) {
    (Paint::hex(0xcbb389), 1.0)
}

/// Two pigments that run into each other, indigo from the shade and ochre from the light.
pub(super) fn tone(n: Vec3<f64>) -> (Paint, f64) {
    let (x, y) = on_form(n);
    let lit = n.dot(KEY) + 0.12 * fractal(1.8 * x, 1.8 * y + 2.0, 3, Draw::Hand);
    let grain = 1.0 + 0.16 * tooth(n);
    let cool = 0.80 * smoothstep(0.55, -0.75, lit) * grain;
    let warm = (0.52 * smoothstep(-0.35, 0.45, lit) * smoothstep(1.3, 0.4, lit) + 0.16) * grain;
    let free = 1.0 - 0.8 * bare(n);
    let sheet = under(paper(n, PAPER), 0xe0a44a, warm * free);
    (pen(as_paint(under(sheet, 0x2c4478, cool)), n), 1.0)
}

/// Colour through stencils: three flat tones of rust, a stroke of light left out, and the block's black line.
pub(super) fn cartoon(n: Vec3<f64>) -> (Paint, f64) {
    let lit = n.dot(KEY);
    let border = |at: f64| smoothstep(at - 0.022, at + 0.022, lit);
    let paint = Paint::hex(0x5f4a3c)
        .over(Paint::hex(0xb9774c), border(-0.02))
        .over(Paint::hex(0xe3b57a), border(0.46))
        .over(Paint::hex(PAPER), dab(n, 0.64, 0.07, 0.40, 0.18));
    (outline(paint, n, 0x21150e, 0x21150e), 1.0)
}

/// A chiaroscuro woodcut of two blocks: olive and paper.
pub(super) fn cartoon_2(n: Vec3<f64>) -> (Paint, f64) {
    let paint = Paint::hex(0x6d7350).over(Paint::hex(0xeee3c0), smoothstep(0.258, 0.302, n.dot(KEY)));
    (outline(paint, n, 0x1e1d12, 0x1e1d12), 1.0)
}

/// A cyanotype: what stands in the light's way stays pale, and Prussian blue grows with the way through the shell.
pub(super) fn xray(n: Vec3<f64>) -> (Paint, f64) {
    let way = 1.0 - n.z;
    let grain = 1.0 + 0.10 * tooth(n);
    let deep = smoothstep(0.0, 1.0, way * (0.62 + 0.38 * way));
    let body = Ramp::new(&[(0.0, 0xa9c7da), (0.3, 0x5f97bf), (0.7, 0x1e568f), (1.0, 0x0c2f63)]);
    let alpha = 0.03 + 0.97 * deep;
    let paint = outline(body.at(way * grain), n, 0x071f47, 0x0d3264);
    (paint, alpha + (1.0 - alpha) * smoothstep(0.93, 0.985, radius(n)))
}

/// A glass drawn by its edges: a thin green-blue wash that thickens outwards, two lights in white body colour, a line.
pub(super) fn glass(n: Vec3<f64>) -> (Paint, f64) {
    let way = 1.0 - n.z;
    let sheet = under(linear(PAPER), 0x6fa9ac, 0.35 + 1.1 * way * (1.0 - 0.5 * reflected(n)));
    let light = (0.9 * bare(n)).max(0.55 * dab(Vec3::new(-n.x, -n.y, n.z), 0.80, 0.04, 0.35, 0.5));
    let shell = 0.05 + 0.80 * math::pow(way, 0.9);
    let alpha = light + (1.0 - light) * shell;
    let paint = as_paint(sheet).over(Paint::hex(0xfffdf6), light / alpha);
    (pen(paint, n), alpha + (1.0 - alpha) * edge(n))
}
