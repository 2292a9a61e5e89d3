//! Selection volumes ([VS-1], [VS-2]): a membership in [0, 1] at each voxel, in shared bricks.

use super::bricked::BrickedVolume;
use super::labels::LabelVolume;
use super::{Anatomy, Volume, Voxels};
use crate::memory::{self, NoRoom};
use crate::space::Grid;

/// Memberships on a grid.
#[derive(Clone, Debug)]
pub struct Selection {
    grid: Grid,
    anatomy: Option<Anatomy>,
    /// The memberships, in [0, 1]. Callers that modify them keep this range.
    pub memberships: BrickedVolume<f64>,
}

impl Selection {
    /// A selection of nothing on the grid of a volume: one brick.
    pub fn nothing(volume: &Volume) -> Self {
        let memberships = BrickedVolume::constant(volume.dims(), 0.0);
        Self { grid: volume.grid().clone(), anatomy: volume.anatomy(), memberships }
    }

    /// Makes a selection whose memberships are the values of a volume, clamped to [0, 1] and not rescaled. Voxels that
    /// are not finite in the file have membership 0.
    ///
    /// # Errors
    /// Memory that the budget does not allow.
    pub fn from_volume(volume: &Volume) -> Result<Self, NoRoom> {
        let membership = |voxel: [usize; 3]| match volume.mask() {
            Some(mask) if mask.voxel(voxel) => 0.0,
            // The sum turns −0 into 0, so that bricks of both are one.
            _ => volume.value(voxel).clamp(0.0, 1.0) + 0.0,
        };
        let memberships = BrickedVolume::from_fn(volume.dims(), membership)?;
        Ok(Self { grid: volume.grid().clone(), anatomy: volume.anatomy(), memberships })
    }

    /// The voxels with one of some labels have membership 1, all others 0.
    ///
    /// # Errors
    /// Memory that the budget does not allow.
    pub fn from_labels(labels: &LabelVolume, ids: &[u32]) -> Result<Self, NoRoom> {
        let [nx, ny, _] = labels.grid().dims();
        let mut ids = ids.to_vec();
        ids.sort_unstable();
        let is_one = |[x, y, z]: [usize; 3]| ids.binary_search(&labels.id((z * ny + y) * nx + x)).is_ok();
        let membership = |voxel| if is_one(voxel) { 1.0 } else { 0.0 };
        let memberships = BrickedVolume::from_fn(labels.grid().dims(), membership)?;
        Ok(Self { grid: labels.grid().clone(), anatomy: labels.anatomy(), memberships })
    }

    /// The memberships as a volume, to be written into a file. Reading the file gives the same selection.
    ///
    /// # Errors
    /// Memory that the budget does not allow.
    pub fn to_volume(&self) -> Result<Volume, NoRoom> {
        let [nx, ny, nz] = self.grid.dims();
        memory::room_for(self.grid.len() as u64, size_of::<f64>() as u64)?;
        let mut dense = Vec::with_capacity(self.grid.len());
        for (z, y) in (0..nz).flat_map(|z| (0..ny).map(move |y| (z, y))) {
            dense.extend((0..nx).map(|x| self.memberships.value([x, y, z])));
        }
        Ok(Volume {
            grid: self.grid.clone(),
            voxels: Voxels::F64(dense),
            slope: 1.0,
            intercept: 0.0,
            mask: None,
            range: self.memberships.range(),
            anatomy: self.anatomy,
        })
    }

    /// The grid of the voxels, in the file's own world.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The grid of the voxels in a world of the anatomical directions `world` ([SPACE-2]).
    pub fn grid_in(&self, world: Option<Anatomy>) -> Grid {
        Anatomy::between(&self.grid, self.anatomy, world)
    }

    /// The box of [VS-2], in index space: from the least to the greatest voxel with membership above 0, grown by one voxel
    /// and clipped to the grid. None if the membership is 0 everywhere.
    pub fn index_box(&self) -> Option<[[usize; 3]; 2]> {
        self.memberships.occupied().map(|ends| grown(ends, self.grid.dims()))
    }
}

/// A box of voxels, grown by one voxel and clipped to the volume ([VS-2]).
pub(super) fn grown([lo, hi]: [[usize; 3]; 2], dims: [usize; 3]) -> [[usize; 3]; 2] {
    [lo.map(|i| i.saturating_sub(1)), std::array::from_fn(|a| (hi[a] + 1).min(dims[a] - 1))]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn selection(values: Vec<f32>, slope: f64) -> Selection {
        let grid = Grid::with_spacing([values.len(), 1, 1], [1.0; 3]).unwrap();
        Selection::from_volume(&Volume::new(grid, Voxels::F32(values), slope, 0.0).unwrap()).unwrap()
    }

    fn memberships(selection: &Selection) -> Vec<f64> {
        (0..selection.grid().len()).map(|x| selection.memberships.value([x, 0, 0])).collect()
    }

    #[test]
    fn values_are_clamped_and_never_divided() {
        let read = selection(vec![-2.0, 0.0, 0.25, 1.0, 255.0, f32::NAN, f32::INFINITY, -0.0], 1.0);
        assert_eq!(memberships(&read), [0.0, 0.0, 0.25, 1.0, 1.0, 0.0, 0.0, 0.0]);
        assert!(memberships(&read).iter().all(|f| f.is_sign_positive()));
        assert_eq!(memberships(&selection(vec![0.5, 3.0], 0.5)), [0.25, 1.0]);
    }

    #[test]
    fn labels_select_their_voxels() {
        let grid = Grid::with_spacing([5, 1, 1], [1.0; 3]).unwrap();
        let volume = Volume::new(grid, Voxels::U8(vec![0, 3, 7, 3, 9]), 1.0, 0.0).unwrap();
        let labels = LabelVolume::new(&volume).unwrap();
        let found = |ids: &[u32]| memberships(&Selection::from_labels(&labels, ids).unwrap());
        assert_eq!(found(&[9, 3]), [0.0, 1.0, 0.0, 1.0, 1.0]);
        assert_eq!(found(&[]), [0.0; 5]);
    }

    #[test]
    fn the_box_is_grown_by_a_voxel_and_clipped() {
        let box_of = |values: Vec<f32>| selection(values, 1.0).index_box().map(|ends| ends.map(|voxel| voxel[0]));
        assert_eq!(box_of(vec![0.0; 7]), None);
        assert_eq!(box_of(vec![0.0, 0.0, 0.5, 0.0, 1.0, 0.0, 0.0]), Some([1, 5]));
        assert_eq!(box_of(vec![1.0, 0.0, 0.0]), Some([0, 1]));
    }

    #[test]
    fn a_written_selection_is_read_as_it_was() {
        let first = selection(vec![0.1, 0.7, 0.0, 1.0, 0.3], 1.0);
        let again = Selection::from_volume(&first.to_volume().unwrap()).unwrap();
        assert_eq!(memberships(&first), memberships(&again));
        assert_eq!(Selection::nothing(&first.to_volume().unwrap()).memberships.distinct_bricks(), 1);
    }
}
