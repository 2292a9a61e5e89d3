//! The traps of empty-space skipping ([RAY-2]): steps set exactly where a kernel's values are.

use super::generator::{KERNELS, camera, dims, grid, volume};
use crate::common::Stage;
use crate::common::lattice::sighted;
use crate::common::random::Random;
use drypoint::scene::glam::DVec3;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Kernel, Length, Number, StepAlong};
use drypoint::scene::volume::{Volume, Voxels};

fn same_bits(shot: &Stage, place: &str) -> usize {
    let (with, without) = (shot.render(), shot.with(|s| s.sampling.skip_empty = false).render());
    assert_eq!(with.bits(), without.bits(), "{place}");
    with.covered()
}

/// The values of all samples, as the caster has them.
fn values(shot: &Stage) -> Vec<f64> {
    let rays = match shot.scene.sampling.number {
        Number::F64 => sighted::<f64>(shot),
        Number::F32 => sighted::<f32>(shot),
    };
    let mut values: Vec<f64> = rays.iter().flatten().filter(|s| !s.masked).map(|s| s.value).collect();
    values.sort_by(f64::total_cmp);
    values
}

/// A function that sees only the highest, only the lowest, or only one value in between of all the samples of a picture:
/// cubic kernels have the first two beyond every voxel. Whatever has that value must not be skipped.
#[test]
fn the_most_extreme_samples_are_seen() {
    let mut seen = 0;
    for seed in 0..500 {
        let r = &mut Random(seed ^ 0xabcd);
        let dims = dims(r);
        let grid = grid(r, dims);
        let volume = volume(r, grid.clone());
        let shot = Stage::regular(volume, &[(0.0, [1.0; 3], 1.0)]).with(|s| {
            s.camera = camera(r, &grid);
            s.picture.size = [8, 8];
            s.sampling.kernel = r.pick(&KERNELS);
            s.sampling.number = r.pick(&[Number::F64, Number::F32]);
            s.sampling.step = Length::Voxels(r.pick(&[0.25, 0.5, 1.0]));
            s.sampling.step_along = r.pick(&[StepAlong::Plane, StepAlong::Ray]);
        });
        let values = values(&shot);
        let (Some(&lowest), Some(&highest)) = (values.first(), values.last()) else { continue };
        let some = values[r.below(values.len())];
        let narrow = shot.scene.sampling.number == Number::F32;
        let above = |at: f64| if narrow { f64::from((at as f32).next_up()) } else { at.next_up() };
        let below = |at: f64| if narrow { f64::from((at as f32).next_down()) } else { at.next_down() };
        let from = |at: f64| vec![(at, 0.0), (at, 0.5)];
        let upto = |at: f64| vec![(at, 0.5), (above(at), 0.0)];
        let only = |at: f64| vec![(below(at), 0.0), (at, 0.0), (at, 0.5), (above(at), 0.0)];
        let functions = [from(highest), upto(lowest), from(some), upto(some), only(some), only(highest), only(lowest)];
        for (i, nodes) in functions.into_iter().enumerate() {
            let nodes: Vec<_> = nodes.into_iter().map(|(at, opacity)| (at, [1.0; 3], opacity)).collect();
            let function = Stage::regular(shot.volume.clone(), &nodes).scene.transfer;
            let with = shot.with(|s| s.transfer = function);
            let covered = same_bits(&with, &format!("seed {seed}, function {i}: {:?}", with.scene));
            assert!(covered > 0, "seed {seed}, function {i}: a sample has the value, and none is seen");
            seen += covered;
        }
    }
    assert!(seen > 1000);
}

/// Catmull–Rom leaves its voxels farthest in the middle of a cell whose 4³ voxels have the signs of their weights: 1.25³ of
/// them. A function that sees no less sees that one sample.
#[test]
fn the_farthest_overshoot() {
    let sign = |i: f64| if (i - 7.5).abs() < 1.0 { 1.0 } else { -1.0 };
    let volume = crate::common::volume([16; 3], |p| {
        let near = (p - DVec3::splat(7.5)).abs().max_element() < 2.0;
        if near { sign(p.x) * sign(p.y) * sign(p.z) } else { 0.0 }
    });
    for at in [1.953_125, 1.953] {
        let shot = Stage::regular(volume.clone(), &[(at, [1.0; 3], 0.0), (at, [1.0; 3], 0.5)]).with(|s| {
            s.sampling.kernel = Kernel::CatmullRom;
            // The middle ray of one pixel, with a plane through the middle.
            s.picture.size = [1, 1];
            s.sampling.step = Length::World(0.5);
            s.camera.eye = Some(DVec3::new(7.5, 7.25, 7.5));
            s.camera.direction_given = true;
        });
        assert_eq!(same_bits(&shot, "overshoot"), 1, "{at}");
    }
}

/// A node that f32 rounds down to a value that bricks reach: in f32 the value is visible, while the node as the scene
/// has it lies above every brick.
#[test]
fn nodes_are_rounded_as_samples_see_them() {
    let grid = Grid::with_spacing([20, 20, 20], [1.0; 3]).unwrap();
    // 1000 + 0.001 · 100 is 1000.1, which is 1000.0999756 in f32: an ulp there is 6·10⁻⁵, far more than bricks are
    // widened in stored units.
    let stored = (0..8000).map(|i| if i % 20 < 10 { 0 } else { 100 }).collect();
    let volume = Volume::new(grid, Voxels::U8(stored), 0.001, 1000.0).unwrap();
    let node = 1000.1;
    let shot = Stage::regular(volume, &[(node, [1.0; 3], 0.0), (node, [1.0; 3], 0.5)])
        .with(|s| s.sampling.number = Number::F32);
    assert!(f64::from(1000.1f32) < node);
    assert!(same_bits(&shot, "f32 nodes") > 0);
}

/// Constants on a node's value, on both sides of a step, for every kernel: all or nothing, skipped or not.
#[test]
fn constants_on_a_node() {
    for kernel in KERNELS {
        for number in [Number::F64, Number::F32] {
            for value in [0.0, 7.0, -1000.25] {
                for dims in [[1, 1, 1], [1, 9, 1], [2, 2, 2], [17, 9, 10]] {
                    let flat = crate::common::volume(dims, |_| value);
                    for (before, after) in [(0.0, 0.5), (0.5, 0.0), (0.0, 0.0)] {
                        let nodes = [(value, [1.0; 3], before), (value, [1.0; 3], after)];
                        let shot = Stage::regular(flat.clone(), &nodes).with(|s| {
                            (s.sampling.kernel, s.sampling.number) = (kernel, number);
                        });
                        let covered = same_bits(&shot, &format!("{kernel:?} {value} {dims:?}"));
                        assert_eq!(covered > 0, after > 0.0, "{kernel:?} {number:?} {value} {dims:?}");
                    }
                }
            }
        }
    }
}

/// Only far bricks are visible, few of them, seen from afar and from between: κ along the ray looks back across skipped
/// bricks, and into masked ones.
#[test]
fn looking_back_across_skipped_bricks() {
    use crate::common::{plain, style};
    use drypoint::scene::tables::{Contours, Kappa};
    for seed in 0..40 {
        let r = &mut Random(seed ^ 0x77);
        let grid = grid(r, [27, 19, 26]);
        let spikes: Vec<usize> = (0..5).map(|_| r.below(grid.len())).collect();
        let mut voxels: Vec<f64> = (0..grid.len()).map(|_| r.unit()).collect();
        spikes.iter().for_each(|&i| voxels[i] = 9.0);
        if r.once_in(2) {
            spikes.iter().for_each(|&i| voxels[(i + 3) % grid.len()] = f64::NAN);
        }
        let volume = Volume::new(grid.clone(), Voxels::F64(voxels), 1.0, 0.0).unwrap();
        let styles = vec![plain("a", [0.2, 0.4, 0.6, 0.9]), style("b", 8, |x, y| [x.abs(), y.abs(), 0.5, 1.0])];
        let shot = Stage::styled(volume, styles, &[(1.5, "a", 0.0), (4.0, "b", 0.4)]).with(|s| {
            s.camera = camera(r, &grid);
            s.sampling.kernel = r.pick(&KERNELS);
            s.sampling.step = Length::Voxels(r.pick(&[0.3, 1.0, 4.0]));
            s.contours = Some(Contours { kappa: Kappa::Ray, ..Contours::default() });
        });
        let shot = shot.layers(&crate::common::LAYERS);
        same_bits(&shot, &format!("seed {seed}: {:?}", shot.scene));
    }
}

/// Pictures of a few thousandths of a voxel down to what rounding leaves, and eyes very far away, aimed at the corners of
/// bricks: neighbouring rays are nearly one, and what bounds them together must not cut off what each of them sees.
#[test]
fn close_ups_and_far_eyes() {
    for seed in 0..200 {
        let r = &mut Random(seed ^ 0x2001);
        let grid = Grid::with_spacing([23, 19, 21], [1.0; 3]).unwrap();
        // Seen are a few voxels, not their neighbours.
        let voxels: Vec<f64> = (0..grid.len()).map(|_| if r.once_in(60) { 1.0 } else { 0.0 }).collect();
        let volume = Volume::new(grid.clone(), Voxels::F64(voxels), 1.0, 0.0).unwrap();
        let shot = Stage::regular(volume, &[(0.4, [1.0; 3], 0.0), (1.0, [0.5; 3], 0.5)]).with(|s| {
            s.sampling.number = r.pick(&[Number::F64, Number::F64, Number::F32]);
            s.picture.size = [20, 18];
            let direction = DVec3::from_array(r.direction()).normalize();
            let corner = DVec3::from_array([0.0; 3].map(|_| 4.0 * (1 + r.below(4)) as f64));
            let away = 10f64.powf(r.between(0.0, 6.0));
            // The picture's height at the corner, in voxels.
            let height = 10f64.powf(r.between(-9.0, 0.5));
            s.camera = if r.once_in(2) {
                crate::common::orthographic(Some(height))
            } else {
                crate::common::perspective((2.0 * (height / 2.0 / away).atan()).to_degrees())
            };
            s.camera.eye = Some(corner - direction * away);
            s.camera.direction = direction;
            s.camera.direction_given = true;
        });
        same_bits(&shot, &format!("seed {seed}: {:?} {:?}", shot.scene.camera, shot.scene.sampling.number));
    }
}
