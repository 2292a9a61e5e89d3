//! Where sampled surfaces have directions, and how good they are ([HATCH-3]).

use super::super::{Directions, Rule, Scales, Thresholds};
use super::*;
use crate::field::{Field, Reconstruction, Rung};
use crate::number::Vec3;

/// Voxels with a neighbour along an axis on the other side of a value.
fn iso_voxels(volume: &Volume, iso: f64) -> Vec<[usize; 3]> {
    let [nx, ny, nz] = volume.dims();
    let inner = (1..nz - 1).flat_map(|z| (1..ny - 1).flat_map(move |y| (1..nx - 1).map(move |x| [x, y, z])));
    let crosses = |&[x, y, z]: &[usize; 3]| {
        let above = |at: [usize; 3]| volume.value(at) > iso;
        let here = above([x, y, z]);
        let around = [[x - 1, y, z], [x + 1, y, z], [x, y - 1, z], [x, y + 1, z], [x, y, z - 1], [x, y, z + 1]];
        around.into_iter().any(|at| above(at) != here)
    };
    inner.filter(crosses).collect()
}

/// Voxels that are left out at the border: directions there are of samples that were continued.
const MARGIN: usize = 10;

/// The share of the iso-voxels away from the border with a direction that `right` accepts.
fn share(volume: &Volume, right: impl Fn(DVec3) -> bool) -> f64 {
    let field = Field::<f64>::new(volume, Reconstruction::default(), Rung::Gradient).unwrap();
    let directions = Directions::new(&field, Rule::Scaled(Thresholds::default()));
    let dims = volume.dims();
    let inner = |v: &[usize; 3]| (0..3).all(|a| v[a] >= MARGIN && v[a] + MARGIN < dims[a]);
    let voxels: Vec<_> = iso_voxels(volume, 127.5).into_iter().filter(inner).collect();
    let mut counts = Scales::default();
    let mut hits = 0;
    for voxel in &voxels {
        let at = Vec3::new(voxel[0] as f64, voxel[1] as f64, voxel[2] as f64);
        hits += usize::from(directions.at(&field, at, &mut counts).is_ok_and(|c| right(c.e2.to_glam())));
    }
    assert_eq!(counts.directions() + counts.umbilic[2] + counts.noise[2] + counts.disagree[2], voxels.len() as u64);
    hits as f64 / voxels.len() as f64
}

/// Widths of the logistic edges, in voxels.
const EDGES: [f64; 3] = [1.0, 2.0, 4.0];

#[test]
fn spheres_have_none() {
    for voxels in [VoxelType::F64, VoxelType::U8] {
        for (radius, edge) in [10.0, 30.0].into_iter().flat_map(|r| EDGES.map(|e| (r, e))) {
            let n = (2.0 * radius + 26.0) as usize;
            let volume = sampled("sphere", cube(n), voxels, &[("R", radius + 0.3), ("w", edge), ("high", 255.0)]);
            let share = share(&volume, |_| true);
            assert!(share <= 0.01, "{voxels:?} {radius} {edge}: {share}");
        }
    }
}

#[test]
fn oblique_planes_of_eight_bits_have_none() {
    for ([nx, ny, nz], edge) in [[0.36, 0.48, 0.8], [1.0, 2.0, 3.0]].into_iter().flat_map(|n| EDGES.map(|e| (n, e))) {
        let params = [("nx", nx), ("ny", ny), ("nz", nz), ("w", edge), ("high", 255.0)];
        let share = share(&sampled("plane", cube(56), VoxelType::U8, &params), |_| true);
        assert!(share <= 0.01, "{nx} {edge}: {share}");
    }
}

/// Within 1°, with eight bits 5°. At an edge of 1 voxel, 2°: there the third derivatives that central differences leave out
/// turn the gradient by F‴/(6F′), some 0.08, times the tangent part of (n₀³, n₁³, n₂³), and the tangent plane with it.
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
            let share = share(&volume, |e| e.cross(axis).length() <= f64::to_radians(degrees).sin());
            assert!(share >= 0.99, "{voxels:?} {radius} {edge}: {share}");
        }
    }
}
