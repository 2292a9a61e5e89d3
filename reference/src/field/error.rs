//! Reconstructions that cannot be.

use drypoint_scene::shot::NotSmooth;

/// A field that cannot be prepared.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FieldError {
    /// An `analytic` Hessian of a kernel without a continuous second derivative ([REC-3]).
    #[error(transparent)]
    NotSmooth(#[from] NotSmooth),
    /// Values that the number type of the samples does not hold.
    #[error("values up to {largest:e} are too large for the number type of the samples")]
    TooLarge {
        /// The largest |value| of the volume.
        largest: f64,
    },
    /// A σ of the `gaussian` Hessian that is not a length, or is longer than the sums are made for.
    #[error("scale = {scale} world units is not between 0 and {longest}, which is 1000 voxels")]
    Scale {
        /// The scale given, in world units.
        scale: f64,
        /// The longest, in world units.
        longest: f64,
    },
}
