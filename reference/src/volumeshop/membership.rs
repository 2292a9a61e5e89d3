//! f_S, the membership of a selection between its voxels ([VS-2]).

use crate::field::Cells;
use crate::field::kernel::trilinear;
use crate::number::{Real, Vec3};
use drypoint_scene::glam::DVec3;
use drypoint_scene::volume::bricked::BrickedVolume;

/// A selection volume at positions of its own index space.
#[derive(Clone, Debug)]
pub struct Memberships<'a, R> {
    volume: &'a BrickedVolume<f64>,
    cells: Cells<R>,
    /// The box of [SPACE-1].
    index_box: [Vec3<R>; 2],
}

impl<'a, R: Real> Memberships<'a, R> {
    /// Prepares the look-up.
    pub fn new(volume: &'a BrickedVolume<f64>) -> Self {
        let end = |n: usize| if n == 1 { [-0.5, 0.5] } else { [0.0, (n - 1) as f64] };
        let ends = volume.dims().map(end);
        let corner = |i: usize| Vec3::from_glam(DVec3::from_array(ends.map(|end| end[i])));
        Self { volume, cells: Cells::new(volume.dims()), index_box: [corner(0), corner(1)] }
    }

    /// The membership at a position. It is trilinear whatever the kernel of the data, and 0 outside the box.
    #[inline]
    pub fn at(&self, p: Vec3<R>) -> R {
        let [lo, hi] = self.index_box;
        if !(p.x >= lo.x && p.x <= hi.x && p.y >= lo.y && p.y <= hi.y && p.z >= lo.z && p.z <= hi.z) {
            return R::ZERO;
        }
        let at = self.cells.locate(p);
        trilinear::value(self.volume.corners(at.cell).map(|row| row.map(R::from_f64)), at.w)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Trilinear interpolation is exact for xyz, at borders of bricks, too; outside the box is nothing.
    #[test]
    fn memberships_between_voxels() {
        let dims = [40, 20, 33];
        let product = |p: DVec3| p.x * p.y * p.z / (39.0 * 19.0 * 32.0);
        let volume = BrickedVolume::from_fn(dims, |voxel| product(DVec3::from_array(voxel.map(|i| i as f64)))).unwrap();
        let memberships = Memberships::<f64>::new(&volume);
        for i in 0..4000 {
            let share = |step: usize| (i * step % 4001) as f64 / 4000.0;
            let p = DVec3::new(39.0 * share(7), 19.0 * share(11), 32.0 * share(13));
            assert!((memberships.at(Vec3::from_glam(p)) - product(p)).abs() < 1e-15, "{p}");
        }
        assert_eq!(memberships.at(Vec3::new(39.0, 19.0, 32.0)), 1.0);
        for outside in [DVec3::new(39.001, 5.0, 5.0), DVec3::new(5.0, -0.001, 5.0), DVec3::NAN] {
            assert_eq!(memberships.at(Vec3::from_glam(outside)), 0.0);
        }
    }

    #[test]
    fn an_axis_of_one_voxel_reaches_half_a_voxel_each_way() {
        let flat = BrickedVolume::constant([1, 3, 1], 0.25);
        let memberships = Memberships::<f64>::new(&flat);
        assert_eq!(memberships.at(Vec3::new(-0.5, 2.0, 0.5)), 0.25);
        assert_eq!(memberships.at(Vec3::new(-0.51, 2.0, 0.5)), 0.0);
    }
}
