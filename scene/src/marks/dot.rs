//! Dots.

use glam::{DVec2, DVec3};

/// A filled disc of the layer's colour: seven numbers, 56 bytes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dot {
    /// Centre on the page, in mm, y down.
    pub at: DVec2,
    /// The point in the world that the dot stands for.
    pub world: DVec3,
    /// The radius, in mm on the page.
    pub radius: f64,
    /// The opacity in (0, 1]. It multiplies the opacity of the pen's colour.
    pub opacity: f64,
}
