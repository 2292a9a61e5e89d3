//! Volume painting (6.1, [VS-6]). Brushes, region growing and watershed change the memberships of a selection at voxels
//! that the transfer function shows.

mod brush;
mod flood;
mod painter;
mod region;

pub use brush::{composed, membership};
pub use flood::{Marker, basins};
pub use painter::{Dab, Growth, PaintError, Painted, Painter, Seed};
pub use region::{VoxelSet, grown};

#[cfg(test)]
mod tests;
