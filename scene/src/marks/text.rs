//! Lines of text.

use glam::DVec2;

/// A line of text on the page, in the colour of its pen.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// The characters, without line breaks.
    pub characters: String,
    /// The start of the baseline, in mm, y down.
    pub at: DVec2,
    /// The size of the font's em, in mm.
    pub size: f64,
    /// The opacity in (0, 1]. It multiplies the opacity of the pen's colour.
    pub opacity: f64,
}
