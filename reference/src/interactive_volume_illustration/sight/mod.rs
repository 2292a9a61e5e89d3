//! Strokes on the page (4.3.2): projection, hidden parts, pens, dashes and gaps.

mod dashes;
mod gaps;
mod projection;
mod styled;
mod visibility;

pub use dashes::{dash_vertices, dashed};
pub use gaps::{GappedLines, gapped};
pub use styled::{StrokePoint, StyledStroke, drawn, grain};
pub use visibility::{PenState, Sight, VisibleLines};
