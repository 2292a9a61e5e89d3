//! The edges of a bounding box.

use super::CurvePoint;
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::view::View;

/// Pairs of corners that an edge joins. Bit a of a corner's number is its place along axis a.
const EDGES: [[usize; 2]; 12] =
    [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]];

/// The least depth of a point that is seen in perspective, as a share of the depth of the farthest end of its edge.
const NEAREST: f64 = 1e-6;

/// Returns the edges of a box by its corners in world space. Bit a of a corner's place in the list is its place along
/// axis a.
pub fn edges(corners: [DVec3; 8]) -> [[DVec3; 2]; 12] {
    EDGES.map(|pair| pair.map(|corner| corners[corner]))
}

/// Returns an edge as points of the picture that are at most a pixel apart, up to `most` points. In perspective the part
/// before the eye is left out. Returns nothing if no part is before the eye.
pub fn edge_points(view: &View, [a, b]: [DVec3; 2], most: usize) -> Vec<CurvePoint> {
    let [mut a, mut b] = [a, b];
    let depth = |p: DVec3| -view.to_eye(p).z;
    if view.perspective {
        let least = depth(a).max(depth(b)) * NEAREST;
        if least <= 0.0 {
            return Vec::new();
        }
        // The point of the edge at the least depth takes the place of an end before it.
        let clipped = |end: DVec3, other: DVec3| {
            if depth(end) >= least {
                return end;
            }
            end + (other - end) * ((least - depth(end)) / (depth(other) - depth(end)))
        };
        [a, b] = [clipped(a, b), clipped(b, a)];
    }
    let at = |p: DVec3| view.point_of(p).map(|at| CurvePoint { at: DVec2::from(at), depth: depth(p) });
    let (Some(from), Some(to)) = (at(a), at(b)) else { return Vec::new() };
    let steps = (from.at.distance(to.at).ceil().clamp(1.0, most.max(2) as f64 - 1.0)) as usize;
    let between = |i: usize| {
        let s = i as f64 / steps as f64;
        // 1/depth is linear on the page in perspective.
        let depth = if view.perspective {
            from.depth * to.depth / (to.depth + (from.depth - to.depth) * s)
        } else {
            from.depth + (to.depth - from.depth) * s
        };
        CurvePoint { at: from.at.lerp(to.at, s), depth }
    };
    (0..=steps).map(between).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::space::Grid;
    use drypoint_scene::tables::{Camera, Projection};

    fn view(projection: Projection, eye: Option<DVec3>) -> View {
        let grid = Grid::with_spacing([11, 11, 11], [1.0; 3]).unwrap();
        let direction = DVec3::new(0.3, 1.0, -0.2);
        let camera = Camera { projection, direction, direction_given: true, eye, ..Camera::default() };
        View::new(&camera, &grid, [80, 60]).unwrap()
    }

    /// A corner has three edges, and an edge joins corners that differ along one axis.
    #[test]
    fn a_box_has_twelve_edges() {
        let corners = std::array::from_fn(|i| DVec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64));
        let found = edges(corners);
        for corner in corners {
            assert_eq!(found.iter().filter(|edge| edge.contains(&corner)).count(), 3);
        }
        assert!(found.iter().all(|[a, b]| (*b - *a).length() == 1.0));
    }

    /// Each point lies on the edge: the ray through it passes the edge at its depth.
    #[test]
    fn points_of_an_edge_lie_on_it() {
        let ends = [DVec3::new(1.0, 2.0, 3.0), DVec3::new(9.0, 8.0, 4.0)];
        for projection in [Projection::Perspective { fov: 40.0 }, Projection::Orthographic { height: None }] {
            let view = view(projection, None);
            let points = edge_points(&view, ends, 1000);
            assert!(points.len() > 10 && points.windows(2).all(|p| p[0].at.distance(p[1].at) <= 1.0));
            for CurvePoint { at, depth } in points {
                let ray = view.ray(at.x, at.y);
                let p = ray.origin + ray.along * depth;
                let along = (ends[1] - ends[0]).normalize();
                assert!((p - ends[0]).reject_from(along).length() < 1e-9, "{p}");
            }
        }
    }

    #[test]
    fn the_part_behind_the_eye_is_left_out() {
        let view = view(Projection::Perspective { fov: 40.0 }, Some(DVec3::splat(5.0)));
        let ahead = view.eye + view.forward * 3.0 + view.right * 0.5;
        let behind = view.eye - view.forward * 2.0;
        let points = edge_points(&view, [ahead, behind], 500);
        assert!(points.len() == 500 && points.iter().all(|p| p.depth > 0.0 && p.at.is_finite()));
        assert_eq!(edge_points(&view, [behind, behind - view.forward], 500), []);
    }
}
