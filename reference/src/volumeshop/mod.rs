//! VolumeShop (Bruckner and Gröller 2005).

pub mod far_side;
mod funnel;
pub mod fuzzy;
pub mod ghosting;
pub mod intersections;
mod membership;
pub mod painting;
pub mod sets;
pub mod shares;

pub use funnel::{FunnelMap, guard};
pub use membership::Memberships;
pub use sets::{ObjectSet, combined};
pub use shares::Shares;
