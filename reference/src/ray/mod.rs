//! Casting rays through the field.

mod cast;
mod gradient_range;
pub mod lattice;
mod layers;
pub mod opacity;
mod over_two;
mod prepared;
mod render;
mod sample;
pub mod skip;

pub use render::{Backdrop, Inputs, RenderError, Renderer};
