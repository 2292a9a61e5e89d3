//! A piecewise-linear function at eight values side by side.

use super::piecewise::{PARTS, Part, Piecewise, Segment};
use crate::field::lanes::{LANES, whole};
use crate::number::Arithmetic;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, mask64x8};

/// Where values fall between the nodes of a function.
pub(crate) struct Places<S: Simd> {
    /// Lanes whose α_u is above 0. What follows is theirs.
    pub(crate) visible: u64,
    /// α_u.
    pub(crate) alpha_u: f64x8<S>,
    /// The linear straight colour.
    pub(crate) color: [f64x8<S>; 3],
}

impl Piecewise<f64> {
    /// [`locate`](Self::locate) for the values of the lanes `asked`, and the colours there, between those of the nodes.
    #[inline(always)]
    pub(crate) fn locate_lanes<S: Simd>(&self, s: f64x8<S>, asked: u64, colors: &[[f64; 3]]) -> Option<Places<S>> {
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
            Some(k) if alike => self.between_lanes(s, seen, k as usize, colors),
            _ => self.one_by_one(s, seen, colors),
        }
    }

    #[inline(always)]
    fn between_lanes<S: Simd>(&self, s: f64x8<S>, seen: u64, node: usize, colors: &[[f64; 3]]) -> Option<Places<S>> {
        let simd = s.simd;
        let Segment { at, width, opacity, next_opacity } = self.segments[node];
        let w = (s - at) / width;
        let alpha_u = f64x8::lerp(f64x8::splat(simd, opacity), f64x8::splat(simd, next_opacity), w);
        let visible = (alpha_u.simd_gt(0.0) & mask64x8::from_bitmask(simd, seen)).to_bitmask();
        let (a, b) = (colors[node], colors[node + 1]);
        if visible == 0 {
            return None;
        }
        let mut color = [w; 3];
        for i in 0..3 {
            color[i] = f64x8::lerp(f64x8::splat(simd, a[i]), f64x8::splat(simd, b[i]), w);
        }
        Some(Places { visible, alpha_u, color })
    }

    #[inline(always)]
    fn one_by_one<S: Simd>(&self, s: f64x8<S>, seen: u64, colors: &[[f64; 3]]) -> Option<Places<S>> {
        let simd = s.simd;
        let s: [f64; LANES] = s.into();
        let (mut visible, mut alpha_u, mut color) = (0, [0.0; LANES], [[0.0; LANES]; 3]);
        for lane in 0..LANES {
            if seen >> lane & 1 == 1
                && let Some(place) = self.locate(s[lane])
            {
                visible |= 1 << lane;
                alpha_u[lane] = place.alpha_u;
                let rgb = place.color(colors);
                (color[0][lane], color[1][lane], color[2][lane]) = (rgb[0], rgb[1], rgb[2]);
            }
        }
        let [r, g, b] = color;
        if visible == 0 {
            return None;
        }
        let color = [r.simd_into(simd), g.simd_into(simd), b.simd_into(simd)];
        Some(Places { visible, alpha_u: alpha_u.simd_into(simd), color })
    }
}
