//! Compositing: two orders in which samples come together, by the one *over* of [`crate::accumulator`].
//!
//! [`ray_order`] follows one ray at a time. [`plane_order`] visits rays plane by plane, for halos, which depend on the
//! samples of earlier planes. Without halos both give the same bits and the same counts.

mod cast;
mod layers;
mod object_ray;
mod object_seeds;
mod part_ray;
mod path;
pub(super) mod plane_order;
pub(super) mod ray_order;
mod ray_state;
mod seed_rays;
mod selection_ray;
mod waiting_tile;

pub(super) use cast::Cast;
pub(super) use layers::{Sums, covering_objects};
pub(super) use object_ray::ObjectRay;
pub(super) use part_ray::{FieldEvaluator, depth_of_part};
pub(super) use path::Step;
pub(super) use ray_state::RayState;
pub(super) use selection_ray::{EMPTY, PlacedSelection};
