//! Strokes on the page (4.3.2): projection, hidden parts, pens, dashes, gaps and joints.

mod dashes;
mod gaps;
mod joining;
mod projection;
mod styled;
mod visibility;

pub use dashes::{dash_vertices, dashed};
pub use gaps::{GappedLines, cut_gaps, gapped, without_doubles};
pub use joining::{Joining, joined};
pub use projection::largest_scale;
pub use styled::{StrokePoint, StyledStroke, drawn, grain};
pub use visibility::{PenState, Sight, VisibleLines};
