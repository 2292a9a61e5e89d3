//! Interactive volume illustration (Nagy, Schneider, Westermann 2002).
//!
//! [`Pyramid`] leads to the cells of an iso-surface, and [`Seeds`] are those of them that strokes begin in.

mod measures;
mod pyramid;
mod seeds;
mod spacing;

pub use measures::{Largest, Measure};
pub use pyramid::Pyramid;
pub use seeds::{SeedRule, Seeds};
pub use spacing::{Apart, spread};
