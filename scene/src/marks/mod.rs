//! Points and lines on a page, as plain data ([STIP-16], [IO-7]): what stippling and hatching make, and what PNG, SVG,
//! PDF and lists all show with the same geometry.
//!
//! **Space.** The page has its origin in the upper left corner, x to the right, y down. Every length on it is in
//! millimetres, also where a scene counts in pixels: `picture.dpi` turns one into the other, and [`Page::unit`] only says
//! in which of the two a list is written.
//!
//! **Steps.** [`Marks::settle`] puts a list onto steps and into the frame: places 0.001 mm, radii 0.005 mm (0.001 mm where the scene counts
//! in pixels), opacities 1/16, colours of vertices 1/255 of sRGB. No writer rounds any further.
//!
//! **Order.** A layer has one pen, hence one colour, so that the order of what is drawn in it cannot be seen, but for lines
//! whose vertices have colours: those are drawn in their order, after the others. Layers are drawn in their order.

mod dot;
mod fewer;
pub mod frame;
mod loops;
mod outline;
mod page;
mod pen;
mod polyline;
mod round;

pub use dot::Dot;
pub use page::{INCH, Page, PageUnit};
pub use pen::Pen;
pub use polyline::{Piece, Polyline, Vertex, color_between};
pub use round::on_step;

/// All that is drawn on a page.
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
}

impl Layer {
    /// A pen that has drawn nothing yet.
    pub fn new(pen: Pen) -> Self {
        Self { pen, dots: Vec::new(), lines: Vec::new() }
    }
}
