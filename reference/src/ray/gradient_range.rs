//! What |g| = 1 stands for ([VAL-2]).

use crate::field::{GradientEstimator, Sampler};
use crate::number::{Real, Vec3};
use drypoint_scene::volume::histogram::quantile;
use drypoint_scene::volume::{Mask, Volume};
use rayon::prelude::*;
use std::ops::RangeInclusive;

/// The quantile q of ‖g‖ over the voxels where it exceeds [PREC-3]'s bound, times the power of two of [SPACE-4], and
/// the number of voxels that were evaluated. 0 where no voxel has a normal. Voxels whose stencil touches a masked one are
/// left out.
pub(super) fn quantile_of_norms<R: Real, S: Sampler<R>>(
    sampler: &S,
    volume: &Volume,
    estimator: GradientEstimator,
    no_normal_below: R,
    q: f64,
) -> (f64, u64) {
    let [nx, ny, nz] = volume.dims();
    let at = |i: usize| R::from_f64(i as f64);
    let norms: Vec<(Vec<f64>, u64)> = (0..nz)
        .into_par_iter()
        .map(|z| {
            let (mut plane, mut evaluated) = (Vec::new(), 0);
            for y in 0..ny {
                for x in 0..nx {
                    if volume.mask().is_some_and(|m| touches(m, volume.dims(), [x, y, z], estimator)) {
                        continue;
                    }
                    evaluated += 1;
                    let norm = sampler.gradient(Vec3::new(at(x), at(y), at(z))).length();
                    if norm > no_normal_below {
                        plane.push(norm.to_f64());
                    }
                }
            }
            (plane, evaluated)
        })
        .collect();
    let evaluated = norms.iter().map(|(_, n)| n).sum();
    let mut norms: Vec<f64> = norms.into_iter().flat_map(|(plane, _)| plane).collect();
    (quantile(&mut norms, q).unwrap_or(0.0), evaluated)
}

/// Whether the gradient at a voxel reads a masked voxel, or the voxel is one.
///
/// The derivative along each axis reads a box about the voxel. Along that axis it has the neighbours, or three voxels
/// inwards from a border where differences are one-sided. Across, central differences read nothing more, Sobel's operator
/// the neighbours where it has both, and the others all that there are; for the kernels' own derivatives these are the
/// corners of the eight cells about the voxel.
fn touches(mask: &Mask, dims: [usize; 3], voxel: [usize; 3], estimator: GradientEstimator) -> bool {
    use GradientEstimator::{Analytic, Central, Regression, Sobel};
    let neighbours = |a: usize| voxel[a].saturating_sub(1)..=(voxel[a] + 1).min(dims[a] - 1);
    let at_border = |a: usize| voxel[a] == 0 || voxel[a] + 1 == dims[a];
    let along = |a: usize| match estimator {
        Central | Sobel if voxel[a] == 0 => 0..=(dims[a] - 1).min(2),
        Central | Sobel if at_border(a) => dims[a].saturating_sub(3)..=voxel[a],
        _ => neighbours(a),
    };
    let across = |a: usize| match estimator {
        Central => voxel[a]..=voxel[a],
        Sobel if at_border(a) => voxel[a]..=voxel[a],
        Sobel | Analytic | Regression => neighbours(a),
    };
    let is_masked = |[x, y, z]: [RangeInclusive<usize>; 3]| {
        z.into_iter().any(|z| y.clone().any(|y| x.clone().any(|x| mask.voxel([x, y, z]))))
    };
    (0..3).any(|axis| is_masked(std::array::from_fn(|a| if a == axis { along(a) } else { across(a) })))
}
