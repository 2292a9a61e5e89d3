//! Interactive volume illustration (Nagy, Schneider and Westermann, Vision, Modeling and Visualization 2002).
//!
//! A [`Pyramid`] finds the cells of an iso-surface (3.2). [`Seeds`] selects the cells in which strokes begin (4.1).
//! [`StrokeGrower`] grows a stroke along a line of curvature from each seed (3, 4.2). [`outlines`] are found anew for each
//! camera. [`Sight`] projects strokes and outlines onto the page and removes their hidden parts (4.3.2). A [`LineSpacing`]
//! keeps lines apart on the page.
//!
//! Section 4.4: [`toon`] selects a tone by the light, [`silhouette`] blackens surfaces that turn away from the eye,
//! and [`view_opacity`] makes them more opaque.

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
pub use counts::{DirectionCounts, HatchCounts, NoDirection, RejectCause, RejectCounts, StrokeEnd, StrokeEnds};
pub use dash::{dash_vertices, dashed};
pub use even::{EvenStrokes, StrokeDirection};
pub use gaps::{GappedLines, gapped};
pub use ground::StrokeField;
pub use line_light::{LineLight, LineLightTable, LineLightTerms};
pub use measures::{LargestMeasure, VoxelMeasure};
pub use noise::deviation;
pub use orientation::{ReferenceField, longest_axis};
pub use outline::{OutlineStrokes, outlines};
pub use packed::PackedStrokes;
pub use placement::Seed;
pub use pyramid::Pyramid;
pub use seeds::{SeedRule, Seeds};
pub use sight::{PenState, Sight, VisibleLines};
pub use silhouette::SilhouetteTest;
pub use spacing::{LineDistance, LineSpacing};
pub use stored::{DirectionInterpolation, DirectionStorage};
pub use strokes::{CurvatureFamily, GrownStrokes, HatchParams, StrokeGrower};
pub use styled::{StrokePoint, StyledStroke, drawn, grain};
pub use toon::Toon;
pub use umbilics::{DirectionEstimator, PrincipalDirections, Thresholds};
pub use view_opacity::ViewOpacity;

#[cfg(test)]
mod tests;
