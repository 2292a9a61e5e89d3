//! The value of a further volume at a sample's place in the world.

use super::{AxisMeasure, SampleQuantities};
use crate::field::{Field, FieldError, HessianEstimator, Reconstruction, Rung, Sampler};
use crate::number::{Real, Vec3};
use crate::transfer::Coordinate;
use drypoint_scene::other_grid::OtherGrid;
use drypoint_scene::volume::{Anatomy, Volume};

/// Another scalar volume, trilinear, on any grid. Unknown values are replaced by the low end of its range. They lie
/// outside its box, and in cells that touch a voxel without a value ([PREC-2]).
pub struct OtherVolume<'v, R> {
    field: Field<'v, R>,
    /// The map between grids; none if the volume lies on the data's own grid.
    map: Option<OtherGrid>,
    low: R,
}

impl<'v, R: Real> OtherVolume<'v, R> {
    /// Another volume in the world of the data volume ([SPACE-2]).
    ///
    /// # Errors
    /// The volume has values that R cannot hold.
    pub fn new(volume: &'v Volume, data: &Volume) -> Result<Self, FieldError> {
        let lies = Anatomy::between(volume.grid(), volume.anatomy(), data.anatomy());
        // Only values are read. The other settings are those that need no preparation.
        let how = Reconstruction { hessian: HessianEstimator::Central, ..Reconstruction::default() };
        let field = Field::new(volume, how, Rung::Value)?;
        Ok(Self { field, map: OtherGrid::new(data.grid(), &lies), low: R::from_f64(volume.range()[0]) })
    }
}

impl<R: Real> AxisMeasure<R> for OtherVolume<'_, R> {
    fn at(&self, here: &SampleQuantities<R>) -> Coordinate<R> {
        let position = match &self.map {
            None => Some(here.position),
            Some(map) => on_other_grid(map, here.position),
        };
        let value = position.and_then(|p| {
            let at = self.field.place(p);
            let known = self.field.volume().mask().is_none_or(|mask| !mask.touches_cell(at.cell));
            known.then(|| self.field.value_at(at))
        });
        Coordinate::Number(value.unwrap_or(self.low))
    }

    fn bytes(&self) -> Option<(&'static str, u64)> {
        Some(("further volume", self.field.volume().voxels().bytes() as u64))
    }
}

/// A position on another grid. Returns none outside its box, with the slack of [`OtherGrid`].
#[inline]
fn on_other_grid<R: Real>(map: &OtherGrid, position: Vec3<R>) -> Option<Vec3<R>> {
    let p = R::mapped(position, map.parts());
    let [lo, hi] = map.reach().map(Vec3::<R>::from_glam);
    let is_there = p.x >= lo.x && p.x <= hi.x && p.y >= lo.y && p.y <= hi.y && p.z >= lo.z && p.z <= hi.z;
    let [lo, hi] = map.own_box().map(Vec3::<R>::from_glam);
    let inside = |p: R, lo: R, hi: R| p.max(lo).min(hi);
    is_there.then(|| Vec3::new(inside(p.x, lo.x, hi.x), inside(p.y, lo.y, hi.y), inside(p.z, lo.z, hi.z)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::{DMat3, DVec3};
    use drypoint_scene::space::Grid;
    use drypoint_scene::volume::Voxels;

    /// A volume of zeros on a grid, as the data.
    fn data(grid: &Grid) -> Volume {
        Volume::new(grid.clone(), Voxels::U8(vec![0; grid.len()]), 1.0, 0.0).unwrap()
    }

    fn at<R: Real>(further: &OtherVolume<'_, R>, p: [f64; 3]) -> f64 {
        let Coordinate::Number(x) = further.at(&SampleQuantities::at(p)) else { panic!() };
        x.to_f64()
    }

    /// A field that is linear in the world, on a sheared, shifted and coarser grid.
    #[test]
    fn a_linear_field_on_another_grid() {
        let data = Grid::with_spacing([20, 20, 20], [1.0, 0.5, 2.0]).unwrap();
        let axes = DMat3::from_cols([3.0, 0.0, 0.0].into(), [1.0, 2.0, 0.0].into(), [0.0, 0.5, 4.0].into());
        let lies = Grid::new([4, 3, 5], axes, DVec3::new(1.0, 1.0, 2.0)).unwrap();
        let linear = |p: DVec3| 3.0 * p.x - p.y + 0.25 * p.z;
        let values: Vec<f64> = (0..lies.len())
            .map(|i| linear(lies.to_world(DVec3::new((i % 4) as f64, (i / 4 % 3) as f64, (i / 12) as f64))))
            .collect();
        let volume = Volume::new(lies.clone(), Voxels::F64(values), 1.0, 0.0).unwrap();
        let further = OtherVolume::<f64>::new(&volume, &self::data(&data)).unwrap();
        for p in [[5.0, 5.0, 3.0], [7.5, 6.25, 4.0], [9.0, 4.0, 2.5]] {
            // Coordinates up to 40 in a dozen operations.
            assert!((at(&further, p) - linear(data.to_world(p.into()))).abs() < 1e-13, "{p:?}");
        }
        // Outside: the lowest voxel.
        assert_eq!(at(&further, [0.0, 0.0, 0.0]), volume.range()[0]);
        assert_eq!(at(&further, [19.0, 19.0, 19.0]), volume.range()[0]);
    }

    #[test]
    fn one_grid_is_read_at_its_own_voxels_up_to_the_border() {
        let grid = Grid::new([3, 2, 1], DMat3::from_diagonal(DVec3::new(0.1, 0.7, 0.3)), DVec3::splat(0.3)).unwrap();
        let volume = Volume::new(grid.clone(), Voxels::U8(vec![1, 2, 3, 4, 5, 9]), 1.0, 0.0).unwrap();
        let further = OtherVolume::<f32>::new(&volume, &data(&grid)).unwrap();
        assert_eq!(at(&further, [2.0, 1.0, 0.0]), 9.0);
        // A grid that is not the same one, and ends at the same place.
        let other = Grid::new([3, 3, 1], DMat3::from_diagonal(DVec3::new(0.1, 0.35, 0.3)), DVec3::splat(0.3)).unwrap();
        assert!((at(&OtherVolume::<f32>::new(&volume, &data(&other)).unwrap(), [2.0, 2.0, 0.0]) - 9.0).abs() < 1e-4);
    }

    #[test]
    fn another_anatomy_is_flipped() {
        // The data's x runs to the left; the other volume's runs to the right, from −2 to 0 of the data's.
        let grid = Grid::with_spacing([3, 1, 1], [1.0; 3]).unwrap();
        let left = Volume::new(grid.clone(), Voxels::U8(vec![1, 2, 4]), 1.0, 0.0).unwrap();
        let left = left.with_anatomy(Some(Anatomy::RightAnteriorSuperior));
        let behind = Grid::new([3, 1, 1], DMat3::IDENTITY, DVec3::new(-2.0, 0.0, 0.0)).unwrap();
        let data = data(&behind).with_anatomy(Some(Anatomy::LeftPosteriorSuperior));
        let further = OtherVolume::<f64>::new(&left, &data).unwrap();
        assert_eq!([0.0, 0.5, 2.0].map(|x| at(&further, [x, 0.0, 0.0])), [4.0, 3.0, 1.0]);
    }

    #[test]
    fn voxels_without_a_value_count_as_the_lowest() {
        let grid = Grid::with_spacing([4, 1, 1], [1.0; 3]).unwrap();
        let volume = Volume::new(grid.clone(), Voxels::F32(vec![2.0, 5.0, f32::NAN, 7.0]), 1.0, 0.0).unwrap();
        let further = OtherVolume::<f64>::new(&volume, &data(&grid)).unwrap();
        assert_eq!([0.5, 1.5, 2.5].map(|x| at(&further, [x, 0.0, 0.0])), [3.5, 2.0, 2.0]);
    }
}
