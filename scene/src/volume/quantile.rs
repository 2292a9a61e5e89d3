//! Quantiles and order statistics of numbers that are not all kept in memory ([VAL-2]).

use super::histogram::added;
use crate::parallel;

/// A number that maps to an integer key of as many bits, in the same order.
pub trait Key: Copy + Send {
    /// Bits of a key.
    const BITS: u32 = 8 * size_of::<Self>() as u32;

    /// The key: keys are in the order of the numbers, −0 below 0.
    fn key(self) -> u64;

    /// The number of a key.
    fn of_key(key: u64) -> Self;
}

macro_rules! key {
    ($($type:ty, $bits:ty, $key:expr, $of_key:expr;)*) => { $(impl Key for $type {
        #[inline(always)]
        fn key(self) -> u64 {
            let key: fn($type) -> $bits = $key;
            u64::from(key(self))
        }

        fn of_key(key: u64) -> Self {
            let of_key: fn($bits) -> $type = $of_key;
            of_key(key as $bits)
        }
    })* };
}

// The order of signed integers is that of their bits with the sign turned over. Floats below 0 go the other way: all their
// bits are turned over.
key! {
    u8, u8, |x| x, |k| k;
    i8, u8, |x| x as u8 ^ (1 << 7), |k| (k ^ (1 << 7)) as i8;
    u16, u16, |x| x, |k| k;
    i16, u16, |x| x as u16 ^ (1 << 15), |k| (k ^ (1 << 15)) as i16;
    u32, u32, |x| x, |k| k;
    i32, u32, |x| x as u32 ^ (1 << 31), |k| (k ^ (1 << 31)) as i32;
    u64, u64, |x| x, |k| k;
    i64, u64, |x| x as u64 ^ (1 << 63), |k| (k ^ (1 << 63)) as i64;
    f32, u32,
        |x| if x.is_sign_negative() { !x.to_bits() } else { x.to_bits() | (1 << 31) },
        |k| f32::from_bits(if k >> 31 == 0 { !k } else { k ^ (1 << 31) });
    f64, u64,
        |x| if x.is_sign_negative() { !x.to_bits() } else { x.to_bits() | (1 << 63) },
        |k| f64::from_bits(if k >> 63 == 0 { !k } else { k ^ (1 << 63) });
}

/// The index, from 0, of the quantile q of n > 0 numbers in ascending order: the index of the ⌈qn⌉-th number, or of the
/// first number for q = 0 ([VAL-2]). A product within rounding of an integer counts as that integer, so that q = 0.07
/// of 100 is the seventh.
pub fn rank(q: f64, n: usize) -> usize {
    let product = q * n as f64;
    let whole = product.round();
    // q and the product are each rounded once, by up to half an ε.
    let place = if (product - whole).abs() <= f64::EPSILON * product { whole } else { product.ceil() };
    (place as usize).clamp(1, n) - 1
}

/// Returns the quantile q of numbers, without interpolation; none if there is no number. See [`select`] for `parts`,
/// `work` and `fill`.
pub fn quantile<N: Key, W>(
    parts: usize,
    work: &(dyn Fn() -> W + Sync),
    fill: &(dyn Fn(&mut W, usize, &mut Vec<N>) + Sync),
    q: f64,
) -> Option<N> {
    select(parts, work, fill, |n| vec![rank(q, n)]).pop()
}

/// Returns the numbers at some indices, from 0, of the ascending order. `places` receives the count of the numbers, and
/// is not called if there are none.
///
/// The numbers come in parts: `fill` appends the numbers of a part to an empty list, with working memory that `work`
/// makes for each thread. It is called again for a part, with the same numbers, if that part can hold a sought one.
///
/// Numbers are counted by the upper 16 bits of their keys first. If few share these bits with a sought number, they are
/// gathered; otherwise they are counted by the next 16 bits, and so on. Gathering all of them would need a second
/// volume.
pub fn select<N: Key, W>(
    parts: usize,
    work: &(dyn Fn() -> W + Sync),
    fill: &(dyn Fn(&mut W, usize, &mut Vec<N>) + Sync),
    places: impl FnOnce(usize) -> Vec<usize>,
) -> Vec<N> {
    // First pass: counts of all numbers by their upper digit.
    let (mut passes, digit) = (Passes { work, fill, spans: vec![[0, u64::MAX]; parts] }, N::BITS.min(DIGIT));
    let mut below = N::BITS - digit;
    let mut counts = passes.count(&[0], below, digit);
    let total: u64 = counts.iter().sum();
    if total == 0 {
        return Vec::new();
    }
    let mut sought: Vec<RankQuery> = places(total as usize)
        .into_iter()
        .map(|place| RankQuery { prefix: 0, place: place as u64, alike: total })
        .collect();
    let mut prefixes = vec![0];
    loop {
        // Each query learns its next digit from the block of counts of its prefix.
        for one in &mut sought {
            let block = prefixes.partition_point(|&prefix| prefix < one.prefix);
            one.narrow(&counts[block << digit..][..1 << digit], digit);
        }
        prefixes = sought.iter().map(|one| one.prefix).collect();
        prefixes.sort_unstable();
        prefixes.dedup();
        // All bits are known, so the prefix is the key.
        if below == 0 {
            return sought.into_iter().map(|one| N::of_key(one.prefix)).collect();
        }
        // Few enough numbers share the prefixes to be gathered and selected directly.
        if sought.iter().all(|one| one.alike <= FEW.max(total / 64)) {
            let members = passes.gather(&prefixes, below);
            return sought.into_iter().map(|one| N::of_key(one.among(&members, below))).collect();
        }
        below -= digit;
        counts = passes.count(&prefixes, below, digit);
    }
}

/// Bits of a key that are counted at a time.
const DIGIT: u32 = 16;

/// Numbers that are gathered in any case rather than counted once more.
const FEW: u64 = 1 << 16;

/// Parts that a thread takes at least, so that few lists of counts are made.
const TOGETHER: usize = 64;

/// A number that is sought by its place in the ascending order.
#[derive(Clone, Copy)]
struct RankQuery {
    /// The upper bits of its key, as far as they are known.
    prefix: u64,
    /// The sought index among the numbers that begin with the prefix.
    place: u64,
    /// Number of the numbers that begin with the prefix.
    alike: u64,
}

impl RankQuery {
    /// Finds the next bits, given how many numbers there are for each of their values.
    fn narrow(&mut self, counts: &[u64], digit: u32) {
        for (value, &count) in counts.iter().enumerate() {
            if self.place < count {
                (self.prefix, self.alike) = (self.prefix << digit | value as u64, count);
                return;
            }
            self.place -= count;
        }
    }

    /// The key among all those that begin as it, or as another sought one.
    fn among(self, members: &[u64], below: u32) -> u64 {
        let mut alike: Vec<u64> = members.iter().copied().filter(|key| key >> below == self.prefix).collect();
        *alike.select_nth_unstable(self.place as usize).1
    }
}

/// Passes over all numbers.
struct Passes<'f, M, N> {
    work: &'f (dyn Fn() -> M + Sync),
    fill: &'f (dyn Fn(&mut M, usize, &mut Vec<N>) + Sync),
    /// Lowest and highest key of each part, from the first pass on.
    spans: Vec<[u64; 2]>,
}

impl<M, N: Key> Passes<'_, M, N> {
    /// Counts the numbers whose keys begin with one of some prefixes, in ascending order. Counts are by the value of
    /// the digit behind the prefix and above `below` bits: one block of counts for each prefix.
    fn count(&mut self, prefixes: &[u64], below: u32, digit: u32) -> Vec<u64> {
        let (work, fill, bins) = (self.work, self.fill, prefixes.len() << digit);
        // Each task counts in its own list of bins, and the lists are summed.
        let together = self.spans.len().div_ceil(4 * parallel::threads()).max(TOGETHER);
        let tasks = self.spans.chunks_mut(together).collect();
        let counts = parallel::map_of(tasks, &|task, spans: &mut [[u64; 2]]| {
            let (mut work, mut numbers, mut counts) = (work(), Vec::new(), vec![0; bins]);
            for (part, span) in (task * together..).zip(spans) {
                if !may_hold(span, prefixes, below + digit) {
                    continue;
                }
                numbers.clear();
                fill(&mut work, part, &mut numbers);
                *span = [u64::MAX, 0];
                for key in numbers.iter().map(|number| number.key()) {
                    *span = [span[0].min(key), span[1].max(key)];
                    let upper = key >> below;
                    let block = match prefixes {
                        [one] => (*one == upper >> digit).then_some(0),
                        _ => prefixes.iter().position(|&prefix| prefix == upper >> digit),
                    };
                    if let Some(block) = block {
                        counts[block << digit | (upper as usize & ((1 << digit) - 1))] += 1;
                    }
                }
            }
            counts
        });
        counts.into_iter().reduce(added).unwrap_or_else(|| vec![0; bins])
    }

    /// The keys that begin with one of some prefixes.
    fn gather(&self, prefixes: &[u64], below: u32) -> Vec<u64> {
        parallel::gather(self.spans.len(), TOGETHER, &|parts, members| {
            let (mut work, mut numbers) = ((self.work)(), Vec::new());
            for part in parts.filter(|&part| may_hold(&self.spans[part], prefixes, below)) {
                numbers.clear();
                (self.fill)(&mut work, part, &mut numbers);
                let keys = numbers.iter().map(|number| number.key());
                members.extend(keys.filter(|key| prefixes.contains(&(key >> below))));
            }
        })
    }
}

/// Whether a span of keys reaches over one that begins with a prefix.
fn may_hold([lowest, highest]: &[u64; 2], prefixes: &[u64], below: u32) -> bool {
    // A key of 64 bits has no bit above 64.
    let [lowest, highest] = [lowest, highest].map(|key| key.checked_shr(below).unwrap_or(0));
    prefixes.iter().any(|prefix| (lowest..=highest).contains(prefix))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::philox;

    /// The quantile of numbers that are sorted.
    fn sorted(numbers: &mut [f64], q: f64) -> Option<f64> {
        numbers.sort_by(f64::total_cmp);
        (!numbers.is_empty()).then(|| numbers[rank(q, numbers.len())])
    }

    fn of_slice<N: Key + Sync>(numbers: &[N], q: f64) -> Option<N> {
        quantile(numbers.len().div_ceil(7), &|| (), &|(), part, to| to.extend(numbers.chunks(7).nth(part).unwrap()), q)
    }

    #[test]
    fn quantiles_by_hand() {
        let five = [30.0, 10.0, 50.0, 20.0, 40.0];
        let wanted = [(0.0, 10.0), (0.2, 10.0), (0.2001, 20.0), (0.5, 30.0), (0.8, 40.0), (0.999, 50.0), (1.0, 50.0)];
        for (q, want) in wanted {
            assert_eq!(of_slice(&five, q), Some(want), "{q}");
        }
        assert_eq!(of_slice::<f64>(&[], 0.5), None);
        // 0.07 · 100 is 7.000000000000001 in f64.
        assert_eq!(rank(0.07, 100), 6);
        assert_eq!(rank(0.999, 1_000_000), 998_999);
    }

    #[test]
    fn keys_are_in_the_order_of_their_numbers() {
        fn check<T: Key + std::fmt::Debug>(ascending: &[T]) {
            assert!(ascending.windows(2).all(|two| two[0].key() < two[1].key()), "{ascending:?}");
            for &x in ascending {
                // The text tells −0 from 0.
                assert_eq!(format!("{:?}", T::of_key(x.key())), format!("{x:?}"));
            }
        }
        check(&[0u8, 1, 200, 255]);
        check(&[i8::MIN, -1, 0, 1, i8::MAX]);
        check(&[0u16, 300, u16::MAX]);
        check(&[i16::MIN, -300, -1, 0, 300, i16::MAX]);
        check(&[0u32, 70_000, u32::MAX]);
        check(&[i32::MIN, -1, 0, 70_000, i32::MAX]);
        check(&[0u64, 1 << 40, u64::MAX]);
        check(&[i64::MIN, -(1 << 40), 0, 1 << 40, i64::MAX]);
        check(&[f32::MIN, -1.5, -1e-40, -0.0, 0.0, 1e-40, 1.5, f32::MAX]);
        check(&[f64::MIN, -1.5, -1e-310, -0.0, 0.0, 1e-310, 1.5, f64::MAX]);
    }

    #[test]
    fn parts_have_the_quantile_of_the_whole() {
        let number = |i: u32| philox::uniforms(1, [i, 0, 0], 0)[0].powi(5) * 1e-3;
        // Parts of 0 to 12 numbers.
        let fill = |(): &mut (), part: usize, numbers: &mut Vec<f64>| {
            numbers.extend((0..part as u32 % 13).map(|i| number(part as u32 * 16 + i)));
        };
        for parts in [0, 1, 2, 30, 1000] {
            for q in [0.0, 0.1, 0.5, 0.999, 1.0] {
                let mut all = Vec::new();
                (0..parts).for_each(|part| fill(&mut (), part, &mut all));
                assert_eq!(quantile(parts, &|| (), &fill, q), sorted(&mut all, q), "{parts} {q}");
            }
        }
    }

    /// Numbers that differ in their last bits alone, more than are gathered, so that all digits are counted.
    #[test]
    fn many_numbers_that_begin_alike_are_counted_to_the_last_bit() {
        let (parts, each) = (300, 1000);
        let number = |i: usize| f64::from_bits(1f64.to_bits() + (i * 7919 % (parts * each)) as u64);
        let fill = |(): &mut (), part: usize, numbers: &mut Vec<f64>| {
            numbers.extend((0..each).map(|i| number(part * each + i)));
        };
        for q in [0.0, 0.3, 0.999, 1.0] {
            let want = f64::from_bits(1f64.to_bits() + rank(q, parts * each) as u64);
            assert_eq!(quantile(parts, &|| (), &fill, q), Some(want), "{q}");
        }
    }
}
