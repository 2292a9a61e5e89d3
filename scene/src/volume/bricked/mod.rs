//! Volumes in shared bricks ([VS-1]): an index table over bricks of [`SIDE`]³ voxels. Equal bricks are stored once, and a
//! modification replaces the bricks that it changes.

mod brick;
mod census;
mod history;
mod pool;
mod table;

pub use brick::{Brick, SIDE};
pub use census::BrickCensus;
pub use history::History;
pub use table::{BrickTable, BrickedVolume};

#[cfg(test)]
mod tests;
