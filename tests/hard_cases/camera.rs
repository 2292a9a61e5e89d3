//! Where rays run ([RAY-5], [RAY-6], [SPACE-3]): a field that is a coordinate says where its samples lie.

use crate::common::{Stage, on, orthographic, perspective};
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::picture::LayerKind;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Camera, Length, StepAlong};
use drypoint::scene::view::View;

pub(crate) fn grids() -> Vec<Grid> {
    let sheared = DMat3::from_cols(DVec3::new(1.0, 0.2, 0.0), DVec3::new(-0.3, 0.9, 0.1), DVec3::new(0.2, 0.4, 2.0));
    vec![
        Grid::with_spacing([8, 8, 8], [1.0; 3]).unwrap(),
        Grid::new([7, 9, 6], sheared, DVec3::new(20.0, -30.0, 5.0)).unwrap(),
    ]
}

/// The world position of the first sample of each pixel: an opaque volume shows at it the value of x, y or z, which
/// trilinear interpolation has exactly but for rounding.
pub(crate) fn first_positions(
    grid: &Grid,
    camera: &Camera,
    size: [usize; 2],
    along: StepAlong,
) -> Vec<Option<(DVec3, f64)>> {
    let shown = [0, 1, 2].map(|axis: usize| {
        let shot = Stage::regular(on(grid.clone(), |p| p[axis]), &[(0.0, [1.0; 3], 1.0)])
            .layers(&[LayerKind::First, LayerKind::Z])
            .with(|s| {
                s.camera = camera.clone();
                s.picture.size = size;
                s.sampling.step = Length::World(0.3);
                s.sampling.step_along = along;
            });
        let shown = shot.render();
        (shown.one(LayerKind::First), shown.one(LayerKind::Z))
    });
    let depths = shown[0].1.clone();
    let hit = |(i, depth): (usize, f64)| {
        depth.is_finite().then(|| (DVec3::new(shown[0].0[i], shown[1].0[i], shown[2].0[i]), depth))
    };
    depths.into_iter().enumerate().map(hit).collect()
}

/// Sample k of pixel (i, j) lies at eye (X, Y, −s) or (Xs, Ys, −s), s = (k + ½)Δ, X = ((i + ½) − W/2)p, Y = (H/2 − (j +
/// ½))p, p = height/H or 2 tan(fov/2)/H, with right = u × up/‖·‖ and up' = right × u; shells have s/cosφ = (k + ½)Δ.
#[test]
fn pixels_see_where_the_formulas_say() {
    let direction = DVec3::new(0.5, 0.8, -0.3);
    for grid in grids() {
        let c = grid.centre();
        let cameras = [
            (Camera { direction, up: DVec3::new(0.1, 0.2, 1.0), ..orthographic(Some(9.0)) }, None),
            (Camera { direction, ..perspective(50.0) }, Some(50.0)),
            (Camera { eye: Some(c - direction * 14.0), target: Some(c + DVec3::X), ..perspective(70.0) }, Some(70.0)),
            (Camera { eye: Some(c), direction, direction_given: true, ..perspective(120.0) }, Some(120.0)),
        ];
        for (camera, fov) in cameras {
            let size = [13, 8];
            let [w, h] = size.map(|n| n as f64);
            for along in [StepAlong::Plane, StepAlong::Ray] {
                let target = camera.target.unwrap_or(c);
                let u = match camera.eye {
                    Some(eye) if !camera.direction_given => (target - eye).normalize(),
                    _ => direction.normalize(),
                };
                let right = u.cross(camera.up).normalize();
                let up = right.cross(u);
                let p = fov.map_or(9.0 / h, |fov: f64| 2.0 * (fov.to_radians() / 2.0).tan() / h);
                // d = r/sin(half the smaller field of view); the picture is wider than high.
                let d = fov.map_or(0.0, |fov: f64| grid.radius() / (fov.to_radians() / 2.0).sin());
                let eye = camera.eye.unwrap_or(target - u * d);
                let mut seen = 0;
                for (t, found) in first_positions(&grid, &camera, size, along).into_iter().enumerate() {
                    let Some((position, s)) = found else { continue };
                    let x = ((t % 13) as f64 + 0.5 - w / 2.0) * p;
                    let y = (h / 2.0 - ((t / 13) as f64 + 0.5)) * p;
                    let scale = if fov.is_some() { s } else { 1.0 };
                    let expected = eye + right * (x * scale) + up * (y * scale) + u * s;
                    assert!(
                        (position - expected).length() < 1e-12 * (1.0 + eye.length()),
                        "{t}: {position} {expected}"
                    );
                    let radius = match (along, fov) {
                        (StepAlong::Ray, Some(_)) => s * (1.0 + x * x + y * y).sqrt(),
                        _ => s,
                    };
                    let k = radius / 0.3 - 0.5;
                    assert!((k - k.round()).abs() < 1e-9 && (fov.is_none() || radius > 0.3), "{radius} {k}");
                    seen += 1;
                }
                assert!(seen > 10, "{seen}");
            }
        }
    }
}

/// The default camera has all of the box in the picture, whatever the picture's shape and the direction, and does not
/// stand farther off than the box's bounding sphere asks.
#[test]
fn the_default_camera_frames_the_volume() {
    for grid in grids() {
        for size in [[60, 60], [90, 40], [40, 90], [1, 1], [300, 1]] {
            for direction in [[1.0, 0.0, 0.0], [-1.0, -0.4, -0.3], [0.0, 0.0, -1.0], [0.3, -0.8, 0.7]] {
                for camera in [perspective(30.0), perspective(120.0), orthographic(None)] {
                    let camera = Camera { direction: direction.into(), ..camera };
                    let view = View::new(&camera, &grid, size).unwrap();
                    for corner in grid.world_corners() {
                        // Before the eye, and from the middle of the picture in pixels no more than half a side.
                        let e = view.to_eye(corner);
                        let pixel = if view.perspective { view.pixel * -e.z } else { view.pixel };
                        let inside = |across: f64, n: usize| (across / pixel).abs() <= n as f64 / 2.0 + 1e-9;
                        assert!(
                            pixel > 0.0 && inside(e.x, size[0]) && inside(e.y, size[1]),
                            "{size:?} {direction:?}: {e}"
                        );
                    }
                    // The bounding sphere touches the nearer pair of the frame's sides.
                    let smaller = size[0].min(size[1]) as f64 / 2.0 * view.pixel;
                    let reach = if view.perspective {
                        let distance = (grid.centre() - view.eye).length();
                        distance * smaller / (1.0 + smaller * smaller).sqrt()
                    } else {
                        smaller
                    };
                    assert!((reach / grid.radius() - 1.0).abs() < 1e-12, "{size:?}: {reach} {}", grid.radius());
                }
            }
        }
    }
}

/// The lower left corner of the world box is at the lower left of a picture taken from the front with z up.
#[test]
fn pictures_stand_upright() {
    let grid = Grid::with_spacing([8; 3], [1.0; 3]).unwrap();
    let corner = on(grid, |p| if p.x < 3.0 && p.z < 3.0 { 1.0 } else { 0.0 });
    let pixels = Stage::regular(corner, &[(0.5, [1.0; 3], 0.0), (0.5, [1.0; 3], 1.0)]).render().pixels();
    let row = |t: usize| (t / 16 >= 8, t % 16 < 8);
    let shown: Vec<_> = (0..256).filter(|&t| pixels[t][3] > 0.0).map(row).collect();
    assert!(shown.len() > 5 && shown.iter().all(|&lower_left| lower_left == (true, true)), "{shown:?}");
}

/// An eye inside the volume at 120°: every pixel sees something, nothing is undefined, and nothing at or before `near` is
/// seen: the first plane is the first beyond it.
#[test]
fn an_eye_inside_sees_all_round() {
    for grid in grids() {
        let camera = Camera {
            eye: Some(grid.centre()),
            direction: DVec3::new(0.2, 0.9, 0.1),
            direction_given: true,
            near: Some(Length::World(0.75)),
            ..perspective(120.0)
        };
        let found = first_positions(&grid, &camera, [16, 16], StepAlong::Plane);
        let first = |found: &Option<(DVec3, f64)>| found.map(|(_, depth)| depth);
        // Planes at 0.15, 0.45, 0.75, 1.05: depth > near leaves out 0.75 itself.
        let depths: Vec<_> = found.iter().filter_map(first).collect();
        assert!(depths.len() > 100 && depths.iter().all(|d| (d - 1.05).abs() < 1e-12), "{depths:?}");
    }
}

/// A picture of one pixel is the middle ray.
#[test]
fn one_pixel() {
    let grid = Grid::with_spacing([8; 3], [1.0; 3]).unwrap();
    for camera in [perspective(120.0), orthographic(None)] {
        let camera = Camera { direction: DVec3::NEG_X, ..camera };
        let found = first_positions(&grid, &camera, [1, 1], StepAlong::Plane);
        let (position, _) = found[0].unwrap();
        assert!((position.y - 3.5).abs() < 1e-12 && (position.z - 3.5).abs() < 1e-12 && position.x > 6.6);
    }
}
