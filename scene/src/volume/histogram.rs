//! Histograms and quantiles of values.

use super::{Access, Volume, Voxel};
use rayon::prelude::*;
use serde::Serialize;
use std::cmp::Ordering;

/// Counts of the values of a volume in equal bins. Masked voxels do not count ([PREC-2]).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Histogram {
    /// Lower end of the first bin.
    pub lo: f64,
    /// Upper end of the last bin, which belongs to it.
    pub hi: f64,
    /// Values in each bin; a value on an edge is in the upper of the two.
    pub bins: Vec<u64>,
}

impl Histogram {
    /// The histogram over the volume's own range, after slope and intercept ([VAL-1]).
    pub fn new(volume: &Volume, bins: usize) -> Self {
        let [lo, hi] = volume.range();
        let counts = with_access!(volume, |access| count(volume, access, bins, |value| bin(value, [lo, hi], bins)));
        Self { lo, hi, bins: counts }
    }

    /// Lower and upper end of a bin.
    pub fn edges(&self, bin: usize) -> [f64; 2] {
        let n = self.bins.len() as f64;
        // Halved, as in `bin`.
        [bin, bin + 1].map(|i| 2.0 * (0.5 * self.lo + (0.5 * self.hi - 0.5 * self.lo) * (i as f64 / n)))
    }

    /// Values in all bins.
    pub fn total(&self) -> u64 {
        self.bins.iter().sum()
    }
}

/// The bin of a value. All values of a constant field are in the first.
fn bin(value: f64, [lo, hi]: [f64; 2], bins: usize) -> usize {
    // Halved, so that the difference of two finite numbers cannot overflow.
    let t = (value * 0.5 - lo * 0.5) / (hi * 0.5 - lo * 0.5);
    // `as` saturates, and makes 0 of the NaN of a constant field.
    ((t * bins as f64) as usize).min(bins.saturating_sub(1))
}

fn count<A: Access>(volume: &Volume, access: A, bins: usize, bin: impl Fn(f64) -> usize + Sync) -> Vec<u64> {
    let [nx, ny, nz] = volume.dims();
    let (slope, intercept) = (volume.slope(), volume.intercept());
    let add = |mut sum: Vec<u64>, part: Vec<u64>| {
        sum.iter_mut().zip(part).for_each(|(a, b)| *a += b);
        sum
    };
    // Sums of whole numbers: the order of the parts does not show.
    (0..nz)
        .into_par_iter()
        .fold(
            || vec![0; bins],
            |mut counts, z| {
                for y in 0..ny {
                    for x in 0..nx {
                        if bins > 0 && volume.mask().is_none_or(|mask| !mask.voxel([x, y, z])) {
                            counts[bin(slope * access.at(x, y, z).to_f64() + intercept)] += 1;
                        }
                    }
                }
                counts
            },
        )
        .reduce(|| vec![0; bins], add)
}

/// The place, from 0, of the quantile q of n > 0 numbers in ascending order: the ⌈qn⌉-th, the first for q = 0
/// ([VAL-2]). A product within rounding of a whole number is that number, so that q = 0.07 of 100 is the seventh.
pub fn rank(q: f64, n: usize) -> usize {
    let product = q * n as f64;
    let whole = product.round();
    // q and the product are each rounded once, by up to half an ε.
    let place = if (product - whole).abs() <= f64::EPSILON * product { whole } else { product.ceil() };
    (place as usize).clamp(1, n) - 1
}

/// The quantile q of numbers without NaN ([VAL-2]): the ⌈qn⌉-th in ascending order, no interpolation. None where there
/// is no number. The numbers are left in another order.
pub fn quantile(numbers: &mut [f64], q: f64) -> Option<f64> {
    if numbers.is_empty() {
        return None;
    }
    let place = rank(q, numbers.len());
    Some(*numbers.select_nth_unstable_by(place, f64::total_cmp).1)
}

/// Quantiles of the values of a volume, after slope and intercept, masked voxels left out.
pub fn quantiles(volume: &Volume, qs: &[f64]) -> Vec<f64> {
    let (slope, intercept) = (volume.slope(), volume.intercept());
    with_access!(volume, |access| {
        // Sorted in the stored type, which takes no more memory than the volume does.
        let stored = sorted(volume, access);
        let n = stored.len();
        let at = |place: usize| slope * stored[if slope < 0.0 { n - 1 - place } else { place }].to_f64() + intercept;
        qs.iter().map(|&q| at(rank(q, n))).collect()
    })
}

/// The stored numbers that are not masked, in ascending order. There is at least one, or the volume would not be.
fn sorted<A: Access>(volume: &Volume, access: A) -> Vec<A::Voxel> {
    let [nx, ny, nz] = volume.dims();
    let mut stored = Vec::with_capacity(volume.grid().len() - volume.mask().map_or(0, |mask| mask.count()));
    for z in 0..nz {
        for y in 0..ny {
            let valid = |x: &usize| volume.mask().is_none_or(|mask| !mask.voxel([*x, y, z]));
            stored.extend((0..nx).filter(valid).map(|x| access.at(x, y, z)));
        }
    }
    stored.par_sort_unstable_by(|a, b| a.partial_cmp(b).unwrap_or(Ordering::Equal));
    stored
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Grid;
    use crate::volume::Voxels;
    use proptest::prelude::*;

    fn volume(voxels: Voxels, slope: f64, intercept: f64) -> Volume {
        let grid = Grid::with_spacing([voxels.len(), 1, 1], [1.0; 3]).unwrap();
        Volume::new(grid, voxels, slope, intercept).unwrap()
    }

    #[test]
    fn quantiles_by_hand() {
        let mut five = [30.0, 10.0, 50.0, 20.0, 40.0];
        let wanted = [(0.0, 10.0), (0.2, 10.0), (0.2001, 20.0), (0.5, 30.0), (0.8, 40.0), (0.999, 50.0), (1.0, 50.0)];
        for (q, want) in wanted {
            assert_eq!(quantile(&mut five, q), Some(want), "{q}");
        }
        assert_eq!(quantile(&mut [], 0.5), None);
        // 0.07 · 100 is 7.000000000000001 in f64.
        assert_eq!(rank(0.07, 100), 6);
        assert_eq!(rank(0.999, 1_000_000), 998_999);
    }

    #[test]
    fn bins_by_hand() {
        // Values −1 … 7 after slope and intercept: bins of width 2, the last one closed.
        let counted = Histogram::new(&volume(Voxels::U8(vec![0, 1, 1, 2, 3, 4]), 2.0, -1.0), 4);
        assert_eq!(counted, Histogram { lo: -1.0, hi: 7.0, bins: vec![1, 2, 1, 2] });
        assert_eq!(counted.edges(1), [1.0, 3.0]);
        assert_eq!(counted.total(), 6);
        let constant = Histogram::new(&volume(Voxels::I16(vec![5; 3]), 1.0, 0.0), 2);
        assert_eq!(constant, Histogram { lo: 5.0, hi: 5.0, bins: vec![3, 0] });
    }

    #[test]
    fn masked_voxels_do_not_count() {
        let holes = volume(Voxels::F32(vec![0.0, f32::NAN, 1.0, f32::INFINITY, 1.0]), 1.0, 0.0);
        assert_eq!(Histogram::new(&holes, 2).bins, [1, 2]);
        assert_eq!(quantiles(&holes, &[0.0, 0.34, 1.0]), [0.0, 1.0, 1.0]);
    }

    #[test]
    fn ranges_that_overflow_when_subtracted() {
        let wide = volume(Voxels::F64(vec![-f64::MAX, 0.0, f64::MAX]), 1.0, 0.0);
        let halves = Histogram::new(&wide, 2);
        assert_eq!(halves.bins, [1, 2]);
        assert_eq!([halves.edges(0), halves.edges(1)], [[-f64::MAX, 0.0], [0.0, f64::MAX]]);
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(64))]

        #[test]
        fn a_volume_and_a_slice_have_the_same_quantiles(
            v in proptest::collection::vec(any::<i16>(), 1..50),
            q in 0.0..=1.0f64,
            slope in prop_oneof![Just(1.0), Just(-2.0)],
        ) {
            let mut values: Vec<f64> = v.iter().map(|&x| slope * f64::from(x) + 3.0).collect();
            let of_volume = quantiles(&volume(Voxels::I16(v), slope, 3.0), &[q]);
            prop_assert_eq!(of_volume[0], quantile(&mut values, q).unwrap());
            values.sort_by(f64::total_cmp);
            // At least a share q of the numbers is not above the quantile; one less would not do.
            let below = values.iter().filter(|&&x| x < of_volume[0]).count() as f64;
            let not_above = values.iter().filter(|&&x| x <= of_volume[0]).count() as f64;
            let n = values.len() as f64;
            prop_assert!(not_above >= q * n - 1e-9 && (below < q * n || q == 0.0));
        }
    }
}
