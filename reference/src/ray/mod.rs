//! Casting rays through the field.

mod cast;
mod cells;
mod draw;
mod gradient_range;
mod lanes;
pub mod lattice;
mod layers;
mod lit;
mod merged;
mod need;
pub mod opacity;
mod over_two;
mod prepare;
mod prepared;
mod render;
mod sample;
pub mod skip;
mod surface;

pub(crate) use gradient_range::{quantile_of_norms, touches as touches_mask};
pub use render::{Backdrop, Inputs, RenderError, Renderer};
