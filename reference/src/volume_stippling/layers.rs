//! Number of voxels of a face that print onto one place ([STIP-17]).

use drypoint_scene::glam::DVec3;
use drypoint_scene::parallel;

/// Number of counted steps along the normal, to either side.
const REACH: i32 = 3;

/// Returns the mean number of steps along ±n at which ‖∇V‖ exceeds the threshold, the voxel itself included. A step
/// is one voxel long. `steps` holds each voxel's place and its step along n, in index space.
///
/// ‖∇V‖ is linear between voxels and 0 beyond the border. Without voxels the result is 1.
pub(super) fn layers(
    dims: [usize; 3],
    norms: &[f64],
    is_above: impl Fn(f64) -> bool + Sync,
    steps: &[([u32; 3], DVec3)],
) -> f64 {
    let count = |(cell, step): &([u32; 3], DVec3)| {
        let own = DVec3::from_array(cell.map(f64::from));
        let at = |k: i32| norm_at(dims, norms, own + *step * f64::from(k));
        (-REACH..=REACH).filter(|&k| at(k).is_some_and(&is_above)).count()
    };
    // Sums of integers do not depend on their order.
    let parts = parallel::map_of(steps.chunks(1 << 12).collect(), &|_, steps| steps.iter().map(count).sum::<usize>());
    let sum: usize = parts.into_iter().sum();
    if steps.is_empty() { 1.0 } else { sum as f64 / steps.len() as f64 }
}

/// ‖∇V‖ at a place in index space. Invalid values count as 0.
fn norm_at(dims: [usize; 3], norms: &[f64], p: DVec3) -> Option<f64> {
    let (mut cell, mut weight) = ([0; 3], [0.0; 3]);
    for a in 0..3 {
        if dims[a] == 1 {
            continue;
        }
        if !(0.0..=(dims[a] - 1) as f64).contains(&p[a]) {
            return None;
        }
        cell[a] = (p[a] as usize).min(dims[a] - 2);
        weight[a] = p[a] - cell[a] as f64;
    }
    let mut sum = 0.0;
    for corner in 0..8 {
        let (mut index, mut w) = ([0; 3], 1.0);
        for a in 0..3 {
            let up = corner >> a & 1;
            w *= if up == 1 { weight[a] } else { 1.0 - weight[a] };
            index[a] = (cell[a] + up).min(dims[a] - 1);
        }
        sum += w * norms[(index[2] * dims[1] + index[1]) * dims[0] + index[0]].max(0.0);
    }
    Some(sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A slab whose ‖∇V‖ falls linearly from its middle plane: the count equals its width, at any orientation.
    #[test]
    fn a_slab_has_as_many_layers_as_it_is_wide() {
        let dims = [40; 3];
        let cells: Vec<[u32; 3]> = (0..40 * 40 * 40).map(|i| [i % 40, i / 40 % 40, i / 1600]).collect();
        for n in [DVec3::Z, DVec3::new(1.0, 2.0, 3.0).normalize(), DVec3::new(-4.0, 2.0, 1.0).normalize()] {
            let t = |cell: [u32; 3]| (DVec3::from_array(cell.map(f64::from)) - DVec3::splat(19.37)).dot(n);
            let norms: Vec<f64> = cells.iter().map(|&cell| (10.0 - t(cell).abs()).max(0.0)).collect();
            // A step of three reaches across four voxels and no farther.
            for half in [0.75, 1.5, 2.0] {
                let is_above = |norm: f64| norm > 10.0 - half;
                let inside = |cell: &&[u32; 3]| t(**cell).abs() < half && cell.iter().all(|i| (5..35).contains(i));
                let steps: Vec<_> = cells.iter().filter(inside).map(|&cell| (cell, n)).collect();
                let found = layers(dims, &norms, is_above, &steps);
                // Lines along n meet ⌊w⌋ voxels or one more, and each of these counts all of them.
                let (whole, more) = ((2.0 * half).floor(), 2.0 * half - (2.0 * half).floor());
                let lines = (whole * whole * (1.0 - more) + (whole + 1.0) * (whole + 1.0) * more) / (2.0 * half);
                // Along an axis all lines are equal, and the count is that of whole planes.
                let planes = (19.37f64 + half).floor() - (19.37f64 - half).floor();
                let wanted = if n == DVec3::Z { planes } else { lines };
                // Linear interpolation cuts off the crest, which shows where the slab ends within half a voxel of it.
                assert!((found - wanted).abs() < 0.1, "{n} {half}: {found}");
            }
        }
        assert_eq!(layers(dims, &[], |_| true, &[]), 1.0);
    }
}
