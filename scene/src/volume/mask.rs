//! Voxels that were NaN or ±∞ in the file ([PREC-2]).

use super::{VolumeError, Voxels};

/// One bit a voxel and one bit a cell; exists only where a volume has such voxels.
#[derive(Clone, Debug, PartialEq)]
pub struct Mask {
    dims: [usize; 3],
    voxels: Vec<u64>,
    cells: Vec<u64>,
    count: usize,
}

fn bit(words: &[u64], i: usize) -> bool {
    words[i / 64] >> (i % 64) & 1 == 1
}

impl Mask {
    /// A mask of the voxels for which `invalid` (x fastest) is true.
    fn new(dims: [usize; 3], invalid: &[bool]) -> Self {
        let words = invalid.len().div_ceil(64);
        let mut mask = Self { dims, voxels: vec![0; words], cells: vec![0; words], count: 0 };
        let [nx, ny, _] = dims;
        for (i, _) in invalid.iter().enumerate().filter(|(_, bad)| **bad) {
            mask.voxels[i / 64] |= 1 << (i % 64);
            mask.count += 1;
            let [x, y, z] = [i % nx, i / nx % ny, i / (nx * ny)];
            // The voxel is a corner of the cells that begin at it and one before it on each axis.
            for cell_z in z.saturating_sub(1)..=z {
                for cell_y in y.saturating_sub(1)..=y {
                    for cell_x in x.saturating_sub(1)..=x {
                        let c = (cell_z * ny + cell_y) * nx + cell_x;
                        mask.cells[c / 64] |= 1 << (c % 64);
                    }
                }
            }
        }
        mask
    }

    /// Number of masked voxels.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Whether the voxel is masked.
    ///
    /// # Panics
    /// If it lies outside the volume.
    #[inline]
    pub fn voxel(&self, [x, y, z]: [usize; 3]) -> bool {
        bit(&self.voxels, (z * self.dims[1] + y) * self.dims[0] + x)
    }

    /// Whether one of the eight corners of the cell that begins at a voxel is masked.
    ///
    /// # Panics
    /// If the cell lies outside the volume.
    #[inline]
    pub fn touches_cell(&self, [x, y, z]: [usize; 3]) -> bool {
        bit(&self.cells, (z * self.dims[1] + y) * self.dims[0] + x)
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> usize {
        (self.voxels.len() + self.cells.len()) * 8
    }
}

/// Gives each voxel that is not finite the value of the nearest finite one in index space (ties: the lowest linear
/// index). Returns the mask of those voxels, or none if all are finite.
pub(super) fn fill_invalid(voxels: &mut Voxels, dims: [usize; 3]) -> Result<Option<Mask>, VolumeError> {
    match voxels {
        Voxels::F32(v) => fill(v, dims, |x| x.is_finite()),
        Voxels::F64(v) => fill(v, dims, |x| x.is_finite()),
        _ => Ok(None),
    }
}

fn fill<V: Copy>(v: &mut [V], dims: [usize; 3], finite: fn(V) -> bool) -> Result<Option<Mask>, VolumeError> {
    let invalid: Vec<bool> = v.iter().map(|&x| !finite(x)).collect();
    let bad = invalid.iter().filter(|&&b| b).count();
    if bad == 0 {
        return Ok(None);
    }
    if bad == v.len() {
        return Err(VolumeError::NothingFinite);
    }
    let nearest = nearest_valid(&invalid, dims);
    for i in (0..v.len()).filter(|&i| invalid[i]) {
        v[i] = v[nearest[i]];
    }
    Ok(Some(Mask::new(dims, &invalid)))
}

/// The linear index of the nearest valid voxel, for each voxel; ties go to the lowest index.
///
/// The lexicographic minimum of (squared distance, index) separates by axis. The squared distance along one more axis
/// is equal for all candidates of a line, so adding it keeps their order.
fn nearest_valid(invalid: &[bool], dims: [usize; 3]) -> Vec<usize> {
    const NONE: (u64, usize) = (u64::MAX, usize::MAX);
    let mut best: Vec<(u64, usize)> = (0..invalid.len()).map(|i| if invalid[i] { NONE } else { (0, i) }).collect();
    let strides = [1, dims[0], dims[0] * dims[1]];
    for axis in 0..3 {
        let (n, stride) = (dims[axis], strides[axis]);
        let before = best.clone();
        for (i, slot) in best.iter_mut().enumerate() {
            let position = i / stride % n;
            let line = i - position * stride;
            let mut found = before[i];
            // Outwards, until the distance along this axis alone is too much.
            for r in 1..n {
                let square = (r * r) as u64;
                if square > found.0 {
                    break;
                }
                let sides = [position.checked_sub(r), Some(position + r).filter(|&q| q < n)];
                if sides == [None, None] {
                    break;
                }
                for q in sides.into_iter().flatten() {
                    let (d, j) = before[line + q * stride];
                    if d != u64::MAX {
                        found = found.min((d + square, j));
                    }
                }
            }
            *slot = found;
        }
    }
    best.into_iter().map(|(_, i)| i).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_fill_is_the_nearest_with_the_lowest_index() {
        // A deterministic scatter of holes, checked against the definition.
        let dims = [7, 6, 5];
        let n = 210;
        let invalid: Vec<bool> = (0..n).map(|i| (i * 7919 + 13) % 11 < 8).collect();
        let position = |i: usize| [i % 7, i / 7 % 6, i / 42];
        let got = nearest_valid(&invalid, dims);
        for (i, &found) in got.iter().enumerate() {
            let distance = |j: usize| -> usize {
                let (a, b) = (position(i), position(j));
                (0..3).map(|k| a[k].abs_diff(b[k]).pow(2)).sum()
            };
            let want = (0..n).filter(|&j| !invalid[j]).min_by_key(|&j| (distance(j), j)).unwrap();
            assert_eq!(found, want, "voxel {i}");
        }
    }

    #[test]
    fn a_masked_voxel_touches_its_eight_cells() {
        let mut invalid = vec![false; 64];
        invalid[21] = true; // (1, 1, 1) of 4³
        let mask = Mask::new([4; 3], &invalid);
        assert_eq!(mask.count(), 1);
        assert!(mask.voxel([1, 1, 1]) && !mask.voxel([2, 1, 1]));
        let touched = (0..64).filter(|i| mask.touches_cell([i % 4, i / 4 % 4, i / 16])).count();
        assert_eq!(touched, 8);
        assert!(mask.touches_cell([0, 0, 0]) && mask.touches_cell([1, 1, 1]) && !mask.touches_cell([2, 1, 1]));
    }

    #[test]
    fn nothing_finite_is_an_error() {
        let mut voxels = Voxels::F32(vec![f32::NAN; 8]);
        assert_eq!(fill_invalid(&mut voxels, [2; 3]), Err(VolumeError::NothingFinite));
    }
}
