//! Segments and rectangles of a page: where two leader lines meet, and where a line runs through a box.

use drypoint_scene::glam::DVec2;

/// The least angle, in radians, between two lines from one anchor that are told apart. Rounding turns a line by less.
const LEAST_ANGLE: f64 = 1e-9;

/// Whether a point lies in a closed rectangle.
pub(super) fn within(point: DVec2, [lower, upper]: [DVec2; 2]) -> bool {
    point.cmpge(lower).all() && point.cmple(upper).all()
}

/// Whether the insides of two rectangles overlap.
pub(super) fn overlap([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    a.cmplt(d).all() && c.cmplt(b).all()
}

/// Whether a segment passes through the inside of a rectangle.
pub(super) fn passes([from, to]: [DVec2; 2], [lower, upper]: [DVec2; 2]) -> bool {
    // Most segments are beside the rectangle, or before or behind it.
    if !(from.max(to).cmpgt(lower).all() && from.min(to).cmplt(upper).all()) {
        return false;
    }
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

/// Whether two segments have a point in common.
pub(super) fn meet([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    // Each line has the other segment's ends on both sides. On one line, bounding boxes decide.
    let side = |from: DVec2, to: DVec2, point: DVec2| (to - from).perp_dot(point - from);
    let straddles = |x: f64, y: f64| !(x > 0.0 && y > 0.0 || x < 0.0 && y < 0.0);
    a.min(b).cmple(c.max(d)).all()
        && c.min(d).cmple(a.max(b)).all()
        && straddles(side(a, b, c), side(a, b, d))
        && straddles(side(c, d, a), side(c, d, b))
}

/// Whether two first segments of leader lines cross, each from its anchor.
///
/// Lines from one anchor cross if one runs on top of the other, or if their other ends are one point.
pub(super) fn cross([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    if a != c {
        return meet([a, b], [c, d]);
    }
    let (first, second) = (b - a, d - a);
    let is_along =
        first.dot(second) > 0.0 && first.perp_dot(second).abs() <= LEAST_ANGLE * first.length() * second.length();
    b == d || is_along
}
