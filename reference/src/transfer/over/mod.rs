//! The quantities that a transfer function can be over ([STF-4]), asked at samples.
//!
//! The list is open. A quantity of one's own is an [`Axis`](drypoint_scene::tables::Axis) of the scene, which says what it needs of a sample, and a
//! [`Measure`] here. What is asked of a sample is only what its axes name.

mod further;
mod label;
pub mod label_distance;
mod of_sample;
mod point;

pub use further::Further;
pub use label::Label;
pub use label_distance::LabelDistance;
pub use of_sample::{Differential, Magnitude, Value};
pub use point::Distance;

use super::Coordinate;
use crate::field::Place;
use crate::number::{Real, Vec3};

/// What is known of a sample when its quantities are measured. What no axis needs has its neutral value.
#[derive(Clone, Copy, Debug)]
pub struct Here<R> {
    /// The position in the data volume's index space.
    pub position: Vec3<R>,
    /// The same as its cell and where in it.
    pub place: Place<R>,
    /// The value.
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

/// One quantity.
pub trait Measure<R: Real>: Send + Sync {
    /// The quantity at a sample.
    fn at(&self, here: &Here<R>) -> Coordinate<R>;

    /// Bytes of what it holds, under a name; none where it holds nothing.
    fn bytes(&self) -> Option<(&'static str, u64)> {
        None
    }

    /// Voxels that were evaluated for it before the rays, under a name.
    fn preprocess(&self) -> Option<(&'static str, u64)> {
        None
    }
}

#[cfg(test)]
impl<R: Real> Here<R> {
    /// A position of which nothing more is known.
    fn at(position: [f64; 3]) -> Self {
        let zero = R::ZERO;
        let place = Place { cell: [0; 3], w: [zero; 3] };
        let position = Vec3::from_glam(position.into());
        Self { position, place, value: zero, gradient: zero, magnitude: zero, principal: [zero; 2], kappa: zero }
    }
}
