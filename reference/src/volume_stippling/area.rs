//! A_vol, the area that the volume's box covers in the picture, and what eq. 1 makes of it ([STIP-2], [STIP-3]).

use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::math;
use drypoint_scene::space::Grid;
use drypoint_scene::view::View;

/// Pixels that a voxel's projection has at least, after the adjustment of 4.2: 5×5.
const SMALLEST_PROJECTION: f64 = 25.0;

/// A_vol in pixels: the convex hull of the box's projected corners.
///
/// Of a box that reaches behind `near`, an eye depth in perspective, what lies before it counts, and of that what the
/// picture shows: near the eye a projection has no bound.
pub(super) fn projected_area(grid: &Grid, view: &View, near: f64) -> f64 {
    let corners = grid.world_corners().map(|corner| view.to_eye(corner));
    if !view.perspective {
        return hull_area(corners.map(|p| DVec2::new(p.x, p.y) / view.pixel).to_vec());
    }
    let project = |p: DVec3| DVec2::new(p.x, p.y) / (-p.z * view.pixel);
    if corners.iter().all(|p| -p.z >= near) {
        return hull_area(corners.map(project).to_vec());
    }
    // The corners before the plane, and where edges cross it. Corner i and i with one bit more share an edge.
    let mut points: Vec<DVec2> = corners.iter().filter(|p| -p.z >= near).map(|&p| project(p)).collect();
    for (i, bit) in (0..8usize).flat_map(|i| [1, 2, 4].map(|bit| (i, bit))).filter(|(i, bit)| i & bit == 0) {
        let (a, b) = (corners[i], corners[i | bit]);
        let (da, db) = (-a.z - near, -b.z - near);
        if (da < 0.0) != (db < 0.0) {
            let at = a + (b - a) * (da / (da - db));
            points.push(DVec2::new(at.x, at.y) / (near * view.pixel));
        }
    }
    let half = DVec2::from(view.size.map(|n| n as f64)) / 2.0;
    area(&clipped(hull(points), half))
}

/// Voxels to the power of ⅔: (X·Y·Z)^(2/3).
fn face(dims: [usize; 3]) -> f64 {
    let edge = dims.into_iter().fold(1.0, |product, n| product * math::cbrt(n as f64));
    edge * edge
}

/// m of 4.2, the smallest whole number with m²·A_vol/(X·Y·Z)^(2/3) ≥ 25. A volume that covers nothing is left as it is, and
/// no box is longer than the volume.
pub(super) fn box_side(area: f64, dims: [usize; 3]) -> usize {
    let each = area / face(dims);
    let longest = dims.into_iter().max().unwrap_or(1);
    if each <= 0.0 || each.is_nan() {
        return 1;
    }
    // Whole numbers of at least 1, so that `as` takes the floor.
    let mut m = ((SMALLEST_PROJECTION / each).sqrt() as usize).clamp(1, longest);
    while m < longest && ((m * m) as f64) * each < SMALLEST_PROJECTION {
        m += 1;
    }
    m
}

/// Eq. 1: N_max = max(1, ⌊k_max·A_vol/(X·Y·Z)^(2/3) + ½⌋), with the dims after the adjustment.
pub(super) fn points_each(k_max: f64, area: f64, dims: [usize; 3]) -> usize {
    // `as` saturates: what is too much for memory is refused before anything is allocated.
    ((k_max * area / face(dims) + 0.5) as usize).max(1)
}

/// The area of the convex hull.
fn hull_area(points: Vec<DVec2>) -> f64 {
    area(&hull(points))
}

/// The convex hull, counterclockwise (Andrew's monotone chain).
fn hull(mut points: Vec<DVec2>) -> Vec<DVec2> {
    points.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
    let turns_left = |a: DVec2, b: DVec2, c: DVec2| (b - a).perp_dot(c - a) > 0.0;
    let chain = |points: &mut dyn Iterator<Item = &DVec2>| {
        let mut chain: Vec<DVec2> = Vec::new();
        for &p in points {
            while chain.len() >= 2 && !turns_left(chain[chain.len() - 2], chain[chain.len() - 1], p) {
                chain.pop();
            }
            chain.push(p);
        }
        // The last point begins the other chain.
        chain.pop();
        chain
    };
    let lower = chain(&mut points.iter());
    let upper = chain(&mut points.iter().rev());
    [lower, upper].concat()
}

/// The area of a polygon.
fn area(polygon: &[DVec2]) -> f64 {
    let twice: f64 = (0..polygon.len()).map(|i| polygon[i].perp_dot(polygon[(i + 1) % polygon.len()])).sum();
    (twice / 2.0).abs()
}

/// The part of a convex polygon inside [−half, half] (Sutherland and Hodgman 1974).
fn clipped(mut polygon: Vec<DVec2>, half: DVec2) -> Vec<DVec2> {
    for (axis, sign) in [(0, 1.0), (0, -1.0), (1, 1.0), (1, -1.0)] {
        let inside = |p: DVec2| half[axis] - sign * p[axis];
        let n = polygon.len();
        let edges = (0..n).map(|i| (polygon[i], polygon[(i + 1) % n]));
        polygon = edges
            .flat_map(|(a, b)| {
                let (da, db) = (inside(a), inside(b));
                let crossing = ((da < 0.0) != (db < 0.0)).then(|| a + (b - a) * (da / (da - db)));
                [(da >= 0.0).then_some(a), crossing].into_iter().flatten()
            })
            .collect();
    }
    polygon
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::tables::{Camera, Length, Projection};

    fn grid() -> Grid {
        Grid::with_spacing([11, 21, 31], [1.0; 3]).unwrap()
    }

    #[test]
    fn a_box_seen_along_an_axis_and_along_a_diagonal() {
        let view = |direction| {
            let projection = Projection::Orthographic { height: Some(Length::World(50.0)) };
            View::new(&Camera { projection, direction, ..Camera::default() }, &grid(), [100, 100]).unwrap()
        };
        // 2 px a unit: 10 × 30 units along y.
        assert!((projected_area(&grid(), &view(DVec3::Y), 0.5) - 1200.0).abs() < 1e-9);
        // The sum of the faces' areas times the direction's components: (20·30 + 10·30 + 10·20)/√3 units.
        let want = 4.0 * 1100.0 / 3f64.sqrt();
        assert!((projected_area(&grid(), &view(DVec3::ONE), 0.5) - want).abs() < 1e-9);
    }

    /// From the middle the whole picture is covered; from just before a face, the face.
    #[test]
    fn an_eye_in_the_volume_sees_the_picture_full() {
        let view = |eye| {
            let camera = Camera { eye: Some(eye), direction: DVec3::Y, direction_given: true, ..Camera::default() };
            View::new(&camera, &grid(), [300, 200]).unwrap()
        };
        assert!((projected_area(&grid(), &view(grid().centre()), 0.5) - 60_000.0).abs() < 1e-6);
        let before = view(DVec3::new(5.0, -100.0, 15.0));
        let want = 10.0 * 30.0 / (100.0 * before.pixel * 100.0 * before.pixel);
        assert!((projected_area(&grid(), &before, 0.5) - want).abs() < 1e-6 * want);
        // Looking away from it there is nothing.
        let away = Camera {
            eye: Some(DVec3::new(5.0, -9.0, 15.0)),
            direction: DVec3::NEG_Y,
            direction_given: true,
            ..Camera::default()
        };
        let away = View::new(&away, &grid(), [300, 200]).unwrap();
        assert_eq!(projected_area(&grid(), &away, 0.5), 0.0);
    }

    #[test]
    fn boxes_and_counts_by_hand() {
        // 64³ voxels: (X·Y·Z)^(2/3) = 4096. 25 px each are enough as they are, 24.99 are not.
        assert_eq!([102_400.0, 102_399.0, 25_600.0, 25_599.0].map(|a| box_side(a, [64; 3])), [1, 2, 2, 3]);
        assert_eq!([box_side(0.0, [64; 3]), box_side(1e-9, [64, 8, 8])], [1, 64]);
        assert_eq!(points_each(1.0, 102_400.0, [64; 3]), 25);
        assert_eq!([0.02, 0.0199, 0.06].map(|k| points_each(k, 102_400.0, [64; 3])), [1, 1, 2]);
        assert_eq!(points_each(400.0, 102_400.0, [64; 3]), 10_000);
    }
}
