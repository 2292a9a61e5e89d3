//! What |g| = 1 stands for ([VAL-2]).

use crate::field::Sampler;
use crate::number::{Real, Vec3};
use drypoint_scene::volume::histogram::quantile;
use drypoint_scene::volume::{Mask, Volume};
use rayon::prelude::*;

/// The quantile q of ‖g‖ over the voxels where it exceeds [PREC-3]'s bound, times the power of two of [SPACE-4], and
/// the number of voxels that were evaluated. 0 where no voxel has a normal.
pub(super) fn quantile_of_norms<R: Real, S: Sampler<R>>(
    sampler: &S,
    volume: &Volume,
    no_normal_below: R,
    q: f64,
) -> (f64, u64) {
    let [nx, ny, nz] = volume.dims();
    let at = |i: usize| R::from_f64(i as f64);
    let norms: Vec<Vec<f64>> = (0..nz)
        .into_par_iter()
        .map(|z| {
            let mut row = Vec::new();
            for y in 0..ny {
                for x in 0..nx {
                    if volume.mask().is_some_and(|m| stencil_is_masked(m, volume.dims(), [x, y, z])) {
                        continue;
                    }
                    let norm = sampler.gradient(Vec3::new(at(x), at(y), at(z))).length();
                    if norm > no_normal_below {
                        row.push(norm.to_f64());
                    }
                }
            }
            row
        })
        .collect();
    let mut norms = norms.concat();
    (quantile(&mut norms, q).unwrap_or(0.0), (nx * ny * nz) as u64)
}

/// Whether one of the voxels that a gradient at a voxel reads is masked: its 26 neighbours and itself.
fn stencil_is_masked(mask: &Mask, dims: [usize; 3], voxel: [usize; 3]) -> bool {
    let range = |a: usize| voxel[a].saturating_sub(1)..=(voxel[a] + 1).min(dims[a] - 1);
    range(2).any(|z| range(1).any(|y| range(0).any(|x| mask.voxel([x, y, z]))))
}
