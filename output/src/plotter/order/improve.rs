//! 2-opt and Or-opt moves between neighbours.

use super::neighbours::Neighbours;
use super::tour::Tour;
use std::collections::VecDeque;

/// Longest run that a move may turn or pass over: longer ones gain no more and cost their length.
const RUN: usize = 50_000;

/// Strokes that an Or-opt move takes along at most.
const TAKEN: usize = 3;

/// Stops that moves may change in all, for each stroke: far more than moves on a random page need, so that only a
/// contrived list ends here.
const BUDGET: usize = 10_000;

/// What a move must gain, in mm: more than rounding can.
const GAIN: f64 = 1e-7;

/// Shortens a tour until no move between neighbours does.
pub(super) fn improve(tour: &mut Tour) {
    let near = Neighbours::new(tour.ends());
    let mut waiting: VecDeque<usize> = tour.stops().map(|stop| stop.item).collect();
    let mut waits = vec![true; tour.len()];
    let mut budget = tour.len().saturating_mul(BUDGET);
    while let Some(item) = waiting.pop_front() {
        waits[item] = false;
        while let Some(touched) = near.of(item).find_map(|other| better(tour, item, other)) {
            let changed = touched.1 - touched.0;
            budget = budget.saturating_sub(changed);
            // Only at the ends of what has moved have strokes got new neighbours; a moved run lies at one of them.
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

/// Makes a move that brings two strokes together, if one gains; which positions have changed, from … to before.
fn better(tour: &mut Tour, item: usize, other: usize) -> Option<(usize, usize)> {
    let (p, q) = (tour.position(item), tour.position(other));
    turned(tour, p.min(q), p.max(q)).or_else(|| taken_along(tour, p, q))
}

/// 2-opt: the run between two strokes backwards, so that their ends meet, or their starts.
fn turned(tour: &mut Tour, p: usize, q: usize) -> Option<(usize, usize)> {
    if q - p > RUN {
        return None;
    }
    // Ends: p+1 … q turned. Starts: p … q−1 turned.
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

/// Or-opt: a run of up to three strokes that begins or ends at p goes before or after the stroke at q.
fn taken_along(tour: &mut Tour, p: usize, q: usize) -> Option<(usize, usize)> {
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
            // Before the stroke at `to`; next to itself there is nothing to gain.
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
