//! The quantities that a transfer function can depend on ([STF-4]), measured at samples.
//!
//! The list is open. A new quantity is an [`Axis`](drypoint_scene::tables::Axis) of the scene, which declares its
//! needs, and a [`AxisMeasure`] here. Samples evaluate only the quantities that the axes name.

mod label;
pub mod label_distance;
mod other_volume;
mod point;
mod sample_quantities;

pub use label::SampleLabel;
pub use label_distance::LabelDistance;
pub use other_volume::OtherVolume;
pub use point::PointDistance;
pub use sample_quantities::{CurvatureMeasure, GradientMagnitude, SampleValue};

use super::Coordinate;
use crate::field::CellPosition;
use crate::number::{Real, Vec3};

/// The properties of a sample from which its quantities are measured. A property that no axis needs has its neutral
/// value.
#[derive(Clone, Copy, Debug)]
pub struct SampleQuantities<R> {
    /// The position in the data volume's index space.
    pub position: Vec3<R>,
    /// The position as a cell and coordinates in it.
    pub place: CellPosition<R>,
    /// The sample's value.
    pub value: R,
    /// ‖g‖ in world space, times the power of two of [SPACE-4]; 0 without a normal ([PREC-3]).
    pub gradient: R,
    /// |g| of [VAL-2]; 0 without a normal.
    pub magnitude: R,
    /// κ₁ and κ₂; 0 without a normal.
    pub principal: [R; 2],
    /// The scene's κ_v; 0 without a normal.
    pub kappa: R,
}

/// A quantity that is measured at samples.
pub trait AxisMeasure<R: Real>: Send + Sync {
    /// The quantity at a sample.
    fn at(&self, here: &SampleQuantities<R>) -> Coordinate<R>;

    /// Name and size in bytes of the stored data. Returns none if nothing is stored.
    fn bytes(&self) -> Option<(&'static str, u64)> {
        None
    }

    /// Name and number of the voxels evaluated before the rays.
    fn preprocess(&self) -> Option<(&'static str, u64)> {
        None
    }
}

#[cfg(test)]
impl<R: Real> SampleQuantities<R> {
    /// A sample with a position and neutral values.
    fn at(position: [f64; 3]) -> Self {
        let zero = R::ZERO;
        let place = CellPosition { cell: [0; 3], w: [zero; 3] };
        let position = Vec3::from_glam(position.into());
        Self { position, place, value: zero, gradient: zero, magnitude: zero, principal: [zero; 2], kappa: zero }
    }
}
