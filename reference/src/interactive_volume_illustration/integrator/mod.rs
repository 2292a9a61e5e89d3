//! Curves along fields of lines, of any kind: steps that keep an error, the cubics between them, and chords of those
//! ([HATCH-4], [HATCH-8], [HATCH-10]).

mod chords;
mod piece;
mod trace;

pub use chords::{point, vertices};
pub use piece::Piece;
pub use trace::{Control, End, Goal, Half, Lines, trace};
