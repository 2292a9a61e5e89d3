//! The choice of a phantom and of its grid.

use crate::volume::VoxelType;

/// A phantom by name.
#[derive(Clone, Debug, PartialEq)]
pub struct PhantomSource {
    /// Name of the phantom.
    pub name: String,
    /// Voxels along x, y, z.
    pub size: [usize; 3],
    /// World units between voxels.
    pub spacing: [f64; 3],
    /// Stored type.
    pub voxel_type: VoxelType,
    /// Parameters by name; those not given have their defaults.
    pub params: Vec<(String, f64)>,
}
