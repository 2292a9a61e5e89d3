//! Pareto fronts of settings ([COST-1]).

use super::{CostRow, Truth};

/// Returns the Pareto-optimal rows among those with the truth of a row, fastest first. No row of them is better in error
/// or time and at least as good in both. A row without error is one of them.
///
/// All rows against the formula have one truth. A finest setting is the truth of its own knob alone: the scene as it is
/// has an error by one knob and none by another.
pub fn front<'r>(rows: &'r [CostRow], of: &CostRow) -> Vec<&'r CostRow> {
    let of_truth: Vec<&CostRow> = rows.iter().filter(|row| have_one_truth(row, of)).collect();
    let mut front: Vec<&CostRow> =
        of_truth.iter().copied().filter(|row| !of_truth.iter().any(|other| is_better(other, row))).collect();
    front.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    front
}

/// Whether the errors of two rows are measured against the same truth.
pub(super) fn have_one_truth(a: &CostRow, b: &CostRow) -> bool {
    a.subject == b.subject && a.truth == b.truth && (a.truth == Truth::Analytic || a.knob == b.knob)
}

/// Whether the first row dominates the second.
fn is_better(a: &CostRow, b: &CostRow) -> bool {
    a.seconds <= b.seconds && a.rms <= b.rms && (a.seconds < b.seconds || a.rms < b.rms)
}

#[cfg(test)]
mod tests {
    use super::super::ErrorSubject;
    use super::*;
    use proptest::prelude::*;

    fn row(setting: &str, seconds: f64, rms: f64, truth: Truth) -> CostRow {
        CostRow {
            knob: "sampling.step".into(),
            subject: ErrorSubject::Picture,
            setting: setting.into(),
            own: false,
            rms,
            max: rms,
            flip: rms,
            angle: None,
            seconds,
            spread: 0.0,
            samples: 1,
            bytes: 1,
            truth,
        }
    }

    fn names(rows: &[CostRow], of: usize) -> Vec<&str> {
        front(rows, &rows[of]).iter().map(|row| row.setting.as_str()).collect()
    }

    #[test]
    fn what_is_slower_and_worse_is_not_on_it() {
        let finest = || Truth::Finest("d".into());
        let rows = [
            row("a", 1.0, 0.5, finest()),
            row("slow", 3.0, 0.5, finest()),
            row("b", 2.0, 0.1, finest()),
            row("equal but slower", 2.5, 0.1, finest()),
            row("worse in the same time", 2.0, 0.2, finest()),
            row("d", 9.0, 0.0, finest()),
            row("of another kind", 0.1, 0.01, Truth::Analytic),
            CostRow { subject: ErrorSubject::Dots, ..row("of dots", 0.1, 0.01, finest()) },
            CostRow { knob: "sampling.kernel".into(), ..row("of another knob", 0.1, 0.01, finest()) },
            CostRow { knob: "sampling.kernel".into(), ..row("of the formula", 0.2, 0.001, Truth::Analytic) },
        ];
        assert_eq!(names(&rows, 0), ["a", "b", "d"]);
        assert_eq!(names(&rows, 6), ["of another kind", "of the formula"]);
        assert_eq!(names(&rows, 7), ["of dots"]);
        assert_eq!(names(&rows, 8), ["of another knob"]);
    }

    /// Numbers in f32 take longer than those in f64, which are the truth.
    #[test]
    fn a_truth_that_is_faster_leaves_no_other() {
        let finest = || Truth::Finest("f64".into());
        let rows = [row("f32", 8.5, 1.6e-6, finest()), row("f64", 6.4, 0.0, finest())];
        assert_eq!(names(&rows, 0), ["f64"]);
    }

    proptest! {
        /// Few values, so that many are equal.
        #[test]
        fn no_row_of_it_is_dominated_and_every_other_is(places in prop::collection::vec((1..6u8, 0..5u8), 1..20)) {
            let rows: Vec<CostRow> =
                places.iter().map(|(s, e)| row("", f64::from(*s), f64::from(*e), Truth::Analytic)).collect();
            let front = front(&rows, &rows[0]);
            let dominated = |row: &CostRow| rows.iter().any(|other| {
                (other.seconds < row.seconds && other.rms <= row.rms)
                    || (other.seconds <= row.seconds && other.rms < row.rms)
            });
            for row in &rows {
                prop_assert_eq!(front.iter().any(|on| std::ptr::eq(*on, row)), !dominated(row));
            }
            prop_assert!(front.is_sorted_by(|a, b| a.seconds <= b.seconds && a.rms >= b.rms));
            // The fastest without error is always there.
            prop_assert!(rows.iter().all(|row| row.rms > 0.0) || front.iter().any(|row| row.rms == 0.0));
        }
    }
}
