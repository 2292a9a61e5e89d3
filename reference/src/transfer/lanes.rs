//! A piecewise-linear function at eight values side by side.

use super::piecewise::{NodeSegment, PARTS, Piecewise, SEARCH};
use crate::field::lanes::{LANES, whole};
use crate::number::Arithmetic;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, mask64x8};

/// Places of values between the nodes of a function, like [`NodePlace`](super::NodePlace).
#[derive(Clone, Copy)]
pub(crate) struct NodePlaces<S: Simd> {
    /// Lanes with α_u above 0. Only these have valid numbers below.
    pub(crate) visible: u64,
    /// The opacities α_u.
    pub(crate) alpha_u: f64x8<S>,
    /// The nodes i₀.
    pub(crate) nodes: LaneNodes,
    /// The fractions i − i₀.
    pub(crate) w: f64x8<S>,
}

/// The node before each value.
#[derive(Clone, Copy)]
pub(crate) enum LaneNodes {
    /// One node for all values.
    One(usize),
    /// A node for each value.
    Each([u32; LANES]),
}

impl LaneNodes {
    /// The node of each lane.
    #[inline(always)]
    pub(crate) fn each(self) -> [u32; LANES] {
        match self {
            Self::One(node) => [node as u32; LANES],
            Self::Each(nodes) => nodes,
        }
    }
}

/// A one in each byte.
const ONES: u64 = u64::from_ne_bytes([1; LANES]);

/// A one in each byte that is not 0.
#[inline(always)]
fn nonzero(bytes: u64) -> u64 {
    const LOW: u64 = 0x7f * ONES;
    ((((bytes & LOW) + LOW) | bytes) >> 7) & ONES
}

impl Piecewise<f64> {
    /// Whether some value of the lanes `asked` may be visible. If not, all are invisible; around a visible region
    /// most values are.
    #[inline(always)]
    pub(crate) fn may_show<S: Simd>(&self, s: f64x8<S>, asked: mask64x8<S>) -> bool {
        let [from, to] = self.seen;
        !(s.simd_lt(from) | s.simd_gt(to) | !asked).all_true()
    }

    /// [`locate`](Self::locate) for the values of the lanes `asked`.
    #[inline(always)]
    pub(crate) fn locate_lanes<S: Simd>(&self, s: f64x8<S>, asked: mask64x8<S>) -> Option<NodePlaces<S>> {
        let simd = s.simd;
        let end = f64x8::splat(simd, self.segments[self.last()].at);
        // Indices of parts, from 0 on. Values before the first part and NaN become 0. Lanes that are not asked get an
        // index beyond all parts.
        let part = (s - self.first) * self.parts_per_unit + 1.0;
        let part = part.simd_gt(0.0).select(part, f64x8::splat(simd, 0.0));
        let last = (PARTS + 2) as f64;
        let part = part.simd_lt(last).select(part, f64x8::splat(simd, last)).floor();
        let parts = whole(asked.select(part, f64x8::splat(simd, last + 1.0)));
        // Without a branch for each lane, which would be unpredictable.
        let mut codes = 0;
        for (lane, part) in parts.into_iter().enumerate() {
            codes |= u64::from(self.codes[part % self.codes.len()]) << (8 * lane);
        }
        if codes == 0 {
            return None;
        }
        let seen = nonzero(codes);
        // Values beyond the last node take its place. This does not affect searches.
        let s = s.simd_gt(end).select(end, s);
        let code = (codes >> (codes.trailing_zeros() & !7)) as u8;
        let (visible, nodes, alpha_u, w) = if code != SEARCH && u64::from(code) * seen == codes {
            // Neighbouring values mostly lie between the same two nodes.
            let node = usize::from(code) - 1;
            let NodeSegment { at, width, opacity, next_opacity } = self.segments[node];
            let w = (s - at) / width;
            let alpha_u = f64x8::lerp(f64x8::splat(simd, opacity), f64x8::splat(simd, next_opacity), w);
            // Gathers one bit of each byte.
            let seen = seen.wrapping_mul(0x0102_0408_1020_4080) >> 56;
            ((alpha_u.simd_gt(0.0)).to_bitmask() & seen, LaneNodes::One(node), alpha_u, w)
        } else {
            self.between_their_own(s, codes)
        };
        (visible != 0).then_some(NodePlaces { visible, alpha_u, nodes, w })
    }

    /// The visible lanes, with the preceding node, α_u and w of each.
    #[inline(always)]
    fn between_their_own<S: Simd>(&self, s: f64x8<S>, codes: u64) -> (u64, LaneNodes, f64x8<S>, f64x8<S>) {
        let simd = s.simd;
        let codes = codes.to_le_bytes();
        let mut nodes = [0; LANES];
        let mut columns = [[0.0; LANES]; 4];
        let mut searched = 0u64;
        for lane in 0..LANES {
            // Lanes without a node read the columns' zeros, and α_u is not above 0.
            let node = usize::from(codes[lane]).wrapping_sub(1);
            if codes[lane] == SEARCH {
                searched |= 1 << lane;
            } else if let Some(&NodeSegment { at, width, opacity, next_opacity }) = self.segments.get(node) {
                nodes[lane] = node as u32;
                (columns[0][lane], columns[1][lane]) = (at, width);
                (columns[2][lane], columns[3][lane]) = (opacity, next_opacity);
            }
        }
        let [at, width, opacity, next_opacity] = columns;
        let (at, width): (f64x8<S>, f64x8<S>) = (at.simd_into(simd), width.simd_into(simd));
        let mut w = (s - at) / width;
        let mut alpha_u = f64x8::lerp(opacity.simd_into(simd), next_opacity.simd_into(simd), w);
        let mut visible = alpha_u.simd_gt(0.0).to_bitmask();
        while searched != 0 {
            let lane = searched.trailing_zeros() as usize;
            searched &= searched - 1;
            if let Some(place) = self.locate(s[lane]) {
                visible |= 1 << lane;
                (nodes[lane], alpha_u[lane], w[lane]) = (place.node as u32, place.alpha_u, place.w);
            }
        }
        (visible, LaneNodes::Each(nodes), alpha_u, w)
    }
}

impl<S: Simd> NodePlaces<S> {
    /// [`NodePlace::color`](super::NodePlace::color) in the visible lanes.
    #[inline(always)]
    pub(crate) fn color(&self, colors: &[[f64; 3]]) -> [f64x8<S>; 3] {
        let simd = self.w.simd;
        let mut rgb = [self.w; 3];
        match self.nodes {
            LaneNodes::One(node) => {
                let (a, b) = (colors[node], colors[(node + 1).min(colors.len() - 1)]);
                for i in 0..3 {
                    rgb[i] = f64x8::lerp(f64x8::splat(simd, a[i]), f64x8::splat(simd, b[i]), self.w);
                }
            }
            LaneNodes::Each(nodes) => {
                let mut columns = [[[0.0; LANES]; 2]; 3];
                for lane in 0..LANES {
                    // w is 0 at the last node. Lanes that are not visible have node 0.
                    let node = nodes[lane] as usize;
                    let (a, b) = (colors[node], colors[(node + 1).min(colors.len() - 1)]);
                    for i in 0..3 {
                        (columns[i][0][lane], columns[i][1][lane]) = (a[i], b[i]);
                    }
                }
                for i in 0..3 {
                    let [a, b] = columns[i];
                    rgb[i] = f64x8::lerp(a.simd_into(simd), b.simd_into(simd), self.w);
                }
            }
        }
        rgb
    }
}
