//! Boxes on top of each other, as near as possible to the heights that they ask for.

/// Returns the lower ends of intervals that do not overlap, in the given order and inside free intervals, which ascend.
/// Returns none if they do not fit.
///
/// `wanted` has the middle that each interval asks for, and its length. The sum of squared distances of the middles from
/// what they ask for is least. Inside one free interval no other heights have that sum.
pub(super) fn stack(wanted: &[[f64; 2]], free: &[[f64; 2]]) -> Option<Vec<f64>> {
    let n = wanted.len();
    // The best heights of the intervals from each one to the last, with their sum, in the free intervals seen so far.
    let mut best: Vec<Option<(f64, Vec<f64>)>> = vec![None; n + 1];
    best[n] = Some((0.0, Vec::new()));
    for (k, &bounds) in free.iter().enumerate().rev() {
        for i in 0..if k == 0 { n.min(1) } else { n } {
            let mut length = 0.0;
            for j in i + 1..=n {
                length += wanted[j - 1][1];
                if length > bounds[1] - bounds[0] {
                    break;
                }
                let Some((sum, above)) = &best[j] else { continue };
                let here = stack_between(&wanted[i..j], bounds);
                let sum = sum + sum_of_squares(&wanted[i..j], &here);
                if best[i].as_ref().is_none_or(|(least, _)| sum < *least) {
                    best[i] = Some((sum, [&here[..], above].concat()));
                }
            }
        }
    }
    best.swap_remove(0).map(|(_, heights)| heights)
}

/// Whether intervals of some lengths fit into free intervals, both in their order. [`stack`] finds heights if they do.
pub(super) fn is_room(lengths: impl IntoIterator<Item = f64>, free: &[[f64; 2]]) -> bool {
    let mut free = free.iter().map(|[low, high]| high - low);
    let (mut room, mut used) = (free.next(), 0.0);
    for length in lengths {
        used += length;
        while room.is_some_and(|room| used > room) {
            (room, used) = (free.next(), length);
        }
    }
    room.is_some()
}

/// The sum of squared distances of the middles of intervals from what they ask for.
fn sum_of_squares(wanted: &[[f64; 2]], lower: &[f64]) -> f64 {
    let distance = |(&[middle, length], lower): (&[f64; 2], &f64)| lower + length / 2.0 - middle;
    wanted.iter().zip(lower).map(distance).map(|distance| distance * distance).sum()
}

/// The heights of intervals between two bounds, whose lengths fit there.
///
/// With the lengths before each interval subtracted, the lower ends only have to ascend. So this is an isotonic
/// regression, and pooling adjacent violators solves it. Bounds clamp its solution.
fn stack_between(wanted: &[[f64; 2]], [low, high]: [f64; 2]) -> Vec<f64> {
    let mut before = 0.0;
    // Blocks of touching intervals: the sum of what they ask for, and their number.
    let mut blocks: Vec<(f64, usize)> = Vec::with_capacity(wanted.len());
    for &[middle, length] in wanted {
        let mut block = (middle - length / 2.0 - before, 1);
        before += length;
        while let Some(&(sum, n)) = blocks.last() {
            if sum / n as f64 <= block.0 / block.1 as f64 {
                break;
            }
            block = (sum + block.0, n + block.1);
            blocks.pop();
        }
        blocks.push(block);
    }
    let last = high - before;
    let starts = blocks.iter().flat_map(|&(sum, n)| std::iter::repeat_n((sum / n as f64).min(last).max(low), n));
    // The end of an interval is the start of the next one in a block, in the arithmetic of the boxes.
    let (mut before, mut end) = (0.0, low);
    let lower = starts.zip(wanted).map(|(start, &[_, length])| {
        let lower = f64::max(start + before, end);
        (before, end) = (before + length, lower + length);
        lower
    });
    lower.collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::philox::uniforms;

    /// The least sum over all heights on a grid, by trying each.
    fn by_trying(wanted: &[[f64; 2]], free: &[[f64; 2]], from: f64) -> f64 {
        let Some((&[middle, length], rest)) = wanted.split_first() else { return 0.0 };
        let heights = (0..=40)
            .map(f64::from)
            .filter(|low| *low >= from && free.iter().any(|[lo, hi]| lo <= low && low + length <= *hi));
        let sum = |low: f64| (low + length / 2.0 - middle).powi(2) + by_trying(rest, free, low + length);
        heights.map(sum).fold(f64::INFINITY, f64::min)
    }

    /// Heights on a grid are no better than those that are found, and there are none where none are found.
    #[test]
    fn heights_are_the_best_in_free_intervals() {
        let mut none = 0;
        for case in 0..300 {
            let [count, a, b, c] = uniforms(13, [case, 0, 0], 0);
            let mut wanted: Vec<[f64; 2]> = (0..1 + (count * 3.0) as u32)
                .map(|i| {
                    let [middle, length, ..] = uniforms(13, [case, 1, i], 0);
                    [40.0 * middle, 1.0 + (length * 12.0).floor()]
                })
                .collect();
            wanted.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let mut ends = [a, b, c, 0.5].map(|end| (end * 40.0).floor());
            ends.sort_by(f64::total_cmp);
            let free = [[0.0, ends[0]], [ends[1], ends[2]], [ends[3], 40.0]];
            let least = by_trying(&wanted, &free, 0.0);
            let found = stack(&wanted, &free);
            assert_eq!(found.is_some(), least.is_finite(), "{case}");
            assert_eq!(found.is_some(), is_room(wanted.iter().map(|[_, length]| *length), &free), "{case}");
            none += usize::from(found.is_none());
            let Some(found) = found else { continue };
            assert!(sum_of_squares(&wanted, &found) <= least + 1e-9, "{case}");
            let ends: Vec<f64> = found.iter().zip(&wanted).map(|(low, [_, length])| low + length).collect();
            assert!(found.iter().zip(&ends).all(|(a, b)| free.iter().any(|[lo, hi]| *lo <= *a && *b <= hi + 1e-9)));
            assert!(ends.iter().zip(&found[1..]).all(|(end, next)| end <= next));
        }
        assert!((10..200).contains(&none), "{none}");
    }
}
