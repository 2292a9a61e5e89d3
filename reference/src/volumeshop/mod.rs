//! Bruckner and Gröller, VolumeShop: An Interactive System for Direct Volume Illustration, IEEE Visualization 2005.

pub mod lighting;
mod preview;

pub use lighting::LightingFunction;
pub use preview::preview;
