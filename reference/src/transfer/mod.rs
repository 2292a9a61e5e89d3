//! Transfer functions between their nodes.

mod piecewise;

pub use piecewise::{NodesError, Piecewise, Place};
