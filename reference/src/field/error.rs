//! Errors of reconstructions.

use drypoint_scene::shot::NotSmooth;

/// A field that cannot be prepared.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FieldError {
    /// An `analytic` Hessian for a kernel without a continuous second derivative ([REC-3]).
    #[error(transparent)]
    NotSmooth(#[from] NotSmooth),
    /// Values too large for the number type of the samples.
    #[error("values up to {largest:e} are too large for the number type of the samples")]
    TooLarge {
        /// The largest |value| of the volume.
        largest: f64,
    },
    /// The σ of the `gaussian` Hessian is not a length, or is longer than the supported maximum.
    #[error("scale = {scale} world units is not between 0 and {longest}, which is 1000 voxels")]
    Scale {
        /// The scale given, in world units.
        scale: f64,
        /// The longest supported scale, in world units.
        longest: f64,
    },
}
