//! A_vol, the area of the volume's box in the picture, and the number of points that eq. 1 derives from it ([STIP-2],
//! [STIP-3]).

use super::ridge::across;
use crate::convex_hull::{area, hull};
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::math;
use drypoint_scene::space::Grid;
use drypoint_scene::view::View;

/// The least number of pixels of a voxel's projection after the adjustment of 4.2: 5×5.
const SMALLEST_PROJECTION: f64 = 25.0;

/// A_vol in pixels: the area of the convex hull of the box's projected corners.
///
/// If the box reaches behind `near`, an eye depth in perspective, only the part before it counts, clipped to the
/// picture. Near the eye a projection has no bound.
pub(super) fn projected_area(grid: &Grid, view: &View, near: f64) -> f64 {
    shown(&eye_corners(grid, view), &[0, 1, 2, 3, 4, 5, 6, 7], view, near)
}

/// Relative difference of a layer's thickness from the smallest voxel that counts as 0: headers have numbers in f32.
const ROUNDING: f64 = 1e-6;

/// Factor of N_max in eq. 1 for thin layers: 1 if voxels are cubes ([STIP-3], [STIP-4]).
///
/// Eq. 1 gives each voxel N_max points. So a face is denser than another if its voxels have smaller pieces of it.
/// Thin layers are equally dense everywhere: a voxel has N_max·h/t points, where h is the smallest voxel. The
/// thickness t of the layer along n ([`across`]) is proportional to the number of voxels per unit of area.
///
/// The factor is the mean of t/h over the box's faces that the reference camera sees, weighted by area. It restores
/// the total number of points: a face seen from the front has the mean density of eq. 1 over the picture of the box.
/// A face that comes into sight has no area at first, so nothing jumps as the camera turns.
pub(super) fn mean_thickness(grid: &Grid, view: &View, near: f64) -> f64 {
    let corners = eye_corners(grid, view);
    let to_faces = grid.inverse_axes().transpose();
    let faces = (0..6).map(|i| {
        let (axis, side) = (i / 2, i % 2);
        let normal = to_faces.col(axis).normalize();
        let face: [usize; 4] = std::array::from_fn(|k| (k >> axis << axis) + k + (side << axis));
        let longer = across(grid, normal) / grid.voxel() - 1.0;
        let outward = view.direction_to_eye(normal) * if side == 0 { -1.0 } else { 1.0 };
        let to_eye = if view.perspective { -corners[face[0]] } else { DVec3::Z };
        let is_seen = outward.dot(to_eye) > 0.0;
        (is_seen, shown(&corners, &face, view, near), if longer > ROUNDING { longer } else { 0.0 })
    });
    let faces: Vec<(bool, f64, f64)> = faces.collect();
    // An eye inside the box sees all faces.
    let is_inside = faces.iter().all(|face| !face.0);
    let seen = faces.iter().filter(|face| face.0 || is_inside);
    let (area, longer) = seen.fold((0.0, 0.0), |(sum, more), &(_, area, longer)| (sum + area, more + area * longer));
    if area > 0.0 { 1.0 + longer / area } else { 1.0 }
}

/// The corners of the box in eye space. Bit a of a corner's index is set at the far end of axis a.
fn eye_corners(grid: &Grid, view: &View) -> [DVec3; 8] {
    grid.world_corners().map(|corner| view.to_eye(corner))
}

/// The visible area in pixels of the convex hull of some corners of the box.
fn shown(corners: &[DVec3; 8], part: &[usize], view: &View, near: f64) -> f64 {
    let all = part.iter().map(|&i| corners[i]);
    if !view.perspective {
        return hull_area(all.map(|p| DVec2::new(p.x, p.y) / view.pixel).collect());
    }
    let project = |p: DVec3| DVec2::new(p.x, p.y) / (-p.z * view.pixel);
    if corners.iter().all(|p| -p.z >= near) {
        return hull_area(all.map(project).collect());
    }
    // Corners before the plane, and crossings of edges with the plane. Two corners whose indices differ in one bit
    // share an edge.
    let mut points: Vec<DVec2> = all.filter(|p| -p.z >= near).map(project).collect();
    let edges = part.iter().flat_map(|&i| [1, 2, 4].map(|bit| (i, i | bit)));
    for (a, b) in edges.filter(|(i, j)| i != j && part.contains(j)) {
        let (a, b) = (corners[a], corners[b]);
        let (da, db) = (-a.z - near, -b.z - near);
        if (da < 0.0) != (db < 0.0) {
            let at = a + (b - a) * (da / (da - db));
            points.push(DVec2::new(at.x, at.y) / (near * view.pixel));
        }
    }
    let half = DVec2::from(view.size.map(|n| n as f64)) / 2.0;
    area(&clipped(hull(points), half))
}

/// (X·Y·Z)^(2/3), the number of voxels in a face of a cube of equal volume.
fn face(dims: [usize; 3]) -> f64 {
    let edge = dims.into_iter().fold(1.0, |product, n| product * math::cbrt(n as f64));
    edge * edge
}

/// m of 4.2, the smallest integer with m²·A_vol/(X·Y·Z)^(2/3) ≥ 25. It is at most the number of voxels along the
/// longest axis, and 1 if the volume covers no pixels.
pub(super) fn box_side(area: f64, dims: [usize; 3]) -> usize {
    let each = area / face(dims);
    let longest = dims.into_iter().max().unwrap_or(1);
    if each <= 0.0 || each.is_nan() {
        return 1;
    }
    // The value is at least 1, so `as` takes the floor.
    let mut m = ((SMALLEST_PROJECTION / each).sqrt() as usize).clamp(1, longest);
    while m < longest && ((m * m) as f64) * each < SMALLEST_PROJECTION {
        m += 1;
    }
    m
}

/// Eq. 1: N_max = max(1, ⌊k_max·A_vol/(X·Y·Z)^(2/3) + ½⌋), with the dims after the adjustment.
pub(super) fn points_each(k_max: f64, area: f64, dims: [usize; 3]) -> usize {
    // `as` saturates. A number of points that exceeds memory is refused before any allocation.
    ((k_max * area / face(dims) + 0.5) as usize).max(1)
}

/// The area of the convex hull.
fn hull_area(points: Vec<DVec2>) -> f64 {
    area(&hull(points))
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
    use drypoint_scene::glam::{DMat3, EulerRot};
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

    /// An eye in the middle covers the whole picture; an eye just before a face covers the face.
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

    #[test]
    fn the_mean_thickness_is_that_of_the_faces_in_front() {
        let far = Grid::with_spacing([11, 21, 31], [1.0, 1.0, 4.0]).unwrap();
        let seen = |grid: &Grid, eye: Option<DVec3>, direction: DVec3| {
            let projection = Projection::Orthographic { height: Some(Length::World(50.0)) };
            let camera = Camera { direction, direction_given: true, ..Camera::default() };
            let camera = if eye.is_some() { Camera { eye, ..camera } } else { Camera { projection, ..camera } };
            mean_thickness(grid, &View::new(&camera, grid, [300, 200]).unwrap(), 0.5)
        };
        let centre = far.centre();
        for eye in [None, Some(centre - 100.0 * DVec3::Z)] {
            assert!((seen(&far, eye, DVec3::Z) - 4.0).abs() < 1e-12, "{eye:?}");
        }
        assert_eq!(seen(&far, None, DVec3::X), 1.0);
        // 20·120 and 10·120 units of faces of thickness 1, 10·20 of thickness 4.
        assert!((seen(&far, None, DVec3::ONE) - (2400.0 + 1200.0 + 4.0 * 200.0) / 3800.0).abs() < 1e-12);
        // From inside, with a face across slices in the middle of the picture.
        let inside = seen(&far, Some(centre), DVec3::Z);
        assert!(inside > 1.0 && inside < 4.0, "{inside}");
        // Cubes that a header turned, in numbers of f32.
        let turn = DMat3::from_euler(EulerRot::XYZ, 0.3, 0.7, 1.1) * 0.9;
        let axes = DMat3::from_cols_array(&turn.to_cols_array().map(|x| f64::from(x as f32)));
        let turned = Grid::new([11, 21, 31], axes, DVec3::ONE).unwrap();
        assert_eq!(seen(&turned, None, DVec3::new(0.2, 1.0, -0.7)), 1.0);
    }
}
