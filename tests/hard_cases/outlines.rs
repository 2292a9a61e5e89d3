//! Outlines where they could go wrong ([HATCH-18]): units, scales, values at the ends of the range, an eye inside.

use drypoint::reference::field::{Field, Reconstruction, Rung};
use drypoint::reference::interactive_volume_illustration::outlines;
use drypoint::reference::surface::IsoSurface;
use drypoint::scene::glam::DVec3;
use drypoint::scene::space::Grid;
use drypoint::scene::strokes::Stroke;
use drypoint::scene::tables::{Camera, Projection};
use drypoint::scene::view::View;
use drypoint::scene::volume::{Volume, Voxels};

/// A ball whose centre is no voxel's, so that no two places are alike: values times `scale`, lengths times `unit`.
fn ball(scale: f64, unit: f64) -> Volume {
    let n = 31;
    let centre = DVec3::new(15.13, 14.71, 15.37);
    let at = |i: usize| DVec3::new((i % n) as f64, (i / n % n) as f64, (i / n / n) as f64);
    let value = |i: usize| (110.0 - 8.0 * (at(i) - centre).length()) * scale;
    let grid = Grid::with_spacing([n; 3], [unit; 3]).unwrap();
    Volume::new(grid, Voxels::F64((0..n * n * n).map(value).collect()), 1.0, 0.0).unwrap()
}

fn found(volume: &Volume, iso: f64, camera: &Camera) -> Vec<Stroke> {
    let field = Field::new(volume, Reconstruction::default(), Rung::Gradient).unwrap();
    let view = View::new(camera, volume.grid(), [64, 64]).unwrap();
    outlines(&IsoSurface::new(&field, iso), &view).strokes
}

fn camera() -> Camera {
    let projection = Projection::Orthographic { height: None };
    Camera { projection, direction: DVec3::new(0.3, 0.7, -0.4), ..Camera::default() }
}

/// How far, in voxels, the places of one closed curve are from the straight pieces of another; `unit` is a voxel of the first.
fn apart(one: &Stroke, unit: f64, other: &Stroke) -> f64 {
    let pieces: Vec<[DVec3; 2]> = (0..other.vertices.len())
        .map(|i| [i, (i + 1) % other.vertices.len()].map(|k| other.vertices[k].world))
        .collect();
    let from = |p: DVec3, [a, b]: [DVec3; 2]| {
        let t = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
        p.distance(a.lerp(b, t))
    };
    let nearest = |p: DVec3| pieces.iter().map(|piece| from(p, *piece)).fold(f64::INFINITY, f64::min);
    one.vertices.iter().map(|vertex| nearest(vertex.world / unit)).fold(0.0, f64::max)
}

/// What straight pieces may be off their curve, in voxels. Places lie on it to 10⁻⁶, but where along it Newton's steps end
/// depends on the last bit where the field has a kink.
const CHORD: f64 = 0.005;

/// A power of two changes no bit, another factor not the curve.
#[test]
fn values_of_any_size() {
    let own = found(&ball(1.0, 1.0), 10.0, &camera());
    assert!(own.len() == 1 && own[0].closed && own[0].vertices.len() > 40);
    for k in [-900, -20, 20, 900] {
        let scale = 2f64.powi(k);
        assert_eq!(found(&ball(scale, 1.0), 10.0 * scale, &camera()), own, "2^{k}");
    }
    for scale in [1e-6, 1e6] {
        let scaled = found(&ball(scale, 1.0), 10.0 * scale, &camera());
        assert!(scaled.len() == 1 && scaled[0].closed);
        assert!(apart(&scaled[0], 1.0, &own[0]) < 1.1 * CHORD, "{scale}");
    }
}

/// The world may be measured in anything.
#[test]
fn lengths_of_any_size() {
    let own = found(&ball(1.0, 1.0), 10.0, &camera());
    for unit in [1e-6, 1e6] {
        let scaled = found(&ball(1.0, unit), 10.0, &camera());
        assert!(scaled.len() == 1 && scaled[0].closed);
        assert!(apart(&scaled[0], unit, &own[0]) < 1.1 * CHORD, "{unit}");
    }
}

/// At the ends of the range and beyond a surface is a point, or there is none.
#[test]
fn values_at_the_ends_of_the_range() {
    let volume = ball(1.0, 1.0);
    let [lo, hi] = volume.range();
    for iso in [lo, hi, lo - 1.0, hi + 1.0, f64::MAX, f64::MIN_POSITIVE] {
        for stroke in found(&volume, iso, &camera()) {
            assert!(stroke.vertices.iter().all(|v| v.world.is_finite() && v.normal.is_finite()), "{iso}");
        }
    }
    assert_eq!(found(&volume, hi + 1.0, &camera()), []);
}

/// An eye inside a ball sees no outline: its surface faces inwards everywhere.
#[test]
fn an_eye_inside() {
    let volume = ball(1.0, 1.0);
    let eye = Some(DVec3::new(13.0, 16.0, 15.0));
    let inside = Camera { projection: Projection::Perspective { fov: 60.0 }, eye, ..Camera::default() };
    assert_eq!(found(&volume, 10.0, &inside), []);
}

/// Voxels a thousand times as long as wide.
#[test]
fn long_voxels() {
    let grid = Grid::with_spacing([31, 31, 9], [1.0, 1.0, 1000.0]).unwrap();
    let centre = grid.centre();
    let across = DVec3::new(1.0, 1.0, 1e-3 * 3.0);
    let value = |i: usize| {
        let at = DVec3::new((i % 31) as f64, (i / 31 % 31) as f64, (i / 961) as f64 * 1000.0);
        10.3 - ((at - centre) * across).length()
    };
    let volume = Volume::new(grid.clone(), Voxels::F64((0..31 * 31 * 9).map(value).collect()), 1.0, 0.0).unwrap();
    let strokes = found(&volume, 0.0, &camera());
    assert!(!strokes.is_empty());
    let [lo, hi] = [grid.origin(), grid.to_world(DVec3::new(30.0, 30.0, 8.0))];
    for vertex in strokes.iter().flat_map(|stroke| &stroke.vertices) {
        assert!(vertex.world.cmpge(lo).all() && vertex.world.cmple(hi).all(), "{}", vertex.world);
    }
}
