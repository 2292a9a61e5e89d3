//! Files of pictures: PNG and EXR, written, read back, compared and laid out on contact sheets; GIF and APNG of frames.
//! Files of marks: PNG, SVG, PDF and lists, and the order in which a plotter draws them.
//!
//! This crate knows no volume. It writes a [`drypoint_scene::picture::Picture`] or [`drypoint_scene::marks::Marks`],
//! and it reads an [`read::Image`] or a list. Comments cite rules of the specification by tags such as [VAL-3].

pub mod animation;
pub mod atomic;
pub mod compare;
mod disc;
pub mod encode;
pub mod error;
pub mod exr;
mod finite;
mod grid;
mod layers;
pub mod list;
pub mod paint;
pub mod plotter;
pub mod png;
pub mod raster;
pub mod read;
pub mod sheet;
pub mod text;
pub mod vector;

pub use error::OutputError;
