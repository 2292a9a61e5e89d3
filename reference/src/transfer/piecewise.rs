//! Exact evaluation of a piecewise-linear opacity over values ([STF-3]).

use crate::number::Real;

/// Nodes of a transfer function, prepared for evaluation at every sample. The lookup table only proposes a node; the
/// nodes decide, so the result is exact.
#[derive(Clone, Debug)]
pub struct Piecewise<R> {
    pub(super) segments: Vec<NodeSegment<R>>,
    /// The last of the nodes at the first node's value.
    at_first: usize,
    /// Lookup table: the content of each part of the line of values.
    parts: Box<[LookupPart; PARTS + 2]>,
    /// Lookup table for lanes.
    pub(super) codes: Box<PartCodes>,
    pub(super) first: R,
    pub(super) parts_per_unit: R,
    /// The closed range that contains every visible value.
    pub(super) seen: [R; 2],
}

/// The segment from a node to the next one. The last node's segment extends beyond it; its width is 1, a valid
/// divisor.
#[derive(Clone, Copy, Debug)]
pub(super) struct NodeSegment<R> {
    pub(super) at: R,
    pub(super) width: R,
    pub(super) opacity: R,
    pub(super) next_opacity: R,
}

/// The content of one part of the line of values and of its neighbours, so that rounding of a value's part does not
/// matter. The range of nodes is cut into [`PARTS`] parts. One more part lies before the range and one after it.
#[derive(Clone, Copy, Debug, PartialEq)]
enum LookupPart {
    /// No value in the part is visible: α_u = 0.
    Invisible,
    /// Every value in the part lies in the segment that begins at this node. It is not the last node.
    Segment(u32),
    /// The part contains a node or an end of the range. The node before a value in it is this one or a later one.
    Search(u32),
}

/// A byte for each part, so that the bytes of eight values form one word. A part without visible values has 0, a part
/// that must be searched [`SEARCH`]. Any other byte is one more than the node at which a segment begins.
///
/// One more part, farther away than any rounding, holds values beyond the last node. Further bytes are 0.
pub(super) type PartCodes = [u8; (PARTS + 3).next_power_of_two()];

/// Marks parts that must be searched, or whose node exceeds a byte.
pub(super) const SEARCH: u8 = u8::MAX;

/// The place of a value between the nodes: i(s) = node + w. The fraction is separate, because adding the node would
/// cost bits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NodePlace<R> {
    /// i₀ = ⌊i⌋.
    pub node: usize,
    /// w = i − i₀, in [0, 1]: a value just below a node can round to 1.
    pub w: R,
    /// α_u, above 0. In a row of a function over two quantities it may be 0.
    pub alpha_u: R,
}

/// Errors of nodes that do not make a function.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum NodesError {
    /// The list of nodes is empty.
    #[error("a transfer function needs at least one node")]
    Empty,
    /// The lists differ in length.
    #[error("{at} positions and {opacity} opacities: each node needs one of each")]
    Lengths {
        /// Number of positions.
        at: usize,
        /// Number of opacities.
        opacity: usize,
    },
    /// A node lies before its predecessor.
    #[error("node {node} at {at} follows a node at {before}; nodes must be in non-decreasing order")]
    Order {
        /// Index of the node, from 0.
        node: usize,
        /// Its position.
        at: f64,
        /// The predecessor's position.
        before: f64,
    },
    /// A position, or the distance from the first to the last, is not a finite number of this type.
    #[error("the nodes reach from {first} to {last}, which is not a finite range")]
    Range {
        /// The first position.
        first: f64,
        /// The last position, or the faulty one.
        last: f64,
    },
    /// An opacity lies outside [0, 1].
    #[error("node {node} has opacity {opacity}, which is not between 0 and 1")]
    Opacity {
        /// Index of the node, from 0.
        node: usize,
        /// Its opacity.
        opacity: f64,
    },
}

/// Number of parts. Parts with a node in them are rare, and the table takes 8 KiB.
pub(super) const PARTS: usize = 1024;

impl<R: Real> NodePlace<R> {
    /// Interpolates the colours of nodes, channel by channel: a + w(b − a).
    #[inline(always)]
    pub(crate) fn color(&self, colors: &[[R; 3]]) -> [R; 3] {
        let a = colors[self.node];
        if self.w == R::ZERO {
            return a;
        }
        let b = colors[self.node + 1];
        [R::lerp(a[0], b[0], self.w), R::lerp(a[1], b[1], self.w), R::lerp(a[2], b[2], self.w)]
    }
}

impl<R: Real> Piecewise<R> {
    /// A function with nodes in non-decreasing order of `at` and opacities in [0, 1].
    ///
    /// # Errors
    /// There is no node, the lists differ in length, or the order is wrong. The range of the positions is not finite,
    /// or an opacity lies outside [0, 1].
    pub fn new(at: &[f64], opacity: &[f64]) -> Result<Self, NodesError> {
        check::<R>(at, opacity)?;
        let at: Vec<R> = at.iter().map(|&a| R::from_f64(a)).collect();
        let opacity: Vec<R> = opacity.iter().map(|&a| R::from_f64(a)).collect();
        let end = at.len() - 1;
        let (first, last) = (at[0].to_f64(), at[end].to_f64());
        let width = (at[end] - at[0]).to_f64();
        let segment = |v: f64| at.iter().rposition(|a| a.to_f64() <= v).unwrap_or(0);
        // The content of a part. Its neighbours count as well, since rounding may lead a value to a neighbour.
        let part = |part: usize| {
            // Part 1 begins at the first node.
            let edge = |n: f64| first + width * ((part as f64 - 1.0 + n) / PARTS as f64);
            // Part 0 holds all values before the range, however close its edges are to the first node.
            let from = if part == 0 { 0 } else { segment(edge(-1.0)) };
            let to = segment(edge(2.0).min(last));
            let reached = &opacity[from..=(to + 1).min(end)];
            if reached.iter().all(|&a| a == R::ZERO) {
                LookupPart::Invisible
            } else if part > 0 && from == to && edge(-1.0) >= first && to < end {
                LookupPart::Segment(from as u32)
            } else {
                LookupPart::Search(from as u32)
            }
        };
        // If the range is 0, or so small that this overflows, every value is searched.
        let per_unit = R::from_f64(PARTS as f64 / width);
        let (parts, parts_per_unit) = if per_unit.to_f64().is_finite() {
            (Box::new(std::array::from_fn(part)), per_unit)
        } else {
            (Box::new([LookupPart::Search(0); PARTS + 2]), R::ZERO)
        };
        // The table in bytes, for lanes, with one more entry for values beyond the last node.
        let mut codes = Box::new([0; (PARTS + 3).next_power_of_two()]);
        let beyond = if opacity[end] == R::ZERO { LookupPart::Invisible } else { LookupPart::Segment(end as u32) };
        for (code, part) in codes.iter_mut().zip(parts.iter().chain([&beyond])) {
            *code = match *part {
                LookupPart::Invisible => 0,
                LookupPart::Segment(k) if k < u32::from(SEARCH) - 1 => k as u8 + 1,
                LookupPart::Segment(_) | LookupPart::Search(_) => SEARCH,
            };
        }
        let segments = (0..=end).map(|k| {
            let next = (k + 1).min(end);
            let width = if k < end { at[next] - at[k] } else { R::ONE };
            NodeSegment { at: at[k], width, opacity: opacity[k], next_opacity: opacity[next] }
        });
        Ok(Self {
            segments: segments.collect(),
            at_first: at.partition_point(|&a| a <= at[0]) - 1,
            parts,
            codes,
            first: at[0],
            parts_per_unit,
            seen: seen(&at, &opacity),
        })
    }

    /// The last node's index.
    #[inline(always)]
    pub(crate) fn last(&self) -> usize {
        self.segments.len() - 1
    }

    /// The place of a value. Returns none if its α_u is 0.
    ///
    /// Values beyond the nodes take the end nodes. Of several nodes at one value, the last one holds at the value
    /// itself. NaN counts as before the first node.
    #[inline(always)]
    pub fn locate(&self, s: R) -> Option<NodePlace<R>> {
        // Values before the first node and NaN become 0.
        let part = (s - self.first) * self.parts_per_unit + R::ONE;
        let Some(part) = part.proposed_index() else {
            let after = self.segments.partition_point(|segment| s >= segment.at);
            return self.search(s, after.saturating_sub(1));
        };
        match self.parts[part.min(PARTS + 1)] {
            LookupPart::Invisible => None,
            LookupPart::Segment(k) => self.between(s, k as usize),
            LookupPart::Search(k) => self.search(s, k as usize),
        }
    }

    /// The place of a value at or after a node and before the next one.
    #[inline(always)]
    fn between(&self, s: R, node: usize) -> Option<NodePlace<R>> {
        let segment = &self.segments[node];
        let w = (s - segment.at) / segment.width;
        let alpha_u = R::lerp(segment.opacity, segment.next_opacity, w);
        (alpha_u > R::ZERO).then_some(NodePlace { node, w, alpha_u })
    }

    /// The place of any value. A value between the nodes must not lie before node k.
    #[inline(never)]
    fn search(&self, s: R, mut k: usize) -> Option<NodePlace<R>> {
        let last = self.last();
        let node = if s >= self.segments[last].at {
            last
        } else if s > self.first {
            while s >= self.segments[k + 1].at {
                k += 1;
            }
            return self.between(s, k);
        } else if s == self.first {
            self.at_first
        } else {
            0
        };
        let alpha_u = self.segments[node].opacity;
        (alpha_u > R::ZERO).then_some(NodePlace { node, w: R::ZERO, alpha_u })
    }
}

/// The range outside which no value is visible: from the node before the first visible one to the node after the
/// last. At an end node the range is unbounded.
fn seen<R: Real>(at: &[R], opacity: &[R]) -> [R; 2] {
    let endless = R::from_f64(f64::INFINITY);
    let is_seen = |&a: &R| a > R::ZERO;
    let Some(last) = opacity.iter().rposition(is_seen) else { return [endless, -endless] };
    let first = opacity.iter().position(is_seen).unwrap_or(0);
    let from = if first == 0 { -endless } else { at[first - 1] };
    [from, at.get(last + 1).copied().unwrap_or(endless)]
}

/// Checks that nodes make a function. It needs at least one node, an opacity in [0, 1] for each, and positions in
/// non-decreasing order with a finite range in this type.
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
    use crate::number::lanes::wide;
    use fearless_simd::prelude::*;
    use fearless_simd::{f64x8, mask64x8};
    use proptest::prelude::*;

    fn opaque(at: &[f64]) -> Piecewise<f64> {
        Piecewise::new(at, &vec![1.0; at.len()]).unwrap()
    }

    /// Nodes and fractions of values for a function that is visible everywhere.
    fn find<const N: usize>(at: &[f64], values: [f64; N]) -> [(usize, f64); N] {
        let f = opaque(at);
        values.map(|s| f.locate(s).map(|p| (p.node, p.w)).unwrap())
    }

    #[test]
    fn nodes_steps_and_ends_by_hand() {
        // Values below 10 take node 0; the step at 20 belongs to its later node; beyond 40 the last node holds.
        let f = Piecewise::new(&[10.0, 20.0, 20.0, 40.0], &[0.25, 0.25, 1.0, 0.5]).unwrap();
        let at = |s: f64| f.locate(s).unwrap();
        assert_eq!(at(-5.0), NodePlace { node: 0, w: 0.0, alpha_u: 0.25 });
        assert_eq!(at(15.0), NodePlace { node: 0, w: 0.5, alpha_u: 0.25 });
        assert_eq!(at(20.0), NodePlace { node: 2, w: 0.0, alpha_u: 1.0 });
        assert_eq!(at(30.0), NodePlace { node: 2, w: 0.5, alpha_u: 0.75 });
        assert_eq!(at(40.0), NodePlace { node: 3, w: 0.0, alpha_u: 0.5 });
        assert_eq!(at(1e300), NodePlace { node: 3, w: 0.0, alpha_u: 0.5 });
        assert_eq!(at(f64::NAN), NodePlace { node: 0, w: 0.0, alpha_u: 0.25 });
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
    fn nothing_is_seen_outside_the_range_of_what_is() {
        let seen = |at: &[f64], opacity: &[f64]| Piecewise::<f64>::new(at, opacity).unwrap().seen;
        let endless = f64::INFINITY;
        assert_eq!(seen(&[0.0, 10.0, 20.0, 30.0, 40.0], &[0.0, 0.0, 1.0, 0.0, 0.0]), [10.0, 30.0]);
        // A step belongs to its later node, and the end nodes hold beyond themselves.
        assert_eq!(seen(&[0.0, 10.0, 10.0], &[0.0, 0.0, 1.0]), [10.0, endless]);
        assert_eq!(seen(&[0.0, 10.0, 20.0], &[0.5, 0.0, 0.0]), [-endless, 10.0]);
        assert_eq!(seen(&[5.0], &[0.5]), [-endless, endless]);
        let [from, to] = seen(&[0.0, 1.0], &[0.0, 0.0]);
        assert!(from > to);
        let f = Piecewise::new(&[0.0, 10.0, 10.0, 20.0, 30.0], &[0.0, 0.0, 0.5, 0.0, 0.0]).unwrap();
        for s in (-50..400).map(|i| f64::from(i) * 0.1).chain(f.seen) {
            assert!(f.locate(s).is_none() || f.seen[0] <= s && s <= f.seen[1], "{s}");
        }
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

    /// Nodes on the edges of parts, and values beside them, whose part comes out as the neighbour.
    #[test]
    fn the_part_next_to_a_value_s_own_will_do() {
        let mut mistaken = 0;
        for (first, width) in [(0.0, 0.1), (-1.0 / 3.0, 2.7), (1e6, 1.0 / 7.0), (0.1, 1e-3)] {
            let at: Vec<f64> = (0..=PARTS / 4).map(|n| first + width * (4.0 * n as f64 / PARTS as f64)).collect();
            // Visible every fifth node, so that parts of all kinds meet.
            let opacity: Vec<f64> = (0..at.len()).map(|n| f64::from(u8::from(n % 5 == 2)) * 0.3).collect();
            let (all, some) = (opaque(&at), Piecewise::new(&at, &opacity).unwrap());
            for (n, s) in at.iter().enumerate().flat_map(|(n, s)| [s.next_down(), *s, s.next_up()].map(|s| (n, s))) {
                let k = at.iter().rposition(|&a| a <= s).unwrap_or(0);
                assert_eq!(all.locate(s).unwrap().node, k, "{s}");
                assert_eq!(some.locate(s).map_or(0.0, |place| place.alpha_u), opacity_of(&at, &opacity, s), "{s}");
                let part = ((s - all.first) * all.parts_per_unit + 1.0) as usize;
                mistaken += usize::from((s < at[n]) != (part < 4 * n + 1));
            }
        }
        assert!(mistaken > 100, "{mistaken}");
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

        /// Nodes a few ulps apart. The edges of parts coincide with the first node. Before it the first opacity still
        /// holds, in lanes as well.
        #[test]
        fn nodes_a_few_last_places_apart(
            mut at in prop::collection::vec(0..3000u64, 1..5),
            opacity in prop::collection::vec(prop_oneof![Just(0.0), 0.0..=1.0f64], 5),
            first in prop_oneof![Just(100.0f64), Just(1e6), 1.0..2.0f64],
            s in 0..3000u64,
            below in prop_oneof![Just(f64::NEG_INFINITY), Just(-90.0), Just(0.0)],
        ) {
            at.sort_unstable();
            let up = |ulps: u64| f64::from_bits(first.to_bits() + ulps);
            let at: Vec<f64> = at.into_iter().map(up).collect();
            let f = Piecewise::new(&at, &opacity[..at.len()]).unwrap();
            for s in [up(s), at[0].next_down(), at[0].next_down().next_down(), below, f64::NAN, f64::INFINITY] {
                let want = opacity_of(&at, &opacity, s);
                prop_assert_eq!(f.locate(s).map_or(0.0, |place| place.alpha_u), want, "{}", s);
                if let Some(simd) = wide() {
                    let lanes = f.locate_lanes(f64x8::splat(simd, s), mask64x8::splat(simd, true));
                    prop_assert_eq!(lanes.map_or(0.0, |places| places.alpha_u[5]), want, "{} in lanes", s);
                }
            }
        }

        /// Compares with a linear search. Clusters put many nodes into one part, and scaling moves the range to its
        /// ends.
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
