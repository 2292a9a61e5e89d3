//! 2-opt and Or-opt moves between neighbours.

use super::neighbours::Neighbours;
use super::tour::Tour;
use std::collections::VecDeque;

/// Longest run of strokes that a move may reverse or pass over. Longer runs take more time and gain nothing.
const RUN: usize = 50_000;

/// Most strokes that an Or-opt move takes along.
const TAKEN: usize = 3;

/// Most positions that all moves may change, for each stroke. Only contrived lists reach the limit.
const BUDGET: usize = 10_000;

/// Least gain of a move, in mm: more than rounding can make.
const GAIN: f64 = 1e-7;

/// Shortens a tour until no move between neighbours gains.
pub(super) fn improve(tour: &mut Tour) {
    let near = Neighbours::new(tour.ends());
    let mut waiting: VecDeque<usize> = tour.stops().map(|stop| stop.item).collect();
    let mut waits = vec![true; tour.len()];
    let mut budget = tour.len().saturating_mul(BUDGET);
    while let Some(item) = waiting.pop_front() {
        waits[item] = false;
        while let Some(touched) = near.of(item).find_map(|other| improving_move(tour, item, other)) {
            let changed = touched.1 - touched.0;
            budget = budget.saturating_sub(changed);
            // Only strokes at the ends of the changed range have new neighbours. A moved run lies at one of these ends.
            let (first, last) = (touched.0.saturating_sub(1), touched.1.min(tour.len() - 1));
            let ends = (first..=last).take(TAKEN + 2).chain((first..=last).rev().take(TAKEN + 2));
            for other in ends.map(|position| tour.item(position)) {
                if !std::mem::replace(&mut waits[other], true) {
                    waiting.push_back(other);
                }
            }
        }
        if budget == 0 {
            return;
        }
    }
}

/// Makes a move that brings two strokes together, if such a move shortens the tour. Returns the half-open range of
/// changed positions.
fn improving_move(tour: &mut Tour, item: usize, other: usize) -> Option<(usize, usize)> {
    let (p, q) = (tour.position(item), tour.position(other));
    two_opt(tour, p.min(q), p.max(q)).or_else(|| or_opt(tour, p, q))
}

/// 2-opt: reverses the run between two strokes, so that their ends meet, or their starts.
fn two_opt(tour: &mut Tour, p: usize, q: usize) -> Option<(usize, usize)> {
    if q - p > RUN {
        return None;
    }
    // The ends meet if p+1 … q is reversed, the starts if p … q−1 is.
    for (first, last) in [(p + 1, q), (p, q - 1)] {
        let (before, after) = (tour.before(first), tour.stop(last));
        let old = tour.on_to(before, first) + tour.on_to(after, last + 1);
        let new = before.distance(after) + tour.on_to(tour.start(first), last + 1);
        if first <= last && old - new > GAIN {
            tour.turn(first, last);
            return Some((first, last + 1));
        }
    }
    None
}

/// Or-opt: moves a run of up to three strokes that begins or ends at p before or after the stroke at q.
fn or_opt(tour: &mut Tour, p: usize, q: usize) -> Option<(usize, usize)> {
    if p.abs_diff(q) > RUN {
        return None;
    }
    for taken in 1..=TAKEN {
        for (first, last) in [(Some(p), p + taken - 1), ((p + 1).checked_sub(taken), p)] {
            let Some(first) = first.filter(|_| last < tour.len()) else { continue };
            if (first..=last).contains(&q) {
                continue;
            }
            let (start, stop, before) = (tour.start(first), tour.stop(last), tour.before(first));
            let freed = before.distance(start) + tour.on_to(stop, last + 1) - tour.on_to(before, last + 1);
            if freed <= GAIN {
                continue;
            }
            // The run goes before the stroke at `to`. Beside itself there is nothing to gain.
            for to in [q, q + 1].into_iter().filter(|&to| to < first || to > last + 1) {
                let place = tour.before(to);
                let old = tour.on_to(place, to);
                for (turned, begin, end) in [(false, start, stop), (true, stop, start)] {
                    let new = place.distance(begin) + tour.on_to(end, to);
                    if freed + old - new > GAIN {
                        tour.shift(first, last, to, turned);
                        return Some((first.min(to), (last + 1).max(to)));
                    }
                }
            }
        }
    }
    None
}
