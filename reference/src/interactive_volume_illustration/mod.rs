//! Nagy, Schneider and Westermann, Interactive Volume Illustration, Vision, Modeling and Visualization 2002.
//!
//! Section 4.4: [`toon`] chooses a tone by the light, [`silhouette`] blackens what turns away from the eye, and
//! [`view_opacity`] makes it more opaque.

pub mod silhouette;
pub mod toon;
pub mod view_opacity;

pub use silhouette::Silhouette;
pub use toon::Toon;
pub use view_opacity::ViewOpacity;
