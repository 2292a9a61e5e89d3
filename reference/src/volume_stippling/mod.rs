//! Volume stippling (Lu, Morris, Ebert, Rheingans, Hansen 2002).
//!
//! [`Preprocess`] finds the voxels that get points and makes the points, once, from the reference camera. A frame
//! then draws a prefix of each voxel's list, whose length the factors give.

mod area;
mod curve_lines;
mod curves;
mod dot_counts;
mod elimination;
mod error;
mod factors;
mod frame;
mod hidden;
mod layers;
mod norms;
mod order;
mod preprocess;
mod resolution;
mod ridge;
mod slab;
pub mod step_wedge;
mod surface_layer;

pub use curve_lines::joined;
pub use curves::{CurveSegment, CurveVoxels, exhaustive};
pub use elimination::{DotCandidate, eliminate};
pub use error::StippleError;
pub use frame::{FrameDots, FrameInputs, Frames, PenTone, choose_on_page, viewing_distance};
pub use hidden::{hides, seen};
pub use preprocess::Preprocess;
