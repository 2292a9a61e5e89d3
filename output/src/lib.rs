//! Files of pictures: PNG, EXR, reading them back, comparing them, laying them out on a sheet.
//!
//! This crate knows no volume: what it writes is a [`drypoint_scene::picture::Picture`], what it reads is an
//! [`read::Image`]. Rules of the specification are cited by their tags, such as [VAL-3].

pub mod atomic;
pub mod compare;
mod disc;
pub mod encode;
pub mod error;
pub mod exr;
mod layers;
pub mod paint;
pub mod png;
pub mod raster;
pub mod read;
pub mod sheet;
pub mod text;

pub use error::OutputError;
