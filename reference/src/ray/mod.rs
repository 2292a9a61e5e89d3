//! Casting rays through the field.

pub mod bounds;
pub mod brick_occupancy;
mod cell_mask;
mod clipped_samples;
mod composite;
mod draw;
mod error;
mod lanes;
pub mod lattice;
mod line_point;
mod measure;
mod merged;
pub mod opacity;
mod pick;
mod pixel_sum;
mod prepare;
mod prepare_object;
mod prepared;
mod prepared_combination;
mod prepared_halos;
mod prepared_meshes;
mod prepared_seeds;
mod prepared_surface;
mod progress;
mod refinement;
mod render;
mod sample;
mod tile_work;

pub use error::RenderError;
pub use line_point::LinePoint;
pub use measure::measure;
pub use pick::{Picked, VISIBLE};
pub use prepare::within_planes;
pub use render::Renderer;
