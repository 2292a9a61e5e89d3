//! Volumetric halos (Bruckner and Gröller 2007).
//!
//! On each plane of samples, seeds mark surfaces that are seen edge-on ([`seed`], 3.1). They are spread over the
//! picture ([`HaloField`], 3.2). The intensities become a glow behind the samples of a plane, or a tint of the samples
//! on planes farther away (3.3).

mod direction;
mod focus;
mod gradient_image;
mod halo_field;
mod halo_planes;
mod median;
mod possible_field;
mod profile;
pub mod seed;
mod spans;
mod spreading;
mod taps;

pub use direction::DirectionInfluence;
pub use focus::FocusInfluence;
pub use halo_field::{HaloField, Process, SpreadParams};
pub(crate) use halo_planes::{HaloPlanes, PreparedHalo, SeedStrip, Tint, guard};
pub(crate) use possible_field::PossibleField;
pub use profile::HaloProfile;
pub use taps::Border;
