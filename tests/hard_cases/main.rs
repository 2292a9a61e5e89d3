//! Where renderers go wrong: a file a theme. What follows from the mathematics alone is a record of [`stability`].

#[path = "../common/mod.rs"]
mod common;

mod anisotropy;
mod blending;
mod borders;
mod camera;
mod clips;
mod counts;
mod degenerate;
mod empty;
mod eye;
mod halos;
mod hash;
mod layers;
mod lighting;
mod masks;
mod meshes;
mod mirror;
mod offset;
mod opacities;
mod outlines;
mod phong;
mod probe;
mod reconstruction;
mod scales;
mod slabs;
mod small;
mod stability;
mod steps;
mod stipples;
mod strokes;
mod styles;
mod surfaces;
mod symmetry;
mod termination;
mod thresholds;
mod toon;
