//! Stipple points as they are made once, before the first frame ([STIP-4]).

use crate::space::Grid;
use glam::DVec3;

/// The points of a volume: the same number for each voxel that has any, in the order in which they are drawn.
///
/// The k-th voxel's points are `offsets[k·each .. (k + 1)·each]`, 12 bytes each.
#[derive(Clone, Debug, PartialEq)]
pub struct Points {
    /// The grid of the voxels: the volume's, or that of its boxes ([STIP-2]).
    pub grid: Grid,
    /// Points of each voxel: N_max ([STIP-3]), or `full` rounded up if `full` is not a whole number.
    pub each: usize,
    /// Number of a voxel's points that T = 1 stands for. It is `each`, or a number less than 1 below `each` with `k_max
    /// = "auto"` ([STIP-17]) and in thin layers of voxels that are not cubes ([STIP-4]).
    pub full: f64,
    /// The voxels that have points, in ascending linear order.
    pub voxels: Vec<PointVoxel>,
    /// The vector from the voxel's centre to each point, in index space.
    pub offsets: Vec<[f32; 3]>,
}

/// A voxel that has points, with what the factors of a frame read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointVoxel {
    /// The voxel's place in the grid.
    pub cell: [u32; 3],
    /// V_i in [0, 1]: the smoothed value, normalized by the volume's range ([STIP-1]).
    pub value: f64,
    /// ‖∇V_i‖ in [0, 1] ([VAL-2]).
    pub magnitude: f64,
    /// n, outward, of length 1, in the world ([NORM-1]).
    pub normal: DVec3,
}

/// A point near an iso-surface that may hide it ([STIP-15]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// The place in the world.
    pub at: DVec3,
    /// The outward normal of its voxel, of length 1, in the world.
    pub normal: DVec3,
    /// The largest distance at which the point's foot on the surface is sought, in world units.
    pub reach: f64,
}

impl PointVoxel {
    /// The centre in index space.
    pub fn centre(&self) -> DVec3 {
        DVec3::from_array(self.cell.map(f64::from))
    }
}

impl Points {
    /// The points of a voxel, in the order in which they are drawn.
    pub fn of(&self, voxel: usize) -> &[[f32; 3]] {
        &self.offsets[voxel * self.each..][..self.each]
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.offsets.len()
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.offsets.is_empty()
    }

    /// Bytes in memory.
    pub fn bytes(&self) -> u64 {
        (self.offsets.len() * size_of::<[f32; 3]>() + self.voxels.len() * size_of::<PointVoxel>()) as u64
    }
}
