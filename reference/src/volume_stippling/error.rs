//! Stipples that cannot be.

use crate::field::FieldError;

/// What stands in the way of stippling a volume.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StippleError {
    /// No field of that volume.
    #[error(transparent)]
    Field(#[from] FieldError),
    /// `stipples.slab` or `camera.near` on the page, or `stipples.size` in the world; a scene file cannot say either.
    #[error("{key} is no length of its space")]
    Length {
        /// The key.
        key: &'static str,
    },
    /// More voxels than can be told apart while the points are put in order.
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
