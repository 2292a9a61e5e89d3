//! A piecewise-linear function at eight values side by side.

use super::Place;
use super::piecewise::{PARTS, Part, Piecewise, Segment};
use crate::field::lanes::{LANES, whole};
use crate::number::Arithmetic;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, mask64x8};

/// Where values fall between the nodes of a function, as [`Place`].
#[derive(Clone, Copy)]
pub(crate) struct Places<S: Simd> {
    /// Lanes whose α_u is above 0. What follows is theirs.
    pub(crate) visible: u64,
    /// α_u.
    pub(crate) alpha_u: f64x8<S>,
    /// i₀.
    pub(crate) nodes: Nodes,
    /// i − i₀.
    pub(crate) w: f64x8<S>,
}

/// The node before each value.
#[derive(Clone, Copy)]
pub(crate) enum Nodes {
    /// One for all, which is not the last.
    One(usize),
    /// Each its own.
    Each([u32; LANES]),
}

impl Piecewise<f64> {
    /// [`locate`](Self::locate) for the values of the lanes `asked`.
    #[inline(always)]
    pub(crate) fn locate_lanes<S: Simd>(&self, s: f64x8<S>, asked: u64) -> Option<Places<S>> {
        let simd = s.simd;
        // As whole numbers from 0 on: what lies before, or is not a number, becomes 0.
        let part = (s - self.first) * self.parts_per_unit + 1.0;
        let part = part.simd_gt(0.0).select(part, f64x8::splat(simd, 0.0));
        let last = (PARTS + 1) as f64;
        let part = part.simd_lt(last).select(part, f64x8::splat(simd, last)).floor();
        let parts = whole(part);
        let (mut seen, mut node, mut alike) = (0, None, true);
        for (lane, part) in parts.into_iter().enumerate() {
            if asked >> lane & 1 == 0 {
                continue;
            }
            match self.parts[part.min(PARTS + 1)] {
                Part::Invisible => {}
                Part::Segment(k) => {
                    seen |= 1 << lane;
                    alike &= *node.get_or_insert(k) == k;
                }
                Part::Search(_) => {
                    seen |= 1 << lane;
                    alike = false;
                }
            }
        }
        match node {
            _ if seen == 0 => None,
            // Neighbours mostly lie between the same two nodes.
            Some(k) if alike => self.between_lanes(s, seen, k as usize),
            _ => self.one_by_one(s, seen),
        }
    }

    #[inline(always)]
    fn between_lanes<S: Simd>(&self, s: f64x8<S>, seen: u64, node: usize) -> Option<Places<S>> {
        let simd = s.simd;
        let Segment { at, width, opacity, next_opacity } = self.segments[node];
        let w = (s - at) / width;
        let alpha_u = f64x8::lerp(f64x8::splat(simd, opacity), f64x8::splat(simd, next_opacity), w);
        let visible = (alpha_u.simd_gt(0.0) & mask64x8::from_bitmask(simd, seen)).to_bitmask();
        if visible == 0 {
            return None;
        }
        Some(Places { visible, alpha_u, nodes: Nodes::One(node), w })
    }

    #[inline(always)]
    fn one_by_one<S: Simd>(&self, s: f64x8<S>, seen: u64) -> Option<Places<S>> {
        let simd = s.simd;
        let s: [f64; LANES] = s.into();
        let (mut visible, mut alpha_u, mut nodes, mut w) = (0, [0.0; LANES], [0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            if seen >> lane & 1 == 1
                && let Some(place) = self.locate(s[lane])
            {
                visible |= 1 << lane;
                alpha_u[lane] = place.alpha_u;
                nodes[lane] = place.node as u32;
                w[lane] = place.w;
            }
        }
        if visible == 0 {
            return None;
        }
        Some(Places { visible, alpha_u: alpha_u.simd_into(simd), nodes: Nodes::Each(nodes), w: w.simd_into(simd) })
    }
}

impl<S: Simd> Places<S> {
    /// [`Place::color`] in the visible lanes.
    #[inline(always)]
    pub(crate) fn color(&self, colors: &[[f64; 3]]) -> [f64x8<S>; 3] {
        let simd = self.w.simd;
        let mut rgb = [self.w; 3];
        match self.nodes {
            Nodes::One(node) => {
                let (a, b) = (colors[node], colors[node + 1]);
                for i in 0..3 {
                    rgb[i] = f64x8::lerp(f64x8::splat(simd, a[i]), f64x8::splat(simd, b[i]), self.w);
                }
            }
            Nodes::Each(nodes) => {
                let mut columns = [[0.0; LANES]; 3];
                for lane in 0..LANES {
                    if self.visible >> lane & 1 == 1 {
                        let color = self.place(lane, nodes).color(colors);
                        for (column, c) in columns.iter_mut().zip(color) {
                            column[lane] = c;
                        }
                    }
                }
                for i in 0..3 {
                    rgb[i] = columns[i].simd_into(simd);
                }
            }
        }
        rgb
    }

    /// One lane's.
    #[inline(always)]
    pub(crate) fn place(&self, lane: usize, nodes: [u32; LANES]) -> Place<f64> {
        Place { node: nodes[lane] as usize, w: self.w[lane], alpha_u: self.alpha_u[lane] }
    }
}
