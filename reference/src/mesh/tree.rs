//! A tree of boxes about triangles.

use drypoint_scene::glam::DVec3;
use drypoint_scene::mesh::BoxNode;
use obvhs::aabb::Aabb;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::ploc::{PlocBuilder, PlocSearchDistance, SortPrecision};
use std::sync::Arc;

/// A tree over boxes. Its leaves have one box each.
#[derive(Clone, Debug)]
pub(super) struct BoxTree {
    nodes: Arc<[BoxNode]>,
}

/// A line prepared for intersection with boxes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slabs {
    origin: DVec3,
    inverse: DVec3,
    /// The distance along each axis at which a box counts as met.
    reach: f64,
}

impl Slabs {
    /// Prepares the line origin + t·along.
    pub(super) fn new(line: [DVec3; 2]) -> Self {
        Self::within(line, 0.0)
    }

    /// Prepares the line origin + t·along. A box counts as met if the line passes it within `reach` along each axis.
    pub(super) fn within([origin, along]: [DVec3; 2], reach: f64) -> Self {
        Self { origin, inverse: along.recip(), reach }
    }

    /// The parameter at which the line enters a box. Returns none if the line misses the box. The parameter is slightly
    /// too small, and a box that the line narrowly misses counts as met.
    fn enters(&self, node: &BoxNode) -> Option<f64> {
        /// Relative errors of differences and products here, and of the test of a triangle, are a few ε.
        const SLACK: f64 = 64.0 * f64::EPSILON;
        let (mut enter, mut leave) = (f64::NEG_INFINITY, f64::INFINITY);
        for axis in 0..3 {
            let (o, inverse) = (self.origin[axis], self.inverse[axis]);
            let margin = self.reach + SLACK * (o.abs() + node.lo[axis].abs().max(node.hi[axis].abs()));
            let [lo, hi] = [node.lo[axis] - margin - o, node.hi[axis] + margin - o];
            if inverse.is_infinite() {
                if lo > 0.0 || hi < 0.0 {
                    return None;
                }
                continue;
            }
            let (a, b) = (lo * inverse, hi * inverse);
            (enter, leave) = (enter.max(a.min(b)), leave.min(a.max(b)));
        }
        let slack = |t: f64| SLACK * t.abs();
        (enter - slack(enter) <= leave + slack(leave)).then(|| enter - slack(enter))
    }
}

impl BoxTree {
    /// Builds the tree over boxes, given by their lowest and highest corners. There is at least one box.
    pub(super) fn new(boxes: &[[DVec3; 2]]) -> Self {
        // f64 rounds to the nearest f32, and one step outwards from there is safe. Beyond the range of f32 a box has no
        // end.
        let lo = |x: f64| (x as f32).next_down();
        let hi = |x: f64| (x as f32).next_up();
        let bound = |&[from, to]: &[DVec3; 2]| {
            let clamp = |x: f32| x.clamp(f32::MIN, f32::MAX);
            let corner = |v: DVec3, round: fn(f64) -> f32| v.to_array().map(|x| clamp(round(x)));
            Aabb::new(corner(from, lo).into(), corner(to, hi).into())
        };
        let bounds: Vec<Aabb> = boxes.iter().map(bound).collect();
        // The builder joins equal boxes one pair at a time, so each box is passed once. `order` holds the indices of
        // equal boxes side by side.
        let key = |i: u32| {
            let Aabb { min, max } = bounds[i as usize];
            [min.x, min.y, min.z, max.x, max.y, max.z].map(f32::to_bits)
        };
        let mut order: Vec<u32> = (0..bounds.len() as u32).collect();
        order.sort_by_key(|&i| key(i));
        let equal: Vec<&[u32]> = order.chunk_by(|&a, &b| key(a) == key(b)).collect();
        let distinct: Vec<Aabb> = equal.iter().map(|places| bounds[places[0] as usize]).collect();
        let indices = (0..distinct.len() as u32).collect();
        let built = PlocBuilder::new().build(PlocSearchDistance::Low, &distinct, indices, SortPrecision::U64, 0);
        let open_lo = |x: f32| if x > f32::MIN { f64::from(x) } else { f64::NEG_INFINITY };
        let open_hi = |x: f32| if x < f32::MAX { f64::from(x) } else { f64::INFINITY };
        let node = |n: &Bvh2Node| BoxNode {
            lo: DVec3::from_array([0, 1, 2].map(|a| open_lo(n.aabb().min[a]))),
            hi: DVec3::from_array([0, 1, 2].map(|a| open_hi(n.aabb().max[a]))),
            first: if n.is_leaf() { built.primitive_indices[n.first_index as usize] } else { n.first_index },
            is_leaf: n.is_leaf(),
        };
        let mut nodes: Vec<BoxNode> = built.nodes.iter().map(node).collect();
        let leaves: Vec<usize> = (0..nodes.len()).filter(|&i| nodes[i].is_leaf).collect();
        for leaf in leaves {
            let places = equal[nodes[leaf].first as usize];
            hang(&mut nodes, leaf, places);
        }
        Self { nodes: nodes.into() }
    }

    /// The nodes.
    pub(super) fn nodes(&self) -> Arc<[BoxNode]> {
        self.nodes.clone()
    }

    /// Bytes in memory.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(&*self.nodes)
    }

    /// Visits the boxes that a line can meet up to a parameter, nearer ones first as a rule. `visit` receives the index
    /// of a box and returns the parameter beyond which no further box is needed.
    pub(super) fn visit(&self, line: &Slabs, mut until: f64, mut visit: impl FnMut(u32) -> f64) {
        let mut open: Vec<(f64, &BoxNode)> = Vec::with_capacity(64);
        let enter = |node| line.enters(node).map(|t| (t, node));
        open.extend(self.nodes.first().and_then(enter));
        while let Some((t, node)) = open.pop() {
            if t > until {
                continue;
            }
            if node.is_leaf {
                until = visit(node.first);
                continue;
            }
            let children = node.first as usize;
            let (a, b) = (enter(&self.nodes[children]), enter(&self.nodes[children + 1]));
            let is_nearer = matches!((a, b), (Some((a, _)), Some((b, _))) if a <= b);
            open.extend(if is_nearer { [b, a] } else { [a, b] }.into_iter().flatten());
        }
    }
}

/// Makes a node the root of a balanced tree over the indices of equal boxes. There is at least one index.
fn hang(nodes: &mut Vec<BoxNode>, root: usize, places: &[u32]) {
    let mut open = vec![(root, places)];
    while let Some((node, places)) = open.pop() {
        if let [place] = places {
            nodes[node] = BoxNode { first: *place, is_leaf: true, ..nodes[node] };
            continue;
        }
        let (children, (left, right)) = (nodes.len(), places.split_at(places.len() / 2));
        nodes[node] = BoxNode { first: children as u32, is_leaf: false, ..nodes[node] };
        nodes.extend([nodes[node]; 2]);
        open.extend([(children, left), (children + 1, right)]);
    }
}
