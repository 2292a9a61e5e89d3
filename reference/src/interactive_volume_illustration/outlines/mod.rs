//! Outlines of an iso-surface for a camera ([HATCH-18]), and its creases ([HATCH-22]).

mod box_intersection;
mod chain;
mod corners;
mod creases;
mod curve_refinement;
mod cusps;
mod facing;
mod iso_difference;
mod page;
mod search;
mod second_function;
mod section;
mod simplification;
mod tetrahedra;

pub use creases::{CreaseStrokes, creases};
pub use cusps::before_cusps;
pub use page::Outlines;
pub use search::{OutlineStrokes, outlines};
