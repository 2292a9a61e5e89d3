//! The picture of an intersection transfer function ([VS-4]): colours over two values.

/// The most pixels along a side.
pub const MOST_SIDE: usize = 4096;

/// A picture over two values. Columns, from the left, stand for the value at p. Rows, from the bottom, stand for the
/// value at T p.
#[derive(Clone, Debug, PartialEq)]
pub struct IntersectionPicture {
    /// Pixels across and down.
    pub size: [usize; 2],
    /// Linear straight colour and opacity, row by row from the top.
    pub pixels: Vec<[f64; 4]>,
    /// Whether the file has opacities, which replace those of the preset.
    pub has_opacity: bool,
}
