//! `[volume]`: the data that is seen.

use crate::volume::VoxelType;
use std::path::PathBuf;

/// The table `[volume]`.
#[derive(Clone, Debug, PartialEq)]
pub struct VolumeTable {
    /// Where the voxels come from.
    pub source: VolumeSource,
    /// The value range of `normalized` ([VAL-1]); none: the volume's own.
    pub range: Option<[f64; 2]>,
    /// The range of ‖g‖ that |g| maps to [0, 1] ([VAL-2]).
    pub gradient_range: GradientRange,
    /// Which values lie outside a surface ([NORM-1]).
    pub outside: Outside,
}

/// Where the voxels come from.
#[derive(Clone, Debug, PartialEq)]
pub enum VolumeSource {
    /// A volume file, already resolved against the scene's folder.
    File {
        /// Path to open.
        path: PathBuf,
        /// Layout of a file without header.
        raw: Option<RawLayout>,
    },
    /// A phantom of our own ([IO-4]).
    Phantom(PhantomSource),
}

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

/// A phantom by name.
#[derive(Clone, Debug, PartialEq)]
pub struct PhantomSource {
    /// Which phantom.
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

/// What |g| = 1 stands for ([VAL-2]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum GradientRange {
    /// lo = 0, hi the quantile of ‖g‖ over the voxels with a normal; `"max"` is the quantile 1.
    Quantile(f64),
    /// lo and hi in value per world unit.
    Fixed([f64; 2]),
}

/// Which values lie outside ([NORM-1]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outside {
    /// Values fall towards the outside: N = −g/‖g‖.
    Low,
    /// Values rise towards the outside: N = +g/‖g‖.
    High,
}

impl VolumeTable {
    /// The table with every default, for a source.
    pub fn new(source: VolumeSource) -> Self {
        Self { source, range: None, gradient_range: GradientRange::Quantile(0.999), outside: Outside::Low }
    }
}
