//! Laws of the field: what every reconstruction must do, whatever its formulas.

mod bits;
mod bricks;
mod closed_forms;
mod reproduction;

use super::{Field, GradientEstimator, HessianEstimator, Kernel, Outside, Reconstruction, Rung, Sampler};
use crate::number::{Real, Sym3, Vec3};
use crate::with_sampler;
use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::space::Grid;
use drypoint_scene::volume::{Volume, Voxels};

const KERNELS: [Kernel; 5] =
    [Kernel::Trilinear, Kernel::Bspline, Kernel::BsplineSmooth, Kernel::Bspline5, Kernel::CatmullRom];

const GRADIENTS: [GradientEstimator; 4] =
    [GradientEstimator::Central, GradientEstimator::Analytic, GradientEstimator::Sobel, GradientEstimator::Regression];

const HESSIANS: [HessianEstimator; 3] =
    [HessianEstimator::Analytic, HessianEstimator::Central, HessianEstimator::Gaussian];

/// Every reconstruction there is.
fn all() -> impl Iterator<Item = Reconstruction> {
    let smooth = |k, h| h != HessianEstimator::Analytic || !matches!(k, Kernel::Trilinear | Kernel::CatmullRom);
    KERNELS.into_iter().flat_map(move |kernel| {
        GRADIENTS.into_iter().flat_map(move |gradient| {
            HESSIANS.into_iter().filter(move |&h| smooth(kernel, h)).map(move |hessian| Reconstruction {
                kernel,
                gradient,
                hessian,
                ..Default::default()
            })
        })
    })
}

/// Isotropic, 1:1:4 and sheared: D in dyadic numbers, so that voxels have exact world positions.
fn frames() -> [DMat3; 3] {
    [
        DMat3::IDENTITY,
        DMat3::from_diagonal(DVec3::new(0.5, 0.5, 2.0)),
        DMat3::from_cols(DVec3::new(1.0, 0.25, 0.0), DVec3::new(-0.5, 1.5, 0.5), DVec3::new(0.25, 0.0, 2.0)),
    ]
}

/// A volume of f64 that samples a function of world space.
fn sampled(dims: [usize; 3], axes: DMat3, f: impl Fn(DVec3) -> f64) -> Volume {
    let grid = Grid::new(dims, axes, DVec3::new(-1.0, 2.0, 0.5)).unwrap();
    let voxels = indices(dims).map(|i| f(grid.to_world(i))).collect();
    Volume::new(grid, Voxels::F64(voxels), 1.0, 0.0).unwrap()
}

/// The voxels of a grid, x fastest.
fn indices([nx, ny, nz]: [usize; 3]) -> impl Iterator<Item = DVec3> {
    (0..nx * ny * nz).map(move |i| DVec3::new((i % nx) as f64, (i / nx % ny) as f64, (i / (nx * ny)) as f64))
}

/// Positions in the box of a grid: on its border, on voxels and between them, from a fixed scatter.
fn positions(grid: &Grid, count: usize) -> Vec<DVec3> {
    let [lo, hi] = grid.index_box();
    let mut state = 0x9e37_79b9_7f4a_7c15_u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 40) as f64 / (1u64 << 24) as f64
    };
    let mut coordinate = |lo: f64, hi: f64| match (next() * 8.0) as u32 {
        0 => lo,
        1 => hi,
        2 => (lo + next() * (hi - lo)).floor().max(lo),
        _ => lo + next() * (hi - lo),
    };
    (0..count).map(|_| DVec3::new(coordinate(lo.x, hi.x), coordinate(lo.y, hi.y), coordinate(lo.z, hi.z))).collect()
}

/// The spectral norm of D⁻¹: one over the voxel of [PREC-3].
fn inverse_norm(grid: &Grid) -> f64 {
    1.0 / grid.smallest_singular_value()
}

/// Six entries as an array: xx, xy, xz, yy, yz, zz.
fn entries<R: Real>(h: Sym3<R>) -> [R; 6] {
    [h.xx, h.xy, h.xz, h.yy, h.yz, h.zz]
}

fn bits(v: Vec3<f64>) -> [u64; 3] {
    // −0 and 0 are one number here.
    [v.x, v.y, v.z].map(|x| (x + 0.0).to_bits())
}
