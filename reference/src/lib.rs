//! The CPU truth of Drypoint: pictures computed in f64, from the stored voxels to the framebuffer.
//!
//! This crate opens no file and knows no file format. Its input and output are plain types of `drypoint_scene`.

mod accumulator;
mod bilinear;
mod convex_hull;
pub mod dot_colors;
pub mod field;
pub mod figure;
pub mod interactive_volume_illustration;
pub mod labels;
mod mesh;
pub mod number;
pub mod ray;
pub mod shading;
pub mod style_transfer_functions;
pub mod suggest;
pub mod surface;
pub mod transfer;
pub mod volume_stippling;
pub mod volumeshop;
pub mod volumetric_halos;
