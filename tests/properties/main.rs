//! What holds of every scene, on random ones.

#[path = "../common/mod.rs"]
mod common;

mod generator;
mod order;
mod scenes;
mod skipping;
