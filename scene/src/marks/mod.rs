//! Dots, lines, areas and text on a page, as plain data ([STIP-16], [IO-7]). Stippling, hatching and annotations make
//! them; PNG, SVG and PDF show them with the same geometry. Lists hold dots or lines.
//!
//! **Space.** The page has its origin in the upper left corner, x to the right, y down. Every length on it is in
//! millimetres, also if a scene counts in pixels. `picture.dpi` converts between the two, and [`Page::unit`] is the
//! unit in which a list is written.
//!
//! **Steps.** [`Marks::settle`] rounds a list to steps and clips it to the frame. The steps are 0.001 mm for places,
//! 0.005 mm for radii (0.001 mm if the scene counts in pixels), 1/16 for opacities, and 1/255 of sRGB for colours of
//! vertices. No writer rounds any further.
//!
//! **Order.** A layer has one pen, hence one colour, so the order of its marks cannot be seen. Lines whose vertices
//! have colours are the exception: they are drawn in their order, after the others. A layer's areas lie under its lines and
//! dots, and its text above them. Layers are drawn in their order.

mod area;
mod dot;
mod fewer;
pub mod frame;
mod loops;
mod outline;
mod page;
mod pen;
mod polyline;
mod round;
mod text;

pub use area::Area;
pub use dot::Dot;
pub use page::{INCH, Page, PageUnit};
pub use pen::Pen;
pub use polyline::{Piece, Polyline, Vertex, color_between};
pub use round::on_step;
pub use text::Text;

/// The numbers of dots and lines in layers.
pub fn mark_counts(layers: &[Layer]) -> [usize; 2] {
    let sum = |n: fn(&Layer) -> usize| layers.iter().map(n).sum();
    [sum(|layer| layer.dots.len()), sum(|layer| layer.lines.len())]
}

/// The dots and lines on a page.
#[derive(Clone, Debug, PartialEq)]
pub struct Marks {
    /// The paper.
    pub page: Page,
    /// The layers, from the lowest to the topmost.
    pub layers: Vec<Layer>,
}

/// The marks of one pen.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// The pen.
    pub pen: Pen,
    /// The dots.
    pub dots: Vec<Dot>,
    /// The lines.
    pub lines: Vec<Polyline>,
    /// The areas.
    pub areas: Vec<Area>,
    /// The text.
    pub texts: Vec<Text>,
}

impl Layer {
    /// A pen that has drawn nothing yet.
    pub fn new(pen: Pen) -> Self {
        Self { pen, dots: Vec::new(), lines: Vec::new(), areas: Vec::new(), texts: Vec::new() }
    }
}
