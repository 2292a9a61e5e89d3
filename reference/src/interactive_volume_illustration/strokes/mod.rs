//! Strokes along the lines of curvature (4.2): integration, polylines, and compact storage.

mod counts;
mod growth;
pub mod integrator;
mod normal_cone;
mod packed;
mod polyline;
mod stroke_field;

pub use counts::{DirectionCounts, HatchCounts, NoDirection, RejectCause, RejectCounts, StrokeEnd, StrokeEnds};
#[cfg(test)]
pub(super) use growth::CurvatureLines;
pub use growth::{CurvatureFamily, GrownStrokes, HatchParams, StrokeGrower};
pub use normal_cone::NormalCone;
pub use packed::PackedStrokes;
pub use stroke_field::StrokeField;
pub(super) use stroke_field::{inside, normal};
