//! Interactive volume illustration (Nagy, Schneider and Westermann, Vision, Modeling and Visualization 2002).
//!
//! Lines on iso-surfaces: [`Pyramid`] leads to the cells of one, [`Seeds`] are those of them that strokes begin in (4.1).
//! [`outlines`] are found anew for each camera. [`Sight`] brings strokes to the page, without what is hidden (4.3.2), and
//! [`spread`] keeps them apart there.
//!
//! Section 4.4: [`toon`] chooses a tone by the light, [`silhouette`] blackens what turns away from the eye, and
//! [`view_opacity`] makes it more opaque.

mod chain;
mod level;
mod measures;
mod outline;
mod project;
mod pyramid;
mod refine;
mod rim;
mod seeds;
mod sight;
pub mod silhouette;
mod spacing;
mod tetrahedra;
mod thin;
pub mod toon;
pub mod view_opacity;

pub use measures::{Largest, Measure};
pub use outline::{Outlines, outlines};
pub use pyramid::Pyramid;
pub use seeds::{SeedRule, Seeds};
pub use sight::{Pen, Seen, Sight};
pub use silhouette::Silhouette;
pub use spacing::{Apart, spread};
pub use toon::Toon;
pub use view_opacity::ViewOpacity;
