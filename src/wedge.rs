//! Step wedges: a page of patches of known tone, for printing and measuring ([STIP-17]).

use crate::Failure;
use drypoint_output::text::{CAP_HEIGHT, WEIGHT, strokes, width};
use drypoint_reference::volume_stippling::step_wedge::{candidates, density, even_dots};
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::marks::{Dot, Layer, Marks, Page, Pen, Polyline, Vertex};
use drypoint_scene::memory::{self, NoRoom};
use drypoint_scene::tone::Tone;
use std::fmt::Write as _;

/// Number of patches: 0, 0.05, … 0.9.
const PATCHES: usize = 19;

/// Number of patches in a row.
const ROW: usize = 5;

/// Bytes of memory for each candidate while dots are chosen.
const CANDIDATE: f64 = 400.0;

/// Height of capitals, in mm.
const LETTERS: f64 = 3.0;

/// Space around a patch, in mm.
const GAP: f64 = 4.0;

/// Least number of touching dots across a patch. A measurement is a mean over many dots.
const DOTS: f64 = 60.0;

/// A page with a step wedge, and the places of its patches.
#[derive(Clone, Debug)]
pub struct StepWedge {
    /// The page.
    pub marks: Marks,
    /// The patches in their order.
    pub patches: Vec<WedgePatch>,
}

/// A square of one tone.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WedgePatch {
    /// Wanted coverage.
    pub wanted: f64,
    /// The upper left corner, in mm on the page.
    pub corner: DVec2,
    /// Side, in mm.
    pub side: f64,
}

/// Returns the wanted tones.
pub fn steps() -> impl Iterator<Item = f64> {
    (0..PATCHES).map(|i| i as f64 / 20.0)
}

/// Draws a step wedge with a pen: evenly spread dots of its nib, as many as the tone asks for. Each patch has an
/// outline and its tone below. `page` gives margin and resolution; its size follows from the nib.
///
/// # Errors
/// A nib so wide that the page exceeds a metre, or so fine that the memory budget does not allow its dots.
pub fn wedge(pen: &Pen, tone: &Tone, page: &Page, seed: u64) -> Result<StepWedge, Failure> {
    let side = (DOTS * pen.width).max(15.0);
    let cell = DVec2::new(side + GAP, side + 2.0 * GAP + LETTERS);
    let rows = PATCHES.div_ceil(ROW);
    let title = GAP + LETTERS;
    let picture = DVec2::new(ROW as f64 * cell.x + GAP, title + rows as f64 * cell.y + GAP);
    if picture.max_element() > 1000.0 {
        let what = format!("a step wedge of a nib of {} mm would be {:.0} mm high", pen.width, picture.y);
        return Err(Failure::new(what, "pen.width", "take a finer pen"));
    }
    // The memory for the densest patch.
    let densest = steps().map(|wanted| density(tone, wanted, pen.width)).fold(0.0, f64::max);
    let candidates = candidates(side, densest);
    let too_fine = |no_room: NoRoom| {
        let what = format!("a step wedge of a nib of {} mm needs {no_room}", pen.width);
        // The number of candidates grows with the inverse square of the nib.
        let remedy = match no_room.enlarged(pen.width * pen.width) {
            Some(square) => format!("take a wider pen: one of {:.1e} mm would fit", 1.01 * square.sqrt()),
            None => "take a wider pen".into(),
        };
        Failure::new(what, "pen.width", remedy)
    };
    memory::room((candidates * CANDIDATE) as u64).map_err(too_fine)?;
    let page = Page::in_millimetres(picture, page.margin, page.dpi);
    let origin = DVec2::splat(page.margin);
    // The title, then each patch with outline and tone.
    let mut layer = Layer::new(pen.clone());
    let (letters, nib) = (Letters { width: pen.width }, pen.width);
    letters.write(&mut layer, &pen.label(), origin + DVec2::new(GAP, GAP + LETTERS));
    let mut patches = Vec::new();
    for (i, wanted) in steps().enumerate() {
        let place = DVec2::new((i % ROW) as f64, (i / ROW) as f64) * cell;
        let corner = origin + DVec2::new(GAP, title + GAP) + place;
        for at in even_dots(side, density(tone, wanted, nib), seed, i as u32) {
            layer.dots.push(Dot { at: corner + at, world: DVec3::ZERO, radius: 0.5 * nib, opacity: 1.0 });
        }
        // The outline lies outside the dots that overhang.
        let around = [DVec2::ZERO, DVec2::X, DVec2::ONE, DVec2::Y].map(|c| corner - nib + c * (side + 2.0 * nib));
        layer.lines.push(line(&around, nib, true));
        let label = format!("{wanted:.2}");
        let middle = 0.5 * (side - letters.width(&label));
        letters.write(&mut layer, &label, corner + DVec2::new(middle, side + 2.0 * nib + LETTERS + 1.0));
        patches.push(WedgePatch { wanted, corner, side });
    }
    let mut marks = Marks { page, layers: vec![layer] };
    marks.settle();
    Ok(StepWedge { marks, patches })
}

/// Returns the table to be filled in: a row for each patch.
pub fn template() -> String {
    let mut text = String::from("wanted,measured\n");
    for wanted in steps() {
        // Writing to a string does not fail.
        let _ = writeln!(text, "{wanted},");
    }
    text
}

/// Letters drawn with a pen.
struct Letters {
    width: f64,
}

impl Letters {
    /// Returns the size of a font unit in mm. A wide pen gets larger letters.
    fn scale(&self) -> f64 {
        (LETTERS / CAP_HEIGHT).max(0.5 * self.width / WEIGHT)
    }

    fn width(&self, text: &str) -> f64 {
        width(text) * self.scale()
    }

    /// Writes a line of text that begins at a point on the baseline.
    fn write(&self, layer: &mut Layer, text: &str, at: DVec2) {
        for stroke in strokes(text) {
            let vertices: Vec<DVec2> = stroke.iter().map(|&[x, y]| at + DVec2::new(x, -y) * self.scale()).collect();
            layer.lines.push(line(&vertices, self.width, false));
        }
    }
}

fn line(places: &[DVec2], width: f64, closed: bool) -> Polyline {
    let vertex = |(i, at): (usize, &DVec2)| {
        let t = i as f64 / (places.len() - 1).max(1) as f64;
        Vertex { at: *at, world: DVec3::ZERO, radius: 0.5 * width, opacity: 1.0, t, color: None }
    };
    Polyline { vertices: places.iter().enumerate().map(vertex).collect(), closed }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn pen(width: f64) -> Pen {
        Pen { number: 1, name: "black".into(), width, color: [0.0, 0.0, 0.0, 1.0] }
    }

    #[test]
    fn patches_lie_on_the_page_and_hold_their_dots() {
        let page = Page::in_millimetres(DVec2::ONE, 10.0, 300.0);
        for width in [0.1, 0.3, 1.0] {
            let found = wedge(&pen(width), &Tone::ideal(), &page, 1).unwrap();
            assert_eq!(found.patches.len(), 19);
            let size = found.marks.page.size;
            for patch in &found.patches {
                assert!(patch.corner.min_element() >= 10.0 && (patch.corner + patch.side).cmple(size - 10.0).all());
                let inside = |dot: &&Dot| {
                    let o = dot.at - patch.corner;
                    o.min_element() >= -1e-3 && o.max_element() <= patch.side + 1e-3
                };
                let ink = found.marks.layers[0].dots.iter().filter(inside).count() as f64 * 0.25 * PI * width * width;
                // Half of the 0.02 that a wedge may be off: dots that are chosen crowd at the border of the larger square
                // that they are chosen in, so that its middle has up to three hundredths fewer.
                let off = (Tone::ideal().coverage(ink / (patch.side * patch.side)) - patch.wanted).abs();
                assert!(off <= 0.01, "{}: {off}, {width}", patch.wanted);
            }
        }
        assert!(wedge(&pen(9.0), &Tone::ideal(), &page, 1).is_err());
    }

    #[test]
    fn the_table_has_a_row_a_patch() {
        let text = template();
        assert!(text.starts_with("wanted,measured\n0,\n0.05,\n0.1,\n0.15,\n") && text.ends_with("0.9,\n"), "{text}");
        assert_eq!(text.lines().count(), 20);
    }
}
