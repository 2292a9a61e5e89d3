//! Boxes of m³ voxels in place of voxels whose projection would be too small for a pattern (4.2, [STIP-2]).

use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::space::Grid;
use drypoint_scene::volume::{Volume, Voxels};
use rayon::prelude::*;

/// The means of boxes of m³ voxels, on their own grid; a box at the end is that of the voxels it has. Voxels that are not
/// valid do not count, and a box of none but those is not valid. An axis of length 1 stays as it is.
///
/// None where there is nothing to do, or where the boxes make no volume: m = 1, or no valid voxel.
pub(super) fn boxes(volume: &Volume, m: usize) -> Option<Volume> {
    if m <= 1 {
        return None;
    }
    let dims = volume.dims();
    let side = dims.map(|n| if n == 1 { 1 } else { m });
    let small: [usize; 3] = std::array::from_fn(|a| dims[a].div_ceil(side[a]));
    let (grid, scale) = (volume.grid(), DVec3::from_array(side.map(|m| m as f64)));
    let origin = grid.to_world((scale - 1.0) * 0.5);
    let boxes = Grid::new(small, grid.axes() * DMat3::from_diagonal(scale), origin).ok()?;
    let mean = |i: usize| {
        let at = [i % small[0], i / small[0] % small[1], i / (small[0] * small[1])];
        let range = |a: usize| at[a] * side[a]..((at[a] + 1) * side[a]).min(dims[a]);
        // Stored numbers: sums of integers are exact.
        let (mut sum, mut count) = (0.0, 0.0);
        for z in range(2) {
            for y in range(1) {
                for x in range(0).filter(|&x| volume.mask().is_none_or(|mask| !mask.voxel([x, y, z]))) {
                    sum += volume.voxels().get((z * dims[1] + y) * dims[0] + x);
                    count += 1.0;
                }
            }
        }
        // 0/0 is NaN, which makes the box invalid.
        sum / count
    };
    let means = (0..boxes.len()).into_par_iter().map(mean).collect();
    Volume::new(boxes, Voxels::F64(means), volume.slope(), volume.intercept()).ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_of_whole_and_partial_boxes() {
        let grid = Grid::new([5, 2, 1], DMat3::from_diagonal(DVec3::new(1.0, 2.0, 7.0)), DVec3::new(10.0, 0.0, 3.0));
        let volume = Volume::new(grid.unwrap(), Voxels::U8((0..10).collect()), 2.0, 1.0).unwrap();
        let boxes = boxes(&volume, 2).unwrap();
        assert_eq!(boxes.dims(), [3, 1, 1]);
        // {0, 1, 5, 6}, {2, 3, 7, 8} and {4, 9}; values are 2·stored + 1.
        assert_eq!([0, 1, 2].map(|x| boxes.value([x, 0, 0])), [7.0, 11.0, 14.0]);
        assert_eq!(boxes.grid().spacing(), [2.0, 4.0, 7.0]);
        // The middle of the first box.
        assert_eq!(boxes.grid().origin(), DVec3::new(10.5, 1.0, 3.0));
        assert!(super::boxes(&volume, 1).is_none());
    }

    #[test]
    fn invalid_voxels_are_left_out() {
        let grid = Grid::with_spacing([4, 2, 2], [1.0; 3]).unwrap();
        let mut values = vec![3.0f32; 16];
        values[0] = f32::NAN;
        values[1] = 10.0;
        for i in [2, 3, 6, 7, 10, 11, 14, 15] {
            values[i] = f32::INFINITY;
        }
        let boxes = boxes(&Volume::new(grid, Voxels::F32(values), 1.0, 0.0).unwrap(), 2).unwrap();
        assert_eq!(boxes.value([0; 3]), 4.0);
        assert!(boxes.mask().unwrap().voxel([1, 0, 0]));
    }
}
