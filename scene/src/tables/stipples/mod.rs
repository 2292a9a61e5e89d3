//! `[stipples]`: volume stippling ([STIP-1] … [STIP-21]). Each factor is a table of its own; one that is absent is 1.

mod curves;
mod factors;
mod kinds;
mod presets;
mod table;

pub use curves::{Curves, CurvesTest};
pub use factors::{Boundary, Distance, Interior, Lighting, Resolution, Silhouette};
pub use kinds::{DotColor, PointsPerPixel, Threshold};
pub(crate) use presets::StipplePreset;
pub(crate) use table::TABLE;
pub use table::{DotDensity, Even, FactorRange, Ink, Snap, StippleGradient, StippleOrder, Stipples};
