//! The part that each voxel belongs to, and the names of the parts ([STF-13]).

mod names;

pub use names::{LabelNames, NamesError, NamesFault};

use super::{Access, Anatomy, Volume, Voxel};
use crate::space::Grid;

/// Ids of parts on a grid, in the narrowest type that holds them: most segmentations take one byte a voxel.
#[derive(Clone, Debug, PartialEq)]
pub struct LabelVolume {
    grid: Grid,
    anatomy: Option<Anatomy>,
    ids: Ids,
}

/// Ids, x fastest.
#[derive(Clone, Debug, PartialEq)]
enum Ids {
    U8(Vec<u8>),
    U16(Vec<u16>),
    U32(Vec<u32>),
}

/// A volume that holds other values than ids.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum LabelError {
    /// A value that is no id.
    #[error("{value} is not a label: an id is a whole number from 0 to 4294967295")]
    NotAnId {
        /// The first voxel with such a value.
        voxel: [usize; 3],
        /// The value, after slope and intercept; NaN for every value that is not finite.
        value: f64,
    },
}

impl LabelVolume {
    /// The ids that a volume holds, after slope and intercept. All voxel types are accepted: ids may have been written
    /// as floating point.
    ///
    /// # Errors
    /// A value that is negative, has a fraction, is not finite or exceeds u32, with the first voxel that has one.
    pub fn new(volume: &Volume) -> Result<Self, LabelError> {
        let [lo, hi] = volume.range();
        let ids = with_access!(volume, |access| {
            if lo >= 0.0 && hi <= f64::from(u8::MAX) {
                gather(volume, access, |id| id as u8).map(Ids::U8)
            } else if lo >= 0.0 && hi <= f64::from(u16::MAX) {
                gather(volume, access, |id| id as u16).map(Ids::U16)
            } else {
                gather(volume, access, |id| id).map(Ids::U32)
            }
        })?;
        Ok(Self { grid: volume.grid().clone(), anatomy: volume.anatomy(), ids })
    }

    /// The grid of the voxels, in the file's own world.
    pub fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The anatomical directions of the file's world, if it has some.
    pub fn anatomy(&self) -> Option<Anatomy> {
        self.anatomy
    }

    /// The grid of the voxels in a world of the anatomical directions `world` ([SPACE-2]).
    pub fn grid_in(&self, world: Option<Anatomy>) -> Grid {
        Anatomy::between(&self.grid, self.anatomy, world)
    }

    /// The id at a linear index, x fastest.
    ///
    /// # Panics
    /// If the index is out of range.
    #[inline(always)]
    pub fn id(&self, i: usize) -> u32 {
        match &self.ids {
            Ids::U8(ids) => u32::from(ids[i]),
            Ids::U16(ids) => u32::from(ids[i]),
            Ids::U32(ids) => ids[i],
        }
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        match &self.ids {
            Ids::U8(ids) => ids.len(),
            Ids::U16(ids) => ids.len() * 2,
            Ids::U32(ids) => ids.len() * 4,
        }
    }
}

/// The voxels as ids of a type that holds those of the volume's range.
fn gather<A: Access, I>(volume: &Volume, access: A, narrow: impl Fn(u32) -> I) -> Result<Vec<I>, LabelError> {
    let ([nx, ny, nz], mask) = (volume.dims(), volume.mask());
    let (slope, intercept) = (volume.slope(), volume.intercept());
    let mut ids = Vec::with_capacity(volume.grid().len());
    for (z, y, x) in (0..nz).flat_map(|z| (0..ny).flat_map(move |y| (0..nx).map(move |x| (z, y, x)))) {
        let value = slope * access.at(x, y, z).to_f64() + intercept;
        let filled = mask.is_some_and(|mask| mask.voxel([x, y, z]));
        if filled || value.fract() != 0.0 || !(0.0..=f64::from(u32::MAX)).contains(&value) {
            let value = if filled { f64::NAN } else { value };
            return Err(LabelError::NotAnId { voxel: [x, y, z], value });
        }
        ids.push(narrow(value as u32));
    }
    Ok(ids)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::volume::{VoxelType, Voxels};
    use glam::DVec3;

    fn volume(voxels: Voxels, slope: f64, intercept: f64) -> Volume {
        let grid = Grid::with_spacing([voxels.len(), 1, 1], [1.0; 3]).unwrap();
        Volume::new(grid, voxels, slope, intercept).unwrap()
    }

    /// Ids are read from every voxel type, with slope and intercept.
    #[test]
    fn ids_of_every_type_of_voxel() {
        for &to in VoxelType::ALL {
            let labels = LabelVolume::new(&volume(Voxels::from_f64(&[0.0, 7.0, 117.0], to), 1.0, 0.0)).unwrap();
            assert_eq!([0, 1, 2].map(|i| labels.id(i)), [0, 7, 117], "{to:?}");
            assert_eq!(labels.bytes(), 3, "{to:?}");
        }
        let scaled = LabelVolume::new(&volume(Voxels::I8(vec![-128, -127, 127]), 100.0, 12_800.0)).unwrap();
        assert_eq!([0, 1, 2].map(|i| scaled.id(i)), [0, 100, 25_500]);
        assert_eq!(scaled.bytes(), 6);
        let wide = LabelVolume::new(&volume(Voxels::U64(vec![0, 4_294_967_295]), 1.0, 0.0)).unwrap();
        assert_eq!((wide.id(1), wide.bytes()), (u32::MAX, 8));
    }

    #[test]
    fn what_is_no_id_is_refused_with_its_voxel() {
        let first = |voxels, slope| LabelVolume::new(&volume(voxels, slope, 0.0)).unwrap_err();
        let at = |x, value| LabelError::NotAnId { voxel: [x, 0, 0], value };
        assert_eq!(first(Voxels::F32(vec![1.0, 2.0, 2.5]), 1.0), at(2, 2.5));
        assert_eq!(first(Voxels::I16(vec![3, -1]), 1.0), at(1, -1.0));
        assert_eq!(first(Voxels::U8(vec![2, 3]), 0.5), at(1, 1.5));
        assert_eq!(first(Voxels::U64(vec![0, 1 << 32]), 1.0), at(1, 4_294_967_296.0));
        // A voxel that was filled has the id of its neighbour, which nobody gave it.
        let LabelError::NotAnId { voxel, value } = first(Voxels::F64(vec![5.0, f64::INFINITY]), 1.0);
        assert!(voxel == [1, 0, 0] && value.is_nan());
    }

    #[test]
    fn a_grid_of_another_anatomy_is_flipped_to_the_world() {
        let labels =
            |anatomy| LabelVolume::new(&volume(Voxels::U8(vec![1, 2]), 1.0, 0.0).with_anatomy(anatomy)).unwrap();
        let [lps, las, ras] = Anatomy::ALL.map(Some);
        let corner = |from, to| labels(from).grid_in(to).to_world(DVec3::new(1.0, 2.0, 3.0)).to_array();
        assert_eq!(corner(ras, lps), [-1.0, -2.0, 3.0]);
        assert_eq!(corner(lps, ras), [-1.0, -2.0, 3.0]);
        assert_eq!(corner(las, ras), [-1.0, 2.0, 3.0]);
        assert_eq!(corner(las, lps), [1.0, -2.0, 3.0]);
        assert_eq!(corner(lps, lps), [1.0, 2.0, 3.0]);
        // One that names none is taken as it is, and so is a world without name.
        assert_eq!([corner(None, lps), corner(ras, None)], [[1.0, 2.0, 3.0]; 2]);
    }
}
