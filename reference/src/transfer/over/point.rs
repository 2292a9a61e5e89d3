//! The distance to a point.

use super::{AxisMeasure, SampleQuantities};
use crate::number::{Mat3, Real, Vec3};
use crate::transfer::Coordinate;
use drypoint_scene::glam::DVec3;
use drypoint_scene::space::Grid;

/// ‖P − p‖ in world units, at the sample's own place.
pub struct PointDistance<R> {
    axes: Mat3<R>,
    /// The vector from p to voxel (0, 0, 0). It is subtracted before anything is rounded to R, so that a distant
    /// origin costs no digits.
    from: Vec3<R>,
}

impl<R: Real> PointDistance<R> {
    /// The distance to a point of the world, from positions in the index space of a grid.
    pub fn new(grid: &Grid, point: DVec3) -> Self {
        Self { axes: Mat3::from_glam(grid.axes()), from: Vec3::from_glam(grid.origin() - point) }
    }
}

impl<R: Real> AxisMeasure<R> for PointDistance<R> {
    fn at(&self, here: &SampleQuantities<R>) -> Coordinate<R> {
        Coordinate::Number((self.axes.apply(here.position) + self.from).length())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::glam::DMat3;

    #[test]
    fn by_hand_on_a_sheared_grid_far_away() {
        // Columns (2, 0, 0), (1, 1, 0), (0, 0, 3), a thousand kilometres off: voxel (1, 2, 1) is (4, 2, 3) from the origin.
        let axes = DMat3::from_cols([2.0, 0.0, 0.0].into(), [1.0, 1.0, 0.0].into(), [0.0, 0.0, 3.0].into());
        let origin = DVec3::splat(1e6);
        let grid = Grid::new([4; 3], axes, origin).unwrap();
        let distance = PointDistance::<f32>::new(&grid, origin + DVec3::new(1.0, -2.0, 3.0));
        // (3, 4, 0).
        assert_eq!(distance.at(&SampleQuantities::at([1.0, 2.0, 1.0])), Coordinate::Number(5.0));
    }
}
