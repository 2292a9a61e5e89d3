//! Strokes on iso-surfaces (Nagy, Schneider and Westermann, *Interactive Volume Illustration*, VMV 2002).
//!
//! Outlines are found anew for each camera ([HATCH-18]); whatever made them, strokes come to the page through [`Sight`],
//! which cuts off what is hidden ([HATCH-14]).

mod chain;
mod level;
mod outline;
mod project;
mod refine;
mod rim;
mod sight;
mod tetrahedra;
mod thin;

pub use outline::{Outlines, outlines};
pub use sight::{Pen, Seen, Sight};
