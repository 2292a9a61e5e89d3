//! The background of a picture, loaded.

use crate::color::Rgba;

/// The background of a picture, linear.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Backdrop<'a> {
    /// Nothing.
    None,
    /// One straight colour.
    Color(Rgba),
    /// Premultiplied pixels of the picture's size, row by row from the top.
    Pixels(&'a [Rgba]),
}
