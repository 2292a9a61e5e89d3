//! A label at a hull point: its box, its leader line, and where two labels meet.

use super::hull::{HullPoint, RadialHull};
use super::segments::{cross, overlap, passes, within};
use drypoint_scene::annotations::Annotation;
use drypoint_scene::glam::DVec2;

/// The geometry of a label at a hull point.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub(super) anchor: DVec2,
    pub(super) hull: HullPoint,
    /// Lower and upper corner of the box.
    pub(super) corners: [DVec2; 2],
    /// The end of the leader line at the box.
    pub(super) end: DVec2,
}

impl Place {
    pub(super) fn new(hull: &RadialHull, at: HullPoint, label: &Annotation) -> Self {
        let half = label.size / 2.0;
        let clearance = hull.clearance(&at, half);
        let centre = at.at + at.normal * clearance;
        // A line from the centre along the normal leaves the box at the nearer of the two sides before it.
        let inside = (half.x / at.normal.x.abs()).min(half.y / at.normal.y.abs());
        let end = at.at + at.normal * (clearance - inside).max(0.0);
        Self { anchor: label.anchor, hull: at, corners: [centre - half, centre + half], end }
    }

    /// The length of the leader line up to the hull: the label's distance from its anchor.
    pub(super) fn distance(&self) -> f64 {
        self.anchor.distance(self.hull.at)
    }

    /// Whether box and leader line lie in a closed rectangle. The anchor does.
    pub(super) fn is_within(&self, frame: [DVec2; 2]) -> bool {
        [self.corners[0], self.corners[1], self.hull.at].into_iter().all(|corner| within(corner, frame))
    }

    /// Whether two labels are in conflict.
    pub(super) fn meets(&self, other: &Self) -> bool {
        self.overlaps(other) || self.touches_box(other) || self.crosses(other)
    }

    /// Whether the insides of two boxes overlap.
    pub(super) fn overlaps(&self, other: &Self) -> bool {
        self.covers(other.corners)
    }

    /// Whether the insides of the box and of a rectangle overlap.
    pub(super) fn covers(&self, [lower, upper]: [DVec2; 2]) -> bool {
        overlap(self.corners, [lower, upper])
    }

    /// Whether the leader line of one of two labels runs through the inside of the other one's box. Boxes lie outside
    /// the hull, so only the second segment can.
    pub(super) fn touches_box(&self, other: &Self) -> bool {
        passes([self.hull.at, self.end], other.corners) || passes([other.hull.at, other.end], self.corners)
    }

    /// Whether two leader lines have a point in common that is not a shared anchor, or run on top of each other.
    ///
    /// First segments lie in the hull. Second segments are outward normals of a convex curve, which never meet. So first
    /// segments decide.
    pub(super) fn crosses(&self, other: &Self) -> bool {
        cross([self.anchor, self.hull.at], [other.anchor, other.hull.at])
    }
}
