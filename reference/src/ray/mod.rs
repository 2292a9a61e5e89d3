//! Casting rays through the field.

mod cells;
mod composite;
mod draw;
mod gradient_range;
mod iso_surface;
mod lanes;
pub mod lattice;
mod merged;
pub mod opacity;
mod prepare;
mod prepared;
mod render;
mod sample;
pub mod skip;

pub use composite::{LayBehind, PlaneEffect, RayOnPlane, SampleOnPlane};
pub(crate) use gradient_range::{quantile_of_norms, touches as touches_mask};
pub use render::{Backdrop, Inputs, RenderError, Renderer};
pub use sample::SampleAttributes;
