//! Bruckner and Gröller, VolumeShop: An Interactive System for Direct Volume Illustration, IEEE Visualization 2005.

pub mod annotations;
pub mod conventions;
pub mod far_side;
mod funnel;
pub mod fuzzy;
pub mod ghosting;
pub mod intersections;
pub mod lighting;
mod membership;
pub mod painting;
mod preview;
pub mod sets;
pub mod shares;

pub use funnel::{FunnelMap, guard};
pub use lighting::LightingFunction;
pub use membership::Memberships;
pub use preview::preview;
pub use sets::{ObjectSet, combined};
pub use shares::Shares;
