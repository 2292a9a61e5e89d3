//! Principal directions and their certainty (3.1): the curvatures of a field, and the directions that strokes follow.

mod mask_margin;
mod noise;
mod orientation;
mod principal;
mod stored;
mod umbilics;

pub use noise::deviation;
pub use orientation::{ReferenceField, longest_axis};
pub use principal::principal;
pub(super) use stored::{CellCache, DirectionInputs, StoredDirections};
pub use stored::{DirectionInterpolation, DirectionStorage};
pub use umbilics::{DirectionEstimator, PrincipalDirections, Thresholds};
