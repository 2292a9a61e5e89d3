//! Drypoint, an illustrative volume renderer: lit-sphere styles, contours of controlled thickness and translucent
//! volumes from CT, MRI and simulation data.
//!
//! This facade holds no formula. [`scene`] says what a picture is made of, [`reference`] computes it, [`output`] writes
//! it; [`job`] hands from one to the next.

pub mod failure;
pub mod job;

pub use drypoint_output as output;
pub use drypoint_reference as reference;
pub use drypoint_scene as scene;
pub use failure::Failure;
