//! Vector files of marks ([IO-7], [STIP-16]): SVG and PDF, from the same groups of numbers.

mod base64;
mod curves;
mod decimals;
mod disjoint_dots;
mod fit;
mod groups;
pub mod pdf;
mod pdf_text;
pub mod svg;
mod svg_text;

use drypoint_scene::color::Rgba;
use drypoint_scene::marks::Marks;
use drypoint_scene::picture::{Picture, Provenance};

/// Contents of a vector file: rounded marks ([`Marks::round`]) and what lies behind them.
#[derive(Clone, Copy, Debug)]
pub struct VectorPage<'a> {
    /// Marks, drawn layer by layer.
    pub marks: &'a Marks,
    /// Linear straight colour of the whole page; none: the paper's own. Its layer's label begins with `%`, so that no
    /// plotter draws it.
    pub background: Option<Rgba>,
    /// Rendered picture whose `beauty` fills the frame. Its layer's label begins with `%`, too.
    pub picture: Option<&'a Picture>,
    /// Whether the marks are a plotter's plan, in drawing order. Each dot is then a stroke of its own.
    pub plotter: bool,
    /// Whether lines and outlines are smooth cubic Béziers through their points ([HATCH-10]). They stay within 0.005 mm
    /// of the curves behind the chords, and corners stay.
    pub beziers: bool,
    /// Whether text is written as the outlines of its letters. If not, it is text that viewers search and select.
    pub outlined: bool,
    /// Provenance, written into the file.
    pub provenance: &'a Provenance,
}
