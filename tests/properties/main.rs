//! What holds of every scene, on random ones.

#[path = "../common/mod.rs"]
mod common;

mod along_ray;
mod architecture;
mod clips;
mod coarse;
mod coverage;
mod generator;
mod lanes;
mod marks;
mod orbit;
mod order;
mod over_two;
mod parts;
mod picking;
mod planes;
mod refinement;
mod scenes;
mod skipping;
mod sources;
mod stop;
mod subset;
mod weight;
