//! Files of pictures: PNG, EXR, reading them back, comparing them, laying them out on a sheet; and marks on a page as
//! PNG, SVG, PDF and lists, and in the order in which a plotter draws them.
//!
//! This crate knows no volume: what it writes is a [`drypoint_scene::picture::Picture`] or
//! [`drypoint_scene::marks::Marks`], what it reads is an [`read::Image`] or a list. Rules of the specification are cited by their tags, such as [VAL-3].

pub mod atomic;
pub mod compare;
mod disc;
pub mod encode;
pub mod error;
pub mod exr;
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
