//! Filled areas.

use crate::color::Rgb;
use glam::DVec2;

/// A filled area on the page.
#[derive(Clone, Debug, PartialEq)]
pub struct Area {
    /// The outlines, in mm, y down. They are filled by the nonzero rule.
    pub outlines: Vec<Vec<DVec2>>,
    /// The opacity in (0, 1]. It multiplies the opacity of the pen's colour.
    pub opacity: f64,
    /// A colour in place of the pen's; none: the pen's.
    pub color: Option<Rgb>,
}
