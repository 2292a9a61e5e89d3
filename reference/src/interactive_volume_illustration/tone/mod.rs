//! Tones (4.3.1, 4.4): light on lines and surfaces, and the width and distance of lines on the page.

mod crossed;
mod evenly;
mod line_light;
mod line_spacing;
mod silhouette;
mod stroke_width;
mod toon;
mod view_opacity;

pub use crossed::{crossed_tone, crossed_tones};
pub use evenly::{EvenStrokes, StrokeDirection};
pub use line_light::{LineLight, LineLightTable, LineLightTerms};
pub use line_spacing::{LineDistance, LineSpacing};
pub use silhouette::SilhouetteTest;
pub use stroke_width::{DepthRange, WidthShares, scatter, surface_tone};
pub use toon::Toon;
pub use view_opacity::ViewOpacity;
