//! Identities that hold bit for bit: constants, powers of two, integer offsets, both ends of the number range, mirrored
//! fields, and the two code paths of a stencil.

use super::*;
use crate::field::{curvature, normal};
use drypoint_scene::volume::VoxelType;
use proptest::prelude::*;

/// A scatter of whole numbers that f64 and f32 hold exactly.
fn scatter(n: usize) -> Vec<f64> {
    (0..n).map(|i| ((i * 7919 + 13) % 251) as f64).collect()
}

fn volume(dims: [usize; 3], voxels: Vec<f64>, slope: f64, intercept: f64) -> Volume {
    let grid = Grid::new(dims, frames()[2], DVec3::ZERO).unwrap();
    Volume::new(grid, Voxels::F64(voxels), slope, intercept).unwrap()
}

/// Value, gradient, the Hessian's gradient and the Hessian as a field gives them.
fn raw(field: &Field<'_, f64>, p: DVec3) -> (f64, [Vec3<f64>; 2], Sym3<f64>) {
    let p = Vec3::from_glam(p);
    with_sampler!(field, |s| {
        let (g, h) = s.hessian(p);
        (s.value(p), [s.gradient(p), g], h)
    })
}

#[test]
fn constants_are_exact_and_have_no_normal() {
    for value in [0.0, 1000.3, -1e-7, 3e300, -4e-300] {
        for dims in [[5, 4, 6], [2, 3, 1], [1, 1, 1]] {
            let v = volume(dims, vec![value; dims.iter().product()], 1.0, 0.0);
            for how in all() {
                let field = Field::<f64>::new(&v, how, Rung::Hessian).unwrap();
                for p in positions(v.grid(), 20) {
                    let (got, [g, own], h) = raw(&field, p);
                    assert_eq!(got, value, "{how:?}");
                    assert_eq!((g, own, h), (Vec3::zero(), Vec3::zero(), Sym3::default()), "{how:?}");
                    assert_eq!(normal::outward(g, Outside::Low, field.no_normal_below()), None);
                }
            }
        }
    }
}

/// Offset data with a rounding error in every voxel is constant all the same ([PREC-3]): values around 1000 whose last
/// place is noise have no normal anywhere, and a ramp of 2⁻⁴⁰ of them has.
#[test]
fn rounding_of_offset_data_has_no_normal_and_a_ramp_has() {
    let dims = [8, 8, 8];
    let noise = |i: usize| 1000.0 * (1.0 + f64::EPSILON * ((i * 7919) % 3) as f64);
    let v = volume(dims, (0..512).map(noise).collect(), 1.0, 0.0);
    let ramp = volume(dims, (0..512).map(|i| 1000.0 * (1.0 + (i % 8) as f64 / 1e12)).collect(), 1.0, 0.0);
    for how in all() {
        let field = Field::<f64>::new(&v, how, Rung::Hessian).unwrap();
        let sloped = Field::<f64>::new(&ramp, how, Rung::Hessian).unwrap();
        for p in positions(v.grid(), 20) {
            let has = |f: &Field<'_, f64>, g| normal::outward(g, Outside::Low, f.no_normal_below()).is_some();
            let (_, flat, _) = raw(&field, p);
            assert!(!flat.iter().any(|&g| has(&field, g)), "{how:?} at {p}");
            let (_, steep, _) = raw(&sloped, p);
            assert!(steep.iter().all(|&g| has(&sloped, g)), "{how:?} at {p}");
        }
    }
}

/// f · 2^k, in the voxels or in slope and intercept, changes no bit of gradients and Hessians times 2^−e, and scales
/// the value exactly; to the ends of the number range.
#[test]
fn powers_of_two_change_no_bit() {
    let dims = [5, 6, 4];
    let base = scatter(120);
    for how in all() {
        let plain = volume(dims, base.clone(), 1.0, 3.0);
        let field = Field::<f64>::new(&plain, how, Rung::Hessian).unwrap();
        for k in [-1000, -530, -3, 1, 70, 530, 1010] {
            let two = 2f64.powi(k);
            let voxels = volume(dims, base.iter().map(|v| v * two).collect(), 1.0, 3.0 * two);
            let slope = volume(dims, base.clone(), two, 3.0 * two);
            for scaled in [voxels, slope] {
                let other = Field::<f64>::new(&scaled, how, Rung::Hessian).unwrap();
                assert_eq!(other.scale_exponent(), field.scale_exponent() + k);
                assert_eq!(other.no_normal_below(), field.no_normal_below());
                for p in positions(plain.grid(), 12) {
                    let ((v, g, h), (sv, sg, sh)) = (raw(&field, p), raw(&other, p));
                    assert_eq!((v * two, g.map(bits), h), (sv, sg.map(bits), sh), "{how:?}, k = {k}, at {p}");
                }
            }
        }
    }
}

/// 2^k added to whole numbers changes no bit of a true gradient or Hessian, whatever reads the voxels' differences.
#[test]
fn an_offset_of_whole_numbers_changes_no_bit() {
    let dims = [5, 6, 4];
    let base = scatter(120);
    let plain = volume(dims, base.clone(), 0.7, -3.0);
    for how in all() {
        let field = Field::<f64>::new(&plain, how, Rung::Hessian).unwrap();
        for k in [0, 10, 40] {
            let offset = volume(dims, base.iter().map(|v| v + 2f64.powi(k)).collect(), 0.7, -3.0);
            let other = Field::<f64>::new(&offset, how, Rung::Hessian).unwrap();
            let up = 2f64.powi(other.scale_exponent() - field.scale_exponent());
            for p in positions(plain.grid(), 12) {
                let ((_, g, h), (_, og, oh)) = (raw(&field, p), raw(&other, p));
                assert_eq!(g.map(bits), og.map(|g| bits(g * up)), "{how:?}, k = {k}, at {p}");
                assert_eq!(h, oh.scaled(up), "{how:?}, k = {k}, at {p}");
            }
        }
    }
}

/// f and −f with `outside` mirrored: the same normals and curvatures, bit for bit ([NORM-1]).
#[test]
fn mirrored_fields_have_the_same_normals_and_curvatures() {
    let dims = [6, 6, 6];
    let base = scatter(216);
    let plain = volume(dims, base.clone(), 1.0, 5.0);
    let mirrored = volume(dims, base, -1.0, -5.0);
    let view = Vec3::from_glam(DVec3::new(1.0, 2.0, -2.0) / 3.0);
    for how in all() {
        let field = Field::<f64>::new(&plain, how, Rung::Hessian).unwrap();
        let other =
            Field::<f64>::new(&mirrored, Reconstruction { outside: Outside::High, ..how }, Rung::Hessian).unwrap();
        for p in positions(plain.grid(), 12) {
            let ((v, [g, own], h), (mv, [mg, mown], mh)) = (raw(&field, p), raw(&other, p));
            assert_eq!(v, -mv);
            let below = field.no_normal_below();
            let (n, m) = (normal::outward(g, Outside::Low, below), normal::outward(mg, Outside::High, below));
            assert!(n.is_some());
            assert_eq!(n.map(bits), m.map(bits), "{how:?} at {p}");
            let (c, d) = (curvature::principal(own, h, Outside::Low), curvature::principal(mown, mh, Outside::High));
            assert_eq!((c.k1, c.k2, bits(c.e1), bits(c.e2)), (d.k1, d.k2, bits(d.e1), bits(d.e2)), "{how:?} at {p}");
            let along = curvature::along_view(own, h, view, Outside::Low);
            assert_eq!(along, curvature::along_view(mown, mh, view, Outside::High));
        }
    }
}

/// Samples have the same bits for every stored type that holds the same integers.
#[test]
fn the_stored_type_does_not_matter() {
    use drypoint_scene::volume::VoxelType;
    let dims = [5, 6, 4];
    let base: Vec<f64> = scatter(120).iter().map(|v| (v / 2.0).floor()).collect();
    let grid = Grid::new(dims, frames()[2], DVec3::ZERO).unwrap();
    for how in all() {
        let of = |t| Volume::new(grid.clone(), Voxels::from_f64(&base, t), 2.0, 1.0).unwrap();
        let plain = of(VoxelType::F64);
        let field = Field::<f64>::new(&plain, how, Rung::Hessian).unwrap();
        for &t in VoxelType::ALL {
            let other = of(t);
            let other = Field::<f64>::new(&other, how, Rung::Hessian).unwrap();
            for p in positions(&grid, 6) {
                assert_eq!(raw(&field, p), raw(&other, p), "{how:?}, {t:?}, at {p}");
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// f32 and f64 samples agree within what f32 can: no path is taken in one and not in the other.
    #[test]
    fn f32_follows_f64(seed in 0usize..1000, kernel in 0usize..5, gradient in 0usize..4) {
        let dims = [6, 5, 4];
        let voxels = (0..120).map(|i| ((i * 7919 + seed * 31) % 251) as f64).collect();
        let v = volume(dims, voxels, 1.0, 0.0);
        let how = Reconstruction { kernel: KERNELS[kernel], gradient: GRADIENTS[gradient], ..Default::default() };
        let wide = Field::<f64>::new(&v, how, Rung::Hessian).unwrap();
        let narrow = Field::<f32>::new(&v, how, Rung::Hessian).unwrap();
        for p in positions(v.grid(), 20) {
            // One position for both, which f32 can represent.
            let q = Vec3::new(p.x as f32, p.y as f32, p.z as f32);
            let p = Vec3::new(f64::from(q.x), f64::from(q.y), f64::from(q.z));
            let (a, ga, (_, ha)) = with_sampler!(wide, |s| (s.value(p), s.gradient(p), s.hessian(p)));
            let (b, gb, (_, hb)) = with_sampler!(narrow, |s| (s.value(q), s.gradient(q), s.hessian(q)));
            // As in `reproduction`: 48 ε, times 422 where a quintic was prefiltered; gradients and Hessians are
            // below 4 in units of 2^e on this grid.
            let c = 48.0 * 422.0 * f64::from(f32::EPSILON);
            prop_assert!((a - f64::from(b)).abs() <= c * 251.0, "{how:?}: {a} {b}");
            prop_assert!((ga.to_glam() - gb.to_glam()).length() <= c * 4.0, "{how:?}: {ga:?} {gb:?}");
            for (a, b) in entries(ha).into_iter().zip(entries(hb)) {
                prop_assert!((a - f64::from(b)).abs() <= c * 4.0, "{how:?}: {ha:?} {hb:?}");
            }
        }
    }
}

/// Values computed at once equal those computed alone: for every stored type, kernel and count, up to the border and on
/// axes of length 1.
#[test]
fn values_at_once_are_the_values_alone() {
    fn check<R: Real>(volume: &Volume, how: Reconstruction) {
        let field = Field::<R>::new(volume, how, Rung::Value).unwrap();
        let [nx, ny, nz] = volume.dims().map(|n| (n - 1) as f64);
        let at = |i: usize| {
            let t = i as f64 / 9.0;
            Vec3::from_glam(DVec3::new(nx * t, ny * (1.0 - t), nz * (0.3 + 0.7 * t)))
        };
        with_sampler!(field, |s| for n in 0..=10 {
            let mut values = vec![R::ZERO; n];
            s.values(at, &mut values);
            let alone: Vec<R> = (0..n).map(|i| s.value(at(i))).collect();
            let bits = |values: Vec<R>| values.into_iter().map(|v| v.to_f64().to_bits()).collect::<Vec<u64>>();
            assert_eq!(bits(values), bits(alone), "{how:?} {n}");
        });
    }
    for dims in [[5, 4, 6], [3, 5, 1], [2, 3, 4]] {
        let values: Vec<f64> = scatter(dims.iter().product()).into_iter().map(|v| (v / 3.0).abs()).collect();
        for &to in VoxelType::ALL {
            let grid = Grid::with_spacing(dims, [1.0; 3]).unwrap();
            let volume = Volume::new(grid, Voxels::from_f64(&values, to), 0.7, 0.1).unwrap();
            for how in all().filter(|how| how.gradient == GradientEstimator::Central) {
                check::<f64>(&volume, how);
                check::<f32>(&volume, how);
            }
        }
    }
}

/// The gradient at a voxel alone is the interpolated one there, since all other corners have weight 0. Numbers whose
/// sums are rounded, the border, and an axis of length 1 are tested too.
#[test]
fn gradients_at_voxels_are_the_interpolated_ones() {
    for dims in [[5, 4, 6], [3, 5, 1], [2, 3, 4]] {
        let values: Vec<f64> = scatter(dims.iter().product()).into_iter().map(|v| v / 3.0 - 17.7).collect();
        let grid = Grid::new(dims, frames()[2], DVec3::ZERO).unwrap();
        for to in [VoxelType::F64, VoxelType::U8] {
            let v = Volume::new(grid.clone(), Voxels::from_f64(&values, to), 0.7, 0.1).unwrap();
            for how in all().filter(|how| how.hessian == HessianEstimator::Central) {
                let field = Field::<f64>::new(&v, how, Rung::Gradient).unwrap();
                for i in indices(dims) {
                    let voxel = i.to_array().map(|i| i as usize);
                    let (got, want) =
                        with_sampler!(field, |s| (s.voxel_gradient(voxel), s.gradient(Vec3::from_glam(i))));
                    assert_eq!(bits(got), bits(want), "{how:?} {to:?} at {i}");
                }
            }
        }
    }
}

/// Squares by differences of integers are those of every voxel's gradient, at the border and on short axes too, in both
/// number types; other voxels, estimators and axes of one voxel are left to others.
#[test]
fn squares_of_integers_are_those_of_their_gradients() {
    fn check<R: Real>(v: &Volume, can: bool) {
        let dims = v.dims();
        let how = Reconstruction { gradient: GradientEstimator::Central, ..Reconstruction::default() };
        let field = Field::<R>::new(v, how, Rung::Gradient).unwrap();
        for (y, z) in (0..dims[1] * dims[2]).map(|row| (row % dims[1], row / dims[1])) {
            let mut squares = vec![R::ZERO; dims[0]];
            assert_eq!(field.integer_squares([y, z], &mut squares), can, "{dims:?}");
            for x in (0..dims[0]).filter(|_| can) {
                let gradient = with_sampler!(field, |s| s.voxel_gradient([x, y, z]));
                assert_eq!(squares[x], gradient.dot(gradient), "{dims:?} at {x} {y} {z}");
            }
        }
    }
    for (dims, frame) in [([21, 4, 5], 2), ([2, 2, 2], 0), ([3, 2, 3], 1), ([9, 3, 4], 2), ([12, 1, 4], 0)] {
        let grid = Grid::new(dims, frames()[frame], DVec3::ZERO).unwrap();
        for &to in VoxelType::ALL {
            // Both ends of the type occur.
            let step = if to.bytes() == 1 { 1.5 } else { 600.0 };
            let values: Vec<f64> = scatter(dims.iter().product()).into_iter().map(|v| (v - 80.0) * step).collect();
            let v = Volume::new(grid.clone(), Voxels::from_f64(&values, to), 0.7, 0.1).unwrap();
            let can =
                !dims.contains(&1) && [VoxelType::U8, VoxelType::I8, VoxelType::U16, VoxelType::I16].contains(&to);
            check::<f64>(&v, can);
            check::<f32>(&v, can);
        }
    }
    let grid = Grid::new([12, 4, 4], frames()[0], DVec3::ZERO).unwrap();
    let v = Volume::new(grid, Voxels::U8(vec![7; 192]), 1.0, 0.0).unwrap();
    let how = Reconstruction { gradient: GradientEstimator::Sobel, ..Reconstruction::default() };
    let field = Field::<f64>::new(&v, how, Rung::Gradient).unwrap();
    assert!(!field.integer_squares([1, 1], &mut [0.0; 12]));
}

/// A row's norms side by side are those of one voxel after the other: where values change, where they do not, and where the
/// last eight overlap those before; rows at a border and short ones are left to others.
#[test]
fn norms_of_a_row_are_those_of_its_voxels() {
    for (dims, can) in [([21, 4, 5], true), ([10, 3, 3], true), ([9, 3, 3], false), ([12, 1, 4], false)] {
        let noise = scatter(dims.iter().product());
        let value = |(i, v): (usize, f64)| if i % dims[0] < dims[0] / 2 { 3.0 } else { v / 3.0 - 17.7 };
        let values: Vec<f64> = noise.into_iter().enumerate().map(value).collect();
        let grid = Grid::new(dims, frames()[2], DVec3::ZERO).unwrap();
        for to in [VoxelType::F64, VoxelType::U8] {
            let v = Volume::new(grid.clone(), Voxels::from_f64(&values, to), 0.7, 0.1).unwrap();
            for gradient in [
                GradientEstimator::Regression,
                GradientEstimator::Central,
                GradientEstimator::Sobel,
                GradientEstimator::Analytic,
            ] {
                let how = Reconstruction { gradient, ..Reconstruction::default() };
                let field = Field::<f64>::new(&v, how, Rung::Gradient).unwrap();
                for (y, z) in (0..dims[1] * dims[2]).map(|row| (row % dims[1], row / dims[1])) {
                    let mut squares = vec![0.0; dims[0]];
                    let is_inside = y > 0 && y + 1 < dims[1] && z > 0 && z + 1 < dims[2];
                    let done = field.squares_inside([y, z], &mut Vec::new(), &mut squares);
                    assert_eq!(done, can && is_inside && gradient != GradientEstimator::Analytic, "{dims:?} {y} {z}");
                    for x in (1..dims[0] - 1).filter(|_| done) {
                        let want = with_sampler!(field, |s| s.voxel_gradient([x, y, z])).length();
                        assert_eq!(squares[x].sqrt().to_bits(), want.to_bits(), "{to:?} at {x} {y} {z}");
                    }
                }
            }
        }
    }
}
