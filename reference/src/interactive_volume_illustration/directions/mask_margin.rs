//! Margins around masked voxels, one for each scale of smoothing ([HATCH-3], [PREC-2]).

use drypoint_scene::glam::DVec3;
use drypoint_scene::volume::{Mask, Volume};

/// Flags for the voxels that have a masked voxel nearby: one bit for each scale.
#[derive(Debug)]
pub(super) struct MaskMargins {
    dims: [usize; 3],
    near: Vec<u8>,
}

impl MaskMargins {
    /// `rooms` holds the margin of each scale: the required distance from masked voxels along each axis, in voxels.
    /// Returns none if no voxel is masked.
    pub(super) fn new<const N: usize>(volume: &Volume, rooms: [[f64; 3]; N]) -> Option<Self> {
        let mask = volume.mask()?;
        let dims = volume.dims();
        let mut near = vec![0; dims.iter().product()];
        for (i, room) in rooms.into_iter().enumerate() {
            let grown = grown(mask, dims, room.map(|room| room.ceil() as usize));
            near.iter_mut().zip(grown).for_each(|(bits, is_near)| *bits |= u8::from(is_near) << i);
        }
        Some(Self { dims, near })
    }

    /// Whether no masked voxel lies within the scale's margin of a place in index space. The margin may reach up to
    /// half a voxel farther, but never less far.
    pub(super) fn is_clear(&self, scale: usize, at: DVec3) -> bool {
        let [nx, ny, nz] = self.dims;
        let voxel = |x: f64, n: usize| (x.round().max(0.0) as usize).min(n - 1);
        let (x, y, z) = (voxel(at.x, nx), voxel(at.y, ny), voxel(at.z, nz));
        self.near[(z * ny + y) * nx + x] >> scale & 1 == 0
    }

    pub(super) fn bytes(&self) -> u64 {
        self.near.len() as u64
    }
}

/// Dilates a mask by a box of `room` voxels to either side along each axis, one axis after the other.
fn grown(mask: &Mask, dims: [usize; 3], room: [usize; 3]) -> Vec<bool> {
    let [nx, ny, nz] = dims;
    let mut set: Vec<bool> = (0..nx * ny * nz).map(|i| mask.voxel([i % nx, i / nx % ny, i / (nx * ny)])).collect();
    let mut line = Vec::new();
    for (axis, stride) in [1, nx, nx * ny].into_iter().enumerate() {
        let n = dims[axis];
        let starts = (0..set.len()).filter(|i| i / stride % n == 0).collect::<Vec<_>>();
        for start in starts {
            line.clear();
            line.extend((0..n).map(|i| set[start + i * stride]));
            // Prefix sums: the number of set voxels of the line before each voxel.
            let mut sum = 0;
            let sums: Vec<usize> = std::iter::once(0)
                .chain(line.iter().map(|&is_set| {
                    sum += usize::from(is_set);
                    sum
                }))
                .collect();
            for i in 0..n {
                let (first, last) = (i.saturating_sub(room[axis]), (i + room[axis]).min(n - 1));
                set[start + i * stride] = sums[last + 1] > sums[first];
            }
        }
    }
    set
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::philox::uniform;
    use drypoint_scene::space::Grid;
    use drypoint_scene::volume::Voxels;

    /// Compares with a search through all masked voxels from every place.
    #[test]
    fn boxes_by_brute_force() {
        let dims = [9, 7, 12];
        let [nx, ny, nz] = dims;
        let n = nx * ny * nz;
        let values = (0..n).map(|i| if uniform(3, [i as u32, 0, 0], 0) < 0.01 { f64::NAN } else { i as f64 }).collect();
        let grid = Grid::with_spacing(dims, [1.0; 3]).unwrap();
        let volume = Volume::new(grid, Voxels::F64(values), 1.0, 0.0).unwrap();
        let rooms = [[2.0, 1.5, 0.0], [4.0, 0.4, 3.0]];
        let clear = MaskMargins::new(&volume, rooms).unwrap();
        let mask = volume.mask().unwrap();
        let masked: Vec<[f64; 3]> = (0..n)
            .map(|i| [i % nx, i / nx % ny, i / (nx * ny)])
            .filter(|&voxel| mask.voxel(voxel))
            .map(|voxel| voxel.map(|i| i as f64))
            .collect();
        assert!(masked.len() > 2);
        let mut both = [0; 2];
        for i in 0..2000 {
            let at = |a: usize| uniform(4, [i, a as u32, 0], 0) * (dims[a] as f64 - 1.0);
            let at = [at(0), at(1), at(2)];
            for (scale, room) in rooms.iter().enumerate() {
                let within =
                    |more: f64| masked.iter().any(|m| (0..3).all(|a| (m[a] - at[a]).abs() <= room[a].ceil() + more));
                let is_clear = clear.is_clear(scale, DVec3::from_array(at));
                assert!(!is_clear || !within(0.0), "{at:?}");
                assert!(is_clear || within(0.5), "{at:?}");
                both[usize::from(is_clear)] += 1;
            }
        }
        assert!(both.iter().all(|&n| n > 200), "{both:?}");
        let whole = Volume::new(volume.grid().clone(), Voxels::F64(vec![0.0; n]), 1.0, 0.0).unwrap();
        assert!(MaskMargins::new(&whole, rooms).is_none());
    }
}
