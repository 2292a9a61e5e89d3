//! Strokes on voxels.

use super::super::{Family, Hatching, Rule, Strokes};
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

/// 64 places along every segment in front of the surface, as the trilinear values have it.
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
            let value = Ground::value(field, Vec3::from_glam(index));
            assert!(value <= iso + 1e-9, "{value}");
        }
    }
}

/// Seeds and rejections are the cells; strokes lie in front, run from 0 to 1 in u, within their length, and on the torus: so
/// far outside of it as δ and a chord say.
#[test]
fn on_a_torus_of_eight_bits() {
    for (spacing, dims) in [([1.0; 3], [40, 40, 18]), ([1.0, 0.5, 2.0], [40, 80, 9])] {
        let volume = torus(VoxelType::U8, spacing, dims);
        let (field, iso) = (field(&volume), 127.5);
        let cells = active(&volume, iso);
        let how = Hatching { length: 15.0, ..Hatching::new(volume.grid()) };
        let strokes = Strokes::new(&field, Some(iso), how);
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
            // Vertices are put onto the surface, across the tangent planes of the estimated gradients: cos 11° at the most.
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
        // δ, c, and half of the spacing that the surface lies between.
        assert!(worst <= 0.15 + 0.1 + 0.5 * spacing[2], "{worst}");
    }
}

/// The same strokes whatever the threads, and whatever was grown before.
#[test]
fn threads_and_order_do_not_show() {
    let volume = torus(VoxelType::U8, [1.0; 3], [40, 40, 18]);
    let field = field(&volume);
    let cells: Vec<_> = active(&volume, 127.5).into_iter().step_by(17).collect();
    let grow = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let strokes = Strokes::new(&field, Some(127.5), Hatching::new(volume.grid()));
        pool.install(|| strokes.grow_all(&cells, |seed| seed.normal.z > 0.5))
    };
    let one = grow(1);
    assert!(!one.cross.is_empty() && one.cross.len() < one.strokes.len());
    assert_eq!(one, grow(3));
    let strokes = Strokes::new(&field, Some(127.5), Hatching::new(volume.grid()));
    let backwards: Vec<_> = cells.iter().copied().rev().collect();
    let back = strokes.grow_all(&backwards, |_| false);
    assert!(back.strokes.iter().rev().eq(&one.strokes));
}

/// Values times 2ᵏ: the same bits. The world times 10^±6 with all lengths: the same strokes.
#[test]
fn units_do_not_show() {
    let volume = torus(VoxelType::F64, [1.0, 0.5, 2.0], [40, 80, 9]);
    let cells: Vec<_> = active(&volume, 127.5).into_iter().step_by(23).collect();
    let grown = |value: f64, world: f64| {
        let grid = Grid::with_spacing(volume.dims(), volume.grid().spacing().map(|s| s * world)).unwrap();
        let voxels = (0..grid.len()).map(|i| volume.voxels().get(i) * value).collect();
        let volume = Volume::new(grid, Voxels::F64(voxels), 1.0, 0.0).unwrap();
        let field = field(&volume);
        Strokes::new(&field, Some(127.5 * value), Hatching::new(volume.grid())).grow_all(&cells, |_| true)
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

/// Against its own finest solution a stroke is within ten times its tolerance, for which order is lost at the faces of cells.
#[test]
fn errors_follow_the_tolerance_between_voxels() {
    let volume = torus(VoxelType::F64, [1.0; 3], [40, 40, 18]);
    for kernel in [Kernel::Trilinear, Kernel::Bspline] {
        let how = Reconstruction { kernel, hessian: HessianEstimator::Auto, ..Default::default() };
        let field = Field::<f64>::new(&volume, how, Rung::Hessian).unwrap();
        let cells: Vec<_> = active(&volume, 127.5).into_iter().step_by(401).collect();
        let how = |tolerance: f64| Hatching {
            tolerance,
            min_step: 1e-9,
            chord: 1e-4,
            length: 12.0,
            rule: Rule::Raw,
            family: Family::Max,
            ..Hatching::new(volume.grid())
        };
        let fine = Strokes::new(&field, Some(127.5), how(1e-7)).grow_all(&cells, |_| false);
        for tolerance in [1e-1, 1e-2, 1e-3, 1e-4] {
            let grown = Strokes::new(&field, Some(127.5), how(tolerance)).grow_all(&cells, |_| false);
            let mut worst: f64 = 0.0;
            for ((_, a), (_, b)) in grown.strokes.iter().zip(&fine.strokes) {
                assert!(!a.closed && !b.closed);
                let ends = |s: &Stroke| [s.vertices[0].world, s.vertices[s.vertices.len() - 1].world];
                let off = ends(a).into_iter().zip(ends(b)).map(|(v, w)| v.distance(w));
                worst = off.fold(worst, f64::max);
            }
            assert_eq!(grown.strokes.len(), fine.strokes.len());
            assert!(worst <= 10.0 * tolerance, "{kernel:?} {tolerance:e}: {worst:e}");
        }
    }
}
