//! Voxels of one iso-surface, in place of those of all boundaries ([STIP-20]).
//!
//! A voxel gets points if the surface lies between it and a face neighbour. The signed distance of a voxel is about
//! d = (f − iso)/‖g‖, and the bell e^(−d²/2) is largest on the surface. So the ridge of the bell takes the place of
//! the ridge of ‖∇V‖: `thin` keeps the voxels nearest to the surface, and `snap` moves points to the top of a
//! Gaussian, which is the surface itself where f is linear.

use drypoint_scene::math;
use drypoint_scene::parallel;
use drypoint_scene::volume::Volume;

/// The surface f = iso among the voxels of a volume.
#[derive(Clone, Copy)]
pub(super) struct SurfaceLayer<'a> {
    pub(super) volume: &'a Volume,
    pub(super) iso: f64,
}

impl SurfaceLayer<'_> {
    fn is_above(&self, cell: [usize; 3]) -> bool {
        self.volume.value(cell) >= self.iso
    }

    /// Whether the surface lies between a voxel and one of its face neighbours.
    pub(super) fn crosses(&self, cell: [usize; 3]) -> bool {
        let (dims, is_above) = (self.volume.dims(), self.is_above(cell));
        (0..3).any(|a| {
            let (mut before, mut after) = (cell, cell);
            before[a] = cell[a].saturating_sub(1);
            after[a] = (cell[a] + 1).min(dims[a] - 1);
            self.is_above(before) != is_above || self.is_above(after) != is_above
        })
    }

    /// The bell of every voxel, x fastest. `norms` holds ‖g‖ over 2^`exponent`; a bell is 0 where it is not above
    /// `bound`.
    ///
    /// The unit of d is the longest step of the grid, so that bells reach the next slice.
    pub(super) fn bells(&self, norms: &[f64], exponent: i32, bound: f64) -> Vec<f64> {
        let [nx, ny, _] = self.volume.dims();
        let unit = self.volume.grid().spacing().into_iter().fold(0.0, f64::max);
        let mut bells = vec![0.0; norms.len()];
        parallel::chunks_mut(&mut bells, nx, &|row, bells| {
            let (y, z) = (row % ny, row / ny);
            for (x, bell) in bells.iter_mut().enumerate() {
                let norm = norms[row * nx + x];
                if norm > bound {
                    // Half values, so that the difference of two finite numbers cannot overflow.
                    let half = 0.5 * self.volume.value([x, y, z]) - 0.5 * self.iso;
                    let d = math::scale_by_power_of_two(half, -exponent) / norm * (2.0 / unit);
                    *bell = math::exp(-0.5 * (d * d));
                }
            }
        });
        bells
    }
}

#[cfg(test)]
mod tests {
    use super::super::ridge::{Norms, to_edge};
    use super::*;
    use drypoint_scene::glam::DVec3;
    use drypoint_scene::space::Grid;
    use drypoint_scene::volume::Voxels;

    /// A linear field: the kept voxels have their centres within half a layer of the plane, and their points move
    /// onto it.
    #[test]
    fn points_of_a_plane_lie_on_it() {
        for (spacing, n) in [
            ([1.0; 3], DVec3::Z),
            ([1.0; 3], DVec3::new(1.0, 2.0, 3.0).normalize()),
            ([1.0, 1.0, 2.5], DVec3::new(1.0, 0.0, 1.0).normalize()),
        ] {
            let grid = Grid::with_spacing([16; 3], spacing).unwrap();
            let cells: Vec<[usize; 3]> = (0..4096).map(|i| [i % 16, i / 16 % 16, i / 256]).collect();
            let at = |cell: [usize; 3]| grid.to_world(DVec3::from_array(cell.map(|i| i as f64)));
            let t = |p: DVec3| (p - grid.centre()).dot(n) - 0.3;
            // ‖g‖ is 8 everywhere, which is 2 times 2².
            let values = cells.iter().map(|&cell| 100.0 - 8.0 * t(at(cell))).collect();
            let volume = Volume::new(grid.clone(), Voxels::F64(values), 1.0, 0.0).unwrap();
            let layer = SurfaceLayer { volume: &volume, iso: 100.0 };
            let bells = layer.bells(&[2.0; 4096], 2, 0.5);
            let ridge = Norms { dims: [16; 3], all: &bells };
            let way = to_edge(&grid, n, true);
            let inner = |cell: &&[usize; 3]| cell.iter().all(|i| (2..14).contains(i));
            let mut kept = 0;
            for &cell in cells.iter().filter(inner).filter(|&&cell| layer.crosses(cell)) {
                if ridge.is_largest(cell, way) {
                    kept += 1;
                    let index = DVec3::from_array(cell.map(|i| i as f64));
                    let moved = grid.to_world(index + way * ridge.top(cell, way));
                    // A parabola between voxels in place of the bell.
                    assert!(t(moved).abs() < 0.02, "{n} {cell:?}: {}", t(moved));
                }
            }
            assert!(kept > 100, "{n}: {kept}");
        }
    }

    #[test]
    fn a_voxel_is_crossed_where_a_face_neighbour_is_on_the_other_side() {
        let grid = Grid::with_spacing([5, 1, 1], [1.0; 3]).unwrap();
        let volume = Volume::new(grid, Voxels::U8(vec![0, 0, 9, 9, 9]), 1.0, 0.0).unwrap();
        let layer = SurfaceLayer { volume: &volume, iso: 9.0 };
        assert_eq!([0, 1, 2, 3, 4].map(|x| layer.crosses([x, 0, 0])), [false, true, true, false, false]);
        // Where there is no gradient there is no bell.
        assert_eq!(layer.bells(&[0.0; 5], 0, 0.0), [0.0; 5]);
    }
}
