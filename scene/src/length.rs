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
    /// Returns a length of [`World`](Self::World) or [`Voxels`](Self::Voxels) in world units; none for lengths on the
    /// page.
    pub fn world(self, grid: &Grid) -> Option<f64> {
        self.of_voxel(grid.voxel())
    }

    /// Like [`Length::world`], for voxels of the given length.
    pub fn of_voxel(self, voxel: f64) -> Option<f64> {
        match self {
            Self::World(length) => Some(length),
            Self::Voxels(n) => Some(n * voxel),
            Self::Millimetres(_) | Self::Pixels(_) | Self::Percent(_) => None,
        }
    }
}
