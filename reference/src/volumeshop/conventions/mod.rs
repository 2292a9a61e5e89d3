//! Artistic conventions (6.3, [VS-8]): the curves of boxes, arrows and fans in a picture.
//!
//! Points of a picture are in pixels from the top left corner, x to the right, y down.

mod arrow;
mod bounding_box;
mod fan;

pub use arrow::ArrowCurve;
pub use bounding_box::{edge_points, edges};
pub use fan::Fan;

use drypoint_scene::glam::DVec2;

/// A point of a curve in a picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurvePoint {
    /// The point of the picture, in pixels.
    pub at: DVec2,
    /// Eye depth.
    pub depth: f64,
}
