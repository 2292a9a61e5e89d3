//! VolumeShop (Bruckner and Gröller 2005).

mod membership;
pub mod painting;

pub use membership::Memberships;
