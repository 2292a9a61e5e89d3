//! Interactive volume illustration (Nagy, Schneider and Westermann, Vision, Modeling and Visualization 2002).
//!
//! A [`Pyramid`] finds the cells of an iso-surface (3.2). [`Seeds`] selects the cells in which strokes begin (4.1).
//! [`StrokeGrower`] grows a stroke along a line of curvature from each seed (3, 4.2). [`outlines()`] are found anew
//! for each camera. [`Sight`] projects strokes and outlines onto the page and removes their hidden parts (4.3.2). A
//! [`LineSpacing`] keeps lines apart on the page.
//!
//! Section 4.4: [`Toon`] selects a tone by the light, [`SilhouetteTest`] blackens surfaces that turn away from the
//! eye, and [`ViewOpacity`] makes them more opaque.

pub mod directions;
mod hatching;
mod outlines;
mod seeds;
mod sight;
mod strokes;
mod tone;

pub use directions::{
    DirectionEstimator, DirectionInterpolation, DirectionStorage, PrincipalDirections, ReferenceField, Thresholds,
    deviation, longest_axis,
};
pub use hatching::{GrownHatching, Hatching, SHORTEST, VisibleValues};
pub use outlines::{CreaseStrokes, OutlineStrokes, Outlines, before_cusps, creases, outlines};
pub use seeds::{LargestMeasure, Pyramid, Seed, SeedRule, Seeds, VoxelMeasure, gradient_range, seed_layers};
pub use sight::{
    GappedLines, Joining, PenState, Sight, StrokePoint, StyledStroke, VisibleLines, cut_gaps, dash_vertices, dashed,
    drawn, gapped, grain, joined, largest_scale, without_doubles,
};
pub use strokes::{
    CurvatureFamily, DirectionCounts, GrownStrokes, HatchCounts, HatchParams, NoDirection, NormalCone, PackedStrokes,
    RejectCause, RejectCounts, StrokeEnd, StrokeEnds, StrokeField, StrokeGrower, integrator,
};
pub use tone::{
    DepthRange, EvenStrokes, LineDistance, LineLight, LineLightTable, LineLightTerms, LineSpacing, SilhouetteTest,
    StrokeDirection, Toon, ViewOpacity, WidthShares, crossed_tone, crossed_tones, scatter, surface_tone,
};

#[cfg(test)]
mod tests;
