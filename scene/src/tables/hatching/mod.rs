//! `[hatching]`: strokes along the lines of curvature of an iso-surface ([HATCH-1] … [HATCH-21]).

mod directions;
mod lighting;
mod presets;
mod stroke;
mod table;

pub use directions::{DirectionRule, DirectionSource, Directions, Interpolate, Reference, StoredAt};
pub use lighting::LineLighting;
pub(crate) use presets::HatchPreset;
pub use stroke::StrokeStyle;
pub(crate) use table::TABLE;
pub use table::{Family, HatchIso, HatchStyle, Hatching, Hidden, SeedsBy, Spacing};
