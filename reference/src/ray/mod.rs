//! Casting rays through the field.

pub mod lattice;
pub mod opacity;
pub mod piecewise;
pub mod skip;
