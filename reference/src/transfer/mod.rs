//! Transfer functions between their nodes.

pub mod gate;
pub(crate) mod lanes;
pub mod over;
mod piecewise;
mod plane;
mod stops;
mod table;

pub use piecewise::{NodePlace, NodesError, Piecewise};
pub use plane::{NodePatch, TransferPlane};
pub use stops::{AxisStops, Coordinate};
pub use table::IndexTable;
