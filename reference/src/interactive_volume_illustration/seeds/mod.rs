//! Seeds of strokes (3.2, 4.1): the cells of a surface, their probabilities, and the places in them.

mod from_field;
mod measures;
mod page;
mod placement;
mod pyramid;
mod root_search;
mod selection;
mod without_iso;

pub use from_field::gradient_range;
pub use measures::{LargestMeasure, VoxelMeasure};
pub use page::seed_layers;
pub use placement::Seed;
pub use pyramid::Pyramid;
pub use selection::{SeedRule, Seeds};
