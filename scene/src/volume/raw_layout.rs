//! The layout of voxels without a header.

use super::VoxelType;

/// Layout of raw voxels.
#[derive(Clone, Debug, PartialEq)]
pub struct RawLayout {
    /// Voxels along x, y, z.
    pub size: [usize; 3],
    /// Stored type.
    pub voxel_type: VoxelType,
    /// Whether the bytes of a number come highest first.
    pub big_endian: bool,
    /// World units between voxels.
    pub spacing: [f64; 3],
    /// Bytes before the first voxel.
    pub skip: u64,
}
