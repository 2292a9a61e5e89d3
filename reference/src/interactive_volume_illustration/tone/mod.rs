//! Tones (4.3.1, 4.4): light on lines and surfaces, and the distance of lines on the page.

mod evenly;
mod line_light;
mod line_spacing;
mod silhouette;
mod toon;
mod view_opacity;

pub use evenly::{EvenStrokes, StrokeDirection};
pub use line_light::{LineLight, LineLightTable, LineLightTerms};
pub use line_spacing::{LineDistance, LineSpacing};
pub use silhouette::SilhouetteTest;
pub use toon::Toon;
pub use view_opacity::ViewOpacity;
