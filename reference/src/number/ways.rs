//! Open comparisons, evaluated both ways.
//!
//! If errors leave a comparison of two [`Bounded`] numbers open, an f32 renderer may decide it the other way.
//! [`follow`] runs a computation once by the values, and once more for each other way. If a formula is continuous where
//! it branches, the intervals of its results overlap, and their union is its bound. Disjoint results are a jump, which
//! depends on a [`Decision`].
//!
//! Minimum, maximum and clamping are no comparisons in this sense, because their intervals are known. Outside
//! [`follow`] every comparison uses the values.

use super::{Bounded, Decision};
use std::cell::RefCell;
use std::cmp::Ordering;

/// The most runs of one computation.
const MOST: usize = 256;

thread_local! {
    static RUN: RefCell<Option<Run>> = const { RefCell::new(None) };
}

/// One run of a computation.
#[derive(Default)]
struct Run {
    /// The indices of the ways to take at the first open comparisons. Later comparisons take way 0.
    script: Vec<usize>,
    made: Vec<Choice>,
}

/// An open comparison.
#[derive(Clone, Copy)]
struct Choice {
    kind: Kind,
    /// The values that were compared.
    pair: [u64; 2],
    /// The number of ways, and the index of the one that was taken.
    ways: usize,
    taken: usize,
    outcome: Ordering,
    decision: Decision,
}

/// The kinds of comparisons.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Order,
    Other(Decision),
}

/// The results of a computation.
pub struct Ways<T> {
    /// The result by the values.
    pub by_value: T,
    /// The results of the other ways, with the decision that differs.
    pub others: Vec<(T, Decision)>,
    /// Whether some ways were left out, because there were too many.
    pub too_many: bool,
}

impl Run {
    /// Chooses a way at an open comparison. A comparison of the same two values has one outcome throughout a run.
    fn take(&mut self, kind: Kind, pair: [&Bounded; 2], ways: &[Ordering], decision: Decision) -> Ordering {
        let pair = pair.map(|number| number.value().to_bits());
        for made in self.made.iter().filter(|made| made.kind == kind) {
            if made.pair == pair {
                return made.outcome;
            }
            if kind == Kind::Order && made.pair == [pair[1], pair[0]] {
                return made.outcome.reverse();
            }
        }
        let taken = self.script.get(self.made.len()).copied().unwrap_or(0).min(ways.len() - 1);
        let outcome = ways[taken];
        self.made.push(Choice { kind, pair, ways: ways.len(), taken, outcome, decision });
        outcome
    }

    /// Scripts that differ from this run at one of its comparisons from the `from`-th on.
    fn branches(&self, from: usize) -> impl Iterator<Item = Vec<usize>> + '_ {
        let taken = |j: usize| self.made[..j].iter().map(|choice| choice.taken);
        (from..self.made.len())
            .flat_map(move |j| (1..self.made[j].ways).map(move |way| taken(j).chain([way]).collect::<Vec<_>>()))
    }

    /// The decision in which the run differs from the run by the values. Decisions other than `Step` come first.
    fn decision(&self) -> Decision {
        let mut others = self.made.iter().filter(|choice| choice.taken > 0).map(|choice| choice.decision);
        others.find(|&decision| decision != Decision::Step).unwrap_or_default()
    }
}

/// The order of two numbers.
pub(super) fn order(a: &Bounded, b: &Bounded) -> Option<Ordering> {
    use Ordering::{Equal, Greater, Less};
    let by_value = a.by_value(b)?;
    if !a.is_open(b) {
        return Some(by_value);
    }
    let decision = if a.decision() == Decision::Step { b.decision() } else { a.decision() };
    let ways: &[Ordering] = match by_value {
        Less => &[Less, Greater],
        Greater => &[Greater, Less],
        Equal => &[Equal, Less, Greater],
    };
    Some(RUN.with_borrow_mut(|run| match run {
        Some(run) => run.take(Kind::Order, [a, b], ways, decision),
        None => by_value,
    }))
}

/// The outcome of an open comparison of another kind.
pub(crate) fn choose(by_value: bool, [a, b]: [Bounded; 2], decision: Decision) -> bool {
    let order = |outcome| if outcome { Ordering::Greater } else { Ordering::Less };
    RUN.with_borrow_mut(|run| match run {
        Some(run) => {
            let ways = [order(by_value), order(!by_value)];
            run.take(Kind::Other(decision), [&a, &b], &ways, decision) == Ordering::Greater
        }
        None => by_value,
    })
}

/// Runs a computation on all open ways. The run by the values is the first one, and is repeated as the last one. So the
/// state that the computation keeps outside its result is as if there had been no other run.
pub fn follow<T>(mut compute: impl FnMut() -> T) -> Ways<T> {
    let mut run = |script: Vec<usize>| {
        RUN.set(Some(Run { script, made: Vec::new() }));
        let result = compute();
        (result, RUN.take().unwrap_or_default())
    };
    let (mut by_value, first) = run(Vec::new());
    let mut scripts: Vec<Vec<usize>> = first.branches(0).collect();
    let (mut others, mut too_many) = (Vec::new(), false);
    while let Some(script) = scripts.pop() {
        if others.len() == MOST {
            too_many = true;
            break;
        }
        let from = script.len();
        let (result, run) = run(script);
        scripts.extend(run.branches(from));
        others.push((result, run.decision()));
    }
    if !others.is_empty() {
        by_value = run(Vec::new()).0;
    }
    Ways { by_value, others, too_many }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::{Arithmetic, Real};

    /// A number that is known to a tenth.
    fn about(x: f64) -> Bounded {
        Bounded::new(x, 0.1)
    }

    /// Results by value and of other ways, in the order of their numbers.
    fn all<T: PartialOrd + Copy>(compute: impl FnMut() -> T) -> Vec<T> {
        let ways = follow(compute);
        let mut all: Vec<T> = [ways.by_value].into_iter().chain(ways.others.iter().map(|other| other.0)).collect();
        all[1..].sort_by(|a, b| a.partial_cmp(b).unwrap());
        all
    }

    #[test]
    fn open_comparisons_go_both_ways_and_others_one() {
        assert_eq!(all(|| about(1.0) < about(1.15)), [true, false]);
        assert_eq!(all(|| about(1.0) < about(1.25)), [true]);
        assert_eq!(all(|| Bounded::exact(1.0) < Bounded::exact(1.0)), [false]);
        assert_eq!(all(|| about(1.0) <= about(1.0)), [true, false, true]);
        assert_eq!(all(|| about(2.95).to_index()), [2, 3]);
        assert_eq!(all(|| about(3.05).to_index()), [3, 2]);
        assert_eq!(all(|| about(0.05).to_index()), [0]);
        assert_eq!(all(|| about(2.5).to_index()), [2]);
    }

    /// Outside nothing is open.
    #[test]
    fn by_the_values() {
        assert!(about(1.0) < about(1.01) && about(1.0) == about(1.0));
        assert_eq!(about(2.99).to_index(), 2);
    }

    /// Two comparisons make four ways; the same one twice makes two, whatever its direction.
    #[test]
    fn the_same_values_have_one_outcome() {
        let [a, b, c] = [1.0, 1.01, 1.02].map(about);
        assert_eq!(all(|| (u8::from(a < b), u8::from(b < c))), [(1, 1), (0, 0), (0, 1), (1, 0)]);
        assert_eq!(all(|| (u8::from(a < b), u8::from(b > a))), [(1, 1), (0, 0)]);
    }

    /// Ways that only open on another way are found.
    #[test]
    fn ways_open_on_ways() {
        let found = all(|| if about(1.0) < about(1.1) { 0 } else { 1 + u8::from(about(5.0) < about(5.01)) });
        assert_eq!(found, [0, 1, 2]);
    }

    #[test]
    fn decisions_are_named_and_many_are_too_many() {
        let ways = follow(|| about(1.0).deciding(Decision::Tone) < about(1.05));
        assert_eq!(ways.others.iter().map(|other| other.1).collect::<Vec<_>>(), [Decision::Tone]);
        let ways = follow(|| (0..9).all(|i| about(f64::from(i)) <= about(f64::from(i) + 0.01)));
        assert!(!ways.too_many, "each that fails is the last one");
        let ways = follow(|| (0..9).filter(|&i| about(f64::from(i)) <= about(f64::from(i) + 0.01)).count());
        assert!(ways.too_many);
    }

    /// The computation keeps what the run by the values leaves.
    #[test]
    fn the_last_run_is_by_the_values() {
        let mut kept = 0;
        follow(|| kept = about(2.95).to_index());
        assert_eq!(kept, 2);
    }
}
