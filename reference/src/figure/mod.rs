//! Parts of figures beside the picture: scale bars, the directions of the data, the points that labels of structures lead
//! to, and the arrangement of panels.

mod directions;
mod inner_points;
mod panels;
mod scale_bar;

pub use directions::{AxisOnPage, axes_on_page, edge_letters};
pub use inner_points::{MapRegion, inner_points};
pub use panels::{PanelGrid, PanelSize, PlacedPanel};
pub use scale_bar::{round_length, world_per_pixel};
