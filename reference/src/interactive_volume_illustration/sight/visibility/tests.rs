use super::*;
use crate::field::{Field, Kernel, Reconstruction, Rung};
use drypoint_scene::clip::NO_PLANES;
use drypoint_scene::glam::DVec2;
use drypoint_scene::space::Grid;
use drypoint_scene::tables::{Camera, Projection};
use drypoint_scene::volume::{Volume, Voxels};
use std::f64::consts::{PI, TAU};

const INK: PenState = PenState { radius: 0.1, opacity: 1.0, color: None };

fn length(lines: &[Polyline]) -> f64 {
    let of = |line: &Polyline| {
        let n = line.vertices.len();
        let pieces = if line.closed { n } else { n - 1 };
        (0..pieces).map(|i| line.vertices[i].world.distance(line.vertices[(i + 1) % n].world)).sum::<f64>()
    };
    lines.iter().map(of).sum()
}

/// A circle of latitude on a ball about `centre`, λ above its equator.
fn latitude(centre: DVec3, radius: f64, lambda: f64) -> Stroke {
    let n = 20_000;
    let vertex = |i: usize| {
        let (sin, cos) = (TAU * i as f64 / n as f64).sin_cos();
        let normal = DVec3::new(lambda.cos() * cos, lambda.cos() * sin, lambda.sin());
        StrokeVertex { world: centre + normal * radius, normal, u: i as f64 / n as f64 }
    };
    Stroke { vertices: (0..n).map(vertex).collect(), closed: true, key: 0 }
}

/// [HATCH-14]'s oracle: the visible share of a circle of latitude, at 1000² pixels.
///
/// With δ = 0 the field is R² − ‖p‖², which B-splines reproduce, and circles lie 1e-5 voxel in front of it. The
/// trilinear ball of δ = 0.1 is off by at most 1/(8·20), which moves the share by 0.001.
#[test]
fn circles_of_latitude_on_a_ball() {
    let ball = |n: usize, value: &dyn Fn(f64) -> f64| {
        let grid = Grid::with_spacing([n; 3], [1.0; 3]).unwrap();
        let centre = grid.centre();
        let at = |i: usize| DVec3::new((i % n) as f64, (i / n % n) as f64, (i / n / n) as f64);
        let values = (0..n * n * n).map(|i| value((at(i) - centre).length())).collect();
        Volume::new(grid, Voxels::F64(values), 1.0, 0.0).unwrap()
    };
    let (fine, coarse) = (40.0, 20.0);
    let smooth = ball(107, &|r| fine * fine - r * r);
    let plain = ball(49, &|r| coarse - r);
    let of = |volume: &'static Volume, kernel| {
        Field::new(volume, Reconstruction { kernel, ..Reconstruction::default() }, Rung::Gradient).unwrap()
    };
    // Fields borrow their volumes for as long as surfaces borrow them.
    let (smooth, plain) = (Box::leak(Box::new(smooth)), Box::leak(Box::new(plain)));
    for (field, radius, offset, shares) in [
        (of(smooth, Kernel::Bspline), fine, 1e-5, [0.567391, 0.391827, 0.642814]),
        (of(plain, Kernel::Trilinear), coarse, 0.1, [0.619793, 0.435744, 0.704316]),
    ] {
        let surface = IsoSurface::new(&field, 0.0);
        let centre = field.volume().grid().centre();
        for ((lambda, i), share) in [(10.0f64, 40.0f64), (-30.0, 60.0), (50.0, 70.0)].into_iter().zip(shares) {
            let (sin, cos) = i.to_radians().sin_cos();
            let camera = Camera {
                projection: Projection::Orthographic { height: None },
                direction: DVec3::new(-sin, 0.0, -cos),
                ..Camera::default()
            };
            let view = View::new(&camera, field.volume().grid(), [1000, 1000]).unwrap();
            let page = Page::in_pixels([1000, 1000], 0.0, 100.0);
            let sight =
                Sight { view: &view, page: &page, near: 0.0, surface: Some(&surface), clip: &NO_PLANES, offset };
            let stroke = latitude(centre, radius, lambda.to_radians());
            let seen = sight.seen(std::slice::from_ref(&stroke), |_, _| INK);
            let whole = length(&sight_without(&sight).seen(&[stroke], |_, _| INK).lines);
            let got = length(&seen.lines) / whole;
            assert!((got - share).abs() < 0.002, "{lambda} {i} {offset}: {got} {share}");
            // One part, however the circle was cut open.
            assert_eq!(seen.lines.len(), 1, "{lambda} {i}");
            assert!(!seen.lines[0].closed && seen.looks > 1000);
        }
    }
}

fn sight_without<'a>(sight: &Sight<'a>) -> Sight<'a> {
    Sight { surface: None, ..*sight }
}

/// A closed stroke that is all visible stays closed. Without a surface there are no visibility tests.
#[test]
fn what_nothing_hides() {
    let grid = Grid::with_spacing([41; 3], [1.0; 3]).unwrap();
    let camera = Camera { projection: Projection::Orthographic { height: None }, ..Camera::default() };
    let view = View::new(&camera, &grid, [100, 100]).unwrap();
    let page = Page::in_pixels([100, 100], 0.0, 100.0);
    let sight = Sight { view: &view, page: &page, near: 0.0, surface: None, clip: &NO_PLANES, offset: 0.15 };
    let stroke = latitude(grid.centre(), 10.0, 0.3);
    let seen = sight.seen(&[stroke.clone(), Stroke { closed: false, ..stroke.clone() }], |_, vertex| PenState {
        radius: 0.1 + vertex.u,
        opacity: 0.5,
        color: None,
    });
    assert_eq!((seen.lines.len(), seen.looks), (2, 0));
    assert!(seen.lines[0].closed && !seen.lines[1].closed);
    for line in &seen.lines {
        assert_eq!(line.vertices.len(), stroke.vertices.len());
        for (got, vertex) in line.vertices.iter().zip(&stroke.vertices) {
            assert_eq!((got.world, got.t, got.opacity), (vertex.world, vertex.u, 0.5));
            assert!((got.radius - 0.1 - vertex.u).abs() < 1e-15);
        }
    }
}

/// Strokes around, behind and through an eye: every number is finite, and every place lies inside the frame, grown by
/// the pen's half width.
#[test]
fn an_eye_amid_strokes() {
    let n = 25;
    let grid = Grid::with_spacing([n; 3], [1.0; 3]).unwrap();
    let values = (0..n * n * n).map(|i| if i % n < 12 { 9.0 } else { 1.0 }).collect();
    let volume = Volume::new(grid, Voxels::F64(values), 1.0, 0.0).unwrap();
    let field = Field::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
    let surface = IsoSurface::new(&field, 5.0);
    let centre = volume.grid().centre();
    let eye = centre + DVec3::new(3.0, 0.0, 0.0);
    let camera = Camera { eye: Some(eye), target: Some(centre), ..Camera::default() };
    let view = View::new(&camera, volume.grid(), [300, 200]).unwrap();
    let page = Page::in_pixels([300, 200], 2.0, 100.0);
    let sight = Sight { view: &view, page: &page, near: 0.5, surface: Some(&surface), clip: &NO_PLANES, offset: 0.15 };
    let circle = latitude(eye, 1.0, 0.2);
    let vertex = |x: f64, u: f64| StrokeVertex { world: eye + DVec3::new(x, 1e-9, 0.0), normal: DVec3::X, u };
    let through =
        Stroke { vertices: vec![vertex(-2.0, 0.0), vertex(0.0, 0.5), vertex(5.0, 1.0)], closed: false, key: 1 };
    let nothing = Stroke::default();
    let one = Stroke { vertices: vec![vertex(0.0, 0.0)], closed: true, key: 2 };
    let lines = sight.seen(&[circle, through, nothing, one], |_, _| INK).lines;
    assert!(!lines.is_empty());
    let beyond = DVec2::splat(page.margin - INK.radius - 1e-9);
    for vertex in lines.iter().flat_map(|line| &line.vertices) {
        assert!(vertex.at.cmpge(beyond).all() && vertex.at.cmple(page.size - beyond).all(), "{}", vertex.at);
        assert!(vertex.world.is_finite() && (0.0..=1.0).contains(&vertex.t));
        assert!(view.to_eye(vertex.world).z <= -0.5 + 1e-9);
    }
    // No frame contains an angle of π: half of the circle is behind the eye.
    assert!(length(&lines[..1]) < PI);
}
