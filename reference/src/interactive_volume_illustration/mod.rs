//! Interactive volume illustration (Nagy, Schneider and Westermann, Vision, Modeling and Visualization 2002).
//!
//! Lines on iso-surfaces: [`Pyramid`] leads to the cells of one, [`Seeds`] are those of them that strokes begin in, and
//! [`Strokes`] grows a stroke along a line of curvature from each (3, 4.1, 4.2). [`outlines`] are found anew for each camera.
//! [`Sight`] brings both to the page, without what is hidden (4.3.2), and a [`Spread`] keeps them apart there.
//!
//! Section 4.4: [`toon`] chooses a tone by the light, [`silhouette`] blackens what turns away from the eye, and
//! [`view_opacity`] makes it more opaque.

mod cells;
mod chain;
mod clear;
mod cone;
mod counts;
mod dash;
pub mod directions;
mod even;
mod front;
mod gaps;
mod ground;
pub mod integrator;
mod level;
mod line_light;
mod measures;
mod noise;
mod orientation;
mod outline;
mod packed;
mod placement;
mod project;
mod pyramid;
mod refine;
mod rim;
mod search;
mod seeds;
mod sight;
pub mod silhouette;
mod spacing;
mod stored;
mod strokes;
mod styled;
mod tetrahedra;
mod thin;
pub mod toon;
mod umbilics;
pub mod view_opacity;
mod without_iso;

pub use cells::gradient_range;
pub use cone::NormalCone;
pub use counts::{HatchCounts, NoDirection, Rejected, Rejections, Scales, Stop, Stops};
pub use dash::{dash_vertices, dashed};
pub use even::{Along, Even};
pub use gaps::{Gapped, gapped};
pub use ground::Ground;
pub use line_light::{LineLight, Terms, TermsTable};
pub use measures::{Largest, Measure};
pub use noise::deviation;
pub use orientation::{Reference, longest_axis};
pub use outline::{Outlines, outlines};
pub use packed::Packed;
pub use placement::Seed;
pub use pyramid::Pyramid;
pub use seeds::{SeedRule, Seeds};
pub use sight::{Pen, Seen, Sight};
pub use silhouette::Silhouette;
pub use spacing::{Apart, Spread};
pub use stored::{Between, Storing};
pub use strokes::{Family, Grown, Hatching, Strokes};
pub use styled::{Drawn, Place, drawn, grain};
pub use toon::Toon;
pub use umbilics::{Directions, Rule, Thresholds};
pub use view_opacity::ViewOpacity;

#[cfg(test)]
mod tests;
