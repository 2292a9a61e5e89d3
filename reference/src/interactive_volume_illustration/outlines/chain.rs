//! Segments of curves joined to chains.

/// Places along a curve, in order.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Chain {
    /// Keys of the places; at least two.
    pub(super) places: Vec<u64>,
    /// Whether the last place is joined to the first.
    pub(super) closed: bool,
}

/// Index of a missing place.
const NONE: usize = usize::MAX;

/// Joins segments whose end keys are equal. A place has at most two segments; a third one is left out.
///
/// Open chains come before closed ones, each group in the order of the smallest possible first key. A closed chain
/// starts at its smallest key and continues to the smaller of the two neighbours. So the result does not depend on
/// the order of the segments.
pub(super) fn chains(mut segments: Vec<[u64; 2]>) -> Vec<Chain> {
    segments.iter_mut().for_each(|segment| segment.sort_unstable());
    segments.sort_unstable();
    let mut keys: Vec<u64> = segments.iter().flatten().copied().collect();
    keys.sort_unstable();
    keys.dedup();
    // Each place gets links to its two neighbours, as long as both ends of a segment are free.
    let mut joined = vec![[NONE; 2]; keys.len()];
    for segment in segments {
        // `keys` contains every key of a segment.
        let [a, b] = segment.map(|key| keys.partition_point(|&k| k < key));
        let free = |i: usize| joined[i].iter().position(|&n| n == NONE);
        if let (Some(i), Some(j)) = (free(a), free(b)) {
            (joined[a][i], joined[b][j]) = (b, a);
        }
    }
    // Open chains start at places with one link. All places left over belong to rings.
    let mut is_used = vec![false; keys.len()];
    let mut chains = Vec::new();
    let ends = (0..keys.len()).filter(|&i| joined[i][1] == NONE && joined[i][0] != NONE);
    for (start, closed) in ends.map(|i| (i, false)).chain((0..keys.len()).map(|i| (i, true))) {
        if is_used[start] {
            continue;
        }
        let (mut places, mut before, mut at) = (Vec::new(), NONE, start);
        while at != NONE && !is_used[at] {
            is_used[at] = true;
            places.push(keys[at]);
            let [a, b] = joined[at];
            let next = if before == NONE {
                a.min(b)
            } else if a == before {
                b
            } else {
                a
            };
            (before, at) = (at, next);
        }
        if places.len() > 1 {
            chains.push(Chain { places, closed });
        }
    }
    chains
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chain(places: &[u64], closed: bool) -> Chain {
        Chain { places: places.to_vec(), closed }
    }

    #[test]
    fn open_and_closed_whatever_the_order() {
        let mut segments = vec![[7, 3], [3, 9], [9, 7], [20, 4], [4, 11], [11, 30]];
        let expected = [chain(&[20, 4, 11, 30], false), chain(&[3, 7, 9], true)];
        for _ in 0..segments.len() {
            segments.rotate_left(1);
            segments.iter_mut().for_each(|segment| segment.reverse());
            assert_eq!(chains(segments.clone()), expected);
        }
        assert_eq!(chains(Vec::new()), []);
    }

    #[test]
    fn a_third_segment_is_left_out() {
        assert_eq!(chains(vec![[1, 2], [1, 3], [1, 4]]), [chain(&[2, 1, 3], false)]);
    }
}
