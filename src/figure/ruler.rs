//! Lengths of a figure, and its text in lines.

use super::ABOVE_TEXT;
use super::page_size::check_pixels;
use crate::Failure;
use drypoint_output::text::{font::extent, wrapped};
use drypoint_scene::glam::DVec2;
use drypoint_scene::marks::{INCH, Page};
use drypoint_scene::tables::{Figure, Length};

/// Lengths of a figure in mm and in pixels.
pub(super) struct Ruler {
    dpi: f64,
    /// Width of the figure in pixels.
    pub(super) width: usize,
    /// Width and height of a pixel, in mm.
    pub(super) pixel: DVec2,
}

/// Text in lines.
pub(super) struct TextBlock {
    pub(super) lines: Vec<String>,
    pub(super) size: f64,
    /// Height in pixels, with the space above it; 0 without text.
    pub(super) height: usize,
}

impl Ruler {
    /// # Errors
    /// More pixels than a picture may have.
    pub(super) fn new(figure: &Figure) -> Result<Self, Failure> {
        let ruler = Self { dpi: figure.figure.dpi, width: 1, pixel: DVec2::splat(INCH / figure.figure.dpi) };
        let mm = ruler.mm(figure.figure.width);
        check_pixels(figure, mm / INCH * ruler.dpi)?;
        let width = ruler.pixels(mm).max(1);
        // A width in mm is exact on the page, and pixels are stretched to fill it.
        Ok(Self { width, pixel: DVec2::new(mm / width as f64, ruler.pixel.y), ..ruler })
    }

    /// A length on the page in mm.
    pub(super) fn mm(&self, length: Length) -> f64 {
        Page::in_pixels([1, 1], 0.0, self.dpi).length(length).unwrap_or_default()
    }

    /// A length in whole pixels.
    pub(super) fn pixels(&self, mm: f64) -> usize {
        (mm / INCH * self.dpi).round_ties_even() as usize
    }

    /// Breaks text into lines of at most a width in pixels.
    pub(super) fn block(&self, text: &str, size: f64, width: usize) -> TextBlock {
        let lines = wrapped(text, size, width as f64 * self.pixel.x);
        let line = extent("", size);
        let mm = lines.len() as f64 * (line.ascent + line.descent) + ABOVE_TEXT * size;
        let height = if lines.is_empty() { 0 } else { (mm / self.pixel.y).ceil() as usize };
        TextBlock { lines, size, height }
    }
}
