//! A drawing in watercolour: pencil beneath, glazes of one pigment and of a shadow colour over it, and a line of the
//! pen around.

use super::super::light::{self, KEY, dab, edge, radius, smoothstep};
use super::super::noise::{Draw, fractal, on_form};
use super::super::paint::{Linear, Paint};
use super::super::stroke::Hatching;
use super::super::wash::{Wash, as_paint, paper, under};
use drypoint_reference::number::Vec3;

/// The paper of the notebook: old rag, cream.
pub(super) const PAPER: u32 = 0xfaf3e2;

/// Iron-gall ink, brown with age.
pub(super) const INK: u32 = 0x2a1a12;

/// How dark a place is drawn, in [0, 1].
pub(super) fn darkness(n: Vec3<f64>) -> f64 {
    light::darkness(n, 0.28, 0.45)
}

/// What one material looks like as a tinted drawing.
pub(super) struct Tinted {
    /// The pigment as it looks at density 1 on white.
    pub(super) pigment: u32,
    /// How much of it there is.
    pub(super) load: f64,
    /// The pigment of the shadow.
    pub(super) shadow: u32,
    /// What the wet border of the light was touched with, and how much: the two run into each other.
    pub(super) warm: (u32, f64),
    /// How wet: how much paper is left bare where light glances.
    pub(super) bare: f64,
    /// How much pencil shows.
    pub(super) pencil: f64,
    /// How unevenly the pigment lies.
    pub(super) mottle: f64,
}

impl Tinted {
    /// The colour at a normal.
    pub(super) fn paint(&self, n: Vec3<f64>) -> Paint {
        let (x, y) = on_form(n);
        let local = Wash { glazes: [(1.40, 0.26), (0.66, 0.30), (0.20, 0.40)], soft: 0.13, edge: 0.16, grain: 0.14 };
        let shade = Wash { glazes: [(0.22, 0.20), (-0.08, 0.24), (-0.36, 0.10)], soft: 0.13, edge: 0.20, grain: 0.20 };
        let mottle = 1.0 + self.mottle * fractal(6.0 * x + 9.0, 6.0 * y, 3, Draw::Mottle);
        let covered = 1.0 - self.bare * bare(n);
        let mut sheet: Linear = paper(n, PAPER);
        sheet = under(sheet, self.pigment, self.load * local.density(n) * mottle * covered);
        let lit = n.dot(KEY);
        let touched = smoothstep(0.95, 0.45, lit)
            * smoothstep(-0.25, 0.25, lit)
            * (1.0 + 0.8 * fractal(2.0 * x, 2.0 * y + 4.0, 2, Draw::Pool));
        sheet = under(sheet, self.warm.0, self.warm.1 * touched.max(0.0));
        sheet = under(sheet, self.shadow, 0.9 * shade.density(n));
        let strokes = Hatching { axis: Vec3::new(0.62, 0.74, 0.26), lines: 27.0, stray: 0.7, soft: 0.3 };
        let pressure = (0.55 + 0.9 * fractal(3.1 * x + 6.0, 3.1 * y, 2, Draw::Pressure)).clamp(0.0, 1.0);
        let pencil = strokes.coverage(n, 0.6 * darkness(n)) * smoothstep(0.20, 0.7, darkness(n)) * pressure;
        sheet = under(sheet, 0x7a7069, self.pencil * pencil);
        pen(as_paint(sheet), n)
    }
}

/// Where paper is left bare for the light: a stroke with ragged ends.
pub(super) fn bare(n: Vec3<f64>) -> f64 {
    let (x, y) = on_form(n);
    let ragged = 0.35 * fractal(5.0 * x, 5.0 * y, 2, Draw::Hand);
    (dab(n, 0.57, 0.095, 0.52, 0.30 + ragged.abs()) * (1.0 + ragged)).clamp(0.0, 1.0)
}

/// The pen's line around `paint`, which swells in the shade and all but lifts in the light.
pub(super) fn pen(paint: Paint, n: Vec3<f64>) -> Paint {
    let light = smoothstep(0.1, 0.95, n.dot(KEY));
    let line = Paint::hex(INK).over(Paint::hex(0x6b4a30), 0.55 * light);
    let inside = 0.28 * smoothstep(0.78, 0.95, radius(n)) * (1.0 - light);
    paint.over(Paint::hex(INK), inside).over(line, edge(n))
}
