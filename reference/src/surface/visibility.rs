//! Visibility of points in front of or behind an opaque iso-surface ([HATCH-14], [STIP-15]).

use super::IsoSurface;
use drypoint_scene::glam::DVec3;
use drypoint_scene::tables::Outside;
use drypoint_scene::view::View;

impl IsoSurface<'_, '_> {
    /// Whether the surface lies between the eye and a point in world space, or at the point itself. It does if there
    /// is a root at an eye depth up to the point's and, in perspective, from `near` on. A point on the surface must
    /// be tested at a distance in front of it ([HATCH-7]).
    pub fn hides(&self, point: DVec3, view: &View, near: f64) -> bool {
        let depth = (point - view.eye).dot(view.forward);
        if view.perspective {
            depth >= near && self.first_root(view.eye, (point - view.eye) / depth, [near, depth]).is_some()
        } else {
            // The ray starts at the point, where rounding is smallest, and runs to the eye at infinity.
            self.first_root(point, -view.forward, [0.0, f64::INFINITY]).is_some()
        }
    }

    /// The side that is in front of the surface for a camera: 1 outwards, −1 inwards. It is inwards for an eye inside
    /// the volume, on the inner side of the value.
    pub fn front(&self, view: &View) -> f64 {
        let eye = self.field().volume().grid().to_index(view.eye);
        let inside = |value: f64| match self.field().reconstruction().outside {
            Outside::Low => value > self.iso(),
            Outside::High => value < self.iso(),
        };
        if view.perspective && self.value(eye).is_some_and(inside) { -1.0 } else { 1.0 }
    }
}
