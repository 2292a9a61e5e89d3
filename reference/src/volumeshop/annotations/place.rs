//! A label at a hull point: its box, its leader line, and where two labels meet.

use super::hull::{HullPoint, RadialHull};
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
        self.corners[0].cmplt(upper).all() && lower.cmplt(self.corners[1]).all()
    }

    /// Whether the leader line of one of two labels runs through the inside of the other one's box. Boxes lie outside
    /// the hull, so only the second segment can.
    pub(super) fn touches_box(&self, other: &Self) -> bool {
        passes([self.hull.at, self.end], other.corners) || passes([other.hull.at, other.end], self.corners)
    }

    /// Whether two leader lines have a point in common that is not a shared anchor.
    ///
    /// First segments lie in the hull. Second segments are outward normals of a convex curve, which never meet. So first
    /// segments decide.
    pub(super) fn crosses(&self, other: &Self) -> bool {
        let ([a, b], [c, d]) = ([self.anchor, self.hull.at], [other.anchor, other.hull.at]);
        if a == c {
            return false;
        }
        // Each line has the other segment's ends on both sides. On one line, bounding boxes decide.
        let side = |from: DVec2, to: DVec2, point: DVec2| (to - from).perp_dot(point - from);
        let straddles = |x: f64, y: f64| !(x > 0.0 && y > 0.0 || x < 0.0 && y < 0.0);
        a.min(b).cmple(c.max(d)).all()
            && c.min(d).cmple(a.max(b)).all()
            && straddles(side(a, b, c), side(a, b, d))
            && straddles(side(c, d, a), side(c, d, b))
    }
}

/// Whether a point lies in a closed rectangle.
pub(super) fn within(point: DVec2, [lower, upper]: [DVec2; 2]) -> bool {
    point.cmpge(lower).all() && point.cmple(upper).all()
}

/// Whether a segment passes through the inside of a rectangle.
fn passes([from, to]: [DVec2; 2], [lower, upper]: [DVec2; 2]) -> bool {
    let (mut enter, mut leave) = (0.0f64, 1.0f64);
    for axis in 0..2 {
        let (start, way) = (from[axis], to[axis] - from[axis]);
        let [a, b] = [(lower[axis] - start) / way, (upper[axis] - start) / way];
        if way != 0.0 {
            (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
        } else if start <= lower[axis] || start >= upper[axis] {
            return false;
        }
    }
    enter < leave
}
