//! The line that an annotation is drawn with.

use crate::color::Rgba;
use crate::tables::Length;

/// Colour and width of a line, or its pen.
#[derive(Clone, Debug, PartialEq)]
pub struct LineStyle {
    /// The colour: linear, straight.
    pub color: Rgba,
    /// The width, on the page.
    pub width: Length,
    /// The pen of `[[pen]]` in their place, by name.
    pub pen: Option<String>,
}

impl LineStyle {
    /// A black line of a width in mm.
    pub(super) const fn black(mm: f64) -> Self {
        Self { color: [0.0, 0.0, 0.0, 1.0], width: Length::Millimetres(mm), pen: None }
    }
}
