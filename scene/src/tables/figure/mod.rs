//! The tables of a figure file: several scenes on one page.

mod panel;
pub(crate) mod root;
mod settings;

pub use panel::{Inset, Panel, PanelSource};
pub use root::Figure;
pub use settings::{FigureSettings, PanelCameras, PanelLetters};
