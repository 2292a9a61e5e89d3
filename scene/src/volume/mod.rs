//! Volumes: voxels in the file's own type on a [`Grid`]. Voxels that are not finite are filled and masked.

// First, since the macro that it defines is known only to what follows.
#[macro_use]
mod voxels;

pub mod bricked;
mod bricks;
mod bytes;
pub mod histogram;
pub mod info;
pub mod labels;
mod mask;
pub mod parts;
pub mod quantile;
mod raw_layout;
pub mod read;
mod selection;
mod shown;
mod subset;
mod value_box;
pub mod write;

pub use bricks::{BRICK, BrickRow, Bricks};
pub use mask::Mask;
pub use raw_layout::RawLayout;
pub use selection::Selection;
pub use shown::ShownValues;
pub use subset::{KeptVoxels, NotInVolume, Subset};
pub use value_box::selected_by_value;
pub use voxels::{Access, Linear, Voxel, VoxelType, Voxels};

use crate::parallel;
use crate::space::Grid;
use glam::DVec3;

/// Anatomical directions of the world axes, as far as a file names them ([SPACE-2]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anatomy {
    /// x to the left, y to posterior, z to superior (NRRD, MetaImage, DICOM).
    LeftPosteriorSuperior,
    /// x to the left, y to anterior, z to superior (NRRD).
    LeftAnteriorSuperior,
    /// x to the right, y to anterior, z to superior (NIfTI).
    RightAnteriorSuperior,
}

impl Anatomy {
    /// Every anatomical space that a volume can name.
    pub const ALL: [Self; 3] = [Self::LeftPosteriorSuperior, Self::LeftAnteriorSuperior, Self::RightAnteriorSuperior];

    /// The name in words, as in the field `space` of NRRD.
    pub fn name(self) -> &'static str {
        match self {
            Self::LeftPosteriorSuperior => "left-posterior-superior",
            Self::LeftAnteriorSuperior => "left-anterior-superior",
            Self::RightAnteriorSuperior => "right-anterior-superior",
        }
    }

    /// The three initials: `LPS`, `LAS`, `RAS`.
    pub fn initials(self) -> &'static str {
        match self {
            Self::LeftPosteriorSuperior => "LPS",
            Self::LeftAnteriorSuperior => "LAS",
            Self::RightAnteriorSuperior => "RAS",
        }
    }

    /// Signs of the directions of x and y; z is superior in all of these spaces.
    fn signs(self) -> DVec3 {
        match self {
            Self::LeftPosteriorSuperior => DVec3::ONE,
            Self::LeftAnteriorSuperior => DVec3::new(1.0, -1.0, 1.0),
            Self::RightAnteriorSuperior => DVec3::new(-1.0, -1.0, 1.0),
        }
    }

    /// Converts a grid from one world to another ([SPACE-2]): axes that point the other way are flipped. If one of the
    /// worlds has no name, the grid is unchanged.
    pub fn between(grid: &Grid, from: Option<Self>, to: Option<Self>) -> Grid {
        match (from, to) {
            (Some(from), Some(to)) => grid.flipped(from.signs() * to.signs()),
            _ => grid.clone(),
        }
    }
}

/// A scalar field sampled on a grid. A value is `slope · stored + intercept` ([VAL-1]).
#[derive(Clone, Debug)]
pub struct Volume {
    grid: Grid,
    voxels: Voxels,
    slope: f64,
    intercept: f64,
    mask: Option<Mask>,
    range: [f64; 2],
    anatomy: Option<Anatomy>,
}

/// A fault that makes a volume impossible.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum VolumeError {
    /// The grid and the voxels disagree.
    #[error("{found} voxels, but the dims {dims:?} need {expected}")]
    Length {
        /// Voxels along x, y, z.
        dims: [usize; 3],
        /// The product of the dims.
        expected: usize,
        /// Voxels that were given.
        found: usize,
    },
    /// A volume without a finite value.
    #[error("no voxel has a finite value")]
    NothingFinite,
    /// Slope and intercept that are not finite, or a slope of 0, or values that overflow.
    #[error("slope {slope} and intercept {intercept} leave no range of finite values")]
    Scaling {
        /// The slope in the file.
        slope: f64,
        /// The intercept in the file.
        intercept: f64,
    },
}

impl Volume {
    /// Places voxels (x fastest) on a grid. Voxels that are NaN or ±∞ get the value of the nearest valid one and a bit
    /// in the mask ([PREC-2]).
    ///
    /// # Errors
    /// A wrong number of voxels, no finite voxel, or a scaling that is not invertible.
    pub fn new(grid: Grid, voxels: Voxels, slope: f64, intercept: f64) -> Result<Self, VolumeError> {
        if voxels.len() != grid.len() {
            return Err(VolumeError::Length { dims: grid.dims(), expected: grid.len(), found: voxels.len() });
        }
        if !(slope.is_finite() && intercept.is_finite() && slope != 0.0) {
            return Err(VolumeError::Scaling { slope, intercept });
        }
        let mut voxels = voxels;
        let mask = mask::fill_invalid(&mut voxels, grid.dims())?;
        let [a, b] = voxels.range().map(|v| slope * v + intercept);
        if !(a.is_finite() && b.is_finite()) {
            return Err(VolumeError::Scaling { slope, intercept });
        }
        Ok(Self { grid, voxels, slope, intercept, mask, range: [a.min(b), a.max(b)], anatomy: None })
    }

    /// Sets the anatomical space that the volume's file names.
    pub fn with_anatomy(self, anatomy: Option<Anatomy>) -> Self {
        Self { anatomy, ..self }
    }

    /// A volume on the same grid: 1 where the value is above 0, and 0 elsewhere. Volumes of labels are drawn as this
    /// mask.
    pub fn present(&self) -> Self {
        let (slope, intercept) = (self.slope, self.intercept);
        let dims = self.dims();
        let mut present = vec![0; self.voxels.len()];
        with_access!(self, |access| parallel::chunks_mut(&mut present, dims[0], &|row, present| {
            let (y, z) = (row % dims[1], row / dims[1]);
            for (x, present) in present.iter_mut().enumerate() {
                *present = u8::from(slope * access.at(x, y, z).to_f64() + intercept > 0.0);
            }
        }));
        let voxels = Voxels::U8(present);
        let range = voxels.range();
        Self { grid: self.grid.clone(), voxels, slope: 1.0, intercept: 0.0, mask: self.mask.clone(), range, ..*self }
    }

    /// Gives some voxels the least value of the volume, or the greatest. Slope, range and mask stay.
    fn flatten(&mut self, is_flat: &(dyn Fn(usize) -> bool + Sync), to_highest: bool) {
        // A negative slope turns the order of the stored numbers round.
        let highest = to_highest == (self.slope > 0.0);
        self.voxels.flatten(is_flat, highest);
    }

    /// The grid of the voxels.
    #[inline]
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Voxels along x, y, z.
    #[inline]
    pub fn dims(&self) -> [usize; 3] {
        self.grid.dims()
    }

    /// The stored voxels, x fastest.
    #[inline]
    pub fn voxels(&self) -> &Voxels {
        &self.voxels
    }

    /// Value = slope · stored + intercept.
    #[inline]
    pub fn slope(&self) -> f64 {
        self.slope
    }

    /// Value = slope · stored + intercept.
    #[inline]
    pub fn intercept(&self) -> f64 {
        self.intercept
    }

    /// The voxels that were NaN or ±∞ in the file, if there was one.
    #[inline]
    pub fn mask(&self) -> Option<&Mask> {
        self.mask.as_ref()
    }

    /// Whether the file stores integers ([REC-3]).
    pub fn is_integer(&self) -> bool {
        self.voxels.voxel_type().is_integer()
    }

    /// Lowest and highest finite value, after slope and intercept.
    pub fn range(&self) -> [f64; 2] {
        self.range
    }

    /// The largest |value|, which sets the scales of [SPACE-4] and [PREC-3].
    pub fn largest_magnitude(&self) -> f64 {
        self.range[0].abs().max(self.range[1].abs())
    }

    /// The anatomical space that the file names.
    pub fn anatomy(&self) -> Option<Anatomy> {
        self.anatomy
    }

    /// The value at a voxel, after slope and intercept.
    ///
    /// # Panics
    /// If the voxel lies outside the grid.
    #[inline]
    pub fn value(&self, voxel: [usize; 3]) -> f64 {
        self.slope * self.stored(voxel) + self.intercept
    }

    /// The stored number of a voxel.
    ///
    /// # Panics
    /// If the voxel lies outside the grid.
    #[inline]
    pub fn stored(&self, [x, y, z]: [usize; 3]) -> f64 {
        let [nx, ny, _] = self.dims();
        self.voxels.get((z * ny + y) * nx + x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_above_zero_is_present() {
        // Values 2·stored − 3: −3, −1, 1, 3.
        let grid = Grid::with_spacing([2, 2, 1], [1.0; 3]).unwrap();
        let volume = Volume::new(grid.clone(), Voxels::I16(vec![0, 1, 2, 3]), 2.0, -3.0).unwrap();
        let present = volume.with_anatomy(Some(Anatomy::RightAnteriorSuperior)).present();
        assert_eq!(present.voxels(), &Voxels::U8(vec![0, 0, 1, 1]));
        assert_eq!((present.range(), present.value([1, 1, 0])), ([0.0, 1.0], 1.0));
        assert_eq!(present.anatomy(), Some(Anatomy::RightAnteriorSuperior));
        // A volume of 0 and 1 is its own `present`.
        assert_eq!(present.present().voxels(), present.voxels());
        // The mask of what was not finite stays.
        let holes = Volume::new(grid, Voxels::F32(vec![1.0, f32::NAN, 0.0, -1.0]), 1.0, 0.0).unwrap().present();
        assert_eq!(holes.mask().map(Mask::count), Some(1));
    }
}
