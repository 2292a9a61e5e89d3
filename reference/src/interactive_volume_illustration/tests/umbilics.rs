//! Places on sampled surfaces with principal directions, and the accuracy of these ([HATCH-3]).

use super::super::{DirectionCounts, DirectionEstimator, PrincipalDirections, Pyramid, Thresholds, deviation};
use super::*;
use crate::field::{Field, Outside, Reconstruction, Rung};
use crate::number::Vec3;
use drypoint_scene::philox::uniforms;
use drypoint_scene::volume::Voxels;

/// Voxels with a neighbour along an axis on the other side of a value, up to the border.
fn iso_voxels(volume: &Volume, iso: f64) -> Vec<[usize; 3]> {
    let [nx, ny, nz] = volume.dims();
    let all = (0..nz).flat_map(|z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])));
    let crosses = |&at: &[usize; 3]| {
        let above = |at: [usize; 3]| volume.value(at) > iso;
        (0..3).any(|a| {
            let beside = |i: usize| {
                let mut to = at;
                to[a] = i;
                above(to) != above(at)
            };
            at[a] > 0 && beside(at[a] - 1) || at[a] + 1 < volume.dims()[a] && beside(at[a] + 1)
        })
    };
    all.filter(crosses).collect()
}

/// The rule's constants, with the noise of the values as measured on the surface. Scenes use these.
fn measured(volume: &Volume) -> Thresholds {
    let deviation = deviation(volume, &Pyramid::new(volume), 127.5, Outside::Low);
    Thresholds { deviation, ..Thresholds::default() }
}

/// The share of the iso-voxels at least `margin` voxels from the border with a direction that `right` accepts.
fn share(volume: &Volume, margin: usize, right: impl Fn(DVec3) -> bool) -> f64 {
    share_by(measured(volume), volume, margin, right)
}

/// Like [`share`], with other constants.
fn share_by(thresholds: Thresholds, volume: &Volume, margin: usize, right: impl Fn(DVec3) -> bool) -> f64 {
    let field = Field::<f64>::new(volume, Reconstruction::default(), Rung::Gradient).unwrap();
    let directions = PrincipalDirections::new(&field, DirectionEstimator::Scaled(thresholds));
    let dims = volume.dims();
    let inner = |v: &[usize; 3]| (0..3).all(|a| v[a] >= margin && v[a] + margin < dims[a]);
    let voxels: Vec<_> = iso_voxels(volume, 127.5).into_iter().filter(inner).collect();
    let mut counts = DirectionCounts::default();
    let mut hits = 0;
    for voxel in &voxels {
        let at = Vec3::new(voxel[0] as f64, voxel[1] as f64, voxel[2] as f64);
        hits += usize::from(directions.at(&field, at, &mut counts).is_ok_and(|c| right(c.e2.to_glam())));
    }
    let refused = counts.umbilic[2] + counts.noise[2] + counts.disagree[2] + counts.border[2];
    assert_eq!(counts.directions() + refused, voxels.len() as u64);
    hits as f64 / voxels.len() as f64
}

/// Distance from the border, in voxels, at which every scale decides: 2σ of the largest.
const DECIDED: usize = 8;

/// Widths of the logistic edges, in voxels.
const EDGES: [f64; 3] = [1.0, 2.0, 4.0];

/// Spheres have no directions up to the border, which lies far away, is near, touches the sphere or cuts it.
#[test]
fn spheres_have_none() {
    for voxels in [VoxelType::F64, VoxelType::U8] {
        for (radius, edge) in [10.3, 14.3, 30.3].into_iter().flat_map(|r| EDGES.map(|e| (r, e))) {
            // A large sphere is tested at two distances only, since its 10⁴ voxels take long.
            let rooms: &[f64] = if radius > 20.0 { &[3.2, 12.7] } else { &[-4.0, -0.5, 0.5, 1.7, 3.2, 5.2, 8.2, 12.7] };
            for room in rooms {
                let n = (2.0 * (radius + room) + 1.0).round() as usize;
                let volume = sampled("sphere", cube(n), voxels, &[("R", radius), ("w", edge), ("high", 255.0)]);
                let share = share(&volume, 0, |_| true);
                assert!(share <= 0.01, "{voxels:?} {radius} {edge} {room}: {share}");
            }
        }
    }
}

/// The volume with the values beyond a plane masked out.
fn cut(volume: &Volume, normal: DVec3) -> Volume {
    let grid = volume.grid();
    let [nx, ny, nz] = volume.dims();
    let values = (0..nx * ny * nz).map(|i| {
        let voxel = [i % nx, i / nx % ny, i / (nx * ny)];
        let from = grid.to_world(DVec3::from_array(voxel.map(|i| i as f64))) - grid.centre();
        if from.dot(normal) > 1.0 { f64::NAN } else { volume.value(voxel) }
    });
    Volume::new(grid.clone(), Voxels::F64(values.collect()), 1.0, 0.0).unwrap()
}

/// Spheres have no directions where masked voxels cut them, although these are filled with their neighbours' values.
#[test]
fn spheres_that_a_mask_cuts_have_none() {
    for (radius, edge) in [10.3f64, 14.3].into_iter().flat_map(|r| EDGES.map(|e| (r, e))) {
        let n = (2.0 * (radius + 8.2) + 1.0).round() as usize;
        let whole = sampled("sphere", cube(n), VoxelType::F64, &[("R", radius), ("w", edge), ("high", 255.0)]);
        for normal in [DVec3::Z, DVec3::new(0.36, -0.48, 0.8)] {
            let share = share(&cut(&whole, normal), 0, |_| true);
            assert!(share <= 0.01, "{radius} {edge} {normal}: {share}");
        }
    }
}

/// A cylinder loses three voxels along the mask if σ = 1 decides. Its remaining rulings are correct.
#[test]
fn cylinders_that_a_mask_cuts_have_their_rulings() {
    let axis = DVec3::new(0.3, -0.5, 0.8).normalize();
    let params = [("R", 10.0), ("ax", axis.x), ("ay", axis.y), ("az", axis.z), ("w", 2.0), ("high", 255.0)];
    let volume = cut(&sampled("cylinder", cube(40), VoxelType::F64, &params), DVec3::X);
    let field = Field::<f64>::new(&volume, Reconstruction::default(), Rung::Gradient).unwrap();
    let directions = PrincipalDirections::new(&field, DirectionEstimator::Scaled(measured(&volume)));
    let (mut all, mut right, mut decided) = (0, 0, [0; 2]);
    for voxel in iso_voxels(&volume, 127.5) {
        let at = Vec3::new(voxel[0] as f64, voxel[1] as f64, voxel[2] as f64);
        let found = directions.at(&field, at, &mut DirectionCounts::default()).ok();
        let off = |e: DVec3| e.cross(axis).length().asin().to_degrees();
        if let Some(off) = found.map(|c| off(c.e2.to_glam())) {
            assert!(off < 2.0, "{voxel:?}: {off}");
            all += 1;
            right += usize::from(off <= 1.0);
        }
        // The mask begins at x = 21.
        if voxel.iter().enumerate().all(|(a, &i)| i >= 2 && i <= if a == 0 { 17 } else { 37 }) {
            decided[usize::from(found.is_some())] += 1;
        }
    }
    let [missing, there] = decided;
    assert!(there > 500 && missing * 100 <= there, "{decided:?}");
    assert!(right * 100 >= all * 99, "{right} of {all}");
}

#[test]
fn oblique_planes_of_eight_bits_have_none() {
    for ([nx, ny, nz], edge) in [[0.36, 0.48, 0.8], [1.0, 2.0, 3.0]].into_iter().flat_map(|n| EDGES.map(|e| (n, e))) {
        let params = [("nx", nx), ("ny", ny), ("nz", nz), ("w", edge), ("high", 255.0)];
        let share = share(&sampled("plane", cube(56), VoxelType::U8, &params), 0, |_| true);
        assert!(share <= 0.01, "{nx} {edge}: {share}");
    }
}

/// A cylinder loses only 2σ at the border for the σ that decides: two voxels for σ = 1.
#[test]
fn cylinders_have_their_rulings_up_to_the_border() {
    let axis = DVec3::new(0.3, -0.5, 0.8).normalize();
    for radius in [6.0, 12.0] {
        let params = [("R", radius), ("ax", axis.x), ("ay", axis.y), ("az", axis.z), ("w", 2.0), ("high", 255.0)];
        let volume = sampled("cylinder", cube(40), VoxelType::F64, &params);
        let right = |e: DVec3| e.cross(axis).length() <= f64::to_radians(1.0).sin();
        let share = share(&volume, 2, right);
        assert!(share >= 0.99, "{radius}: {share}");
    }
}

/// Rulings are within 1°, or 5° with eight bits. For an edge width of 1 voxel the bound is 2°. Central differences
/// leave out third derivatives there. These turn the gradient by F‴/(6F′), some 0.08, times the tangential part of
/// (n₀³, n₁³, n₂³), and the tangent plane with it.
#[test]
fn oblique_cylinders_have_their_rulings() {
    let axis = DVec3::new(0.3, -0.5, 0.8).normalize();
    for voxels in [VoxelType::F64, VoxelType::U8] {
        for (radius, edge) in [10.0, 30.0].into_iter().flat_map(|r| EDGES.map(|e| (r, e))) {
            let degrees = match voxels {
                VoxelType::U8 => 5.0,
                _ if edge == 1.0 => 2.0,
                _ => 1.0,
            };
            let n = (2.0 * radius + 34.0) as usize;
            let params = [("R", radius), ("ax", axis.x), ("ay", axis.y), ("az", axis.z), ("w", edge), ("high", 255.0)];
            let volume = sampled("cylinder", cube(n), voxels, &params);
            let share = share(&volume, DECIDED, |e| e.cross(axis).length() <= f64::to_radians(degrees).sin());
            assert!(share >= 0.99, "{voxels:?} {radius} {edge}: {share}");
        }
    }
}

/// A volume with a scanner's noise of standard deviation 8, stored as bytes: twenty-eight times their rounding.
fn noisy(phantom: &Volume) -> Volume {
    let [nx, ny, _] = phantom.dims();
    let voxels = (0..phantom.grid().len()).map(|i| {
        let [a, b, ..] = uniforms(11, [i as u32, 0, 0], 0);
        let normal = (-2.0 * (1.0 - a).ln()).sqrt() * (std::f64::consts::TAU * b).cos();
        // The values are far from both ends, so that none is clipped.
        (64.0 + 0.5 * phantom.value([i % nx, i / nx % ny, i / nx / ny]) + 4.0 * normal).round() as u8
    });
    Volume::new(phantom.grid().clone(), Voxels::U8(voxels.collect()), 2.0, -128.0).unwrap()
}

/// A rule that knows rounding alone gives directions on noisy spheres; with the measured noise there are none.
#[test]
fn noise_makes_no_directions_where_it_is_measured() {
    for radius in [14.3_f64, 30.3] {
        let n = (2.0 * (radius + 6.0) + 1.0).round() as usize;
        let phantom = sampled("sphere", cube(n), VoxelType::F64, &[("R", radius), ("w", 2.0), ("high", 255.0)]);
        let volume = noisy(&phantom);
        let (with, without) = (share(&volume, 0, |_| true), share_by(Thresholds::default(), &volume, 0, |_| true));
        println!("a noisy sphere of {radius}: {with} with, {without} without");
        assert!(with <= 0.01 && without > 0.1, "{radius}: {with} {without}");
    }
}

/// On a noisy cylinder a larger scale gives the directions. At least three quarters of the surface have one, and it
/// is correct.
#[test]
fn noise_leaves_what_is_sure() {
    let axis = DVec3::new(0.3, -0.5, 0.8).normalize();
    let params = [("R", 10.0), ("ax", axis.x), ("ay", axis.y), ("az", axis.z), ("w", 2.0), ("high", 255.0)];
    let volume = noisy(&sampled("cylinder", cube(54), VoxelType::F64, &params));
    let (any, right) = (
        share(&volume, DECIDED, |_| true),
        share(&volume, DECIDED, |e| e.cross(axis).length() <= f64::to_radians(15.0).sin()),
    );
    println!("a noisy cylinder: {any} have a direction, {right} a right one");
    assert!(any > 0.75 && right > 0.99 * any, "{any} {right}");
}
