use super::*;
use crate::field::{Field, Reconstruction, Rung};
use drypoint_scene::glam::DMat3;
use drypoint_scene::phantom::{Phantom, by_name};
use drypoint_scene::philox::uniform;
use drypoint_scene::tables::{Camera, Projection};
use drypoint_scene::volume::{Volume, Voxels};

/// Half of an outline's tolerance, for straight segments. The other half is for their ends.
const OFF: f64 = 0.01;

fn view(grid: &Grid, direction: [f64; 3], projection: Projection) -> View {
    let camera = Camera { projection, direction: DVec3::from_array(direction), ..Camera::default() };
    View::new(&camera, grid, [64, 64]).unwrap()
}

const PARALLEL: Projection = Projection::Orthographic { height: None };

/// The outlines of a phantom's own formula on a grid.
fn exact(phantom: &dyn Phantom, grid: &Grid, iso: f64, view: &View) -> OutlineStrokes {
    let dims = grid.dims().map(|n| (n - 1).div_ceil(BRICK));
    let mut bricks = Vec::new();
    for_each(dims, |brick| bricks.push(brick));
    let volume = Volume::new(grid.clone(), Voxels::F64(vec![1.0; grid.len()]), 1.0, 0.0).unwrap();
    let search = CurveSearch {
        grid,
        mask: None,
        level: IsoDifference::new(&volume, iso),
        outside: Outside::Low,
        no_normal_below: 1e-9,
    };
    let field = Field::new(&volume, Reconstruction::default(), Rung::Value).unwrap().with_formula(phantom);
    search.outlines(&field, view, &bricks)
}

/// Ends and middles of the pieces of strokes.
fn places(strokes: &[Stroke]) -> Vec<DVec3> {
    let of = |stroke: &Stroke| {
        let at: Vec<DVec3> = stroke.vertices.iter().map(|v| v.world).collect();
        let n = at.len();
        let segments = if stroke.closed { n } else { n - 1 };
        (0..segments).flat_map(|i| [at[i], (at[i] + at[(i + 1) % n]) / 2.0]).collect::<Vec<_>>()
    };
    strokes.iter().flat_map(of).collect()
}

fn sphere(grid: &Grid, radius: f64) -> Box<dyn Phantom> {
    by_name("sphere", grid, &[("R".into(), radius)]).unwrap()
}

/// The largest gap in angle between neighbours among places round a centre, seen against a plane's normal.
fn largest_gap(places: &[DVec3], centre: DVec3, normal: DVec3) -> f64 {
    let x = normal.any_orthonormal_vector();
    let y = normal.cross(x);
    let mut angles: Vec<f64> = places.iter().map(|&p| (p - centre).dot(y).atan2((p - centre).dot(x))).collect();
    angles.sort_by(f64::total_cmp);
    let around = angles[0] + std::f64::consts::TAU - angles[angles.len() - 1];
    angles.windows(2).map(|pair| pair[1] - pair[0]).fold(around, f64::max)
}

#[test]
fn a_sphere_has_one_circle() {
    let grid = Grid::with_spacing([41; 3], [1.0; 3]).unwrap();
    let radius = 14.0;
    let phantom = sphere(&grid, radius);
    // Along axes and diagonals many voxels have exactly g·v = 0.
    for direction in [[0.3, 0.7, -0.4], [1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [1.0, 1.0, 1.0], [0.0, 1.0, 1.0]] {
        let view = view(&grid, direction, PARALLEL);
        let found = exact(phantom.as_ref(), &grid, 0.0, &view);
        assert_eq!((found.strokes.len(), found.lost), (1, 0), "{direction:?}");
        let stroke = &found.strokes[0];
        assert!(stroke.closed);
        let all = places(&found.strokes);
        for &p in &all {
            let from = p - grid.centre();
            assert!(from.dot(view.forward).abs() < OFF && (from.length() - radius).abs() < OFF, "{from}");
        }
        for vertex in &stroke.vertices {
            let from = vertex.world - grid.centre();
            // The last step of Newton's method is below 1e-6, and each step squares the error. The clamp of a step is
            // not met.
            assert!(from.dot(view.forward).abs() < 1e-6 && (from.length() - radius).abs() < 1e-6, "{from}");
            assert!((vertex.normal - from / radius).length() < 1e-6);
        }
        // The longest chord that stays within half of 0.01 voxel is 2√(2·14·0.005) = 0.75.
        assert!(largest_gap(&all, grid.centre(), view.forward) < 0.75 / radius);
        // Each place occurs once: the circle is not traversed twice.
        let length: f64 = all.windows(2).map(|pair| pair[0].distance(pair[1])).sum();
        assert!((length / radius - std::f64::consts::TAU).abs() < 0.06, "{length}");
        assert!(stroke.vertices.windows(2).all(|pair| pair[0].u < pair[1].u) && stroke.vertices[0].u == 0.0);
    }
}

/// In perspective the circle is nearer to the eye: at R²/D from the centre, of radius R√(1 − R²/D²).
#[test]
fn a_sphere_in_perspective() {
    let grid = Grid::with_spacing([41; 3], [1.0; 3]).unwrap();
    let radius = 14.0;
    let phantom = sphere(&grid, radius);
    let view = view(&grid, [0.2, -0.5, 0.6], Projection::Perspective { fov: 50.0 });
    let distance = (view.eye - grid.centre()).length();
    let towards = (view.eye - grid.centre()) / distance;
    let found = exact(phantom.as_ref(), &grid, 0.0, &view);
    assert_eq!((found.strokes.len(), found.lost), (1, 0));
    for p in places(&found.strokes) {
        let from = p - grid.centre();
        assert!((from.dot(towards) - radius * radius / distance).abs() < OFF, "{from}");
        assert!((from.length() - radius).abs() < OFF, "{from}");
    }
}

/// A torus seen from above its side has two closed curves. Their places have f = 0 and N·v = 0 to a hundredth of a
/// voxel, measured by the length of a Newton step.
#[test]
fn a_torus_turns_away_twice() {
    let grid = Grid::with_spacing([49, 49, 33], [1.0; 3]).unwrap();
    let phantom = by_name("torus", &grid, &[("R".into(), 13.0), ("r".into(), 6.0)]).unwrap();
    let view = view(&grid, [0.3, 0.4, -1.0], PARALLEL);
    let found = exact(phantom.as_ref(), &grid, 0.0, &view);
    assert_eq!((found.strokes.len(), found.lost), (2, 0));
    assert!(found.strokes.iter().all(|stroke| stroke.closed));
    let v = -view.forward;
    for p in places(&found.strokes) {
        let jet = phantom.jet(p);
        let g = jet.gradient;
        assert!(jet.value.abs() / g.length() < OFF, "{}", jet.value);
        // d(g·v)/dx = Hv, in the tangent plane.
        let h = jet.hessian * v;
        let n = g.normalize();
        let across = (h - n * n.dot(h)).length();
        assert!(g.dot(v).abs() / across < OFF, "{} {across}", g.dot(v));
    }
}

/// On anisotropic and sheared grids the circle is a circle of the world, to a hundredth of the smallest voxel.
#[test]
fn grids_of_any_shape() {
    let thin = Grid::with_spacing([45, 45, 13], [1.0, 1.0, 4.0]).unwrap();
    let axes = DMat3::from_cols(DVec3::new(1.0, 0.2, 0.0), DVec3::new(-0.3, 1.1, 0.1), DVec3::new(0.4, 0.0, 0.9));
    let sheared = Grid::new([49; 3], axes, DVec3::new(100.0, -7.0, 3.0)).unwrap();
    for (grid, radius) in [(thin, 16.0), (sheared, 13.0)] {
        let phantom = sphere(&grid, radius);
        let view = view(&grid, [0.3, 0.7, -0.4], PARALLEL);
        let found = exact(phantom.as_ref(), &grid, 0.0, &view);
        assert_eq!((found.strokes.len(), found.lost), (1, 0));
        assert!(found.strokes[0].closed);
        for p in places(&found.strokes) {
            let from = p - grid.centre();
            let off = OFF * grid.voxel();
            assert!(from.dot(view.forward).abs() < off && (from.length() - radius).abs() < off, "{from}");
        }
    }
}

fn sampled(grid: Grid, value: impl Fn(DVec3) -> f64, voxels: fn(Vec<f64>) -> Voxels) -> Volume {
    let [nx, ny, nz] = grid.dims();
    let mut values = Vec::new();
    for_each([nx, ny, nz], |voxel| values.push(value(grid.to_world(position(voxel)))));
    Volume::new(grid, voxels(values), 1.0, 0.0).unwrap()
}

fn bytes(values: Vec<f64>) -> Voxels {
    Voxels::U8(values.into_iter().map(|v| v as u8).collect())
}

fn found(volume: &Volume, iso: f64, direction: [f64; 3], projection: Projection) -> OutlineStrokes {
    let field = Field::new(volume, Reconstruction::default(), Rung::Gradient).unwrap();
    let view = view(volume.grid(), direction, projection);
    outlines(&IsoSurface::new(&field, iso), &view)
}

/// A ball cut by the box: its circle on the box's face, closed to a corner, and the curve that ends there.
#[test]
fn where_the_surface_meets_the_box() {
    let grid = Grid::with_spacing([33, 33, 17], [1.0; 3]).unwrap();
    let (centre, radius) = (DVec3::new(16.0, 16.0, 4.0), 11.0);
    let volume = sampled(grid, |p| radius - (p - centre).length(), Voxels::F64);
    let found = found(&volume, 0.0, [1.0, 0.2, 0.1], PARALLEL);
    let on_box: Vec<&Stroke> = found.strokes.iter().filter(|s| s.vertices.iter().all(|v| v.world.z == 0.0)).collect();
    assert_eq!((on_box.len(), found.strokes.len()), (1, 2));
    assert!(on_box[0].closed);
    let expected = (radius * radius - 16.0f64).sqrt();
    for vertex in &on_box[0].vertices {
        // Trilinear values of a distance are off by at most an eighth of the curvature of a circle of that radius.
        let from = (vertex.world - DVec3::new(16.0, 16.0, 0.0)).length();
        assert!((from - expected).abs() < 1.0 / (4.0 * expected), "{from}");
    }
    let turning = &found.strokes[0];
    let last = turning.vertices.len() - 1;
    assert!(!turning.closed && turning.vertices[0].world.z < 0.1 && turning.vertices[last].world.z < 0.1);
    // At the corners of the box the loop continues over its edge and is closed all the same.
    let corner = sampled(
        Grid::with_spacing([17; 3], [1.0; 3]).unwrap(),
        |p| 9.0 - (p - DVec3::splat(2.0)).length(),
        Voxels::F64,
    );
    let field = Field::new(&corner, Reconstruction::default(), Rung::Gradient).unwrap();
    let view = view(corner.grid(), [-1.0, -1.0, -1.0], PARALLEL);
    let strokes = outlines(&IsoSurface::new(&field, 0.0), &view).strokes;
    let rim: Vec<&Stroke> =
        strokes.iter().filter(|s| s.vertices.iter().all(|v| v.world.min_element() == 0.0)).collect();
    assert!(rim.len() == 1 && rim[0].closed);
}

/// Iso-values equal to voxels' values, flat parts and steps: every stroke is finite and on the surface.
#[test]
fn plateaus_and_stored_values() {
    let ball = |p: DVec3| (150.0 - 8.0 * (p - DVec3::splat(12.0)).length()).round();
    let brick = |p: DVec3| if (p - DVec3::splat(12.0)).abs().max_element() <= 6.0 { 100.0 } else { 0.0 };
    let terraces = |p: DVec3| ((p.x + 0.5 * p.y + 0.25 * p.z) / 6.0).floor() * 40.0;
    let grid = || Grid::with_spacing([25; 3], [1.0; 3]).unwrap();
    for (volume, levels) in [
        (sampled(grid(), ball, bytes), vec![100.0, 94.0, 54.0]),
        (sampled(grid(), brick, bytes), vec![100.0, 50.0, 0.0]),
        (sampled(grid(), terraces, bytes), vec![0.0, 40.0, 80.0, 60.0]),
        (sampled(grid(), |_| 7.0, bytes), vec![7.0, 3.0]),
    ] {
        let field = Field::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
        for iso in levels {
            for direction in [[1.0, 0.0, 0.0], [0.3, 0.7, -0.4], [1.0, 1.0, 0.0]] {
                for projection in [PARALLEL, Projection::Perspective { fov: 60.0 }] {
                    for stroke in found(&volume, iso, direction, projection).strokes {
                        for vertex in &stroke.vertices {
                            let at = Vec3::from_glam(volume.grid().to_index(vertex.world));
                            let value: f64 = field.value(at);
                            assert!(vertex.world.is_finite() && (vertex.normal.length() - 1.0).abs() < 1e-12);
                            // The place is within 1e-6 voxel of the surface, and values change by at most 255 a
                            // voxel.
                            assert!((value - iso).abs() < 1e-3, "{value} {iso}");
                            assert!((0.0..=1.0).contains(&vertex.u));
                        }
                    }
                }
            }
        }
    }
    let ball = found(&sampled(grid(), ball, bytes), 94.0, [0.0, 1.0, 0.0], PARALLEL);
    assert!(ball.strokes.iter().any(|stroke| stroke.closed && stroke.vertices.len() > 20));
}

/// Noise has a curve in most cells. The strokes do not depend on the number of threads, nor fail for an eye amid the
/// noise.
#[test]
fn noise_on_any_number_of_threads() {
    let grid = Grid::with_spacing([21, 18, 19], [1.0, 0.7, 1.3]).unwrap();
    let volume =
        sampled(grid, |p| (uniform(5, [p.x as u32, (p.y * 10.0) as u32, (p.z * 10.0) as u32], 0) * 4.0).floor(), bytes);
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| found(&volume, 1.0, [0.3, 0.7, -0.4], Projection::Perspective { fov: 60.0 }))
    };
    let one = run(1);
    assert!(one.strokes.len() > 50 && one.places > 1000, "{}", one.strokes.len());
    assert_eq!(one, run(3));
    let field = Field::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
    let camera = Camera { eye: Some(DVec3::new(10.0, 6.3, 12.0)), ..Camera::default() };
    let amid = View::new(&camera, volume.grid(), [64, 64]).unwrap();
    let surface = IsoSurface::new(&field, 1.0);
    let strokes = outlines(&surface, &amid).strokes;
    assert!(strokes.iter().flat_map(|s| &s.vertices).all(|v| v.world.is_finite() && v.normal.is_finite()));
    // Skipping by ranges of bricks leaves nothing out.
    assert_eq!(strokes, outlines(&IsoSurface::without_skipping(&field, 1.0), &amid).strokes);
    // A flat volume has no cells.
    let flat =
        Volume::new(Grid::with_spacing([4, 1, 4], [1.0; 3]).unwrap(), Voxels::U8(vec![9; 16]), 1.0, 0.0).unwrap();
    assert_eq!(found(&flat, 9.0, [0.0, 1.0, 0.0], PARALLEL), OutlineStrokes::default());
}
