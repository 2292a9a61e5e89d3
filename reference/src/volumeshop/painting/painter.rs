//! Strokes that change a selection: dabs of a brush, grown regions and basins of a watershed ([VS-6]).

use super::brush::{composed, membership};
use super::flood::{Marker, basins};
use super::region::grown;
use crate::field::{Field, FieldError, Reconstruction, Rung, Sampler};
use drypoint_scene::glam::DVec3;
use drypoint_scene::memory::NoRoom;
use drypoint_scene::tables::{Brush, Connectivity, PaintMode};
use drypoint_scene::volume::{Selection, ShownValues, Volume};

/// One dab of a brush.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dab {
    /// A point of the world. The brush is centred at the nearest voxel.
    pub at: DVec3,
    /// Radius in world units.
    pub radius: f64,
    /// Shape.
    pub brush: Brush,
    /// The change of the memberships.
    pub mode: PaintMode,
}

/// A region to grow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Growth {
    /// A point of the world. The seed is the nearest voxel.
    pub at: DVec3,
    /// The largest difference from the seed's value.
    pub tolerance: f64,
    /// The voxels that count as neighbours.
    pub connect: Connectivity,
    /// The change of the memberships.
    pub mode: PaintMode,
}

/// A seed of a watershed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Seed {
    /// A point of the world. The marker is the nearest voxel.
    pub at: DVec3,
    /// The change of the memberships in the seed's basin.
    pub mode: PaintMode,
}

/// The extent of a stroke.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Painted {
    /// Number of shown voxels that the stroke covers.
    pub voxels: usize,
    /// Number of bricks whose memberships changed.
    pub bricks: usize,
}

/// Errors of strokes.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PaintError {
    /// A seed lies outside the volume. The field is the seed's index.
    #[error("the seed lies outside the volume")]
    Outside(usize),
    /// The transfer function does not show a seed's voxel. The field is the seed's index.
    #[error("the transfer function does not show the seed's voxel")]
    Hidden(usize),
    /// The budget does not allow the memory.
    #[error("{0}")]
    NoRoom(NoRoom),
    /// The volume has no gradient.
    #[error("{0}")]
    Field(FieldError),
}

impl From<NoRoom> for PaintError {
    fn from(no_room: NoRoom) -> Self {
        Self::NoRoom(no_room)
    }
}

/// The painter of selections of a volume.
pub struct Painter<'a> {
    volume: &'a Volume,
    shown: ShownValues<'a>,
}

impl<'a> Painter<'a> {
    /// Prepares painting onto voxels with values for which `is_shown` holds. Voxels that are not finite in the file are
    /// never painted.
    pub fn new(volume: &'a Volume, is_shown: &'a (dyn Fn(f64) -> bool + Sync)) -> Self {
        Self { volume, shown: ShownValues::new(volume, is_shown) }
    }

    /// Dabs a brush onto a selection of the volume. The brush need not lie in the volume.
    ///
    /// # Errors
    /// The budget does not allow the memory.
    pub fn dab(&self, selection: &mut Selection, dab: &Dab) -> Result<Painted, NoRoom> {
        let grid = self.volume.grid();
        let centre = nearest_voxel(grid.to_index(dab.at));
        // Half the sides of the box about the brush, in index space. The brush is a ball or a box of the world.
        let rows = grid.inverse_axes().transpose();
        let reach = [rows.x_axis, rows.y_axis, rows.z_axis].map(|row| match dab.brush {
            Brush::Gaussian | Brush::Ball => row.length(),
            Brush::Box => row.abs().element_sum(),
        });
        // A margin for rounding. The membership decides at the brush's border.
        let reach = DVec3::from_array(reach) * dab.radius * (1.0 + 1e-9);
        let last = DVec3::from_array(grid.dims().map(|n| (n - 1) as f64));
        let (lo, hi) = ((centre - reach).ceil().max(DVec3::ZERO), (centre + reach).floor().min(last));
        if !lo.cmple(hi).all() {
            return Ok(Painted::default());
        }
        let (first, end) = (lo.to_array().map(|i| i as usize), hi.to_array().map(|i| i as usize + 1));
        let mut voxels = 0;
        let bricks = selection.memberships.modify(first, end, |voxel, f| {
            let offset = grid.axes() * (DVec3::from_array(voxel.map(|i| i as f64)) - centre);
            match membership(dab.brush, offset, dab.radius) {
                Some(b) if self.shows(voxel) => {
                    voxels += 1;
                    composed(dab.mode, f, b)
                }
                _ => f,
            }
        })?;
        Ok(Painted { voxels, bricks })
    }

    /// Paints a region that grows from a seed over shown voxels of similar value.
    ///
    /// # Errors
    /// A seed is hidden or lies outside the volume, or the budget does not allow the memory.
    pub fn grow(&self, selection: &mut Selection, growth: &Growth) -> Result<Painted, PaintError> {
        let seed = self.seed(growth.at, 0)?;
        let (dims, value) = (self.volume.dims(), self.volume.value(seed));
        let region = grown(dims, seed, growth.connect, |voxel| {
            (self.volume.value(voxel) - value).abs() <= growth.tolerance && self.shows(voxel)
        })?;
        let [first, end] = region.bounds();
        let change = |voxel, f| if region.has(voxel) { composed(growth.mode, f, 1.0) } else { f };
        let bricks = selection.memberships.modify(first, end, change)?;
        Ok(Painted { voxels: region.count(), bricks })
    }

    /// Paints the basins of seeds. The relief is the gradient magnitude by central differences. Hidden voxels are
    /// walls.
    ///
    /// # Errors
    /// A seed is hidden or lies outside the volume, or the budget does not allow the memory.
    pub fn watershed(&self, selection: &mut Selection, seeds: &[Seed]) -> Result<Painted, PaintError> {
        let field = Field::<f64>::new(self.volume, Reconstruction::default(), Rung::Gradient);
        let field = field.map_err(PaintError::Field)?;
        // Squares have the same order as magnitudes.
        self.watershed_over(selection, seeds, &mut |voxel| {
            let gradient = field.voxel_gradient(voxel);
            gradient.dot(gradient)
        })
    }

    /// Paints the basins of seeds over a relief. Hidden voxels are walls.
    ///
    /// # Errors
    /// A seed is hidden or lies outside the volume, or the budget does not allow the memory.
    fn watershed_over(
        &self,
        selection: &mut Selection,
        seeds: &[Seed],
        relief: &mut dyn FnMut([usize; 3]) -> f64,
    ) -> Result<Painted, PaintError> {
        let mut markers = Vec::new();
        for (i, seed) in seeds.iter().enumerate() {
            markers.push(Marker { voxel: self.seed(seed.at, i)?, basin: i as u32 + 1 });
        }
        let dims = self.volume.dims();
        let basins = basins(dims, &markers, &|voxel| self.shows(voxel), relief)?;
        let voxels = basins.iter().filter(|&&basin| basin > 0).count();
        let change = |[x, y, z]: [usize; 3], f| match basins[(z * dims[1] + y) * dims[0] + x].checked_sub(1) {
            Some(seed) => composed(seeds[seed as usize].mode, f, 1.0),
            None => f,
        };
        let bricks = selection.memberships.modify([0; 3], dims, change)?;
        Ok(Painted { voxels, bricks })
    }

    /// The voxel of a seed.
    fn seed(&self, at: DVec3, place: usize) -> Result<[usize; 3], PaintError> {
        let index = nearest_voxel(self.volume.grid().to_index(at));
        let last = DVec3::from_array(self.volume.dims().map(|n| (n - 1) as f64));
        if !(index.cmpge(DVec3::ZERO).all() && index.cmple(last).all()) {
            return Err(PaintError::Outside(place));
        }
        let voxel = index.to_array().map(|i| i as usize);
        if self.shows(voxel) { Ok(voxel) } else { Err(PaintError::Hidden(place)) }
    }

    /// Whether a voxel is shown.
    fn shows(&self, voxel: [usize; 3]) -> bool {
        self.shown.has(self.volume.stored(voxel)) && !self.volume.mask().is_some_and(|mask| mask.voxel(voxel))
    }
}

/// The voxel nearest to a position. Of two at equal distance, it is the one with the lower index.
fn nearest_voxel(index: DVec3) -> DVec3 {
    // The sum turns −0 into 0.
    (index - 0.5).ceil() + 0.0
}
