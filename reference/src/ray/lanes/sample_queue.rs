//! A queue of samples, which are shaded eight at a time.
//!
//! Often only one or two of eight neighbouring rays see something, and shading a style's sample costs as much for one
//! ray as for eight. So visible samples wait, and are shaded eight at a time, whichever rays of a tile they lie on. A
//! ray may therefore be followed slightly beyond the sample where it ends; samples there are neither shown nor counted.
//! Eight rays that all seem to have ended are suspended. They are followed further only if the waiting samples turn out
//! to be translucent.

use super::packet::{Asked, Packet, RAYS, vector};
use super::ray_lanes::{AHEAD, Lookahead, RayLanes};
use super::style::{ShadedLanes, StyleShader};
use crate::accumulator::Accumulator;
use crate::field::lanes::{LANES, Places, Reader};
use crate::number::Vec3;
use crate::number::lanes::rows;
use crate::ray::opacity::{Correction, correct};
use crate::ray::prepared::Prepared;
use crate::ray::sample::Styled;
use crate::transfer;
use crate::transfer::lanes::LaneNodes;
use drypoint_scene::counts::Counts;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, mask64x8};

/// Numbers of a sample: k, its cell, the fractions in the cell, α_u and i − i₀.
const NUMBERS: usize = 9;
/// Seven samples may be left over when eight more come.
const ROOM: usize = 2 * LANES;

/// Samples in the order in which they were found.
struct SampleQueue {
    len: usize,
    numbers: [[f64; ROOM]; NUMBERS],
    nodes: [u32; ROOM],
    rays: [u8; ROOM],
}

/// Samples that are shaded together.
pub(super) struct Batch<S: Simd> {
    /// Lanes with a sample.
    pub(super) asked: u64,
    /// The ray of each sample: eight times the index of its packet, plus its lane.
    pub(super) rays: [u8; LANES],
    pub(super) k: f64x8<S>,
    pub(super) at: Places<S>,
    pub(super) place: transfer::lanes::NodePlaces<S>,
}

impl SampleQueue {
    fn new() -> Self {
        Self { len: 0, numbers: [[0.0; ROOM]; NUMBERS], nodes: [0; ROOM], rays: [0; ROOM] }
    }

    /// Adds the visible samples of one plane of a packet.
    #[inline(always)]
    fn push<S: Simd>(&mut self, packet: usize, k: f64, at: Places<S>, place: &transfer::lanes::NodePlaces<S>) {
        let [x, y, z, wx, wy, wz] = at.to_columns();
        let columns: [[f64; LANES]; NUMBERS] = [[k; LANES], x, y, z, wx, wy, wz, place.alpha_u.into(), place.w.into()];
        let nodes = place.nodes.each();
        let mut left = place.visible;
        while left != 0 {
            let lane = left.trailing_zeros() as usize % LANES;
            left &= left - 1;
            // At most seven samples wait, so there is room for eight more. The compiler cannot know this.
            let to = self.len % ROOM;
            for (numbers, column) in self.numbers.iter_mut().zip(&columns) {
                numbers[to] = column[lane];
            }
            (self.nodes[to], self.rays[to]) = (nodes[lane], (LANES * packet + lane) as u8);
            self.len += 1;
        }
    }

    /// Removes and returns the first eight samples, or as many as there are.
    #[inline(always)]
    fn pop<S: Simd>(&mut self, simd: S) -> Batch<S> {
        let mut columns = [f64x8::splat(simd, 0.0); NUMBERS];
        for (numbers, column) in self.numbers.iter_mut().zip(&mut columns) {
            *column = f64x8::from_slice(simd, &numbers[..LANES]);
        }
        let (mut nodes, mut rays) = ([0; LANES], [0; LANES]);
        nodes.copy_from_slice(&self.nodes[..LANES]);
        rays.copy_from_slice(&self.rays[..LANES]);
        if self.len > LANES {
            for numbers in &mut self.numbers {
                numbers.copy_within(LANES.., 0);
            }
            self.nodes.copy_within(LANES.., 0);
            self.rays.copy_within(LANES.., 0);
        }
        let asked = if self.len < LANES { (1 << self.len) - 1 } else { u64::from(u8::MAX) };
        self.len = self.len.saturating_sub(LANES);
        let [k, x, y, z, wx, wy, wz, alpha_u, w] = columns;
        Batch {
            asked,
            rays,
            k,
            at: Places::from_columns([x, y, z, wx, wy, wz]),
            place: transfer::lanes::NodePlaces { visible: asked, alpha_u, nodes: LaneNodes::Each(nodes), w },
        }
    }
}

/// The rays of a tile: the front of each ray, and the sample where it ends.
struct Fronts {
    of_ray: [Accumulator<f64>; RAYS],
    farthest: [f64; RAYS],
    /// The planes of each packet on which values were expensive.
    asked: [Vec<Asked>; RAYS / LANES],
}

impl Fronts {
    fn new(packets: &mut [Packet<'_, '_>]) -> Self {
        let asked = Default::default();
        let mut fronts = Self { of_ray: [Accumulator::empty(0.0); RAYS], farthest: [f64::NEG_INFINITY; RAYS], asked };
        for (packet, asked) in packets.iter_mut().zip(&mut fronts.asked) {
            *asked = std::mem::take(&mut packet.asked);
        }
        for (packet, farthest) in packets.iter().zip(fronts.farthest.chunks_exact_mut(LANES)) {
            farthest.copy_from_slice(&packet.ends[1]);
        }
        fronts
    }

    /// Copies the results to the packets.
    fn hand_over(self, packets: &mut [Packet<'_, '_>]) {
        for (packet, asked) in packets.iter_mut().zip(self.asked) {
            packet.asked = asked;
        }
        let rays = self.of_ray.chunks_exact(LANES).zip(self.farthest.chunks_exact(LANES));
        for (packet, (fronts, farthest)) in packets.iter_mut().zip(rays) {
            for (rgba, Accumulator { rgb: [r, g, b], opacity }) in packet.rgba.iter_mut().zip(fronts) {
                *rgba = [*r, *g, *b, *opacity];
            }
            packet.ends[1].copy_from_slice(farthest);
        }
    }

    /// The lanes of a packet whose rays have not ended before sample k.
    #[inline(always)]
    fn open<S: Simd>(&self, simd: S, packet: usize, k: f64) -> mask64x8<S> {
        f64x8::from_slice(simd, &self.farthest[LANES * packet..][..LANES]).simd_ge(k)
    }

    /// The opacity in front on each ray of a packet.
    #[inline(always)]
    fn opacity<S: Simd>(&self, simd: S, packet: usize) -> f64x8<S> {
        let mut opacity = [0.0; LANES];
        for (opacity, front) in opacity.iter_mut().zip(&self.of_ray[LANES * packet..][..LANES]) {
            *opacity = front.opacity;
        }
        opacity.simd_into(simd)
    }
}

/// Casts packets in styles.
#[inline(always)]
pub(super) fn cast_waiting<S: Simd, F: Reader<S>>(
    simd: S,
    packets: &mut [Packet<'_, '_>],
    styled: &Styled<f64>,
    reader: F,
    counts: &mut Counts,
) {
    let mut fronts = Fronts::new(packets);
    if let [Packet { prepared, .. }, ..] = &*packets {
        let mut look = StyleShader::new(simd, packets, styled);
        Packets { simd, prepared, packets, reader }.run(&mut fronts, &mut look, counts);
    }
    fronts.hand_over(packets);
}

/// The place at which a packet continues: the index of its range, and the earliest sample.
type Next = (usize, i64);

/// Packets whose samples wait for each other.
pub(super) struct Packets<'p, 'v, S: Simd, F> {
    simd: S,
    pub(super) prepared: &'p Prepared<'v, f64>,
    packets: &'p [Packet<'p, 'v>],
    pub(super) reader: F,
}

impl<S: Simd, F: Reader<S>> Packets<'_, '_, S, F> {
    /// Visits all samples and shades the visible ones eight at a time.
    #[inline(always)]
    fn run(&self, fronts: &mut Fronts, look: &mut StyleShader<'_, S>, counts: &mut Counts) {
        let mut waiting = SampleQueue::new();
        let mut next = [Some((0, i64::MIN)); RAYS / LANES];
        let on_their_way = &mut next[..self.packets.len()];
        while on_their_way.iter().any(Option::is_some) {
            for (packet, next) in on_their_way.iter_mut().enumerate() {
                if let Some(from) = *next {
                    *next = self.follow(packet, from, &mut waiting, fronts, look, counts);
                }
            }
            while waiting.len > 0 {
                self.show_batch(&waiting.pop(self.simd), look, fronts, counts);
            }
        }
    }

    /// Visits samples of a packet, the nearest plane first. Returns the place at which to continue, if it stops because
    /// all rays seem to have ended.
    #[inline(always)]
    fn follow(
        &self,
        packet: usize,
        (first_range, earliest): Next,
        waiting: &mut SampleQueue,
        fronts: &mut Fronts,
        look: &mut StyleShader<'_, S>,
        counts: &mut Counts,
    ) -> Option<Next> {
        let simd = self.simd;
        if fronts.open(simd, packet, earliest as f64).all_false() {
            return None;
        }
        let rays = &self.packets[packet];
        let walk = RayLanes::new(simd, rays, self.reader);
        let one = f64x8::splat(simd, 1.0);
        let nearest: f64x8<S> = rays.ends[0].simd_into(simd);
        // The approximate transmittance of each ray after all waiting samples. Below the limit the ray may have ended
        // by then.
        let (mut through, limit) = (one - fronts.opacity(simd, packet), 1.0 - self.prepared.stop_at);
        let mut ahead = Lookahead::new(simd);
        // Samples beyond the place where it stopped are evaluated again.
        while fronts.asked[packet].pop_if(|&mut (k, _)| k >= earliest).is_some() {}
        for (range, &[first, last]) in rays.together.iter().enumerate().skip(first_range) {
            for group in (first.max(earliest)..=last).step_by(AHEAD) {
                let open = fronts.open(simd, packet, group as f64);
                if open.all_false() {
                    return None;
                }
                walk.look_ahead(&mut ahead, [group, last], open, nearest, &mut fronts.asked[packet]);
                while let Some((plane, s, values)) = ahead.next() {
                    let k = plane as f64;
                    let open = fronts.open(simd, packet, k);
                    let active = open & walk.wanted(nearest.simd_le(k), values);
                    let Some(place) = self.prepared.object.function.locate_lanes(s, active) else {
                        continue;
                    };
                    let late = place.visible & through.simd_le(limit).to_bitmask();
                    if 2 * late.count_ones() > place.visible.count_ones() && plane > earliest {
                        // Most of the samples that would join the queue lie beyond the end of their ray.
                        return Some((range, plane));
                    }
                    waiting.push(packet, k, walk.places(k), &place);
                    if waiting.len >= LANES {
                        self.show_batch(&waiting.pop(simd), look, fronts, counts);
                    }
                    let seen = mask64x8::from_bitmask(simd, place.visible);
                    through = seen.select(through * (one - place.alpha_u), through);
                    if (through.simd_le(limit) | !open).all_true() {
                        return Some((range, plane + 1));
                    }
                }
            }
        }
        None
    }

    /// The index positions of samples of any rays, in the lanes `asked`. The other lanes hold the origin.
    #[inline(always)]
    pub(super) fn positions_of(&self, rays: &[u8; LANES], k: f64x8<S>, asked: u64) -> Vec3<f64x8<S>> {
        let mut p = [[0.0; LANES]; 3];
        let mut left = asked;
        while left != 0 {
            let lane = left.trailing_zeros() as usize;
            left &= left - 1;
            let ray = usize::from(rays[lane]);
            let (packet, ray) = (&self.packets[ray / LANES], ray % LANES);
            let t = packet.depth_step[ray] * (k[lane] + 0.5);
            for ((p, origin), along) in p.iter_mut().zip(&packet.origin).zip(&packet.along) {
                p[lane] = origin[ray] + along[ray] * t;
            }
        }
        vector(self.simd, p)
    }

    /// Shades samples and composites them behind the front. It is called from two places, so it is compiled once, apart
    /// from them.
    #[inline(never)]
    fn show_batch(&self, batch: &Batch<S>, look: &mut StyleShader<'_, S>, fronts: &mut Fronts, counts: &mut Counts) {
        self.simd.vectorize(
            #[inline(always)]
            || {
                let simd = self.simd;
                let ShadedLanes { rgb: [r, g, b], alpha, ratio, counted } = look.show(self, batch);
                let corrected: [f64; LANES] = if batch.asked.count_ones() > 2 {
                    correct(alpha, ratio).into()
                } else {
                    let mut corrected = [0.0; LANES];
                    for lane in 0..batch.asked.count_ones() as usize {
                        corrected[lane] = Correction::new(ratio[lane]).apply(alpha[lane]);
                    }
                    corrected
                };
                let k: [f64; LANES] = batch.k.into();
                let rows = rows([r, g, b, f64x8::splat(simd, 1.0)]);
                let mut shown = 0;
                for lane in 0..batch.asked.count_ones() as usize {
                    let ray = usize::from(batch.rays[lane]) % RAYS;
                    if k[lane] > fronts.farthest[ray] {
                        continue;
                    }
                    shown |= 1 << lane;
                    let [r, g, b, _] = rows[lane].into();
                    let front = &mut fronts.of_ray[ray];
                    front.over([r, g, b], corrected[lane]);
                    if front.opacity >= self.prepared.stop_at {
                        fronts.farthest[ray] = k[lane];
                    }
                }
                counted.add(shown, counts);
            },
        );
    }
}
