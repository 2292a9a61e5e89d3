//! One layer of voxels a face: non-maximum suppression of ‖∇V‖ along the normal ([STIP-4], `thin`).

use drypoint_scene::glam::DVec3;

/// Norms of the voxels of a grid, x fastest.
#[derive(Clone, Copy)]
pub(super) struct Norms<'a> {
    pub(super) dims: [usize; 3],
    pub(super) all: &'a [f64],
}

impl Norms<'_> {
    /// Interpolated at a place in index space; none outside the grid. A norm that is not valid counts as 0.
    fn at(&self, p: DVec3) -> Option<f64> {
        let mut cell = [0; 3];
        let mut w = [0.0; 3];
        for a in 0..3 {
            let last = self.dims[a] - 1;
            if last > 0 && !(p[a] >= 0.0 && p[a] <= last as f64) {
                return None;
            }
            // An axis of length 1 has one voxel, whatever the coordinate.
            cell[a] = if last > 0 { (p[a] as usize).min(last - 1) } else { 0 };
            w[a] = if last > 0 { p[a] - cell[a] as f64 } else { 0.0 };
        }
        let read = |i: usize, j: usize, k: usize| {
            let [x, y, z]: [usize; 3] = std::array::from_fn(|a| (cell[a] + [i, j, k][a]).min(self.dims[a] - 1));
            self.all[(z * self.dims[1] + y) * self.dims[0] + x].max(0.0)
        };
        let lerp = |a: f64, b: f64, w: f64| a + (b - a) * w;
        let line = |j, k| lerp(read(0, j, k), read(1, j, k), w[0]);
        let plane = |k| lerp(line(0, k), line(1, k), w[1]);
        Some(lerp(plane(0), plane(1), w[2]))
    }

    /// Whether a voxel's norm is the largest along ±n within one voxel; `step` leads one voxel along n in index space. Of
    /// equals the side of the lower linear index is kept.
    pub(super) fn is_largest(&self, cell: [usize; 3], step: DVec3) -> bool {
        let centre = DVec3::from_array(cell.map(|i| i as f64));
        let own = self.all[(cell[2] * self.dims[1] + cell[1]) * self.dims[0] + cell[0]];
        // Which of the two comes first in linear order.
        let first = [step.z, step.y, step.x].into_iter().find(|&x| x != 0.0).map_or(1.0, f64::signum);
        let before = self.at(centre - step * first).is_none_or(|norm| norm < own);
        let after = self.at(centre + step * first).is_none_or(|norm| norm <= own);
        before && after
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ridge of ‖∇V‖ three voxels wide, along an oblique plane: the voxels that stay have their centres within half a
    /// voxel of it, as many as the plane has area.
    #[test]
    fn a_wide_ridge_keeps_one_layer() {
        let dims = [24, 24, 24];
        for n in [DVec3::Z, DVec3::new(1.0, 2.0, 3.0).normalize(), DVec3::ONE.normalize()] {
            let t = |cell: [usize; 3]| (DVec3::from_array(cell.map(|i| i as f64)) - 11.6).dot(n);
            let cells: Vec<[usize; 3]> = (0..24 * 24 * 24).map(|i| [i % 24, i / 24 % 24, i / 576]).collect();
            let all: Vec<f64> = cells.iter().map(|&cell| (2.0 - t(cell).abs()).max(0.0)).collect();
            let norms = Norms { dims, all: &all };
            let inner = |cell: &[usize; 3]| cell.iter().all(|i| (4..20).contains(i));
            for &cell in cells.iter().filter(|cell| inner(cell)) {
                let kept = all[cell[0] + 24 * (cell[1] + 24 * cell[2])] > 0.0 && norms.is_largest(cell, n);
                // Between |t| = ½ ± the error of interpolating the ridge's top, ¼ voxel, either may be.
                if t(cell).abs() < 0.25 || t(cell).abs() > 0.75 {
                    assert_eq!(kept, t(cell).abs() < 0.5, "{n} {cell:?}: {}", t(cell));
                }
            }
        }
    }

    #[test]
    fn of_equals_the_lower_index_stays() {
        let all = [0.0, 1.0, 1.0, 0.0];
        let norms = Norms { dims: [4, 1, 1], all: &all };
        for step in [DVec3::X, DVec3::NEG_X] {
            let kept = [0, 1, 2, 3].map(|x| norms.is_largest([x, 0, 0], step));
            assert_eq!(kept, [false, true, false, false]);
        }
    }
}
