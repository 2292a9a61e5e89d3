//! Transfer functions between their nodes.

pub mod gate;
pub(crate) mod lanes;
pub mod over;
mod piecewise;
mod plane;
mod stops;
mod table;

pub use piecewise::{NodesError, Piecewise, Place};
pub use plane::{Patch, Plane};
pub use stops::{Coordinate, Stops};
pub use table::Table;
