//! Drypoint, an illustrative volume renderer: lit-sphere styles, contours of controlled thickness and translucent
//! volumes from CT, MRI and simulation data.
//!
//! This facade holds no formula. [`scene`] describes a picture, [`mod@reference`] computes it, [`output`] writes it.
//! [`job`] connects them:
//!
//! | step | with |
//! |---|---|
//! | a scene from a file or a text | [`scene::file::load`], [`scene::file::parse`] |
//! | a scene for a bare volume | [`scene::volume::read::read`], [`job::bare`] |
//! | everything that it names | [`job::Job::load`], [`job::Job::with_volume`] |
//! | the same from files in memory | [`job::Job::load_for`] with a [`scene::source::Source`] |
//! | a picture, and what it took | [`job::Job::renderer`], then [`reference::ray::Renderer::frame`] |
//! | a file | [`job::Job::write`] |
//! | the place that is seen at a pixel | [`picking::pick_pixel`] |
//! | points and lines, and frames of all of it | [`marking::Marking`], [`drawing::Drawing`] |
//! | several scenes on one page | [`figure::FigureLayout`] |
//! | frames of the volume alone, on either back end | [`frames::Frames`] |
//! | what its accuracy costs | [`cost::sweep`] |
//! | all of the command | `command::run` |
//!
//! The programs in `examples/` render into a buffer and to standard output, write dots as SVG, make a volume from a
//! formula, and compare two pictures.
//!
//! Every error is a [`Failure`]: what is wrong, where, and what to do.

mod annotating;
mod backend;
#[cfg(feature = "command")]
pub mod command;
pub mod cost;
pub mod drawing;
pub mod failure;
pub mod figure;
pub mod format;
pub mod frames;
#[cfg(feature = "gpu")]
pub mod gpu;
#[cfg(not(feature = "gpu"))]
#[path = "no_gpu.rs"]
pub mod gpu;
pub mod halo;
pub mod job;
pub mod labels;
pub mod marking;
pub mod picking;
pub mod stippling;
pub mod stroking;
#[cfg(feature = "plots")]
pub mod tone_plot;
#[cfg(feature = "gpu")]
pub mod validate;
pub mod wedge;

pub use drypoint_output as output;
pub use drypoint_reference as reference;
pub use drypoint_scene as scene;
pub use failure::{Failure, Failures};
pub use format::Format;
