//! Exact evaluation of a piecewise-linear opacity over values ([STF-3]).

use crate::number::Real;

/// Nodes of a transfer function, ready to be asked at every sample.
#[derive(Clone, Debug)]
pub struct Piecewise<R> {
    at: Vec<R>,
    opacity: Vec<R>,
    /// What is known beforehand of each of equal parts of the range of nodes.
    parts: Vec<Part>,
    per_value: R,
}

/// One part of the range, with its neighbours, so that no rounding of a value's part matters.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Part {
    /// Every value in it has α_u = 0.
    Invisible,
    /// Every value in it lies in the segment that begins at this node.
    Segment(u32),
    /// A node lies in it: the segment is this one or a later one.
    From(u32),
}

/// Where a value falls between the nodes: i(s) = node + w.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place<R> {
    /// i₀ = ⌊i⌋.
    pub node: usize,
    /// w = i − i₀, in [0, 1).
    pub w: R,
    /// α_u, above 0.
    pub alpha_u: R,
}

/// Enough that parts with a node in them are rare; 8 KiB.
const PARTS: usize = 1024;

impl<R: Real> Piecewise<R> {
    /// Takes at least one node, in non-decreasing order of `at`.
    pub fn new(at: &[f64], opacity: &[f64]) -> Self {
        let at: Vec<R> = at.iter().map(|&a| R::from_f64(a)).collect();
        let opacity: Vec<R> = opacity.iter().map(|&a| R::from_f64(a)).collect();
        let (first, last) = (at[0].to_f64(), at[at.len() - 1].to_f64());
        let width = last - first;
        let per_value = if width > 0.0 { PARTS as f64 / width } else { 0.0 };
        let segment = |v: f64| at.iter().rposition(|a| a.to_f64() <= v).unwrap_or(0);
        let parts = (0..=PARTS)
            .map(|part| {
                let edge = |n: f64| first + width * (part as f64 + n) / PARTS as f64;
                let (from, to) = (segment(edge(-1.0)), segment(edge(2.0)));
                let reached = &opacity[from..=(to + 1).min(at.len() - 1)];
                if reached.iter().all(|&a| a <= R::ZERO) {
                    Part::Invisible
                } else if from == to && edge(-1.0) >= first {
                    Part::Segment(from as u32)
                } else {
                    Part::From(from as u32)
                }
            })
            .collect();
        // A width whose reciprocal is not finite is too narrow for parts.
        let per_value = R::from_f64(if per_value.is_finite() { per_value } else { 0.0 });
        Self { at, opacity, parts, per_value }
    }

    /// Where a value falls, or nothing where its α_u is 0.
    ///
    /// Values beyond the nodes take the end nodes; of two nodes at one value the later one holds there.
    #[inline(always)]
    pub fn locate(&self, s: R) -> Option<Place<R>> {
        let last = self.at.len() - 1;
        let k = if s >= self.at[last] {
            last
        } else if s < self.at[0] {
            0
        } else {
            match self.parts[((s - self.at[0]) * self.per_value).split().0.min(PARTS)] {
                Part::Invisible => return None,
                Part::Segment(k) => k as usize,
                Part::From(k) => self.search(s, k as usize),
            }
        };
        let (a, o) = (self.at[k], self.opacity[k]);
        let (w, alpha_u) = if k == last || s < a {
            (R::ZERO, o)
        } else {
            let w = (s - a) / (self.at[k + 1] - a);
            (w, R::lerp(o, self.opacity[k + 1], w))
        };
        (alpha_u > R::ZERO).then_some(Place { node: k, w, alpha_u })
    }

    /// The last node at or below a value that is less than the last node's, beginning at one of its predecessors.
    fn search(&self, s: R, mut k: usize) -> usize {
        while s >= self.at[k + 1] {
            k += 1;
        }
        k
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn nodes_steps_and_ends_by_hand() {
        // Values below 10 take node 0; the step at 20 belongs to its later node; beyond 40 the last node holds.
        let f = Piecewise::new(&[10.0, 20.0, 20.0, 40.0], &[0.25, 0.25, 1.0, 0.5]);
        let at = |s: f64| f.locate(s).unwrap();
        assert_eq!(at(-5.0), Place { node: 0, w: 0.0, alpha_u: 0.25 });
        assert_eq!(at(15.0), Place { node: 0, w: 0.5, alpha_u: 0.25 });
        assert_eq!(at(20.0), Place { node: 2, w: 0.0, alpha_u: 1.0 });
        assert_eq!(at(30.0), Place { node: 2, w: 0.5, alpha_u: 0.75 });
        assert_eq!(at(40.0), Place { node: 3, w: 0.0, alpha_u: 0.5 });
        assert_eq!(at(1e300), Place { node: 3, w: 0.0, alpha_u: 0.5 });
    }

    #[test]
    fn one_node_and_all_nodes_at_one_value() {
        let one = Piecewise::new(&[7.0], &[0.5]);
        assert_eq!([0.0, 7.0, 9.0].map(|s| one.locate(s).unwrap().alpha_u), [0.5; 3]);
        let stacked = Piecewise::new(&[7.0, 7.0, 7.0], &[0.1, 0.2, 0.3]);
        assert_eq!(stacked.locate(6.9).unwrap().alpha_u, 0.1);
        assert_eq!(stacked.locate(7.0).unwrap().alpha_u, 0.3);
    }

    #[test]
    fn nothing_where_the_opacity_is_zero() {
        let f = Piecewise::new(&[0.0, 10.0, 20.0], &[0.0, 0.0, 1.0]);
        assert_eq!(f.locate(5.0), None);
        assert_eq!(f.locate(10.0), None);
        assert!(f.locate(10.000_001).is_some());
    }

    /// α_u by its definition.
    fn opacity_of(at: &[f64], opacity: &[f64], s: f64) -> f64 {
        match at.iter().rposition(|&a| a <= s) {
            None => opacity[0],
            Some(k) if k + 1 == at.len() => opacity[k],
            Some(k) => opacity[k] + (s - at[k]) / (at[k + 1] - at[k]) * (opacity[k + 1] - opacity[k]),
        }
    }

    proptest! {
        #[test]
        fn what_is_known_beforehand_changes_no_bit(
            mut at in prop::collection::vec(0..40u8, 1..9),
            opacity in prop::collection::vec(prop_oneof![Just(0.0), 0.0..=1.0f64], 9),
            s in -5.0..45.0f64,
        ) {
            at.sort_unstable();
            let at: Vec<f64> = at.into_iter().map(f64::from).collect();
            let f = Piecewise::new(&at, &opacity[..at.len()]);
            for s in [s, s.round()] {
                let got = f.locate(s).map_or(0.0, |place| place.alpha_u);
                prop_assert_eq!(got, opacity_of(&at, &opacity, s));
            }
        }

        #[test]
        fn the_parts_find_what_a_search_finds(
            mut at in prop::collection::vec(-1e3..1e3f64, 1..12),
            s in -2e3..2e3f64,
            pick in 0usize..12,
            scale in -300i32..300,
        ) {
            at.sort_by(f64::total_cmp);
            let factor = 2f64.powi(scale);
            let at: Vec<f64> = at.iter().map(|a| a * factor).collect();
            let f = Piecewise::new(&at, &vec![1.0; at.len()]);
            for s in [s * factor, at[pick % at.len()]] {
                let want = at.iter().rposition(|&a| a <= s).unwrap_or(0);
                prop_assert_eq!(f.locate(s).map(|place| place.node), Some(want));
            }
        }
    }
}
