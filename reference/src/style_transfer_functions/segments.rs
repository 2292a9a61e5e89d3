//! Where a value lies among the nodes of a piecewise-linear function ([STF-3]).

use crate::number::Real;

/// The nodes' positions, with a table of starting points so that finding a value does not depend on how many nodes
/// there are. The table only proposes; the nodes decide, so the result is exact.
#[derive(Clone, Debug, PartialEq)]
pub struct Segments<R> {
    at: Vec<R>,
    /// For each of the equal parts of [a₀, a_{N−1}] a node near its start.
    start: Vec<u32>,
    /// Parts per unit of value.
    parts_per_unit: R,
}

/// Nodes that make no function.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NodesError {
    /// There is none.
    #[error("a transfer function needs at least one node")]
    Empty,
    /// The lists differ in length.
    #[error("{at} positions, {opacity} opacities and {style} styles are not one of each per node")]
    Lengths {
        /// Number of positions.
        at: usize,
        /// Number of opacities.
        opacity: usize,
        /// Number of styles.
        style: usize,
    },
    /// A node stands before its predecessor.
    #[error("node {node} at {at} stands after a node at {before}; nodes stand in non-decreasing order")]
    Order {
        /// Which node, from 0.
        node: usize,
        /// Its position.
        at: f64,
        /// Its predecessor's.
        before: f64,
    },
    /// A position, or the distance from the first to the last, is not a finite number of this type.
    #[error("the nodes reach from {first} to {last}, which is not a finite range")]
    Range {
        /// The first position.
        first: f64,
        /// The last one, or the one at fault.
        last: f64,
    },
    /// An opacity outside [0, 1].
    #[error("node {node} has opacity {opacity}, which is not between 0 and 1")]
    Opacity {
        /// Which node, from 0.
        node: usize,
        /// Its opacity.
        opacity: f64,
    },
}

impl<R: Real> Segments<R> {
    /// From the nodes' positions in non-decreasing order.
    ///
    /// # Errors
    /// No node, a wrong order, or positions whose range is not finite.
    pub fn new(at: &[f64]) -> Result<Self, NodesError> {
        let (&first, &last) = at.first().zip(at.last()).ok_or(NodesError::Empty)?;
        if let Some(&odd) = at.iter().find(|a| !a.is_finite()) {
            return Err(NodesError::Range { first, last: odd });
        }
        if let Some(node) = (1..at.len()).find(|&k| at[k] < at[k - 1]) {
            return Err(NodesError::Order { node, at: at[node], before: at[node - 1] });
        }
        let at: Vec<R> = at.iter().map(|&a| R::from_f64(a)).collect();
        let span = (at[at.len() - 1] - at[0]).to_f64();
        if !span.is_finite() {
            return Err(NodesError::Range { first, last });
        }
        let parts = (4 * at.len()).min(1024);
        let per_unit = R::from_f64(parts as f64 / span);
        // A range of 0 or so small that this overflows has one part.
        let parts_per_unit = if per_unit.to_f64().is_finite() { per_unit } else { R::ZERO };
        let edge = |b: usize| at[0] + R::from_f64(span * (b as f64 / parts as f64));
        let start = (0..parts).map(|b| at.partition_point(|&a| a <= edge(b)).saturating_sub(1) as u32).collect();
        Ok(Self { at, start, parts_per_unit })
    }

    /// N.
    pub fn len(&self) -> usize {
        self.at.len()
    }

    /// Never true: a function has at least one node.
    pub fn is_empty(&self) -> bool {
        false
    }

    /// i(s) as its whole part k and its fraction: the last k with a_k ≤ s and (s − a_k)/(a_{k+1} − a_k). Before the
    /// first node and from the last one on the fraction is 0. Of nodes at one value the last one holds at the value
    /// itself. The fraction is not added to k, which would cost it the bits of k.
    #[inline]
    pub fn find(&self, s: R) -> (usize, R) {
        let last = self.at.len() - 1;
        if s >= self.at[last] {
            return (last, R::ZERO);
        }
        if s > self.at[0] {
            let (part, _) = ((s - self.at[0]) * self.parts_per_unit).split();
            let mut k = self.start[part.min(self.start.len() - 1)] as usize;
            while self.at[k] > s {
                k -= 1;
            }
            while self.at[k + 1] <= s {
                k += 1;
            }
            return (k, (s - self.at[k]) / (self.at[k + 1] - self.at[k]));
        }
        // At the first node or before it; a value that is not a number counts as before it.
        (self.at.partition_point(|&a| a <= s).saturating_sub(1), R::ZERO)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn by_hand() {
        let nodes = Segments::<f64>::new(&[60.0, 90.0, 180.0]).unwrap();
        assert_eq!(nodes.find(75.0), (0, 0.5));
        assert_eq!(nodes.find(90.0), (1, 0.0));
        assert_eq!(nodes.find(157.5), (1, 0.75));
        for (s, k) in [(-1e300, 0), (60.0, 0), (180.0, 2), (1e300, 2), (f64::NAN, 0)] {
            assert_eq!(nodes.find(s), (k, 0.0), "{s}");
        }
    }

    #[test]
    fn one_node_is_a_constant() {
        let nodes = Segments::<f64>::new(&[5.0]).unwrap();
        for s in [f64::NEG_INFINITY, 4.0, 5.0, 6.0, f64::INFINITY] {
            assert_eq!(nodes.find(s), (0, 0.0), "{s}");
        }
    }

    #[test]
    fn of_two_nodes_at_one_value_the_later_holds_at_the_value() {
        let nodes = Segments::<f64>::new(&[0.0, 10.0, 10.0, 20.0]).unwrap();
        let below = f64::from_bits(10f64.to_bits() - 1);
        let (k, t) = nodes.find(below);
        assert_eq!(k, 0);
        assert!(1.0 - t < 1e-15 && t < 1.0);
        assert_eq!(nodes.find(10.0), (2, 0.0));
        // A step at either end: the later node at the value, the earlier one only beyond it.
        let ends = Segments::<f64>::new(&[0.0, 0.0, 1.0, 1.0]).unwrap();
        assert_eq!(
            [-1.0, 0.0, 0.5, 1.0, 2.0].map(|s| ends.find(s)),
            [(0, 0.0), (1, 0.0), (1, 0.5), (3, 0.0), (3, 0.0)]
        );
    }

    #[test]
    fn what_is_no_function_is_refused() {
        let new = Segments::<f64>::new;
        assert_eq!(new(&[]), Err(NodesError::Empty));
        assert_eq!(new(&[1.0, 3.0, 2.0]), Err(NodesError::Order { node: 2, at: 2.0, before: 3.0 }));
        assert!(matches!(new(&[1.0, f64::NAN]), Err(NodesError::Range { .. })));
        assert_eq!(new(&[-1e308, 1e308]), Err(NodesError::Range { first: -1e308, last: 1e308 }));
        assert!(matches!(Segments::<f32>::new(&[0.0, 1e39]), Err(NodesError::Range { .. })));
        assert!(new(&[0.0, f64::from_bits(1)]).is_ok());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]
        /// The definition itself, by looking at every node; clusters put many nodes into one part of the table.
        #[test]
        fn agrees_with_the_definition(
            mut at in prop::collection::vec(prop_oneof![-1e3..1e3f64, 0.0..1e-6f64, Just(0.0), Just(7.0)], 1..40),
            s in prop::collection::vec(prop_oneof![-1.1e3..1.1e3f64, 0.0..1e-6f64], 20),
        ) {
            at.sort_by(f64::total_cmp);
            let nodes = Segments::<f64>::new(&at).unwrap();
            for &s in s.iter().chain(&at) {
                let expected = match at.iter().rposition(|&a| a <= s) {
                    None => (0, 0.0),
                    Some(k) if k + 1 == at.len() => (k, 0.0),
                    Some(k) => (k, (s - at[k]) / (at[k + 1] - at[k])),
                };
                prop_assert_eq!(nodes.find(s), expected);
            }
        }

        /// Values scaled by a power of two with their nodes give the same bits.
        #[test]
        fn a_power_of_two_changes_no_bit(s in -10.0..300.0f64, k in -300i32..300) {
            let scale = drypoint_scene::math::scale_by_power_of_two(1.0, k);
            let at = [0.1, 3.7, 3.7, 100.3, 255.0];
            let here = Segments::<f64>::new(&at).unwrap().find(s);
            prop_assert_eq!(Segments::<f64>::new(&at.map(|a| a * scale)).unwrap().find(s * scale), here);
        }
    }
}
