//! Subsets of a volume: a box of its voxels, and every n-th voxel in the box ([VOL-1]).

use crate::space::{Grid, SpaceError};
use std::ops::Range;

/// The voxels of a volume to read: a box of indices, and every n-th voxel from its first corner on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Subset {
    /// First and last index along x, y, z, both included; none: the whole volume.
    pub ranges: Option<[[usize; 2]; 3]>,
    /// Steps between kept voxels along x, y, z; at least 1.
    pub stride: [usize; 3],
}

/// A range of indices that a volume does not have.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the range [{}, {}] along {} is not in the volume, whose indices go from 0 to {last}",
    .range[0], .range[1], ["x", "y", "z"][*.axis % 3]
)]
pub struct NotInVolume {
    /// 0, 1 or 2.
    pub axis: usize,
    /// The range asked for.
    pub range: [usize; 2],
    /// The last index of the volume.
    pub last: usize,
}

impl Default for Subset {
    /// Every voxel.
    fn default() -> Self {
        Self { ranges: None, stride: [1; 3] }
    }
}

impl Subset {
    /// Returns the voxels of a volume with `dims` that are kept. A stride of 0 counts as 1. Along an axis with one kept
    /// voxel the grid has the step of the whole volume.
    ///
    /// # Errors
    /// A range that ends before it begins or beyond the volume.
    pub fn of(&self, dims: [usize; 3]) -> Result<KeptVoxels, NotInVolume> {
        let mut kept = KeptVoxels::all(dims);
        for axis in 0..3 {
            let last = dims[axis].saturating_sub(1);
            let [first, end] = self.ranges.map_or([0, last], |ranges| ranges[axis]);
            if first > end || end > last {
                return Err(NotInVolume { axis, range: [first, end], last });
            }
            let stride = self.stride[axis].max(1);
            kept.first[axis] = first;
            kept.dims[axis] = (end - first) / stride + 1;
            // A single voxel keeps its thickness.
            kept.stride[axis] = if kept.dims[axis] == 1 { 1 } else { stride };
        }
        Ok(kept)
    }
}

/// Voxels of a volume that are kept: a regular lattice of its grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct KeptVoxels {
    /// Voxels of the whole volume along x, y, z.
    whole: [usize; 3],
    /// The first kept voxel.
    first: [usize; 3],
    stride: [usize; 3],
    /// Kept voxels along x, y, z.
    dims: [usize; 3],
}

impl KeptVoxels {
    /// All voxels of a volume with `dims`.
    pub fn all(dims: [usize; 3]) -> Self {
        Self { whole: dims, first: [0; 3], stride: [1; 3], dims }
    }

    /// Whether every voxel is kept.
    pub fn is_all(&self) -> bool {
        self.dims == self.whole
    }

    /// Number of kept voxels.
    pub fn len(&self) -> usize {
        self.dims.iter().product()
    }

    /// Whether no voxel is kept. This happens only for a volume without voxels.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The index, in the whole volume, of a kept voxel by its number; x is fastest.
    pub fn index(&self, i: usize) -> [usize; 3] {
        let [nx, ny, _] = self.dims;
        let kept = [i % nx, i / nx % ny, i / nx / ny];
        std::array::from_fn(|axis| self.first[axis] + self.stride[axis] * kept[axis])
    }

    /// Returns the grid of the kept voxels. Each kept voxel stays where it is in the world.
    ///
    /// # Errors
    /// Strides that stretch the axes too far apart for a grid.
    pub fn grid(&self, whole: &Grid) -> Result<Grid, SpaceError> {
        if self.is_all() {
            return Ok(whole.clone());
        }
        let [x, y, z] = self.stride.map(|n| n as f64);
        let axes = whole.axes();
        let axes = glam::DMat3::from_cols(axes.x_axis * x, axes.y_axis * y, axes.z_axis * z);
        let [i, j, k] = self.first.map(|n| n as f64);
        Grid::new(self.dims, axes, whole.to_world(glam::DVec3::new(i, j, k)))
    }

    /// Appends the numbers of kept voxels. `numbers` are those of the volume's voxels from the linear index `from` on.
    pub fn append<T: Copy>(&self, numbers: &[T], from: usize, to: &mut Vec<T>) {
        if self.is_all() {
            to.extend_from_slice(numbers);
            return;
        }
        let [nx, ny, _] = self.whole;
        for row in from / nx..(from + numbers.len()).div_ceil(nx) {
            // The part of this row that the numbers hold, in indices along x.
            let start = (row * nx).max(from);
            let end = ((row + 1) * nx).min(from + numbers.len());
            let begin = row * nx;
            if self.has(1, row % ny) && self.has(2, row / ny) {
                to.extend(self.along_x(start - begin..end - begin).map(|x| numbers[begin + x - from]));
            }
        }
    }

    /// Whether voxels with an index on an axis can be kept.
    fn has(&self, axis: usize, index: usize) -> bool {
        let from_first = index.checked_sub(self.first[axis]);
        from_first.is_some_and(|n| n.is_multiple_of(self.stride[axis]) && n / self.stride[axis] < self.dims[axis])
    }

    /// The kept indices along x within a range.
    fn along_x(&self, range: Range<usize>) -> impl Iterator<Item = usize> {
        let ([first, ..], [stride, ..], [n, ..]) = (self.first, self.stride, self.dims);
        let before = range.start.saturating_sub(first).div_ceil(stride);
        (before.min(n)..n).map(move |i| first + i * stride).take_while(move |&x| x < range.end)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{DMat3, DVec3};

    fn kept(ranges: [[usize; 2]; 3], stride: [usize; 3], dims: [usize; 3]) -> KeptVoxels {
        Subset { ranges: Some(ranges), stride }.of(dims).unwrap()
    }

    #[test]
    fn voxels_are_kept_by_hand() {
        // 5 × 4 × 3 voxels that hold their linear index.
        let all: Vec<usize> = (0..60).collect();
        let kept = kept([[1, 4], [0, 3], [1, 2]], [2, 3, 1], [5, 4, 3]);
        assert_eq!((kept.dims, kept.len(), kept.is_all()), ([2, 2, 2], 8, false));
        assert_eq!((kept.index(0), kept.index(6)), ([1, 0, 1], [1, 3, 2]));
        let expected = [21, 23, 36, 38, 41, 43, 56, 58];
        // In one piece, and in pieces of any length.
        for piece in [60, 1, 2, 3, 7, 19] {
            let mut to = Vec::new();
            for (i, numbers) in all.chunks(piece).enumerate() {
                kept.append(numbers, i * piece, &mut to);
            }
            assert_eq!(to, expected, "pieces of {piece}");
        }
        let mut whole = Vec::new();
        Subset::default().of([5, 4, 3]).unwrap().append(&all, 0, &mut whole);
        assert_eq!(whole, all);
    }

    #[test]
    fn kept_voxels_stay_in_the_world() {
        let axes = DMat3::from_cols(DVec3::new(1.0, 0.25, 0.0), DVec3::new(0.0, 2.0, 0.5), DVec3::new(0.5, 0.0, 4.0));
        let grid = Grid::new([9, 8, 7], axes, DVec3::new(3.0, -2.0, 8.0)).unwrap();
        let part = kept([[2, 7], [1, 1], [0, 6]], [2, 5, 3], [9, 8, 7]).grid(&grid).unwrap();
        assert_eq!(part.dims(), [3, 1, 3]);
        for (i, j, k) in [(0, 0, 0), (2, 0, 1), (1, 0, 2)] {
            let [of_part, of_whole] = [[i, j, k], [2 + 2 * i, 1, 3 * k]].map(|p| DVec3::from(p.map(f64::from)));
            assert_eq!(part.to_world(of_part), grid.to_world(of_whole));
        }
    }

    #[test]
    fn ranges_beyond_the_volume_are_named() {
        let of = |range| Subset { ranges: Some([[0, 4], range, [0, 2]]), stride: [1; 3] }.of([5, 4, 3]).map(|_| ());
        let not_in = |range| Err(NotInVolume { axis: 1, range, last: 3 });
        assert_eq!(of([0, 3]), Ok(()));
        assert_eq!(of([1, 4]), not_in([1, 4]));
        assert_eq!(of([2, 1]), not_in([2, 1]));
        assert_eq!(of([usize::MAX, usize::MAX]), not_in([usize::MAX; 2]));
        let said = "the range [1, 4] along y is not in the volume, whose indices go from 0 to 3";
        assert_eq!(of([1, 4]).unwrap_err().to_string(), said);
        // A stride beyond the box keeps its first voxel.
        assert_eq!(kept([[1, 4], [0, 3], [0, 2]], [usize::MAX, 4, 2], [5, 4, 3]).dims, [1, 1, 2]);
    }
}
