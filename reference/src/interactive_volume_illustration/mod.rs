//! Interactive volume illustration (Nagy, Schneider, Westermann 2002): lines on iso-surfaces.
//!
//! [`Pyramid`] leads to the cells of an iso-surface, [`Seeds`] are those of them that strokes begin in. [`outlines`] are found
//! anew for each camera. [`Sight`] brings strokes to the page, without what is hidden, and [`spread`] keeps them apart there.

mod chain;
mod level;
mod measures;
mod outline;
mod project;
mod pyramid;
mod refine;
mod rim;
mod seeds;
mod sight;
mod spacing;
mod tetrahedra;
mod thin;

pub use measures::{Largest, Measure};
pub use outline::{Outlines, outlines};
pub use pyramid::Pyramid;
pub use seeds::{SeedRule, Seeds};
pub use sight::{Pen, Seen, Sight};
pub use spacing::{Apart, spread};
