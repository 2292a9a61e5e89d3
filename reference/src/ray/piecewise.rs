//! Exact evaluation of a piecewise-linear opacity over values ([STF-3]).

use crate::number::Real;

/// Nodes of a transfer function, ready to be asked at every sample.
#[derive(Clone, Debug)]
pub struct Piecewise<R> {
    at: Vec<R>,
    opacity: Vec<R>,
    /// Whether the segment that begins at a node has an opacity above 0 somewhere; the last is beyond the last node.
    visible: Vec<bool>,
    /// For each of equal parts of the range of nodes, a node at or before every value in it.
    bucket: Vec<u32>,
    per_value: R,
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

const BUCKETS: usize = 256;

impl<R: Real> Piecewise<R> {
    /// Takes at least one node, in non-decreasing order of `at`.
    pub fn new(at: &[f64], opacity: &[f64]) -> Self {
        let at: Vec<R> = at.iter().map(|&a| R::from_f64(a)).collect();
        let opacity: Vec<R> = opacity.iter().map(|&a| R::from_f64(a)).collect();
        let n = at.len();
        let visible =
            (0..n).map(|k| opacity[k] > R::ZERO || (k + 1 < n && opacity[k + 1] > R::ZERO)).collect::<Vec<_>>();
        let width = at[n - 1].to_f64() - at[0].to_f64();
        let per_value = R::from_f64(if width > 0.0 { BUCKETS as f64 / width } else { 0.0 });
        let bucket = (0..=BUCKETS)
            .map(|b| {
                // One bucket back, so that no rounding of the index can begin after the value's own segment.
                let edge = at[0].to_f64() + width * (b as f64 - 1.0) / BUCKETS as f64;
                at.iter().rposition(|a| a.to_f64() <= edge).unwrap_or(0) as u32
            })
            .collect();
        Self { at, opacity, visible, bucket, per_value }
    }

    /// Where a value falls, or nothing where its α_u is 0.
    ///
    /// Values beyond the nodes take the end nodes; of two nodes at one value the later one holds there.
    #[inline(always)]
    pub fn locate(&self, s: R) -> Option<Place<R>> {
        let k = self.segment(s);
        if !self.visible[k] {
            return None;
        }
        let (a, o) = (self.at[k], self.opacity[k]);
        let (w, alpha_u) = if k + 1 == self.at.len() || s < a {
            (R::ZERO, o)
        } else {
            let w = (s - a) / (self.at[k + 1] - a);
            (w, R::lerp(o, self.opacity[k + 1], w))
        };
        (alpha_u > R::ZERO).then_some(Place { node: k, w, alpha_u })
    }

    /// The last node at or below a value; the first where there is none.
    #[inline(always)]
    fn segment(&self, s: R) -> usize {
        let last = self.at.len() - 1;
        if s >= self.at[last] {
            return last;
        }
        let offset = s - self.at[0];
        if offset < R::ZERO {
            return 0;
        }
        let mut k = self.bucket[(offset * self.per_value).split().0.min(BUCKETS)] as usize;
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

    proptest! {
        #[test]
        fn the_buckets_find_what_a_search_finds(
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
                prop_assert_eq!(f.segment(s), want);
            }
        }
    }
}
