//! Interactive volume illustration (Nagy, Schneider and Westermann 2002): strokes along the lines of curvature.
//!
//! [`Strokes`] grows a stroke from each cell that it is given.

mod cone;
mod counts;
pub mod directions;
mod front;
mod ground;
pub mod integrator;
mod orientation;
mod placement;
mod search;
mod strokes;
mod umbilics;

pub use cone::NormalCone;
pub use counts::{HatchCounts, NoDirection, Rejected, Rejections, Scales, Stop, Stops};
pub use ground::Ground;
pub use orientation::{Reference, longest_axis};
pub use placement::Seed;
pub use strokes::{Family, Grown, Hatching, Strokes};
pub use umbilics::{Directions, Rule, Thresholds};

#[cfg(test)]
mod tests;
