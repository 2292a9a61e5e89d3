//! Quantiles of more numbers than are kept ([VAL-2]).

use drypoint_scene::volume::histogram::rank;
use rayon::prelude::*;

/// Bits of a number that do not make its class: that is of sign, exponent and four bits of the fraction.
const BELOW: u32 = 48;

/// Classes of the numbers of at least 0.
const CLASSES: usize = 1 << (63 - BELOW);

/// The class of a number of at least 0: such numbers are in the order of their bits.
#[inline(always)]
fn class(number: f64) -> usize {
    (number.to_bits() >> BELOW) as usize & (CLASSES - 1)
}

/// Returns the quantile q of numbers of at least 0 without NaN, as
/// [`quantile`](drypoint_scene::volume::histogram::quantile) does, and none if there is no number.
///
/// The numbers come in parts: `fill` appends those of a part to an empty list, with memory to work in that `work` makes for
/// each thread. It is called twice for a part: numbers are counted by class first, then those of one class are gathered.
pub(crate) fn quantile_of_parts<W: Send>(
    parts: usize,
    work: impl Fn() -> W + Sync + Send,
    fill: impl Fn(&mut W, usize, &mut Vec<f64>) + Sync,
    q: f64,
) -> Option<f64> {
    /// Parts that a thread takes at least, so that few lists of counts are made.
    const TOGETHER: usize = 64;
    let each = || (0..parts).into_par_iter().with_min_len(TOGETHER);
    let counts = each()
        .fold(
            || (work(), Vec::new(), vec![0u64; CLASSES]),
            |(mut work, mut numbers, mut counts), part| {
                numbers.clear();
                fill(&mut work, part, &mut numbers);
                for &number in &numbers {
                    counts[class(number)] += 1;
                }
                (work, numbers, counts)
            },
        )
        .map(|(_, _, counts)| counts)
        .reduce_with(|mut a, b| {
            a.iter_mut().zip(b).for_each(|(a, b)| *a += b);
            a
        })?;
    let total: u64 = counts.iter().sum();
    if total == 0 {
        return None;
    }
    let (mut place, mut wanted) = (rank(q, total as usize) as u64, 0);
    while place >= counts[wanted] {
        place -= counts[wanted];
        wanted += 1;
    }
    let gathered = each()
        .fold(
            || (work(), Vec::new(), Vec::new()),
            |(mut work, mut numbers, mut members), part| {
                numbers.clear();
                fill(&mut work, part, &mut numbers);
                members.extend(numbers.iter().filter(|&&number| class(number) == wanted));
                (work, numbers, members)
            },
        )
        .map(|(_, _, members)| members);
    let mut members: Vec<f64> = gathered.flatten_iter().collect();
    Some(*members.select_nth_unstable_by(place as usize, f64::total_cmp).1)
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::philox;
    use drypoint_scene::volume::histogram::quantile;

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
                assert_eq!(quantile_of_parts(parts, || (), fill, q), quantile(&mut all, q), "{parts} {q}");
            }
        }
    }
}
