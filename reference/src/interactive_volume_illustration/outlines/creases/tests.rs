use super::*;
use crate::field::{Field, Reconstruction, Rung};
use drypoint_scene::glam::DMat3;
use drypoint_scene::phantom::by_name;
use drypoint_scene::space::Grid;
use drypoint_scene::strokes::Stroke;
use drypoint_scene::volume::{Volume, Voxels};

/// The bound of [HATCH-22]: half a voxel.
const OFF: f64 = 0.5;

fn grid(side: usize) -> Grid {
    Grid::with_spacing([side; 3], [1.0; 3]).unwrap()
}

fn sampled(grid: Grid, value: impl Fn(DVec3) -> f64) -> Volume {
    let n = grid.dims()[0];
    let at = |i: usize| grid.to_world(position([i % n, i / n % n, i / n / n]));
    let values = (0..n * n * n).map(|i| value(at(i))).collect();
    Volume::new(grid.clone(), Voxels::F64(values), 1.0, 0.0).unwrap()
}

fn found(volume: &Volume, iso: f64) -> Vec<Stroke> {
    let field = Field::new(volume, Reconstruction::default(), Rung::Gradient).unwrap();
    creases(&IsoSurface::new(&field, iso), 30.0, 0.0).found.strokes
}

/// The distance to a cube of half a side, whose edges are rounded by r: positive inside.
fn rounded_cube(p: DVec3, half: f64, r: f64) -> f64 {
    let q = p.abs() - (half - r);
    r - q.max(DVec3::ZERO).length() - q.max_element().min(0.0)
}

/// Vertices, and places between them a tenth of a voxel apart or less.
fn places(stroke: &Stroke) -> Vec<DVec3> {
    let ends: Vec<DVec3> = stroke.vertices.iter().map(|vertex| vertex.world).collect();
    let between = |pair: &[DVec3]| {
        let steps = (pair[0].distance(pair[1]) * 10.0).ceil().max(1.0) as usize;
        let [a, b] = [pair[0], pair[1]];
        (0..=steps).map(move |k| a.lerp(b, k as f64 / steps as f64)).collect::<Vec<_>>()
    };
    ends.windows(2).flat_map(between).collect()
}

/// Cubes whose edges are rounded by some voxels, straight and turned: twelve creases, all of them within half a voxel of
/// an edge, all along the edges, and three of them ending at each corner.
#[test]
fn a_rounded_cube_has_twelve_edges() {
    let turned = DMat3::from_axis_angle(DVec3::new(0.3, 0.5, 0.8).normalize(), 0.7);
    for (r, turn) in [(1.0, DMat3::IDENTITY), (2.0, DMat3::IDENTITY), (2.0, turned), (3.0, turned)] {
        let (half, centre) = (10.3, DVec3::new(20.2, 19.9, 20.4));
        let local = |p: DVec3| turn.transpose() * (p - centre);
        let strokes = found(&sampled(grid(41), |p| rounded_cube(local(p), half, r)), 0.0);
        let ends: Vec<_> =
            strokes.iter().map(|s| [s.vertices[0], s.vertices[s.vertices.len() - 1]].map(|v| local(v.world))).collect();
        assert_eq!(strokes.len(), 12, "{r}: {ends:?}");
        let all: Vec<DVec3> = strokes.iter().flat_map(places).map(local).collect();
        for &p in &all {
            // On an edge the two larger coordinates are equal.
            let mut a = p.abs().to_array();
            a.sort_by(f64::total_cmp);
            let off = ((a[2] - a[1]) / 2f64.sqrt()).hypot(rounded_cube(p, half, r));
            assert!(off <= OFF, "{r}: {p} {off}");
        }
        // Middles of the arcs between faces, along the part where only two faces meet.
        let out = half - r + r / 2f64.sqrt();
        for (axis, signs) in
            (0..3).flat_map(|axis| [[1.0, 1.0], [1.0, -1.0], [-1.0, 1.0], [-1.0, -1.0]].map(|s| (axis, s)))
        {
            for k in 0..=20 {
                let mut edge = DVec3::ZERO;
                edge[axis] = (half - r) * (f64::from(k) / 10.0 - 1.0);
                (edge[(axis + 1) % 3], edge[(axis + 2) % 3]) = (out * signs[0], out * signs[1]);
                let nearest = all.iter().map(|p| p.distance(edge)).fold(f64::INFINITY, f64::min);
                assert!(nearest <= OFF, "{r}: {edge} {nearest}");
            }
        }
        let ends: Vec<DVec3> =
            strokes.iter().flat_map(|s| [s.vertices[0], s.vertices[s.vertices.len() - 1]]).map(|v| v.world).collect();
        for end in &ends {
            assert_eq!(ends.iter().filter(|other| *other == end).count(), 3, "{r}: {end}");
        }
    }
}

/// A sharp right angle between two voxels. Its smoothed values are Φ(x)Φ(y), which central differences read two voxels
/// apart: D = ½(Φ(3/2) − Φ(−1/2)) = 0.3123 is the slope of a factor, and the normal turns by 2√2 D = 50.6° over two
/// voxels.
#[test]
fn a_right_angle_turns_by_fifty_degrees() {
    let volume = sampled(grid(41), |p| if p.x < 20.5 && p.y < 20.5 { 1.0 } else { 0.0 });
    let field = Field::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
    // The trilinear value at the corner of the step is a quarter.
    let at = |angle: f64| creases(&IsoSurface::new(&field, 0.25), angle, 0.0).found.strokes;
    assert_eq!((at(49.0).len(), at(52.0).len()), (1, 0));
    for vertex in &at(49.0)[0].vertices {
        assert!((vertex.world.truncate() - 20.5).length() < 0.1, "{}", vertex.world);
    }
}

/// Round bodies whose radii exceed eight voxels have no creases: as formulas in floating point, and as bytes.
#[test]
fn round_bodies_have_none() {
    let grid = Grid::with_spacing([61; 3], [1.0; 3]).unwrap();
    for (name, params) in [
        ("sphere", vec![("R".into(), 8.5)]),
        ("cylinder", vec![("R".into(), 8.5)]),
        ("torus", vec![("R".into(), 18.0), ("r".into(), 8.5)]),
    ] {
        let phantom = by_name(name, &grid, &params).unwrap();
        let exact = sampled(grid.clone(), |p| phantom.value(p));
        assert_eq!(found(&exact, 0.0), [], "{name}");
        let values: Vec<u8> =
            (0..grid.len()).map(|i| (exact.voxels().get(i) * 30.0 + 128.0).clamp(0.0, 255.0) as u8).collect();
        let bytes = Volume::new(grid.clone(), Voxels::U8(values), 1.0, 0.0).unwrap();
        assert_eq!(found(&bytes, 128.0), [], "{name}");
    }
    // A ball of three voxels turns by 38°, and has no direction.
    let ball = sampled(self::grid(21), |p| 3.0 - p.distance(DVec3::splat(10.1)));
    assert_eq!(found(&ball, 0.0), []);
}

/// A groove is a crease like an edge.
#[test]
fn valleys_count() {
    // Two planes meet at a right angle at the bottom of a groove along y.
    let volume = sampled(grid(41), |p| 10.0 + (p.x - 20.0).abs() - p.z);
    let strokes = found(&volume, 0.0);
    assert_eq!(strokes.len(), 1);
    assert!(strokes[0].vertices.iter().all(|vertex| (vertex.world.x - 20.0).abs() < OFF));
}
