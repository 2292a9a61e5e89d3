//! Boxes of m³ voxels that replace voxels whose projection is too small for a pattern (4.2, [STIP-2]).

use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::parallel;
use drypoint_scene::space::Grid;
use drypoint_scene::volume::{Volume, Voxels};

/// Means over boxes of m³ voxels, on a grid of their own.
///
/// A box at the end averages the voxels that it has, and may reach beyond the last of them. Invalid voxels do not
/// count, and a box of invalid voxels is invalid. An axis has at least two boxes, since one box has no gradient; an
/// axis of one or two voxels is not changed.
///
/// Returns none if m = 1 or if no voxel is valid.
pub(super) fn boxes(volume: &Volume, m: usize) -> Option<Volume> {
    let dims = volume.dims();
    let side = dims.map(|n| m.min(n.div_ceil(2)));
    if side == [1; 3] {
        return None;
    }
    let small: [usize; 3] = std::array::from_fn(|a| dims[a].div_ceil(side[a]));
    let (grid, scale) = (volume.grid(), DVec3::from_array(side.map(|m| m as f64)));
    let origin = grid.to_world((scale - 1.0) * 0.5);
    let boxes = Grid::new(small, grid.axes() * DMat3::from_diagonal(scale), origin).ok()?;
    let mean = |i: usize| {
        let at = [i % small[0], i / small[0] % small[1], i / (small[0] * small[1])];
        let range = |a: usize| at[a] * side[a]..((at[a] + 1) * side[a]).min(dims[a]);
        let mut mean = BoxMean::of(volume.voxels());
        for z in range(2) {
            for y in range(1) {
                for x in range(0).filter(|&x| volume.mask().is_none_or(|mask| !mask.voxel([x, y, z]))) {
                    mean.add(volume.voxels().get((z * dims[1] + y) * dims[0] + x));
                }
            }
        }
        // The mean of no values is NaN, which makes the box invalid.
        mean.get()
    };
    let means = parallel::gather(boxes.len(), boxes.dims()[0], &|row, means| means.extend(row.map(mean)));
    Volume::new(boxes, Voxels::F64(means), volume.slope(), volume.intercept()).ok()
}

/// An accumulator for the mean of stored numbers.
#[derive(Clone, Copy)]
enum BoxMean {
    /// A sum, for types with so few bits that sums of integers and of equal numbers are exact.
    Sum { sum: f64, count: f64 },
    /// A running mean, for all other types. The mean of equal numbers is exactly this number, so a constant volume
    /// stays constant. Nothing overflows.
    Running { mean: f64, count: f64 },
}

impl BoxMean {
    fn of(voxels: &Voxels) -> Self {
        match voxels {
            Voxels::U8(_) | Voxels::I8(_) | Voxels::U16(_) | Voxels::I16(_) | Voxels::F32(_) => {
                Self::Sum { sum: 0.0, count: 0.0 }
            }
            _ => Self::Running { mean: 0.0, count: 0.0 },
        }
    }

    #[inline]
    fn add(&mut self, number: f64) {
        match self {
            Self::Sum { sum, count } => {
                *sum += number;
                *count += 1.0;
            }
            Self::Running { mean, count } => {
                *count += 1.0;
                *mean += number / *count - *mean / *count;
            }
        }
    }

    fn get(self) -> f64 {
        match self {
            Self::Running { mean, count } if count > 0.0 => mean,
            Self::Running { .. } => f64::NAN,
            Self::Sum { sum, count } => sum / count,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn means_of_whole_and_partial_boxes() {
        let grid = Grid::new([5, 3, 1], DMat3::from_diagonal(DVec3::new(1.0, 2.0, 7.0)), DVec3::new(10.0, 0.0, 3.0));
        let volume = Volume::new(grid.unwrap(), Voxels::U8((0..15).collect()), 2.0, 1.0).unwrap();
        let two = boxes(&volume, 2).unwrap();
        assert_eq!(two.dims(), [3, 2, 1]);
        // {0, 1, 5, 6}, {2, 3, 7, 8} and {4, 9}; values are 2·stored + 1.
        assert_eq!([0, 1, 2].map(|x| two.value([x, 0, 0])), [7.0, 11.0, 14.0]);
        assert_eq!(two.value([0, 1, 0]), 22.0);
        assert_eq!(two.grid().spacing(), [2.0, 4.0, 7.0]);
        // The middle of the first box.
        assert_eq!(two.grid().origin(), DVec3::new(10.5, 1.0, 3.0));
        assert!(super::boxes(&volume, 1).is_none());
        // However large a box is, an axis has two boxes and a gradient between them.
        for m in [3, 4, 1 << 20] {
            let two = boxes(&volume, m).unwrap();
            assert_eq!((two.dims(), two.grid().spacing()), ([2, 2, 1], [3.0, 4.0, 7.0]));
        }
        // An axis is not shortened more than needed: two voxels stay.
        let flat =
            Volume::new(Grid::with_spacing([2, 1, 1], [1.0; 3]).unwrap(), Voxels::U8(vec![3, 9]), 1.0, 0.0).unwrap();
        assert!(super::boxes(&flat, 2).is_none());
    }

    /// Boxes of a constant have this constant, both whole and partial boxes. Boxes of the largest numbers are finite.
    #[test]
    fn means_of_equal_numbers_are_that_number() {
        for number in [0.1, 1000.1, -1e-9, f64::MAX, -f64::MAX] {
            for (dims, m) in [([33, 33, 33], 32), ([40, 9, 5], 16), ([10, 10, 10], 4)] {
                let grid = Grid::with_spacing(dims, [1.0; 3]).unwrap();
                let all = vec![number; grid.len()];
                let volume = Volume::new(grid, Voxels::F64(all), 1.0, 0.0).unwrap();
                let boxes = boxes(&volume, m).unwrap();
                assert!((0..boxes.grid().len()).all(|i| boxes.voxels().get(i) == number), "{number} {dims:?} {m}");
            }
        }
        let both = (0..8).map(|i| if i % 2 == 0 { f64::MAX } else { -f64::MAX }).collect();
        let volume =
            Volume::new(Grid::with_spacing([8, 1, 1], [1.0; 3]).unwrap(), Voxels::F64(both), 1.0, 0.0).unwrap();
        let mean = boxes(&volume, 2).unwrap().voxels().get(0);
        assert!(mean.abs() <= f64::MAX * f64::EPSILON, "{mean:e}");
    }

    #[test]
    fn invalid_voxels_are_left_out() {
        let grid = Grid::with_spacing([4, 3, 1], [1.0; 3]).unwrap();
        let mut values = vec![3.0f32; 12];
        (values[0], values[1]) = (f32::NAN, 10.0);
        for i in [2, 3, 6, 7] {
            values[i] = f32::INFINITY;
        }
        let boxes = boxes(&Volume::new(grid, Voxels::F32(values), 1.0, 0.0).unwrap(), 2).unwrap();
        // 10, 3 and 3.
        assert_eq!(boxes.value([0; 3]), 16.0 / 3.0);
        assert!(boxes.mask().unwrap().voxel([1, 0, 0]) && !boxes.mask().unwrap().voxel([1, 1, 0]));
    }
}
