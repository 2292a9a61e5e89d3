//! Where fields are sampled and where they are asked.

use drypoint::reference::field::probe::{Probe, at_index};
use drypoint::reference::field::{Field, Reconstruction, Rung};
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::math::{cos, sin};
use drypoint::scene::phantom::{self, Phantom};
use drypoint::scene::space::Grid;
use drypoint::scene::volume::{Volume, VoxelType};

/// Point n of an even scatter over the unit cube: the additive recurrence of the root of x⁴ = x + 1.
pub(crate) fn scattered(n: usize) -> DVec3 {
    let step = DVec3::new(0.819_172_513_396_164_5, 0.671_043_606_703_789_3, 0.549_700_477_901_970_3);
    (DVec3::splat(0.5) + step * n as f64).fract()
}

/// Unit vectors spread evenly over the sphere, along a spiral.
pub(crate) fn directions(count: usize) -> impl Iterator<Item = DVec3> {
    (0..count).map(move |i| {
        let z = 1.0 - (2 * i + 1) as f64 / count as f64;
        let (r, angle) = ((1.0 - z * z).sqrt(), 2.399_963_229_728_653 * i as f64);
        DVec3::new(r * cos(angle), r * sin(angle), z)
    })
}

/// A field on `side`³ voxels with their middle at a point of the world: what a reconstruction there knows of a volume
/// of any size, as long as the border is far.
pub(crate) fn around(field: &dyn Phantom, p: DVec3, axes: DMat3, side: usize) -> Result<Volume, String> {
    let middle = DVec3::splat((side - 1) as f64 / 2.0);
    let grid = Grid::new([side; 3], axes, p - axes * middle).map_err(|e| e.to_string())?;
    phantom::sample(field, grid, VoxelType::F64).map_err(|e| e.to_string())
}

/// What a reconstruction says at positions in index space.
pub(crate) fn probed(volume: &Volume, how: Reconstruction, at: &[DVec3]) -> Result<Vec<Probe>, String> {
    let field = Field::<f64>::new(volume, how, Rung::Hessian).map_err(|e| e.to_string())?;
    at.iter().map(|&p| at_index(&field, p, None).ok_or_else(|| format!("{p} lies outside"))).collect()
}

/// How far two curvatures are off, the worse of both.
pub(crate) fn curvature_error(probe: &Probe, [k1, k2]: [f64; 2]) -> f64 {
    (probe.k1 - k1).abs().max((probe.k2 - k2).abs())
}
