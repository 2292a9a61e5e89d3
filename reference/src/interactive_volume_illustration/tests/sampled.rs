//! Strokes on voxels.

use super::super::strokes::CurvatureLines;
use super::super::strokes::integrator::{Control, HalfCurve, LineField, trace};
use super::super::{CurvatureFamily, DirectionEstimator, HatchParams, NoDirection, StrokeGrower};
use super::*;
use crate::field::{Field, HessianEstimator, Kernel, Reconstruction, Rung};
use drypoint_scene::math::scale_by_power_of_two;
use drypoint_scene::strokes::Stroke;
use drypoint_scene::volume::Voxels;

fn field(volume: &Volume) -> Field<'_, f64> {
    Field::new(volume, Reconstruction::default(), Rung::Hessian).unwrap()
}

fn torus(voxels: VoxelType, spacing: [f64; 3], dims: [usize; 3]) -> Volume {
    let grid = Grid::with_spacing(dims, spacing).unwrap();
    sampled("torus", grid, voxels, &[("R", 11.0), ("r", 6.0), ("w", 1.5), ("high", 255.0)])
}

/// Tests 64 places along every segment: they lie in front of the trilinear surface.
fn assert_in_front(field: &Field<'_, f64>, iso: f64, stroke: &Stroke) {
    let grid = field.volume().grid();
    let places: Vec<DVec3> = stroke.vertices.iter().map(|v| v.world).collect();
    for (i, &a) in places.iter().enumerate() {
        let b = if i + 1 < places.len() {
            places[i + 1]
        } else if stroke.closed {
            places[0]
        } else {
            a
        };
        for s in 0..64 {
            let index = grid.to_index(a + (b - a) * (f64::from(s) / 64.0));
            let value = StrokeField::value(field, Vec3::from_glam(index));
            assert!(value <= iso + 1e-9, "{value}");
        }
    }
}

/// Seeds and rejections add up to the cells. Strokes lie in front, u runs from 0 to 1, and lengths are within the
/// limit. On the torus, strokes lie outside by δ and a chord's error.
#[test]
fn on_a_torus_of_eight_bits() {
    for (spacing, dims) in [([1.0; 3], [40, 40, 18]), ([1.0, 0.5, 2.0], [40, 80, 9])] {
        let volume = torus(VoxelType::U8, spacing, dims);
        let (field, iso) = (field(&volume), 127.5);
        let cells = active(&volume, iso);
        let how = HatchParams { length: 15.0, ..HatchParams::new(volume.grid()) };
        let strokes = StrokeGrower::new(&field, Some(iso), how);
        let grown = strokes.grow_all(&cells, |_| false);
        let counts = grown.counts;
        assert_eq!(counts.strokes + counts.rejected.total(), cells.len() as u64);
        assert_eq!(counts.strokes, grown.strokes.len() as u64);
        assert_eq!(counts.stops.named().iter().map(|(_, n)| n).sum::<u64>() + counts.stops.closed, 2 * counts.strokes);
        assert!(counts.strokes as f64 >= 0.5 * cells.len() as f64);
        let centre = volume.grid().centre();
        let mut worst: f64 = 0.0;
        for (seed, stroke) in &grown.strokes {
            assert!(seed.target < iso);
            assert_in_front(&field, iso, stroke);
            let length: f64 = stroke.vertices.windows(2).map(|v| v[0].world.distance(v[1].world)).sum();
            // Vertices are moved onto the surface, across the tangent planes of estimated gradients; the angle is at
            // most 11°.
            assert!(length <= how.length * 1.02, "{length}");
            assert_eq!(stroke.vertices[0].u, 0.0);
            assert!(stroke.vertices.windows(2).all(|v| v[0].u < v[1].u));
            assert!(stroke.closed || stroke.vertices[stroke.vertices.len() - 1].u == 1.0);
            for v in &stroke.vertices {
                let p = v.world - centre;
                let off = (p.x.hypot(p.y) - 11.0).hypot(p.z) - 6.0;
                worst = worst.max(off.abs());
            }
        }
        // δ, c, and half of the spacing between whose voxels the surface lies.
        assert!(worst <= 0.15 + 0.1 + 0.5 * spacing[2], "{worst}");
    }
}

/// Strokes do not depend on the number of threads, nor on what was grown before.
#[test]
fn threads_and_order_do_not_show() {
    let volume = torus(VoxelType::U8, [1.0; 3], [40, 40, 18]);
    let field = field(&volume);
    let cells: Vec<_> = active(&volume, 127.5).into_iter().step_by(17).collect();
    let grow = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let strokes = StrokeGrower::new(&field, Some(127.5), HatchParams::new(volume.grid()));
        pool.install(|| strokes.grow_all(&cells, |seed| seed.normal.z > 0.5))
    };
    let one = grow(1);
    assert!(!one.cross.is_empty() && one.cross.len() < one.strokes.len());
    assert_eq!(one, grow(3));
    let strokes = StrokeGrower::new(&field, Some(127.5), HatchParams::new(volume.grid()));
    let backwards: Vec<_> = cells.iter().copied().rev().collect();
    let back = strokes.grow_all(&backwards, |_| false);
    assert!(back.strokes.iter().rev().eq(&one.strokes));
}

/// Values times 2ᵏ give the same bits. The world times 10^±6, with all lengths, gives the same strokes.
#[test]
fn units_do_not_show() {
    let volume = torus(VoxelType::F64, [1.0, 0.5, 2.0], [40, 80, 9]);
    let cells: Vec<_> = active(&volume, 127.5).into_iter().step_by(23).collect();
    let grown = |value: f64, world: f64| {
        let grid = Grid::with_spacing(volume.dims(), volume.grid().spacing().map(|s| s * world)).unwrap();
        let voxels = (0..grid.len()).map(|i| volume.voxels().get(i) * value).collect();
        let volume = Volume::new(grid, Voxels::F64(voxels), 1.0, 0.0).unwrap();
        let field = field(&volume);
        StrokeGrower::new(&field, Some(127.5 * value), HatchParams::new(volume.grid())).grow_all(&cells, |_| true)
    };
    let one = grown(1.0, 1.0);
    for k in [-300, -1, 8, 300] {
        let other = grown(scale_by_power_of_two(1.0, k), 1.0);
        assert_eq!(other.counts, one.counts);
        for (a, b) in one.strokes.iter().chain(&one.cross).zip(other.strokes.iter().chain(&other.cross)) {
            assert_eq!(a.1, b.1);
        }
    }
    for (value, world) in [(1e6, 1.0), (1e-6, 1.0), (1.0, 1e6), (1.0, 1e-6)] {
        let other = grown(value, world);
        assert_eq!(other.counts, one.counts, "{value:e} {world:e}");
        for (a, b) in one.strokes.iter().zip(&other.strokes) {
            assert_eq!(a.1.vertices.len(), b.1.vertices.len());
            for (v, w) in a.1.vertices.iter().zip(&b.1.vertices) {
                let off = v.world.distance(w.world / world);
                assert!(off <= 1e-9, "{value:e} {world:e}: {off:e}");
            }
        }
    }
}

/// Both halves from the seeds of cells, with the number of directions, in all and for each σ.
fn traced(
    field: &Field<'_, f64>,
    cells: &[[usize; 3]],
    rule: DirectionEstimator,
    tolerance: f64,
) -> (Vec<HalfCurve<NoDirection>>, u64, [u64; 3]) {
    let voxel = field.volume().grid().voxel();
    let how = HatchParams { tolerance, rule, family: CurvatureFamily::Max, ..HatchParams::new(field.volume().grid()) };
    let strokes = StrokeGrower::new(field, Some(127.5), how);
    let mut counts = HatchCounts::default();
    let mut halves = Vec::new();
    let mut asked = 0;
    for &cell in cells {
        let Ok(seed) = strokes.place(cell, &mut counts) else { continue };
        let along = seed.curvature.e1.to_glam();
        for along in [along, -along] {
            let mut lines = CurvatureLines::new(&strokes, seed.family, seed.target, &mut counts);
            let there = lines.at(seed.world).unwrap();
            let along = there * there.dot(along).signum();
            let control = Control {
                tolerance,
                first: voxel,
                min_step: 1e-12,
                max_step: 2.0 * voxel,
                length: 6.0 * voxel,
                cos_max_angle: -1.0,
                goal: None,
            };
            let half = trace(&mut lines, seed.world, along, &control);
            asked += u64::from(half.evaluations);
            halves.push(half);
        }
    }
    (halves, asked, counts.scales.given)
}

/// The place after an arc on a half. Returns none beyond its end.
fn after(half: &HalfCurve<NoDirection>, arc: f64) -> Option<DVec3> {
    let mut before = 0.0;
    for segment in &half.segments {
        let step = segment.tangents[0].length();
        if arc <= before + step {
            return Some(segment.point((arc - before) / step));
        }
        before += step;
    }
    None
}

/// A stroke is within ten times its tolerance of its own finest solution, all along it. The field has kinks at the
/// faces of cells and jumps where σ changes. The cost is of fourth order: 100^¼ = 3.2 times the directions for a
/// hundredth of the tolerance, once steps are shorter than cells.
#[test]
fn errors_follow_the_tolerance_between_voxels() {
    let volume = torus(VoxelType::F64, [1.0; 3], [40, 40, 18]);
    let bytes = torus(VoxelType::U8, [1.0; 3], [40, 40, 24]);
    let scaled = DirectionEstimator::Scaled(Default::default());
    for (name, volume, kernel, rule) in [
        ("raw trilinear", &volume, Kernel::Trilinear, DirectionEstimator::Raw),
        ("raw bspline", &volume, Kernel::Bspline, DirectionEstimator::Raw),
        ("scaled f64", &volume, Kernel::Trilinear, scaled),
        ("scaled u8", &bytes, Kernel::Trilinear, scaled),
    ] {
        let how = Reconstruction { kernel, hessian: HessianEstimator::Auto, ..Default::default() };
        let field = Field::<f64>::new(volume, how, Rung::Hessian).unwrap();
        let cells: Vec<_> = active(volume, 127.5).into_iter().step_by(401).collect();
        let (fine, ..) = traced(&field, &cells, rule, 1e-12);
        let (mut asked, mut found) = (Vec::new(), Vec::new());
        for tolerance in [1e-1, 3e-2, 1e-2, 5e-3, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10] {
            let (halves, directions, _) = traced(&field, &cells, rule, tolerance);
            assert_eq!(halves.len(), fine.len());
            let (mut worst, mut places) = (0.0f64, 0);
            for (a, b) in halves.iter().zip(&fine) {
                for arc in (0..=60).map(|i| f64::from(i) * 0.1) {
                    if let (Some(p), Some(q)) = (after(a, arc), after(b, arc)) {
                        worst = worst.max(p.distance(q));
                        places += 1;
                    }
                }
            }
            assert!(places > 1000, "{places}");
            asked.push(directions as f64);
            found.push(worst / tolerance);
        }
        assert!(found.iter().all(|off| *off <= 10.0), "{name}: {found:?}");
        for hundredth in [5, 7, 9] {
            assert!(asked[hundredth + 2] <= 3.2 * asked[hundredth], "{name}: {asked:?}");
        }
    }
}
