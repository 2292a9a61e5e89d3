//! Volume stippling (Lu, Morris, Ebert, Rheingans, Hansen 2002).
//!
//! [`Preprocess`] finds the voxels that get points and makes them, once, from the reference camera; a frame then draws of
//! each voxel's list as many as the factors say.

mod area;
mod blue_noise;
mod count;
mod error;
mod factors;
mod frame;
mod norms;
mod order;
mod preprocess;
mod resolution;
mod slab;
mod snap;
mod thin;

pub use error::StippleError;
pub use frame::{Drawn, FrameInputs, Frames, viewing_distance};
pub use preprocess::{Inputs, Preprocess};
