//! ‖g‖ at every voxel and the length that counts as |g| = 1, by the estimator of stippling ([STIP-1], [VAL-2]).

use crate::field::{Field, touches_mask};
use drypoint_scene::parallel;
use drypoint_scene::volume::quantile::quantile;

/// Replaces ‖g‖ where not all contributing voxels are valid.
pub(super) const INVALID: f64 = -1.0;

/// ‖g‖ of each voxel, x fastest, times the power of two of [SPACE-4].
pub(super) fn norms(field: &Field<'_, f64>) -> Vec<f64> {
    let (volume, estimator) = (field.volume(), field.reconstruction().gradient);
    let [nx, ny, _] = volume.dims();
    let mut norms = vec![0.0; volume.grid().len()];
    parallel::chunks_mut(&mut norms, nx, &|row, norms| {
        let (y, z) = (row % ny, row / ny);
        field.voxel_squares([y, z], &mut Vec::new(), norms);
        norms.iter_mut().for_each(|norm| *norm = norm.sqrt());
        if let Some(mask) = volume.mask() {
            let touches = |x| touches_mask(mask, volume.dims(), [x, y, z], estimator);
            norms.iter_mut().enumerate().filter(|(x, _)| touches(*x)).for_each(|(_, norm)| *norm = INVALID);
        }
    });
    norms
}

/// The quantile q of the norms above a non-negative bound. Returns none if there are none.
pub(super) fn quantile_above(norms: &[f64], bound: f64, q: f64) -> Option<f64> {
    let chunks: Vec<&[f64]> = norms.chunks(1 << 16).collect();
    let above = |(): &mut (), i: usize, numbers: &mut Vec<f64>| {
        numbers.extend(chunks[i].iter().filter(|&&norm| norm > bound));
    };
    quantile(chunks.len(), &|| (), &above, q)
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::philox;
    use drypoint_scene::volume::quantile::rank;

    #[test]
    fn the_quantile_of_sorted_copies() {
        let norms: Vec<f64> = (0..5000)
            .map(|i| philox::uniforms(1, [i, 0, 0], 0))
            .map(|[u, v, ..]| if u < 0.2 { INVALID } else { v * v * v * 1e-3 })
            .collect();
        for bound in [0.0, 1e-6, 1.0] {
            for q in [0.0, 0.1, 0.5, 0.999, 1.0] {
                let mut above: Vec<f64> = norms.iter().copied().filter(|&norm| norm > bound).collect();
                above.sort_by(f64::total_cmp);
                let want = (!above.is_empty()).then(|| above[rank(q, above.len())]);
                assert_eq!(quantile_above(&norms, bound, q), want, "{bound} {q}");
            }
        }
        assert_eq!(quantile_above(&[], 0.0, 0.5), None);
    }
}
