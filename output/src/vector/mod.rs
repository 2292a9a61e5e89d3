//! Vector files of marks ([IO-7], [STIP-16]): SVG and PDF, from the same groups of the same numbers.

mod apart;
mod base64;
mod curves;
mod decimals;
mod fit;
mod groups;
pub mod pdf;
pub mod svg;

use drypoint_scene::color::{Rgba, linear_to_srgb};
use drypoint_scene::marks::Marks;
use drypoint_scene::picture::{Picture, Provenance};

/// What a vector file shows: marks on their steps ([`Marks::round`]), and what lies behind them.
#[derive(Clone, Copy, Debug)]
pub struct Sheet<'a> {
    /// Drawn layer by layer.
    pub marks: &'a Marks,
    /// Paint over the whole page, linear, straight; none where the paper's own colour is meant. Its layer's label begins
    /// with `%`, so that no plotter draws it.
    pub background: Option<Rgba>,
    /// A rendered picture, whose `beauty` fills the frame; its layer's label begins with `%` too.
    pub picture: Option<&'a Picture>,
    /// Whether the marks are what a plotter will draw, in that order: each dot a stroke of its own.
    pub plotter: bool,
    /// Whether lines and outlines are cubic Béziers, smooth through their points ([HATCH-10]): within 0.005 mm of what their
    /// chords stand for, and corners stay.
    pub beziers: bool,
    /// Written into the file.
    pub provenance: &'a Provenance,
}

/// Red, green and blue of a linear colour as sRGB bytes, which is what both formats have.
fn bytes([r, g, b, _]: Rgba) -> [u8; 3] {
    [r, g, b].map(|c| crate::encode::quantize(linear_to_srgb(c).clamp(0.0, 1.0), 255) as u8)
}
