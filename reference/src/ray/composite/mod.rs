//! Compositing: two orders in which samples come together, by the one *over* of [`crate::accumulator`].
//!
//! [`ray_order`] follows one ray at a time. [`plane_order`] visits rays plane by plane, for effects that read what
//! lies on the planes before. Both give the same bits and the same counts.

mod cast;
mod layers;
mod path;
mod plane_effect;
pub(super) mod plane_order;
pub(super) mod ray_order;
mod ray_state;

pub(super) use cast::Cast;
pub(super) use layers::{Sums, pooled};
pub(super) use path::Step;
pub use plane_effect::{LayBehind, PlaneEffect, RayOnPlane, SampleOnPlane};
pub(super) use ray_state::RayState;
