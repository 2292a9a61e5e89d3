//! Errors of stippling.

use crate::field::FieldError;

/// The reason why a volume cannot be stippled.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StippleError {
    /// The volume does not make a field.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// The length `stipples.slab` is on the page. A scene file cannot cause this error.
    #[error("stipples.slab is a length on the page, not in the volume")]
    Slab,
    /// The volume has more voxels than the ordering of points can index.
    #[error("{voxels} voxels are above the threshold, and at most {most} can have points")]
    TooMany {
        /// Voxels above the threshold.
        voxels: usize,
        /// The most.
        most: usize,
    },
    /// More points of a voxel than have a number each.
    #[error("a voxel would have {each} points, and at most {most} are possible")]
    TooDense {
        /// Points of each voxel.
        each: usize,
        /// The most.
        most: usize,
    },
}
