//! Bruckner and Gröller, Style Transfer Functions for Illustrative Volume Rendering, Computer Graphics Forum 26(3),
//! 2007.
//!
//! A visible sample passes through these modules in order. [`crate::transfer`] gives the position of the value and its
//! α_u, and [`lookup`] the styles (3.2, 4.1). [`frame`] gives the normal for the lookup. [`curvature_along_ray`] gives
//! κ_v (3.3), and [`contour`] converts it to the threshold τ (eq. 1) and pushes the normal outwards. The styles are
//! looked up in their [`sphere_map`]s, or in their [`mipmaps`] (4.3). [`transparency`] computes the opacity (eq. 2),
//! per reference length and not yet corrected for the step ([VAL-4]).

pub mod contour;
pub mod curvature_along_ray;
pub mod extract;
pub mod frame;
pub(crate) mod lanes;
mod lit_disc;
pub mod lookup;
pub mod mipmaps;
mod preview;
pub mod sphere_map;
pub mod transparency;

pub use contour::Contour;
pub use lit_disc::lit_disc;
pub use lookup::{Blend, Blend2, Spheres, StyleIndex};
pub use mipmaps::{Detail, Footprint, MipMap};
pub use preview::preview;
pub use sphere_map::SphereMap;
