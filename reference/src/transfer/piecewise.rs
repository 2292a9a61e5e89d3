//! Exact evaluation of a piecewise-linear opacity over values ([STF-3]).

use crate::number::Real;

/// Nodes of a transfer function, ready to be asked at every sample. What is prepared only proposes: the nodes decide, so
/// the result is exact.
#[derive(Clone, Debug)]
pub struct Piecewise<R> {
    at: Vec<R>,
    opacity: Vec<R>,
    /// The last of the nodes at the first node's value.
    at_first: usize,
    /// What is known beforehand of each of equal parts of the range of nodes.
    parts: Vec<Part>,
    parts_per_unit: R,
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

/// Where a value falls between the nodes: i(s) = node + w. The fraction is not added to the node, which would cost it
/// bits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place<R> {
    /// i₀ = ⌊i⌋.
    pub node: usize,
    /// w = i − i₀, in [0, 1]: a value just below a node can round to the whole way.
    pub w: R,
    /// α_u, above 0; in a row of a function over two quantities it may be 0.
    pub alpha_u: R,
}

/// Nodes that make no function.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NodesError {
    /// There is none.
    #[error("a transfer function needs at least one node")]
    Empty,
    /// The lists differ in length.
    #[error("{at} positions and {opacity} opacities are not one of each per node")]
    Lengths {
        /// Number of positions.
        at: usize,
        /// Number of opacities.
        opacity: usize,
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

/// Enough that parts with a node in them are rare; 8 KiB.
const PARTS: usize = 1024;

impl<R: Real> Piecewise<R> {
    /// From nodes in non-decreasing order of `at`, with opacities in [0, 1].
    ///
    /// # Errors
    /// No node, lists of different length, a wrong order, positions whose range is not finite, an opacity outside
    /// [0, 1].
    pub fn new(at: &[f64], opacity: &[f64]) -> Result<Self, NodesError> {
        check::<R>(at, opacity)?;
        let at: Vec<R> = at.iter().map(|&a| R::from_f64(a)).collect();
        let opacity: Vec<R> = opacity.iter().map(|&a| R::from_f64(a)).collect();
        let (first, last) = (at[0].to_f64(), at[at.len() - 1].to_f64());
        let width = (at[at.len() - 1] - at[0]).to_f64();
        let segment = |v: f64| at.iter().rposition(|a| a.to_f64() <= v).unwrap_or(0);
        let parts = (0..=PARTS)
            .map(|part| {
                let edge = |n: f64| first + width * ((part as f64 + n) / PARTS as f64);
                let (from, to) = (segment(edge(-1.0)), segment(edge(2.0).min(last)));
                let reached = &opacity[from..=(to + 1).min(at.len() - 1)];
                if reached.iter().all(|&a| a == R::ZERO) {
                    Part::Invisible
                } else if from == to && edge(-1.0) >= first && to + 1 < at.len() {
                    Part::Segment(from as u32)
                } else {
                    Part::From(from as u32)
                }
            })
            .collect();
        // A range of 0, or so small that this overflows, has one part, in which every node is searched.
        let per_unit = R::from_f64(PARTS as f64 / width);
        let (parts, parts_per_unit) =
            if per_unit.to_f64().is_finite() { (parts, per_unit) } else { (vec![Part::From(0); PARTS + 1], R::ZERO) };
        let at_first = at.partition_point(|&a| a <= at[0]) - 1;
        Ok(Self { at, opacity, at_first, parts, parts_per_unit })
    }

    /// Where a value falls, or nothing where its α_u is 0.
    ///
    /// Values beyond the nodes take the end nodes; of nodes at one value the last one holds at the value itself. What
    /// is not a number counts as before the first node.
    #[inline(always)]
    pub fn locate(&self, s: R) -> Option<Place<R>> {
        let last = self.at.len() - 1;
        let (node, w) = if s >= self.at[last] {
            (last, R::ZERO)
        } else if s > self.at[0] {
            let part = ((s - self.at[0]) * self.parts_per_unit).split().0.min(PARTS);
            let k = match self.parts[part] {
                Part::Invisible => return None,
                Part::Segment(k) => k as usize,
                Part::From(k) => self.search(s, k as usize),
            };
            (k, (s - self.at[k]) / (self.at[k + 1] - self.at[k]))
        } else {
            (if s == self.at[0] { self.at_first } else { 0 }, R::ZERO)
        };
        let o = self.opacity[node];
        let alpha_u = if w == R::ZERO { o } else { R::lerp(o, self.opacity[node + 1], w) };
        (alpha_u > R::ZERO).then_some(Place { node, w, alpha_u })
    }

    /// The last node at or below a value that is less than the last node's, beginning at one of its predecessors.
    fn search(&self, s: R, mut k: usize) -> usize {
        while s >= self.at[k + 1] {
            k += 1;
        }
        k
    }
}

/// Whether nodes make a function: at least one, an opacity in [0, 1] for each, in non-decreasing order, and positions
/// whose range is finite in this type.
pub(super) fn check<R: Real>(at: &[f64], opacity: &[f64]) -> Result<(), NodesError> {
    let (&lowest, &highest) = at.first().zip(at.last()).ok_or(NodesError::Empty)?;
    if at.len() != opacity.len() {
        return Err(NodesError::Lengths { at: at.len(), opacity: opacity.len() });
    }
    if let Some(node) = opacity.iter().position(|a| !(0.0..=1.0).contains(a)) {
        return Err(NodesError::Opacity { node, opacity: opacity[node] });
    }
    if let Some(&odd) = at.iter().find(|a| !a.is_finite()) {
        return Err(NodesError::Range { first: lowest, last: odd });
    }
    if let Some(node) = (1..at.len()).find(|&k| at[k] < at[k - 1]) {
        return Err(NodesError::Order { node, at: at[node], before: at[node - 1] });
    }
    if !(R::from_f64(highest) - R::from_f64(lowest)).to_f64().is_finite() {
        return Err(NodesError::Range { first: lowest, last: highest });
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn opaque(at: &[f64]) -> Piecewise<f64> {
        Piecewise::new(at, &vec![1.0; at.len()]).unwrap()
    }

    /// Node and fraction of values of a function that is visible everywhere.
    fn find<const N: usize>(at: &[f64], values: [f64; N]) -> [(usize, f64); N] {
        let f = opaque(at);
        values.map(|s| f.locate(s).map(|p| (p.node, p.w)).unwrap())
    }

    #[test]
    fn nodes_steps_and_ends_by_hand() {
        // Values below 10 take node 0; the step at 20 belongs to its later node; beyond 40 the last node holds.
        let f = Piecewise::new(&[10.0, 20.0, 20.0, 40.0], &[0.25, 0.25, 1.0, 0.5]).unwrap();
        let at = |s: f64| f.locate(s).unwrap();
        assert_eq!(at(-5.0), Place { node: 0, w: 0.0, alpha_u: 0.25 });
        assert_eq!(at(15.0), Place { node: 0, w: 0.5, alpha_u: 0.25 });
        assert_eq!(at(20.0), Place { node: 2, w: 0.0, alpha_u: 1.0 });
        assert_eq!(at(30.0), Place { node: 2, w: 0.5, alpha_u: 0.75 });
        assert_eq!(at(40.0), Place { node: 3, w: 0.0, alpha_u: 0.5 });
        assert_eq!(at(1e300), Place { node: 3, w: 0.0, alpha_u: 0.5 });
        assert_eq!(at(f64::NAN), Place { node: 0, w: 0.0, alpha_u: 0.25 });
    }

    #[test]
    fn one_node_and_nodes_at_one_value() {
        assert_eq!(find(&[7.0], [f64::NEG_INFINITY, 7.0, f64::INFINITY]), [(0, 0.0); 3]);
        assert_eq!(find(&[7.0, 7.0, 7.0], [6.9, 7.0]), [(0, 0.0), (2, 0.0)]);
        // A step at either end: the later node at the value, the earlier one only beyond it.
        let ends = find(&[0.0, 0.0, 1.0, 1.0], [-1.0, 0.0, 0.5, 1.0, 2.0]);
        assert_eq!(ends, [(0, 0.0), (1, 0.0), (1, 0.5), (3, 0.0), (3, 0.0)]);
        let [(k, w)] = find(&[0.0, 10.0, 10.0, 20.0], [10f64.next_down()]);
        assert!(k == 0 && 1.0 - w < 1e-15);
    }

    #[test]
    fn nothing_where_the_opacity_is_zero() {
        let f = Piecewise::new(&[0.0, 10.0, 20.0], &[0.0, 0.0, 1.0]).unwrap();
        assert_eq!(f.locate(5.0), None);
        assert_eq!(f.locate(10.0), None);
        assert!(f.locate(10.000_001).is_some());
    }

    #[test]
    fn what_is_no_function_is_refused() {
        let new = |at: &[f64]| Piecewise::<f64>::new(at, &vec![1.0; at.len()]).map(|_| ());
        assert_eq!(new(&[]), Err(NodesError::Empty));
        assert_eq!(new(&[1.0, 3.0, 2.0]), Err(NodesError::Order { node: 2, at: 2.0, before: 3.0 }));
        assert!(matches!(new(&[1.0, f64::NAN]), Err(NodesError::Range { .. })));
        assert_eq!(new(&[-1e308, 1e308]), Err(NodesError::Range { first: -1e308, last: 1e308 }));
        assert!(matches!(Piecewise::<f32>::new(&[0.0, 1e39], &[1.0; 2]), Err(NodesError::Range { .. })));
        assert!(new(&[0.0, f64::from_bits(1)]).is_ok());
        let with = |opacity: &[f64]| Piecewise::<f64>::new(&[0.0, 1.0], opacity).map(|_| ());
        assert_eq!(with(&[0.5]), Err(NodesError::Lengths { at: 2, opacity: 1 }));
        assert_eq!(with(&[0.5, 1.5]), Err(NodesError::Opacity { node: 1, opacity: 1.5 }));
        assert!(with(&[f64::NAN, 0.0]).is_err());
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
        #![proptest_config(ProptestConfig::with_cases(200))]
        #[test]
        fn what_is_known_beforehand_changes_no_bit(
            mut at in prop::collection::vec(0..40u8, 1..9),
            opacity in prop::collection::vec(prop_oneof![Just(0.0), 0.0..=1.0f64], 9),
            s in -5.0..45.0f64,
        ) {
            at.sort_unstable();
            let at: Vec<f64> = at.into_iter().map(f64::from).collect();
            let f = Piecewise::new(&at, &opacity[..at.len()]).unwrap();
            for s in [s, s.round()] {
                let got = f.locate(s).map_or(0.0, |place| place.alpha_u);
                prop_assert_eq!(got, opacity_of(&at, &opacity, s));
            }
        }

        /// By looking at every node; clusters put many nodes into one part, scaling moves the range to its ends.
        #[test]
        fn the_parts_find_what_a_search_finds(
            mut at in prop::collection::vec(prop_oneof![-1e3..1e3f64, 0.0..1e-6f64, Just(0.0), Just(7.0)], 1..40),
            s in prop::collection::vec(prop_oneof![-1.1e3..1.1e3f64, 0.0..1e-6f64], 20),
            scale in -300i32..300,
        ) {
            at.sort_by(f64::total_cmp);
            let scale = drypoint_scene::math::scale_by_power_of_two(1.0, scale);
            let here = opaque(&at);
            let there = opaque(&at.iter().map(|a| a * scale).collect::<Vec<_>>());
            for &s in s.iter().chain(&at) {
                let want = match at.iter().rposition(|&a| a <= s) {
                    None => (0, 0.0),
                    Some(k) if k + 1 == at.len() => (k, 0.0),
                    Some(k) => (k, (s - at[k]) / (at[k + 1] - at[k])),
                };
                let got = here.locate(s).map(|p| (p.node, p.w));
                prop_assert_eq!(got, Some(want));
                // Values scaled by a power of two with their nodes give the same bits.
                prop_assert_eq!(there.locate(s * scale).map(|p| (p.node, p.w)), got);
            }
        }
    }
}
