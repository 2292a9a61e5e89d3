//! The nearest place on a line where the field has a value ([HATCH-7]).

/// A search along a line.
pub(super) struct RootSearch<F> {
    /// f(s) − target; none outside the field.
    pub over: F,
    /// |f − target| that is accepted as a root.
    pub tolerance: f64,
    /// Number of evaluations left.
    pub budget: u32,
}

/// A place on the line, and f − target there.
type Known = [f64; 2];

impl<F: Fn(f64) -> Option<f64>> RootSearch<F> {
    fn at(&mut self, s: f64) -> Option<f64> {
        self.budget = self.budget.checked_sub(1)?;
        (self.over)(s)
    }

    /// Returns the root next to s = 0 in [−reach, reach]. `steps` equidistant places to either side are evaluated,
    /// nearest first, and the first change of sign is refined.
    pub(super) fn nearest(&mut self, reach: f64, steps: u32) -> Option<f64> {
        let first = self.at(0.0)?;
        if first.abs() <= self.tolerance {
            return Some(0.0);
        }
        let mut before = [Some([0.0, first]); 2];
        for step in 1..=steps {
            let mut roots = [None; 2];
            for (way, sign) in [1.0, -1.0].into_iter().enumerate() {
                let Some(from) = before[way] else { continue };
                let s = sign * reach * (f64::from(step) / f64::from(steps));
                before[way] = self.at(s).map(|value| [s, value]);
                if let Some(to) = before[way].filter(|to| (to[1] > 0.0) != (first > 0.0)) {
                    roots[way] = self.between(from, to);
                    before[way] = None;
                }
            }
            match roots {
                [Some(a), Some(b)] => return Some(if a <= -b { a } else { b }),
                [a, b] if a.is_some() || b.is_some() => return a.or(b),
                [..] if before == [None; 2] => return None,
                [..] => {}
            }
        }
        None
    }

    /// Returns a root between two places whose values differ in sign. Secants replace Newton's steps, since an
    /// estimated gradient need not be the derivative. An end that stays twice gets less weight (Anderson and Björck
    /// 1973). Every fourth step halves the interval, so that no shape of the function slows the search down.
    fn between(&mut self, [mut a, mut at_a]: Known, [mut b, mut at_b]: Known) -> Option<f64> {
        if at_b.abs() <= self.tolerance {
            return Some(b);
        }
        let less = |new: f64, old: f64| if new / old < 1.0 { 1.0 - new / old } else { 0.5 };
        let mut before = None;
        for step in 1.. {
            let secant = a + (b - a) * (at_a / (at_a - at_b));
            let s = if step % 4 == 0 { a + 0.5 * (b - a) } else { secant };
            let value = self.at(s)?;
            if value.abs() <= self.tolerance {
                return Some(s);
            }
            let replaces_b = (value > 0.0) == (at_b > 0.0);
            let again = before == Some(replaces_b);
            if replaces_b {
                at_a *= if again { less(value, at_b) } else { 1.0 };
                (b, at_b) = (s, value);
            } else {
                at_b *= if again { less(value, at_a) } else { 1.0 };
                (a, at_a) = (s, value);
            }
            before = Some(replaces_b);
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    /// The root, and the number of evaluations.
    fn search(f: impl Fn(f64) -> Option<f64>, budget: u32) -> (Option<f64>, u32) {
        let asked = Cell::new(0);
        let over = |s: f64| {
            asked.set(asked.get() + 1);
            f(s)
        };
        let root = RootSearch { over, tolerance: 1e-12, budget }.nearest(2.0, 12);
        (root, asked.get())
    }

    #[test]
    fn the_nearest_of_several_roots() {
        // Both sides of a thin sheet: −0.5 and 0.3.
        let (root, asked) = search(|s| Some((s - 0.3) * (s + 0.5)), 60);
        assert!((root.unwrap() - 0.3).abs() < 1e-11 && asked <= 30, "{root:?} {asked}");
        // At the centre itself, and beyond the reach.
        assert_eq!(search(|s| Some(s.powi(3)), 60), (Some(0.0), 1));
        assert_eq!(search(|s| Some(s - 2.001), 60), (None, 25));
    }

    #[test]
    fn kinks_steps_and_borders() {
        // A slope that jumps a thousandfold at the root.
        let kink = |s: f64| Some(if s < 1.234 { s - 1.234 } else { 1e3 * (s - 1.234) });
        let (root, asked) = search(kink, 60);
        assert!((root.unwrap() - 1.234).abs() < 1e-11 && asked <= 60, "{asked}");
        // A jump has no root: the evaluations run out.
        assert_eq!(search(|s| Some(if s < 1.1 { -1.0 } else { 1.0 }), 60), (None, 60));
        // Outside the field nothing is found, inside it still is.
        assert_eq!(search(|s| (s > -0.2).then_some(s + 0.5), 60).0, None);
        assert!(search(|s| (s > -0.7).then_some(s + 0.5), 60).0.is_some());
    }
}
