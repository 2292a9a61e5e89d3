//! A fan: two outlines on the page and the lines that join them.

use crate::convex_hull::hull;
use drypoint_scene::glam::DVec2;
use drypoint_scene::math;
use drypoint_scene::tables::FanShape;
use std::f64::consts::TAU;

/// Points of a circle.
const CIRCLE: usize = 128;

/// The outlines of a fan, in any unit of the page.
#[derive(Clone, Debug, PartialEq)]
pub struct Fan {
    /// The outline around each of both sets of points.
    pub outlines: [Vec<DVec2>; 2],
    /// The lines that join both outlines: the edges of their common hull that do. None if one lies in the other.
    pub joints: Vec<[DVec2; 2]>,
    /// The area between: the common hull without the outlines' insides, to be filled by the nonzero rule.
    pub area: Vec<Vec<DVec2>>,
}

impl Fan {
    /// Returns the fan around two sets of points on the page. Returns none if a set has no finite point.
    pub fn new(shape: FanShape, sets: [&[DVec2]; 2]) -> Option<Self> {
        let [a, b] = sets.map(|points| outline(shape, points));
        let (a, b) = (a?, b?);
        let around = hull(a.iter().chain(&b).copied().collect());
        let is_of_a = |p: &DVec2| a.contains(p);
        let pairs = (0..around.len()).map(|i| [around[i], around[(i + 1) % around.len()]]);
        let joints = pairs.filter(|[p, q]| is_of_a(p) != is_of_a(q)).collect();
        // A hole in a hole would be filled again: of outlines that overlap the larger one alone is a hole.
        let holes: Vec<&Vec<DVec2>> = if overlap(&a, &b) { vec![&b] } else { vec![&a, &b] };
        let holes = holes.into_iter().map(|outline| hull(outline.clone()).into_iter().rev().collect());
        let area = std::iter::once(around.clone()).chain(holes).collect();
        Some(Self { outlines: [a, b], joints, area })
    }
}

/// The rectangle around points, or the circle around the rectangle.
fn outline(shape: FanShape, points: &[DVec2]) -> Option<Vec<DVec2>> {
    let mut finite = points.iter().copied().filter(|point| point.is_finite());
    let first = finite.next()?;
    let [lo, hi] = finite.fold([first; 2], |[lo, hi], point| [lo.min(point), hi.max(point)]);
    Some(match shape {
        FanShape::Rectangle => vec![lo, DVec2::new(hi.x, lo.y), hi, DVec2::new(lo.x, hi.y)],
        FanShape::Circle => {
            let (centre, radius) = ((lo + hi) / 2.0, lo.distance(hi) / 2.0);
            let turn = |i: usize| i as f64 / CIRCLE as f64 * TAU;
            (0..CIRCLE).map(|i| centre + DVec2::new(math::cos(turn(i)), math::sin(turn(i))) * radius).collect()
        }
    })
}

/// Whether the rectangles around two outlines overlap.
fn overlap(a: &[DVec2], b: &[DVec2]) -> bool {
    let ends = |points: &[DVec2]| points.iter().fold([points[0]; 2], |[lo, hi], p| [lo.min(*p), hi.max(*p)]);
    let ([a, b], [c, d]) = (ends(a), ends(b));
    a.cmplt(d).all() && c.cmplt(b).all()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::convex_hull::area;

    fn square(x: f64, y: f64, side: f64) -> [DVec2; 2] {
        [DVec2::new(x, y), DVec2::new(x + side, y + side)]
    }

    /// A small square left of a large one: two joints, from its outer corners; the area is a trapezoid without the part of
    /// the small square in it.
    #[test]
    fn squares_are_joined_by_two_lines() {
        let (a, b) = (square(0.0, 4.0, 2.0), square(10.0, 0.0, 10.0));
        let fan = Fan::new(FanShape::Rectangle, [&a, &b]).unwrap();
        let mut joints = fan.joints.clone();
        joints.iter_mut().for_each(|joint| joint.sort_by(|p, q| p.x.total_cmp(&q.x)));
        joints.sort_by(|p, q| p[0].y.total_cmp(&q[0].y));
        let at = DVec2::new;
        assert_eq!(joints, [[at(0.0, 4.0), at(10.0, 0.0)], [at(0.0, 6.0), at(10.0, 10.0)]]);
        // The common hull: a trapezoid of widths 2 and 10 over 10, and the large square.
        let signed: f64 = fan.area.iter().map(|outline| area(outline)).sum::<f64>() - 2.0 * (4.0 + 100.0);
        assert!((signed - (60.0 - 4.0)).abs() < 1e-12, "{signed}");
    }

    /// The joints of two circles are their outer tangents: as long as √(d² − (r − s)²), to the corners of the polygons.
    #[test]
    fn circles_are_joined_by_their_tangents() {
        let (a, b) = (square(0.0, 0.0, 2.0), square(20.0, 3.0, 6.0));
        let fan = Fan::new(FanShape::Circle, [&a, &b]).unwrap();
        assert_eq!(fan.joints.len(), 2);
        let (d, r, s) = (DVec2::new(1.0, 1.0).distance(DVec2::new(23.0, 6.0)), 2f64.sqrt(), 18f64.sqrt());
        let tangent = (d * d - (s - r) * (s - r)).sqrt();
        for [p, q] in fan.joints {
            assert!((p.distance(q) - tangent).abs() < 0.15, "{} {tangent}", p.distance(q));
        }
    }

    #[test]
    fn one_inside_the_other_has_no_joints() {
        let (a, b) = (square(4.0, 4.0, 1.0), square(0.0, 0.0, 10.0));
        let fan = Fan::new(FanShape::Rectangle, [&a, &b]).unwrap();
        assert_eq!(fan.joints, [[DVec2::ZERO; 2]; 0]);
        assert_eq!(Fan::new(FanShape::Circle, [&a, &[DVec2::NAN]]), None);
    }
}
