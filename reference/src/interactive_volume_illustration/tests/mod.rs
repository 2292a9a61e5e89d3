//! Strokes on surfaces whose lines of curvature are known.

mod closed_forms;
mod sampled;
mod stored;
mod umbilics;

use super::{HatchCounts, Seed, StrokeField, StrokeGrower};
use crate::field::Outside;
use crate::number::{Sym3, Vec3};
use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::phantom::{self, Phantom};
use drypoint_scene::space::Grid;
use drypoint_scene::volume::{Volume, VoxelType};

/// A formula with its gradient and Hessian, bright inside.
struct Formula<F> {
    grid: Grid,
    range: [f64; 2],
    at: F,
}

impl<F: Fn(DVec3) -> (f64, DVec3, DMat3) + Sync> Formula<F> {
    fn world(&self, index: Vec3<f64>) -> DVec3 {
        self.grid.to_world(index.to_glam())
    }
}

impl<F: Fn(DVec3) -> (f64, DVec3, DMat3) + Sync> StrokeField for Formula<F> {
    fn grid(&self) -> &Grid {
        &self.grid
    }

    fn outside(&self) -> Outside {
        Outside::Low
    }

    fn range(&self) -> [f64; 2] {
        self.range
    }

    fn exponent(&self) -> i32 {
        0
    }

    fn no_normal_below(&self) -> f64 {
        1e-12
    }

    fn masked(&self, _: [usize; 3]) -> bool {
        false
    }

    fn cell(&self, index: Vec3<f64>) -> [usize; 3] {
        let dims = self.grid.dims();
        let [x, y, z] = index.to_glam().to_array();
        [(x, 0), (y, 1), (z, 2)].map(|(c, a)| (c as usize).min(dims[a] - 2))
    }

    fn value(&self, index: Vec3<f64>) -> f64 {
        (self.at)(self.world(index)).0
    }

    fn gradient(&self, index: Vec3<f64>) -> Vec3<f64> {
        Vec3::from_glam((self.at)(self.world(index)).1)
    }

    fn second(&self, index: Vec3<f64>) -> (Vec3<f64>, Sym3<f64>) {
        let (_, g, h) = (self.at)(self.world(index));
        let [x, y, z] = [h.x_axis, h.y_axis, h.z_axis];
        (Vec3::from_glam(g), Sym3 { xx: x.x, xy: x.y, xz: x.z, yy: y.y, yz: y.z, zz: z.z })
    }
}

fn cube(n: usize) -> Grid {
    Grid::with_spacing([n; 3], [1.0; 3]).unwrap()
}

/// A phantom's formula, without voxels.
fn exact(
    name: &str,
    grid: Grid,
    params: &[(&str, f64)],
) -> Formula<impl Fn(DVec3) -> (f64, DVec3, DMat3) + Sync + use<>> {
    let phantom = made(name, &grid, VoxelType::F64, params);
    let size = grid.radius();
    let at = move |x: DVec3| {
        let jet = phantom.jet(x);
        (phantom.value(x), jet.gradient, jet.hessian)
    };
    Formula { grid, range: [-size, size], at }
}

fn made(name: &str, grid: &Grid, voxels: VoxelType, params: &[(&str, f64)]) -> Box<dyn Phantom> {
    let params: Vec<(String, f64)> = params.iter().map(|(name, value)| ((*name).to_owned(), *value)).collect();
    phantom::for_type(name, grid, voxels, &params).unwrap()
}

fn sampled(name: &str, grid: Grid, voxels: VoxelType, params: &[(&str, f64)]) -> Volume {
    phantom::sample(made(name, &grid, voxels, params).as_ref(), grid, voxels).unwrap()
}

/// The seed of the stroke through a place, which stays at the place's own value.
fn seed_at(strokes: &StrokeGrower<'_, '_>, world: DVec3) -> Seed {
    let target = strokes.ground().value(Vec3::from_glam(strokes.ground().grid().to_index(world)));
    strokes.seed([0; 3], world, target, &mut HatchCounts::default()).unwrap()
}

/// Cells whose corners have values on both sides of a value.
fn active(volume: &Volume, iso: f64) -> Vec<[usize; 3]> {
    let [nx, ny, nz] = volume.dims();
    let cells = (0..nz - 1).flat_map(|z| (0..ny - 1).flat_map(move |y| (0..nx - 1).map(move |x| [x, y, z])));
    let crossed = |&[x, y, z]: &[usize; 3]| {
        let corners = [0, 1, 2, 3, 4, 5, 6, 7].map(|i| volume.value([x + (i & 1), y + (i >> 1 & 1), z + (i >> 2)]));
        corners.iter().any(|&c| c >= iso) && corners.iter().any(|&c| c <= iso)
    };
    cells.filter(crossed).collect()
}
