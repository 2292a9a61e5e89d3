//! Stored directions against directions computed at every place, and invariances of the storage ([HATCH-4],
//! [HATCH-5]).

use super::super::directions::{DirectionInterpolation, DirectionStorage};
use super::super::{
    CurvatureFamily, DirectionCounts, DirectionEstimator, HatchParams, NoDirection, Pyramid, SeedRule, StrokeGrower,
};
use super::*;
use crate::field::{Field, Reconstruction, Rung};
use drypoint_scene::math::scale_by_power_of_two;
use drypoint_scene::philox::uniform;
use drypoint_scene::strokes::Measure;
use drypoint_scene::volume::Voxels;

const TENSOR: Option<DirectionStorage> = Some(DirectionStorage { between: DirectionInterpolation::Tensor, all: false });
const FLIPPED: Option<DirectionStorage> =
    Some(DirectionStorage { between: DirectionInterpolation::Flipped, all: false });
const ALL: Option<DirectionStorage> = Some(DirectionStorage { between: DirectionInterpolation::Tensor, all: true });

fn raw(grid: &Grid, stored: Option<DirectionStorage>) -> HatchParams {
    HatchParams { rule: DirectionEstimator::Raw, stored, ..HatchParams::new(grid) }
}

/// The root mean square angle between stored and computed directions of both families, at places on a torus, with a
/// voxel size of 1/`n`.
fn off_on_torus(n: usize) -> f64 {
    let grid = Grid::with_spacing([40 * n, 40 * n, 24 * n], [1.0 / n as f64; 3]).unwrap();
    let ground = exact("torus", grid, &[("R", 11.0), ("r", 6.0)]);
    let [direct, stored] = [None, TENSOR].map(|stored| StrokeGrower::on(&ground, Some(0.0), raw(&ground.grid, stored)));
    let centre = ground.grid.centre();
    let (mut sum, mut places) = (0.0, 0);
    for i in 0..300u32 {
        let [u, v] = [0, 1].map(|a| std::f64::consts::TAU * uniform(5, [i, a, 0], 0));
        let ring = 11.0 + 6.0 * v.cos();
        let world = centre + DVec3::new(ring * u.cos(), ring * u.sin(), 6.0 * v.sin());
        let index = Vec3::from_glam(ground.grid.to_index(world));
        let mut counts = DirectionCounts::default();
        let [a, b] = [&direct, &stored].map(|s| s.curvature(index, &mut counts).unwrap());
        assert_eq!((counts.given[0], counts.between, counts.missing), (1, 1, 0));
        for (e, f) in [(a.e1, b.e1), (a.e2, b.e2)] {
            sum += e.cross(f).dot(e.cross(f));
            places += 1;
        }
    }
    (sum / f64::from(places)).sqrt()
}

/// Linear interpolation: halving the voxel size leaves a quarter of the error, within a tenth.
#[test]
fn between_voxels_the_error_is_of_second_order() {
    let off = [1, 2, 4].map(off_on_torus);
    for pair in off.windows(2) {
        let order = (pair[0] / pair[1]).log2();
        assert!((order - 2.0).abs() < 0.1, "{off:?}: {order}");
    }
    // h²/8 of the second derivatives along three axes, some 1/R² with R = 5 … 17.
    assert!(off[0] < 3.0 / 8.0 / 25.0, "{off:?}");
}

/// Directions turn by 1/R around a cylinder. The tensors e eᵀ at angles of ±φ/2 have their dominant eigenvector in
/// the middle, exactly. Along the cylinder all corners agree.
#[test]
fn rulings_of_a_cylinder_are_exact() {
    let axis = DVec3::new(0.3, -0.5, 0.8).normalize();
    let ground = exact("cylinder", cube(48), &[("R", 14.0), ("ax", axis.x), ("ay", axis.y), ("az", axis.z)]);
    let centre = ground.grid.centre();
    let out = axis.any_orthonormal_vector();
    for storing in [TENSOR, FLIPPED] {
        let strokes = StrokeGrower::on(&ground, Some(0.0), raw(&ground.grid, storing));
        for i in 0..200u32 {
            let turn = drypoint_scene::glam::DQuat::from_axis_angle(axis, f64::from(i));
            let index = Vec3::from_glam(ground.grid.to_index(centre + turn * out * 14.0 + axis * f64::from(i % 7)));
            let c = strokes.curvature(index, &mut DirectionCounts::default()).unwrap();
            assert!(c.e2.to_glam().cross(axis).length() <= 64.0 * f64::EPSILON);
            assert!(c.k2.abs() <= 1e-15 && (c.k1 * 14.0 - 1.0).abs() < 0.01, "{c:?}");
        }
    }
}

fn torus(voxels: VoxelType) -> Volume {
    sampled("torus", cube(40), voxels, &[("R", 11.0), ("r", 6.0), ("w", 1.5), ("high", 255.0)])
}

/// Strokes and their counts do not depend on when, or by how many threads, directions are computed. The number of
/// computed directions depends on when, but not on the threads.
#[test]
fn when_directions_are_made_does_not_show() {
    for (voxels, rule) in
        [(VoxelType::U8, DirectionEstimator::Scaled(Default::default())), (VoxelType::F64, DirectionEstimator::Raw)]
    {
        let volume = torus(voxels);
        let field = Field::<f64>::new(&volume, Reconstruction::default(), Rung::Hessian).unwrap();
        let cells: Vec<_> = active(&volume, 127.5).into_iter().step_by(13).collect();
        let grow = |threads: usize, stored: Option<DirectionStorage>| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let how = HatchParams { rule, stored, length: 15.0, ..HatchParams::new(volume.grid()) };
            let strokes = StrokeGrower::new(&field, Some(127.5), how);
            let grown = pool.install(|| {
                strokes.prepare();
                strokes.grow_all(&cells, |_| true)
            });
            (grown, strokes.stored())
        };
        let (one, made) = grow(1, TENSOR);
        assert!(one.strokes.len() > cells.len() / 2 && one.counts.scales.given == [0; 3]);
        assert!(made[0] > 1000 && made[1] < 64 * volume.grid().len() as u64);
        let (direct, none) = grow(2, None);
        assert_eq!((none, direct.counts.scales.between), ([0, 0], 0));
        assert!(direct != one);
        for threads in [2, 7] {
            assert_eq!(grow(threads, TENSOR), (one.clone(), made));
        }
        let (all, whole) = grow(2, ALL);
        assert_eq!(all, one);
        assert!(whole[0] > 2 * made[0]);
        assert_eq!(grow(7, ALL).1, whole);
        let (flipped, _) = grow(1, FLIPPED);
        assert_eq!(flipped, grow(7, FLIPPED).0);
        assert!(flipped != one && flipped.strokes.len() > cells.len() / 2);
    }
}

/// The pyramid knows curvatures if the directions of all voxels are computed. Seeds are the same.
#[test]
fn seeds_do_not_depend_on_what_the_pyramid_knows() {
    let volume = torus(VoxelType::U8);
    let field = Field::<f64>::new(&volume, Reconstruction::default(), Rung::Hessian).unwrap();
    let rule = SeedRule::Curvature { min_curvature: 0.1, min_gradient: 0.0 };
    for kind in [Measure::Mean, Measure::Curvedness] {
        let [(visited, plain), (all, known)] = [TENSOR, ALL].map(|stored| {
            let strokes =
                StrokeGrower::new(&field, Some(127.5), HatchParams { stored, ..HatchParams::new(volume.grid()) });
            strokes.prepare();
            let pyramid = strokes.with_curvature(Pyramid::new(&volume), kind);
            let seeds = strokes.seeds(&pyramid, &field, 127.5, rule, (kind, [0.0, 100.0]));
            (seeds, pyramid.bytes() as f64 / pyramid.entries() as f64)
        });
        assert_eq!([plain, known], [2.0, 3.0]);
        assert!(visited.draw(1).count() > 100 && visited.draw(1).eq(all.draw(1)));
        assert_eq!(visited.expected(), all.expected());
        assert!(all.measured <= visited.measured, "{} {}", all.measured, visited.measured);
    }
}

/// The signs of stored directions, turned at random at each voxel, do not change the strokes.
#[test]
fn signs_of_stored_directions_do_not_show() {
    let ground = exact("torus", cube(40), &[("R", 11.0), ("r", 6.0)]);
    let grown = |storing: Option<DirectionStorage>, signs: bool| {
        let strokes = StrokeGrower::on(&ground, Some(0.0), HatchParams { length: 15.0, ..raw(&ground.grid, storing) });
        if signs {
            strokes.turn_signs();
        }
        let cells: Vec<_> =
            (0..300u32).map(|i| [0, 1, 2].map(|a| (40.0 * uniform(9, [i, a, 0], 0)) as usize)).collect();
        strokes.grow_all(&cells, |_| false)
    };
    let one = grown(TENSOR, false);
    assert!(one.strokes.len() > 5);
    for ((seed, stroke), (other, turned)) in one.strokes.iter().zip(&grown(TENSOR, true).strokes) {
        assert_eq!((seed, stroke), (other, turned));
    }
    assert_eq!(one.counts, grown(TENSOR, true).counts);
    // The corners of the paper's method have a sign of their own again.
    assert_eq!(grown(FLIPPED, false), grown(FLIPPED, true));
}

/// Values times 2ᵏ give the same bits.
#[test]
fn powers_of_two_do_not_show() {
    let volume = torus(VoxelType::F64);
    let cells: Vec<_> = active(&volume, 127.5).into_iter().step_by(41).collect();
    let grown = |factor: f64, rule: DirectionEstimator| {
        let voxels = (0..volume.grid().len()).map(|i| volume.voxels().get(i) * factor).collect();
        let volume = Volume::new(volume.grid().clone(), Voxels::F64(voxels), 1.0, 0.0).unwrap();
        let field = Field::<f64>::new(&volume, Reconstruction::default(), Rung::Hessian).unwrap();
        let how = HatchParams { rule, stored: TENSOR, ..HatchParams::new(volume.grid()) };
        let grown = StrokeGrower::new(&field, Some(127.5 * factor), how).grow_all(&cells, |_| true);
        let strokes: Vec<_> = grown.strokes.into_iter().chain(grown.cross).map(|(_, stroke)| stroke).collect();
        (strokes, grown.counts)
    };
    for rule in [DirectionEstimator::Raw, DirectionEstimator::Scaled(Default::default())] {
        let one = grown(1.0, rule);
        for k in [-300, -1, 300] {
            assert_eq!(grown(scale_by_power_of_two(1.0, k), rule), one);
        }
    }
}

/// A sphere stores no direction and has no stroke. Half the corners without a direction are too many.
#[test]
fn where_no_voxel_has_a_direction_there_is_none() {
    let volume = sampled("sphere", cube(40), VoxelType::U8, &[("R", 12.3), ("w", 2.0), ("high", 255.0)]);
    let field = Field::<f64>::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
    let how = HatchParams { stored: TENSOR, ..HatchParams::new(volume.grid()) };
    let strokes = StrokeGrower::new(&field, Some(127.5), how);
    let cells: Vec<_> = active(&volume, 127.5).into_iter().step_by(11).collect();
    let grown = strokes.grow_all(&cells, |_| false);
    assert!(grown.strokes.len() * 50 <= cells.len());
    assert!(grown.counts.rejected.no_direction * 100 >= cells.len() as u64 * 98);
    assert!(grown.counts.scales.missing >= grown.counts.rejected.no_direction);
}

/// Away from umbilics, strokes of stored and of computed directions agree to the error of interpolation. On a torus
/// of radii 11 and 6, after an arc of 15, the error is some hundredths of a voxel.
#[test]
fn strokes_are_near_those_of_computed_directions() {
    let ground = exact("torus", cube(40), &[("R", 11.0), ("r", 6.0)]);
    let centre = ground.grid.centre();
    for storing in [TENSOR, FLIPPED] {
        for i in 0..40 {
            let [u, v] = [0.1 + f64::from(i), 0.7 * f64::from(i)];
            let ring = 11.0 + 6.0 * v.cos();
            let world = centre + DVec3::new(ring * u.cos(), ring * u.sin(), 6.0 * v.sin());
            let ends = [None, storing].map(|stored| {
                let how = HatchParams {
                    length: 15.0,
                    family: CurvatureFamily::Max,
                    tolerance: 1e-4,
                    ..raw(&ground.grid, stored)
                };
                let strokes = StrokeGrower::on(&ground, Some(0.5), how);
                let stroke = strokes.grow(&seed_at(&strokes, world), &mut HatchCounts::default()).unwrap();
                [stroke.vertices[0].world, stroke.vertices[stroke.vertices.len() - 1].world]
            });
            let [[a, b], [c, d]] = ends;
            let apart = (a.distance(c).max(b.distance(d))).min(a.distance(d).max(b.distance(c)));
            assert!(apart < 0.1, "{u} {v}: {apart}");
        }
    }
}

/// A place has no direction if no voxel around it has one, and this is counted.
#[test]
fn a_plane_has_no_direction_between_its_voxels() {
    let ground = exact("plane", cube(16), &[("nx", 1.0), ("ny", 2.0), ("nz", 3.0)]);
    let strokes = StrokeGrower::on(&ground, Some(0.0), raw(&ground.grid, TENSOR));
    let mut counts = DirectionCounts::default();
    let index = Vec3::new(7.3, 7.1, 7.9);
    assert_eq!(strokes.curvature(index, &mut counts), Err(NoDirection::Umbilic));
    assert_eq!((counts.missing, counts.between, strokes.stored()[0]), (1, 0, 0));
}

/// Cells of the surface of a ground where its value is 0.
fn surface_cells(ground: &dyn StrokeField) -> Vec<[usize; 3]> {
    let [nx, ny, nz] = ground.grid().dims();
    let value = |voxel: [usize; 3]| ground.value(Vec3::from_glam(DVec3::from_array(voxel.map(|i| i as f64))));
    let cells = (0..nz - 1).flat_map(|z| (0..ny - 1).flat_map(move |y| (0..nx - 1).map(move |x| [x, y, z])));
    let crossed = |&[x, y, z]: &[usize; 3]| {
        let corners = [0, 1, 2, 3, 4, 5, 6, 7].map(|i| value([x + (i & 1), y + (i >> 1 & 1), z + (i >> 2)]));
        corners.iter().any(|&c| c > 0.0) && corners.iter().any(|&c| c < 0.0)
    };
    cells.filter(crossed).collect()
}

/// The root mean square angle in degrees between e₁ at the voxels of a surface's cells and the true direction, and the
/// number of voxels without one.
fn off_at_voxels(strokes: &StrokeGrower<'_, '_>, cells: &[[usize; 3]], truth: &dyn Fn(DVec3) -> DVec3) -> (f64, usize) {
    let found = cells.iter().map(|&cell| strokes.at_voxel(cell).map(|c| (cell, c.e1.to_glam())));
    let (mut sum, mut missing) = (0.0, 0);
    for one in found {
        match one {
            Some((cell, e)) => {
                let at = strokes.ground().grid().to_world(DVec3::from_array(cell.map(|i| i as f64)));
                sum += e.cross(truth(at)).length().min(1.0).asin().powi(2);
            }
            None => missing += 1,
        }
    }
    ((sum / (cells.len() - missing) as f64).sqrt().to_degrees(), missing)
}

/// Smoothing averages the noise of directions away: a cylinder whose Hessian has an error of twice its curvature.
#[test]
fn smoothed_directions_of_a_noisy_cylinder_agree() {
    let grid = Grid::with_spacing([40, 40, 30], [1.0, 1.0, 1.5]).unwrap();
    let (centre, radius) = (grid.centre(), 12.0);
    let at = move |x: DVec3| {
        let out = DVec3::new(x.x - centre.x, x.y - centre.y, 0.0);
        let (rho, n) = (out.length(), out.normalize_or(DVec3::X));
        let t = DVec3::Z.cross(n);
        // A random symmetric matrix in the tangent plane of each place.
        let random = |draw: u32| 2.0 * uniform(8, x.to_array().map(|c| (4.0 * c) as u32), draw) - 1.0;
        let outer = |a: DVec3, b: DVec3| DMat3::from_cols(a * b.x, a * b.y, a * b.z);
        let noise = (outer(t, t) * random(0)
            + outer(DVec3::Z, DVec3::Z) * random(1)
            + (outer(t, DVec3::Z) + outer(DVec3::Z, t)) * random(2))
            * (2.0 / radius);
        (radius - rho, -n, outer(t, t) * (-1.0 / rho.max(1.0)) + noise)
    };
    let ground = Formula { grid, range: [-20.0, 20.0], at };
    let cells = surface_cells(&ground);
    let off = |smooth: f64| {
        let how = HatchParams { smooth, ..raw(&ground.grid, TENSOR) };
        let strokes = StrokeGrower::on(&ground, Some(0.0), how);
        if smooth > 0.0 {
            strokes.smooth(&cells);
        }
        // Far from the ends, where there are neighbours on both sides.
        let inner: Vec<_> = cells.iter().copied().filter(|cell| (8..22).contains(&cell[2])).collect();
        // Bright inside, κ₁ = 1/ρ runs around the axis.
        off_at_voxels(&strokes, &inner, &|x| DVec3::Z.cross(x - centre).normalize())
    };
    let [(before, _), (after, missing)] = [off(0.0), off(4.0)];
    assert!(before > 30.0 && after < 5.0 && missing == 0, "{before} {after} {missing}");
}

/// The lines of a torus are those of its symmetries, so that a mean over a length keeps them, but for the grid.
#[test]
fn smoothed_directions_of_a_torus_stay() {
    let grid = Grid::with_spacing([40, 40, 24], [1.0; 3]).unwrap();
    let ground = exact("torus", grid, &[("R", 11.0), ("r", 6.0)]);
    let cells = surface_cells(&ground);
    let how = HatchParams { smooth: 2.0, ..raw(&ground.grid, TENSOR) };
    let strokes = StrokeGrower::on(&ground, Some(0.0), how);
    strokes.smooth(&cells);
    let centre = ground.grid.centre();
    // Bright inside, κ₁ = 1/r runs around the tube: in the plane through the axis, across the tube's radius.
    let around = |x: DVec3| {
        let out = (x - centre).with_z(0.0).normalize();
        let radius = x - centre - 11.0 * out;
        radius.cross(DVec3::Z.cross(out)).normalize()
    };
    let (off, missing) = off_at_voxels(&strokes, &cells, &around);
    assert!(off < 3.0 && missing == 0, "{off} {missing}");
}
