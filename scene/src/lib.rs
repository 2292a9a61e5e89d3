//! The parts of a Drypoint picture: space, volumes, phantoms, scene files, styles, plans, and the plain types that
//! the other crates hand to each other.
//!
//! This crate renders nothing: it has no value of the field between voxels and no loop over pixels.
//! Rules of the specification are cited by their tags, such as [SPACE-4].

pub mod annotations;
pub mod atomic;
pub mod backdrop;
pub mod blue_noise;
pub mod clip;
pub mod color;
pub mod counts;
pub(crate) mod document;
pub mod file;
pub mod fragments;
pub mod inputs;
pub mod intersection_picture;
pub mod knobs;
mod length;
pub mod lighting;
pub mod marks;
pub mod math;
pub mod measured;
pub mod memory;
pub mod mesh;
mod nearest;
pub mod other_grid;
pub mod parallel;
pub mod phantom;
pub mod philox;
pub mod picture;
pub mod plan;
pub mod points;
mod quantity;
pub mod shot;
pub mod source;
pub mod space;
pub mod strokes;
pub mod style;
pub mod tables;
pub mod tone;
pub mod transfer;
pub mod unprintable;
pub mod view;
pub mod volume;

pub use glam;
