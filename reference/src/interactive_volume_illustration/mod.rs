//! Interactive volume illustration (Nagy, Schneider and Westermann 2002): strokes along the lines of curvature.

pub mod directions;
pub mod integrator;
