//! Rays in lanes, sample by sample, front to back ([RAY-1], [RAY-2], [VAL-3]).

use super::packet::{Asked, Column, IN_ORDER, Packet, of_rays, vector};
use crate::accumulator::Accumulator;
use crate::field::lanes::{LANES, Places, Reader};
use crate::number::Vec3;
use crate::ray::opacity::{Correction, correct};
use crate::ray::prepared::Prepared;
use crate::transfer;
use drypoint_scene::counts::Counts;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, mask64x8};

/// The states of eight rays.
pub(super) struct RayLanes<'p, 'v, S: Simd, F> {
    pub(super) simd: S,
    pub(super) prepared: &'p Prepared<'v, f64>,
    pub(super) reader: F,
    origin: Vec3<f64x8<S>>,
    along: Vec3<f64x8<S>>,
    depth_step: f64x8<S>,
    /// Δ/Δ₀.
    ratio: f64x8<S>,
}

/// Number of planes whose values are computed before the first of them is shown. Values then need not wait for each
/// other, and a mispredicted branch at one sample does not discard the others.
pub(super) const AHEAD: usize = 4;

/// Values of samples on some planes.
pub(super) struct Lookahead<S: Simd> {
    first: i64,
    s: [f64x8<S>; AHEAD],
    /// The lanes whose values were asked for.
    asked: [u64; AHEAD],
    /// One bit for each plane on which something may be visible.
    seen: u32,
}

impl<S: Simd> Lookahead<S> {
    #[inline(always)]
    pub(super) fn new(simd: S) -> Self {
        Self { first: 0, s: [f64x8::splat(simd, 0.0); AHEAD], asked: [0; AHEAD], seen: 0 }
    }

    /// The next plane on which something may be visible, the values there, and the lanes for which they were computed.
    #[inline(always)]
    pub(super) fn next(&mut self) -> Option<(i64, f64x8<S>, u64)> {
        if self.seen == 0 {
            return None;
        }
        let i = self.seen.trailing_zeros() as usize % AHEAD;
        self.seen &= self.seen - 1;
        Some((self.first + i as i64, self.s[i], self.asked[i]))
    }
}

/// The visible samples of one plane.
pub(super) struct LaneSamples<S: Simd> {
    /// k.
    pub(super) k: f64,
    /// Places between nodes. Its visible lanes are the ones that count.
    pub(super) place: transfer::lanes::NodePlaces<S>,
    /// The lanes of `place` as a mask.
    pub(super) seen: mask64x8<S>,
}

/// A shader of eight samples of one plane.
pub(super) trait ShadeLanes<S: Simd> {
    /// Straight colours and opacities per reference length of the visible lanes.
    fn show<F: Reader<S>>(
        &mut self,
        walk: &RayLanes<'_, '_, S, F>,
        sample: &LaneSamples<S>,
        counts: &mut Counts,
    ) -> ([f64x8<S>; 3], f64x8<S>);
}

/// The accumulated colours and opacities of eight rays.
struct LaneFront<S: Simd> {
    accumulator: Accumulator<f64x8<S>>,
    /// The last opacities before and after their correction. Opacities of a function repeat along a ray.
    corrected: [f64x8<S>; 2],
}

impl<S: Simd> LaneFront<S> {
    /// Corrects the opacities of the lanes `fresh`, together if they are many, else one by one.
    #[inline(always)]
    fn correct(&mut self, fresh: u64, alpha: f64x8<S>, ratio: f64x8<S>) {
        let lanes = mask64x8::from_bitmask(alpha.simd, fresh);
        if fresh.count_ones() > 2 {
            self.corrected[1] = lanes.select(correct(alpha, ratio), self.corrected[1]);
        } else {
            let mut corrected: Column = self.corrected[1].into();
            let mut left = fresh;
            while left != 0 {
                let lane = left.trailing_zeros() as usize;
                left &= left - 1;
                corrected[lane] = Correction::new(ratio[lane]).apply(alpha[lane]);
            }
            self.corrected[1] = corrected.simd_into(alpha.simd);
        }
        self.corrected[0] = lanes.select(alpha, self.corrected[0]);
    }
}

impl<'p, 'v, S: Simd, F: Reader<S>> RayLanes<'p, 'v, S, F> {
    #[inline(always)]
    pub(super) fn new(simd: S, packet: &Packet<'p, 'v>, reader: F) -> Self {
        let [_, _, _, step] = of_rays(simd, &packet.sights, &IN_ORDER);
        Self {
            simd,
            prepared: packet.prepared,
            reader,
            origin: vector(simd, packet.origin),
            along: vector(simd, packet.along),
            depth_step: packet.depth_step.simd_into(simd),
            ratio: step / packet.prepared.object.reference_length,
        }
    }

    /// Visits all samples, the nearest plane first.
    #[inline(always)]
    pub(super) fn run(&self, packet: &mut Packet<'_, '_>, look: &mut impl ShadeLanes<S>, counts: &mut Counts) {
        let zero = f64x8::splat(self.simd, 0.0);
        let mut front = LaneFront { accumulator: Accumulator::empty(zero), corrected: [zero; 2] };
        let nearest: f64x8<S> = packet.ends[0].simd_into(self.simd);
        let mut farthest: f64x8<S> = packet.ends[1].simd_into(self.simd);
        let mut ahead = Lookahead::new(self.simd);
        // Values are cheap here, so `asked` stays empty.
        let mut asked = Vec::new();
        'rays: for &[first, last] in &packet.together {
            for group in (first..=last).step_by(AHEAD) {
                let open = farthest.simd_ge(group as f64);
                if open.all_false() {
                    break 'rays;
                }
                self.look_ahead(&mut ahead, [group, last], open, nearest, &mut asked);
                while let Some((plane, s, _)) = ahead.next() {
                    let k = plane as f64;
                    let active = farthest.simd_ge(k) & nearest.simd_le(k);
                    let stopped = self.visit(k, s, active, look, &mut front, counts);
                    farthest = stopped.select(f64x8::splat(self.simd, k), farthest);
                }
            }
        }
        packet.ends[1] = farthest.into();
        let Accumulator { rgb: [r, g, b], opacity } = front.accumulator;
        let (r, g, b, opacity): (Column, Column, Column, Column) = (r.into(), g.into(), b.into(), opacity.into());
        for lane in 0..LANES {
            packet.rgba[lane] = [r[lane], g[lane], b[lane], opacity[lane]];
        }
    }

    /// The values of the first planes of a range, in lanes where something may be visible, whose rays are open and
    /// begin at `nearest`.
    #[inline(always)]
    pub(super) fn look_ahead(
        &self,
        ahead: &mut Lookahead<S>,
        [first, last]: [i64; 2],
        open: mask64x8<S>,
        nearest: f64x8<S>,
        asked: &mut Vec<Asked>,
    ) {
        (ahead.first, ahead.seen) = (first, 0);
        let n = (last - first + 1).min(AHEAD as i64) as usize;
        for (i, s) in ahead.s.iter_mut().take(n).enumerate() {
            let k = (first + i as i64) as f64;
            let at = self.places(k);
            let mut wanted = open & nearest.simd_le(k);
            if F::DEAR {
                let lanes = self.where_cells_show(&at, wanted.to_bitmask());
                if lanes == 0 {
                    continue;
                }
                asked.push((first + i as i64, lanes));
                (ahead.asked[i], wanted) = (lanes, mask64x8::from_bitmask(self.simd, lanes));
            }
            *s = self.reader.values(&at, wanted);
            let may_be_seen = self.prepared.object.function.may_show(*s, wanted);
            ahead.seen |= u32::from(may_be_seen) << i;
        }
    }

    /// The lanes in whose cells something may be visible.
    #[inline(always)]
    fn where_cells_show(&self, at: &Places<S>, lanes: u64) -> u64 {
        let Some(cells) = &self.prepared.cells else { return lanes };
        let alone = at.alone();
        let (mut left, mut show) = (lanes, 0);
        while left != 0 {
            let lane = left.trailing_zeros() as usize % LANES;
            left &= left - 1;
            show |= u64::from(cells.can_show(&self.prepared.object.field, alone.cell(lane))) << lane;
        }
        show
    }

    /// Lanes of a plane that have a value.
    #[inline(always)]
    pub(super) fn wanted(&self, lanes: mask64x8<S>, asked: u64) -> mask64x8<S> {
        if F::DEAR { lanes & mask64x8::from_bitmask(self.simd, asked) } else { lanes }
    }

    /// The places of samples k.
    #[inline(always)]
    pub(super) fn places(&self, k: f64) -> Places<S> {
        self.reader.places(self.origin + self.along * (self.depth_step * (k + 0.5)))
    }

    /// Visits samples k of the active lanes. Returns the lanes whose ray ends there.
    #[inline(always)]
    fn visit(
        &self,
        k: f64,
        s: f64x8<S>,
        active: mask64x8<S>,
        look: &mut impl ShadeLanes<S>,
        front: &mut LaneFront<S>,
        counts: &mut Counts,
    ) -> mask64x8<S> {
        let simd = self.simd;
        let Some(place) = self.prepared.object.function.locate_lanes(s, active) else {
            return mask64x8::splat(simd, false);
        };
        let seen = mask64x8::from_bitmask(simd, place.visible);
        let sample = LaneSamples { k, place, seen };
        let (rgb, alpha) = look.show(self, &sample, counts);
        let fresh = (seen & alpha.simd_ne(front.corrected[0])).to_bitmask();
        if fresh != 0 {
            front.correct(fresh, alpha, self.ratio);
        }
        front.accumulator.over_where(seen, rgb, front.corrected[1]);
        seen & front.accumulator.opacity.simd_ge(self.prepared.stop_at)
    }
}
