//! ‖g‖ at every voxel, and what |g| = 1 stands for, by the estimator that stippling uses ([STIP-1], [VAL-2]).

use crate::field::{Field, GradientEstimator, Sampler};
use crate::ray::touches_mask;
use drypoint_scene::volume::histogram::rank;
use rayon::prelude::*;

/// In place of ‖g‖ where the voxels that it is made of are not all valid.
pub(super) const INVALID: f64 = -1.0;

/// ‖g‖ of each voxel, x fastest, times the power of two of [SPACE-4].
pub(super) fn norms<S: Sampler<f64>>(sampler: &S, field: &Field<'_, f64>, estimator: GradientEstimator) -> Vec<f64> {
    let volume = field.volume();
    let [nx, ny, _] = volume.dims();
    let mut norms = vec![0.0; volume.grid().len()];
    norms.par_chunks_mut(nx).enumerate().with_min_len(16).for_each_init(Vec::new, |rows, (row, norms)| {
        let (y, z) = (row % ny, row / ny);
        let norm = |x| sampler.voxel_gradient([x, y, z]).length();
        if field.regression_norms([y, z], rows, norms) {
            (norms[0], norms[nx - 1]) = (norm(0), norm(nx - 1));
        } else {
            norms.iter_mut().enumerate().for_each(|(x, at)| *at = norm(x));
        }
        if let Some(mask) = volume.mask() {
            let touches = |x| touches_mask(mask, volume.dims(), [x, y, z], estimator);
            norms.iter_mut().enumerate().filter(|(x, _)| touches(*x)).for_each(|(_, norm)| *norm = INVALID);
        }
    });
    norms
}

/// The quantile q of the norms that exceed a bound, which is not negative; none where none does. As
/// [`quantile`](drypoint_scene::volume::histogram::quantile), without a copy of all.
pub(super) fn quantile_above(norms: &[f64], bound: f64, q: f64) -> Option<f64> {
    /// Bits of a number that make its class: sign, exponent and four of the fraction.
    const CLASS: u32 = 48;
    let class = |norm: f64| (norm.to_bits() >> CLASS) as usize;
    // Numbers of at least 0 are in the order of their bits.
    let add = |mut a: Vec<usize>, b: Vec<usize>| {
        a.iter_mut().zip(b).for_each(|(a, b)| *a += b);
        a
    };
    let counted = |norms: &[f64]| {
        let mut counts = vec![0usize; 1 << (63 - CLASS)];
        for &norm in norms.iter().filter(|&&norm| norm > bound) {
            counts[class(norm)] += 1;
        }
        counts
    };
    let counts = norms.par_chunks(1 << 20).map(counted).reduce_with(add)?;
    let total: usize = counts.iter().sum();
    if total == 0 {
        return None;
    }
    let (mut place, mut wanted) = (rank(q, total), 0);
    while place >= counts[wanted] {
        place -= counts[wanted];
        wanted += 1;
    }
    let is_in = |norm: &&f64| **norm > bound && class(**norm) == wanted;
    let mut members: Vec<f64> = norms.par_iter().filter(is_in).copied().collect();
    Some(*members.select_nth_unstable_by(place, f64::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::philox;
    use drypoint_scene::volume::histogram::quantile;

    #[test]
    fn the_quantile_of_sorted_copies() {
        let norms: Vec<f64> = (0..5000)
            .map(|i| philox::uniforms(1, [i, 0, 0], 0))
            .map(|[u, v, ..]| if u < 0.2 { INVALID } else { v * v * v * 1e-3 })
            .collect();
        for bound in [0.0, 1e-6, 1.0] {
            for q in [0.0, 0.1, 0.5, 0.999, 1.0] {
                let mut above: Vec<f64> = norms.iter().copied().filter(|&norm| norm > bound).collect();
                assert_eq!(quantile_above(&norms, bound, q), quantile(&mut above, q), "{bound} {q}");
            }
        }
        assert_eq!(quantile_above(&[], 0.0, 0.5), None);
    }
}
