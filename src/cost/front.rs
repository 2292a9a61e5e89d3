//! Pareto fronts of settings ([COST-1]).

use super::{CostRow, ErrorSubject, Truth};

/// Returns the Pareto-optimal rows, fastest first. No other row of the same subject and kind of truth is better in
/// error or time and at least as good in both.
///
/// Against the formula all rows have one truth. Against finest settings a row's error is the error of its own knob, and
/// the front tells which knob to change first. A row without error is its own truth and is on no front.
pub fn front(rows: &[CostRow], subject: ErrorSubject, analytic: bool) -> Vec<&CostRow> {
    let mut of_kind: Vec<&CostRow> = rows
        .iter()
        .filter(|r| r.subject == subject && (r.truth == Truth::Analytic) == analytic && r.rms > 0.0)
        .collect();
    of_kind.sort_by(|a, b| a.seconds.total_cmp(&b.seconds).then(a.rms.total_cmp(&b.rms)));
    let mut least = f64::INFINITY;
    of_kind.retain(|row| {
        let better = row.rms < least;
        least = least.min(row.rms);
        better
    });
    of_kind
}

#[cfg(test)]
mod tests {
    use super::*;

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
        ];
        let names = |analytic| {
            front(&rows, ErrorSubject::Picture, analytic).iter().map(|row| row.setting.clone()).collect::<Vec<_>>()
        };
        assert_eq!(names(false), ["a", "b"]);
        assert_eq!(names(true), ["of another kind"]);
        assert!(front(&[], ErrorSubject::Picture, true).is_empty());
    }
}
