//! Visibility of points in front of or behind an opaque iso-surface ([HATCH-14], [STIP-15]).

use super::{Clipped, IsoSurface};
use drypoint_scene::glam::DVec3;
use drypoint_scene::shot::Outside;
use drypoint_scene::view::View;

impl IsoSurface<'_, '_> {
    /// Whether the surface lies between the eye and a point in world space, or at the point itself. It does if there
    /// is a root at an eye depth up to the point's and, in perspective, from `near` on. A point on the surface must
    /// be tested at a distance in front of it ([HATCH-7]).
    pub fn hides(&self, point: DVec3, view: &View, near: f64) -> bool {
        let depth = (point - view.eye).dot(view.forward);
        if view.perspective {
            depth >= near && self.meets(view.eye, (point - view.eye) / depth, [near, depth])
        } else {
            // The ray starts at the point, where rounding is smallest, and runs to infinity towards the eye.
            self.leaves(point, -view.forward, [0.0, f64::INFINITY])
        }
    }

    /// Whether a line from the eye meets the clipped surface.
    fn meets(&self, origin: DVec3, direction: DVec3, range: [f64; 2]) -> bool {
        if self.clip().is_empty() {
            return self.first_root(origin, direction, range).is_some();
        }
        let (line, mask) = (self.index_line(origin, direction), self.field().volume().mask());
        self.roots.first_left(self.field(), mask, line, range, self.cut()).is_some()
    }

    /// Like [`meets`](Self::meets), for a line that runs towards the eye.
    fn leaves(&self, origin: DVec3, direction: DVec3, range: [f64; 2]) -> bool {
        if self.clip().is_empty() {
            return self.first_root(origin, direction, range).is_some();
        }
        let (line, mask) = (self.index_line(origin, direction), self.field().volume().mask());
        self.roots.is_left(self.field(), mask, line, range, self.cut())
    }

    fn index_line(&self, origin: DVec3, direction: DVec3) -> [DVec3; 2] {
        let grid = self.field().volume().grid();
        [grid.to_index(origin), grid.inverse_axes() * direction]
    }

    fn cut(&self) -> Clipped<'_> {
        Clipped { clip: self.clip(), outside: self.field().reconstruction().outside }
    }

    /// The side that is in front of the surface for a camera: 1 outwards, −1 inwards. It is −1 if a perspective eye is
    /// inside the volume, on the inner side of the value, and no plane cuts there.
    pub fn front(&self, view: &View) -> f64 {
        let eye = self.field().volume().grid().to_index(view.eye);
        let inside = |value: f64| match self.field().reconstruction().outside {
            Outside::Low => value > self.iso(),
            Outside::High => value < self.iso(),
        };
        let is_inside = view.perspective && !self.clip().cut(eye) && self.value(eye).is_some_and(inside);
        if is_inside { -1.0 } else { 1.0 }
    }
}
