//! Bounds of f32 renderers ([GPU-2]), held against the one that there is: `sampling.number = "f32"`.

#[path = "../common/mod.rs"]
mod common;

#[path = "../properties/clips.rs"]
#[allow(dead_code)]
mod clips;
#[path = "../properties/generator.rs"]
#[allow(dead_code)]
mod generator;
#[path = "../properties/over_two.rs"]
#[allow(dead_code)]
mod over_two;

#[path = "../common/halos.rs"]
mod halo_scenes;
mod halos;
#[path = "../common/meshes.rs"]
mod mesh_scenes;
mod meshes;
#[path = "../common/objects.rs"]
mod object_scenes;
mod objects;
mod random;
mod scenes;
mod texts;
