//! The convex hull around which labels stand, parametrized radially.

use crate::convex_hull::{area, hull};
use drypoint_scene::glam::DVec2;
use drypoint_scene::math;
use std::f64::consts::TAU;

/// A point of the hull.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct HullPoint {
    /// Its direction from the centroid, in turns from x towards y: t ∈ [0, 1).
    pub(super) t: f64,
    /// The point.
    pub(super) at: DVec2,
    /// The outward normal, of length 1: the edge's that contains the point. A vertex belongs to the edge after it.
    pub(super) normal: DVec2,
}

/// A convex polygon with a point for each direction from its centroid.
pub(super) struct RadialHull {
    /// The vertices, counterclockwise in ascending order of their directions.
    vertices: Vec<DVec2>,
    /// The direction of each vertex, in turns.
    turns: Vec<f64>,
    /// The normal of the edge that begins at each vertex.
    normals: Vec<DVec2>,
    centroid: DVec2,
    /// The largest distance of two vertices.
    pub(super) diameter: f64,
}

/// The directions of an octagon's vertices.
const OCTAGON: [(f64, f64); 8] =
    [(2.0, 1.0), (1.0, 2.0), (-1.0, 2.0), (-2.0, 1.0), (-2.0, -1.0), (-1.0, -2.0), (1.0, -2.0), (2.0, -1.0)];

impl RadialHull {
    /// The hull of some points; none if numbers of their size cannot tell its vertices from each other.
    ///
    /// A line or a point has no directions about its centroid. If the hull's width is less than `least` on average, an
    /// octagon of about that size stands for each point.
    pub(super) fn new(points: Vec<DVec2>, least: f64) -> Option<Self> {
        let mut vertices = hull(points.clone());
        if vertices.len() < 3 || area(&vertices) <= least * diameter(&vertices) {
            let wide = points.iter().flat_map(|&p| OCTAGON.map(|(x, y)| p + DVec2::new(x, y) * (least / 2.0)));
            vertices = hull(wide.collect());
        }
        if vertices.len() < 3 {
            return None;
        }
        let centroid = centroid(&vertices);
        let first = (0..vertices.len())
            .min_by(|&i, &j| turns(vertices[i] - centroid).total_cmp(&turns(vertices[j] - centroid)))?;
        vertices.rotate_left(first);
        let normals =
            (0..vertices.len()).map(|i| -(vertices[(i + 1) % vertices.len()] - vertices[i]).perp().normalize());
        let normals = normals.collect();
        let turns = vertices.iter().map(|&vertex| turns(vertex - centroid)).collect();
        Some(Self { diameter: diameter(&vertices), vertices, turns, normals, centroid })
    }

    /// The point in a direction, in turns.
    pub(super) fn at(&self, t: f64) -> HullPoint {
        let edge = self.edge(t);
        let (angle, normal) = (t * TAU, self.normals[edge]);
        let ray = DVec2::new(math::cos(angle), math::sin(angle));
        let at = self.centroid + ray * (normal.dot(self.vertices[edge] - self.centroid) / normal.dot(ray));
        HullPoint { t, at, normal }
    }

    /// The point nearest to a point of the hull's inside. Of several, the one on the first edge counts, from the
    /// vertex with the least t.
    pub(super) fn nearest(&self, to: DVec2) -> HullPoint {
        let feet = (1..self.vertices.len()).map(|edge| self.foot(edge, to));
        feet.fold(self.foot(0, to), |best, foot| if nearer(&foot, &best, to) { foot } else { best })
    }

    /// The local minimum of the distance that a walk along the hull from the direction `t` leads to.
    pub(super) fn nearest_from(&self, t: f64, to: DVec2) -> HullPoint {
        let n = self.vertices.len();
        let mut edge = self.edge(t);
        let mut best = self.foot(edge, to);
        // A foot inside an edge is a local minimum. From a foot at an end of the edge, the walk goes on beyond that end.
        // Each step is nearer than the one before, so no edge comes twice.
        for _ in 0..n {
            let s = self.along(edge, to);
            let next = if s >= 1.0 { (edge + 1) % n } else { (edge + n - 1) % n };
            let foot = self.foot(next, to);
            if s > 0.0 && s < 1.0 || !nearer(&foot, &best, to) {
                break;
            }
            (edge, best) = (next, foot);
        }
        best
    }

    /// The distance by which a box with its centre at a point of the hull moves along the normal until it misses the hull.
    ///
    /// Convex shapes are apart if a line along one of their edges separates them. The box is beyond the edge with the
    /// normal m once m·(p + s·n − v) is the box's half extent along m, where v is a vertex of the edge.
    pub(super) fn clearance(&self, point: &HullPoint, half: DVec2) -> f64 {
        let farthest = |axis: DVec2| self.vertices.iter().map(|&v| axis.dot(v)).fold(f64::NEG_INFINITY, f64::max);
        let axes = [DVec2::X * point.normal.x.signum(), DVec2::Y * point.normal.y.signum()];
        let edges = self.normals.iter().zip(&self.vertices).map(|(&m, &v)| (m, m.dot(v)));
        let lines = edges.chain(axes.map(|axis| (axis, farthest(axis)))).filter(|(m, _)| m.dot(point.normal) > 0.0);
        let distances = lines.map(|(m, to)| (to - m.dot(point.at) + m.abs().dot(half)) / m.dot(point.normal));
        distances.fold(f64::INFINITY, f64::min).max(0.0)
    }

    /// The edge that the ray in a direction leaves by.
    fn edge(&self, t: f64) -> usize {
        let before = self.turns.partition_point(|&turn| turn <= t);
        (before + self.turns.len() - 1) % self.turns.len()
    }

    /// The foot of the perpendicular from a point to an edge: 0 at the edge's start, 1 at its end.
    fn along(&self, edge: usize, to: DVec2) -> f64 {
        let (a, b) = (self.vertices[edge], self.vertices[(edge + 1) % self.vertices.len()]);
        (to - a).dot(b - a) / (b - a).length_squared()
    }

    /// The point of an edge nearest to a point. An end of the edge is the vertex itself.
    fn foot(&self, edge: usize, to: DVec2) -> HullPoint {
        let next = (edge + 1) % self.vertices.len();
        let (a, b) = (self.vertices[edge], self.vertices[next]);
        let s = self.along(edge, to);
        let (edge, at) = if s >= 1.0 { (next, b) } else { (edge, if s > 0.0 { a + (b - a) * s } else { a }) };
        HullPoint { t: turns(at - self.centroid), at, normal: self.normals[edge] }
    }
}

/// Whether a hull point is nearer than another.
fn nearer(point: &HullPoint, than: &HullPoint, to: DVec2) -> bool {
    point.at.distance_squared(to) < than.at.distance_squared(to)
}

/// The direction of a vector in turns, in [0, 1).
pub(super) fn turns(v: DVec2) -> f64 {
    wrapped(math::atan2(v.y, v.x) / TAU)
}

/// A number of turns without its whole turns, in [0, 1).
pub(super) fn wrapped(t: f64) -> f64 {
    // The fraction of a tiny negative number rounds to 1.
    let fraction = t - t.floor();
    if fraction < 1.0 { fraction } else { 0.0 }
}

/// The largest distance of two points.
fn diameter(points: &[DVec2]) -> f64 {
    let distances = points.iter().enumerate().flat_map(|(i, a)| points[..i].iter().map(move |b| a.distance(*b)));
    distances.fold(0.0, f64::max)
}

/// The centroid of a convex polygon's area.
fn centroid(polygon: &[DVec2]) -> DVec2 {
    let (mut sum, mut weight, from) = (DVec2::ZERO, 0.0, polygon[0]);
    for pair in polygon.windows(2) {
        let (a, b) = (pair[0] - from, pair[1] - from);
        let area = a.perp_dot(b);
        (sum, weight) = (sum + (a + b) * area, weight + area);
    }
    from + sum / (3.0 * weight)
}
