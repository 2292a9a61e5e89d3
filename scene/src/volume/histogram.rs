//! Histograms and quantiles of values.

use super::quantile::{rank, select};
use super::{Access, Volume, Voxel};
use crate::parallel;
use serde::Serialize;

/// Counts of the values of a volume in equal bins. Masked voxels do not count ([PREC-2]).
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Histogram {
    /// Lower end of the first bin.
    pub lo: f64,
    /// Upper end of the last bin. This value belongs to the bin.
    pub hi: f64,
    /// Number of values in each bin. A value on an edge is in the upper bin.
    pub bins: Vec<u64>,
}

impl Histogram {
    /// The histogram over the volume's own range, after slope and intercept ([VAL-1]).
    pub fn new(volume: &Volume, bins: usize) -> Self {
        let [lo, hi] = volume.range();
        let (slope, intercept) = (volume.slope(), volume.intercept());
        let counts = with_access!(volume, |access| sums(volume, access, bins, |stored| {
            (bins > 0).then(|| bin(slope * stored.to_f64() + intercept, [lo, hi], bins))
        }));
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

/// Counts the voxels that are not masked in `bins` bins. `bin` gives the bin of a stored number, if it has one.
fn sums<A: Access>(
    volume: &Volume,
    access: A,
    bins: usize,
    bin: impl Fn(A::Voxel) -> Option<usize> + Sync,
) -> Vec<u64> {
    let [nx, ny, nz] = volume.dims();
    // A part for each thread: bins can be many.
    let part = nz.div_ceil(parallel::threads());
    let parts = parallel::map(nz.div_ceil(part), &|i| {
        let mut counts = vec![0; bins];
        for z in i * part..nz.min((i + 1) * part) {
            for y in 0..ny {
                for x in 0..nx {
                    if volume.mask().is_none_or(|mask| !mask.voxel([x, y, z]))
                        && let Some(bin) = bin(access.at(x, y, z))
                    {
                        counts[bin] += 1;
                    }
                }
            }
        }
        counts
    });
    parts.into_iter().fold(vec![0; bins], added)
}

/// The sums of two lists of counts.
pub(super) fn added(mut sums: Vec<u64>, counts: Vec<u64>) -> Vec<u64> {
    sums.iter_mut().zip(counts).for_each(|(sum, count)| *sum += count);
    sums
}

/// Quantiles of the values of a volume, after slope and intercept, masked voxels left out.
pub fn quantiles(volume: &Volume, qs: &[f64]) -> Vec<f64> {
    let (slope, intercept) = (volume.slope(), volume.intercept());
    let [nx, ny, nz] = volume.dims();
    // A negative slope turns the order over.
    let place = |q, n| if slope < 0.0 { n - 1 - rank(q, n) } else { rank(q, n) };
    with_access!(volume, |access| {
        let fill = |(): &mut (), row: usize, numbers: &mut Vec<_>| {
            let (y, z) = (row % ny, row / ny);
            let is_valid = |x: &usize| volume.mask().is_none_or(|mask| !mask.voxel([*x, y, z]));
            numbers.extend((0..nx).filter(is_valid).map(|x| access.at(x, y, z)));
        };
        let stored = select(ny * nz, &|| (), &fill, |n| qs.iter().map(|&q| place(q, n)).collect());
        stored.into_iter().map(|stored| slope * stored.to_f64() + intercept).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Grid;
    use crate::volume::{VoxelType, Voxels};
    use proptest::prelude::*;

    fn volume(voxels: Voxels, slope: f64, intercept: f64) -> Volume {
        let grid = Grid::with_spacing([voxels.len(), 1, 1], [1.0; 3]).unwrap();
        Volume::new(grid, voxels, slope, intercept).unwrap()
    }

    /// The quantile of numbers that are sorted.
    fn sorted(numbers: &mut [f64], q: f64) -> f64 {
        numbers.sort_by(f64::total_cmp);
        numbers[rank(q, numbers.len())]
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

    #[test]
    fn quantiles_of_every_type_are_those_of_its_sorted_numbers() {
        let qs = [0.0, 0.1, 0.25, 0.5, 0.7, 0.99, 1.0];
        let numbers: Vec<f64> = (0..1000).map(|i| f64::from(i * 7919 % 1000 - 400) * 1.37e5 / 3.0).collect();
        for &voxel_type in VoxelType::ALL {
            for slope in [1.0, -0.5] {
                let volume = volume(Voxels::from_f64(&numbers, voxel_type), slope, 2.0);
                let mut values: Vec<f64> = (0..1000).map(|i| volume.value([i, 0, 0])).collect();
                let expected: Vec<f64> = qs.iter().map(|&q| sorted(&mut values, q)).collect();
                assert_eq!(quantiles(&volume, &qs), expected, "{}, {slope}", voxel_type.name());
            }
        }
        // Numbers that differ in their last bits, and both ends of a type.
        let close = [u64::MAX, 1 << 60, (1 << 60) + (1 << 20), 0, (1 << 60) + (1 << 40)];
        let found = quantiles(&volume(Voxels::U64(close.to_vec()), 1.0, 0.0), &[0.0, 0.4, 0.6, 0.8, 1.0]);
        assert_eq!(found, [0, 1 << 60, (1 << 60) + (1 << 20), (1 << 60) + (1 << 40), u64::MAX].map(|n| n as f64));
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
            prop_assert_eq!(of_volume[0], sorted(&mut values, q));
            // At least a share q of the numbers is not above the quantile; one less would not do.
            let below = values.iter().filter(|&&x| x < of_volume[0]).count() as f64;
            let not_above = values.iter().filter(|&&x| x <= of_volume[0]).count() as f64;
            let n = values.len() as f64;
            prop_assert!(not_above >= q * n - 1e-9 && (below < q * n || q == 0.0));
        }
    }
}
