//! Outlines of an iso-surface for a camera ([HATCH-18]).

mod box_intersection;
mod chain;
mod curve_refinement;
mod iso_difference;
mod search;
mod section;
mod simplification;
mod tetrahedra;

pub use search::{OutlineStrokes, outlines};
