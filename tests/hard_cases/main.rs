//! Where renderers go wrong: a file a theme.

#[path = "../common/mod.rs"]
mod common;

mod blending;
mod camera;
mod counts;
mod hash;
mod layers;
mod masks;
mod mirror;
mod offset;
mod phong;
mod probe;
mod slabs;
mod styles;
mod termination;
