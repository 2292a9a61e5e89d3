//! Integral curves of fields of lines: steps with error control, the cubics between them, and chords of these cubics
//! ([HATCH-4], [HATCH-8], [HATCH-10]).

mod chords;
mod cubic_segment;
mod trace;

pub use chords::{point, vertices};
pub use cubic_segment::CubicSegment;
pub use trace::{Control, EndCause, Goal, HalfCurve, LineField, trace};
