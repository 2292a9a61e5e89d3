//! Volumetric halos (Bruckner and Gröller 2007).

mod gradient_image;
mod halo_field;
mod median;
mod spans;
mod spreading;
mod taps;

pub use halo_field::{HaloField, Process, SpreadParams};
pub use taps::Border;
