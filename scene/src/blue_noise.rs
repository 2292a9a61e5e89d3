//! The mask of blue noise that rounds fractions to whole numbers, spread evenly over voxels ([STIP-5]).
//!
//! The mask is made by the void-and-cluster method: R. Ulichney, *The void-and-cluster method for dither array
//! generation*, Human Vision, Visual Processing, and Digital Display IV, SPIE 1913, 1993, here in three dimensions.
//! Pictures show the mask on surfaces. Voids are therefore measured in the planes of two axes as well as in space.

use crate::math::exp;
use crate::philox;

/// Voxels along each axis of the mask, which repeats.
pub const SIDE: usize = 32;

/// Number of voxels of the mask.
const VOXELS: usize = SIDE * SIDE * SIDE;

/// The ranks that [`void_and_cluster`] made, x fastest, two bytes each, the lower byte first.
static RANKS: &[u8; 2 * VOXELS] = include_bytes!("../../data/blue_noise.bin");

/// Returns u in (0, 1) of a voxel: (rank + ½)/32³. Over a period of the mask, ⌊N + u⌋ has the mean N, to half a rank.
#[inline]
pub fn at(cell: [u32; 3]) -> f64 {
    let [x, y, z] = cell.map(|i| i as usize % SIDE);
    let i = 2 * ((z * SIDE + y) * SIDE + x);
    (f64::from(u16::from_le_bytes([RANKS[i], RANKS[i + 1]])) + 0.5) / VOXELS as f64
}

/// Computes the mask: every rank from 0 to 32³ − 1 once, x fastest.
pub fn void_and_cluster() -> Vec<u16> {
    let kernel = kernel();
    let mut field = EnergyField { energy: vec![0.0; VOXELS], is_set: vec![false; VOXELS], kernel };
    // A tenth of the voxels at random, moved from the tightest cluster to the largest void until that changes nothing.
    for i in 0..VOXELS {
        let cell = [i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE].map(|x| x as u32);
        if philox::uniform(0, cell, 0) < 0.1 {
            field.flip(i);
        }
    }
    loop {
        let cluster = field.tightest_cluster();
        field.flip(cluster);
        let void = field.largest_void();
        field.flip(void);
        if void == cluster {
            break;
        }
    }
    let mut ranks = vec![0; VOXELS];
    let prototype = field.is_set.clone();
    let count = prototype.iter().filter(|&&set| set).count();
    for rank in (0..count).rev() {
        let cluster = field.tightest_cluster();
        field.flip(cluster);
        ranks[cluster] = rank as u16;
    }
    for (i, _) in prototype.iter().enumerate().filter(|(_, set)| **set) {
        field.flip(i);
    }
    // The tightest cluster of what is left is where the energy of what is set is least, so one rule fills to the end.
    for rank in count..VOXELS {
        let void = field.largest_void();
        field.flip(void);
        ranks[void] = rank as u16;
    }
    ranks
}

/// The weights that a set voxel adds to those around it, by their offsets on the torus.
fn kernel() -> Vec<f64> {
    /// The deviation in voxels. Ulichney's 1.5, for a plane, leaves cuts of a tone of a tenth uneven.
    const SIGMA: f64 = 2.0;
    let squared = |d: usize| (d.min(SIDE - d) * d.min(SIDE - d)) as f64;
    let gaussian = |r2: f64| exp(-r2 / (2.0 * SIGMA * SIGMA));
    let at = |i: usize| {
        let d = [i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE];
        let planes = d.iter().filter(|&&d| d == 0).count() as f64;
        let r2 = d.map(squared).iter().sum::<f64>();
        gaussian(r2) * (1.0 + PLANES * planes)
    };
    (0..VOXELS).map(at).collect()
}

/// Additional weight of a voxel in each of the three planes. A larger weight makes cuts along the axes more even, and
/// oblique cuts less. At 1 the worst of the cuts that were tried is best.
const PLANES: f64 = 1.0;

/// The set voxels, and each voxel's closeness to them.
struct EnergyField {
    energy: Vec<f64>,
    is_set: Vec<bool>,
    kernel: Vec<f64>,
}

impl EnergyField {
    /// Sets or unsets a voxel.
    fn flip(&mut self, i: usize) {
        let sign = if self.is_set[i] { -1.0 } else { 1.0 };
        self.is_set[i] = !self.is_set[i];
        let [x, y, z] = [i % SIDE, i / SIDE % SIDE, i / SIDE / SIDE];
        for (row, energy) in self.energy.chunks_exact_mut(SIDE).enumerate() {
            let (dy, dz) = ((row % SIDE + SIDE - y) % SIDE, (row / SIDE + SIDE - z) % SIDE);
            let kernel = &self.kernel[(dz * SIDE + dy) * SIDE..][..SIDE];
            let (before, after) = energy.split_at_mut(x);
            after.iter_mut().zip(kernel).for_each(|(e, k)| *e += sign * k);
            before.iter_mut().zip(&kernel[SIDE - x..]).for_each(|(e, k)| *e += sign * k);
        }
    }

    /// The set voxel with the highest energy. Ties go to the first one.
    fn tightest_cluster(&self) -> usize {
        self.best(true, |a, b| a > b)
    }

    /// The unset voxel with the lowest energy. Ties go to the first one.
    fn largest_void(&self) -> usize {
        self.best(false, |a, b| a < b)
    }

    fn best(&self, set: bool, better: impl Fn(f64, f64) -> bool) -> usize {
        let mut best: Option<(usize, f64)> = None;
        for (i, (&energy, &is_set)) in self.energy.iter().zip(&self.is_set).enumerate() {
            if is_set == set && best.is_none_or(|(_, least)| better(energy, least)) {
                best = Some((i, energy));
            }
        }
        best.map_or(0, |(i, _)| i)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_rank_once_and_the_file_is_what_the_method_makes() {
        let ranks = void_and_cluster();
        let mut sorted = ranks.clone();
        sorted.sort_unstable();
        assert!(sorted.iter().enumerate().all(|(i, &rank)| i == usize::from(rank)));
        let bytes: Vec<u8> = ranks.iter().flat_map(|rank| rank.to_le_bytes()).collect();
        assert!(bytes == RANKS, "data/blue_noise.bin: write it anew with `cargo run -p drypoint-docs -- blue-noise`");
    }

    #[test]
    fn numbers_lie_inside_and_repeat() {
        assert_eq!(at([1, 2, 3]), at([33, 66, 99]));
        let mean: f64 = (0..VOXELS as u32).map(|i| at([i % 32, i / 32 % 32, i / 1024])).sum::<f64>() / VOXELS as f64;
        assert!((mean - 0.5).abs() < 1e-12);
    }
}
