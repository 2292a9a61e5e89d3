//! Lengths with their units ([SPACE-5], [SCN-2]).

use crate::space::Grid;

/// A length as a scene gives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Length {
    /// World units.
    World(f64),
    /// Times the smallest spacing of `[volume]`.
    Voxels(f64),
    /// Millimetres on the page.
    Millimetres(f64),
    /// Pixels of the picture.
    Pixels(f64),
    /// Per cent of the picture's height.
    Percent(f64),
}

impl Length {
    /// The length in world units, for the two units that have a length in the world; none for the others.
    pub fn world(self, grid: &Grid) -> Option<f64> {
        self.of_voxel(grid.voxel())
    }

    /// The length in world units where a voxel is so long, as [`Length::world`].
    pub fn of_voxel(self, voxel: f64) -> Option<f64> {
        match self {
            Self::World(length) => Some(length),
            Self::Voxels(n) => Some(n * voxel),
            Self::Millimetres(_) | Self::Pixels(_) | Self::Percent(_) => None,
        }
    }
}
