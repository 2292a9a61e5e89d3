//! Histograms and quantiles of values.

use super::bytes::Stored;
use super::{Access, Volume, Voxel};
use rayon::prelude::*;
use serde::Serialize;

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

/// Counts the voxels that are not masked in so many bins; `bin` says in which one a stored number belongs, if in any.
fn sums<A: Access>(
    volume: &Volume,
    access: A,
    bins: usize,
    bin: impl Fn(A::Voxel) -> Option<usize> + Sync,
) -> Vec<u64> {
    let [nx, ny, nz] = volume.dims();
    let add = |mut sum: Vec<u64>, part: Vec<u64>| {
        sum.iter_mut().zip(part).for_each(|(a, b)| *a += b);
        sum
    };
    // Sums of whole numbers: the order of the parts does not show. A part for each thread: bins can be many.
    let part = nz.div_ceil(rayon::current_num_threads());
    (0..nz)
        .into_par_iter()
        .with_min_len(part)
        .fold(
            || vec![0; bins],
            |mut counts, z| {
                for y in 0..ny {
                    for x in 0..nx {
                        if volume.mask().is_none_or(|mask| !mask.voxel([x, y, z]))
                            && let Some(bin) = bin(access.at(x, y, z))
                        {
                            counts[bin] += 1;
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
    let n = volume.grid().len() - volume.mask().map_or(0, |mask| mask.count());
    let places = qs.iter().map(|&q| rank(q, n)).map(|place| if slope < 0.0 { n - 1 - place } else { place });
    let places: Vec<u64> = places.map(|place| place as u64).collect();
    with_access!(volume, |access| {
        let stored = select(volume, access, &places);
        stored.into_iter().map(|stored| slope * stored.to_f64() + intercept).collect()
    })
}

/// Bits of a number that are counted at a time.
const DIGIT: u32 = 16;

/// A number that is sought by its place in the ascending order: the upper bits of its key, as far as they are known, and its
/// place among the numbers that begin with them.
#[derive(Clone, Copy)]
struct Sought {
    prefix: u64,
    place: u64,
}

/// The stored numbers at some places, from 0, of their ascending order; those that are masked do not count.
///
/// A radix selection: the numbers are counted by the upper 16 bits of their keys, then those that begin as a sought one by the
/// next 16, and so on. Sorting would need a second volume.
fn select<A: Access>(volume: &Volume, access: A, places: &[u64]) -> Vec<A::Voxel>
where
    A::Voxel: Stored,
{
    let mut sought: Vec<Sought> = places.iter().map(|&place| Sought { prefix: 0, place }).collect();
    let bits = 8 * size_of::<A::Voxel>() as u32;
    let digit = bits.min(DIGIT);
    for below in (0..bits / digit).rev().map(|i| i * digit) {
        let mut prefixes: Vec<u64> = sought.iter().map(|one| one.prefix).collect();
        prefixes.sort_unstable();
        prefixes.dedup();
        let digits = 1 << digit;
        let counts = sums(volume, access, prefixes.len() * digits, |stored| {
            let upper = stored.key() >> below;
            let block = prefixes.iter().position(|&prefix| prefix == upper >> digit)?;
            Some(block * digits + upper as usize % digits)
        });
        for one in &mut sought {
            let Ok(block) = prefixes.binary_search(&one.prefix) else { continue };
            for (value, &count) in counts[block * digits..][..digits].iter().enumerate() {
                if one.place < count {
                    one.prefix = one.prefix << digit | value as u64;
                    break;
                }
                one.place -= count;
            }
        }
    }
    sought.into_iter().map(|one| A::Voxel::of_key(one.prefix)).collect()
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

    #[test]
    fn quantiles_of_every_type_are_those_of_its_sorted_numbers() {
        let qs = [0.0, 0.1, 0.25, 0.5, 0.7, 0.99, 1.0];
        let numbers: Vec<f64> = (0..1000).map(|i| f64::from(i * 7919 % 1000 - 400) * 1.37e5 / 3.0).collect();
        for &voxel_type in VoxelType::ALL {
            for slope in [1.0, -0.5] {
                let volume = volume(Voxels::from_f64(&numbers, voxel_type), slope, 2.0);
                let mut values: Vec<f64> = (0..1000).map(|i| volume.value([i, 0, 0])).collect();
                let expected: Vec<f64> = qs.iter().filter_map(|&q| quantile(&mut values, q)).collect();
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
