//! Samples that wait until eight of them can be shown together.
//!
//! Of eight neighbouring rays often one or two alone see something, and what a style asks of a sample is as dear for one as
//! for eight. So samples that are seen wait, and are shown eight at a time, whichever rays they lie on. A ray may so be
//! followed a little beyond the sample where it ends; what was done there is neither shown nor counted.

use super::Packet;
use super::correct::correct;
use super::style::{InStyle, Looks};
use super::walk::Walk;
use crate::field::lanes::{LANES, Packed, Places};
use crate::number::lanes::rows;
use crate::ray::opacity::Correction;
use crate::transfer;
use crate::transfer::lanes::Nodes;
use drypoint_scene::counts::Counts;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4, f64x8, mask64x8};

/// Numbers of a sample: k, its cell, the ways into it, α_u and i − i₀.
const NUMBERS: usize = 9;
/// Seven may be left over when eight come.
const ROOM: usize = 2 * LANES;

/// Samples in the order in which they were found; none are left over from one packet to the next.
pub(super) struct Waiting {
    len: usize,
    numbers: [[f64; ROOM]; NUMBERS],
    nodes: [u32; ROOM],
    rays: [u8; ROOM],
}

/// Samples to be shown together.
pub(super) struct Batch<S: Simd> {
    /// Lanes with a sample.
    pub(super) asked: u64,
    /// The ray of each.
    pub(super) rays: [u8; LANES],
    pub(super) k: f64x8<S>,
    pub(super) at: Places<S>,
    pub(super) place: transfer::lanes::Places<S>,
}

impl Waiting {
    pub(super) fn new() -> Self {
        Self { len: 0, numbers: [[0.0; ROOM]; NUMBERS], nodes: [0; ROOM], rays: [0; ROOM] }
    }

    /// Takes the visible samples of one plane.
    #[inline(always)]
    fn push<S: Simd>(&mut self, k: f64, at: Places<S>, place: &transfer::lanes::Places<S>) {
        let [x, y, z, wx, wy, wz] = at.to_columns();
        let columns: [[f64; LANES]; NUMBERS] = [[k; LANES], x, y, z, wx, wy, wz, place.alpha_u.into(), place.w.into()];
        let nodes = place.nodes.each();
        let mut left = place.visible;
        while left != 0 {
            let lane = left.trailing_zeros() as usize % LANES;
            left &= left - 1;
            // At most seven wait, so there is room for eight; the compiler cannot know.
            let to = self.len % ROOM;
            for (numbers, column) in self.numbers.iter_mut().zip(&columns) {
                numbers[to] = column[lane];
            }
            (self.nodes[to], self.rays[to]) = (nodes[lane], lane as u8);
            self.len += 1;
        }
    }

    /// Gives away the first eight, or as many as there are.
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
            place: transfer::lanes::Places { visible: asked, alpha_u, nodes: Nodes::Each(nodes), w },
        }
    }
}

/// What has come together on the rays: r, g, b and opacity of each, and the sample where it ends.
struct Light {
    rgba: [[f64; 4]; LANES],
    farthest: [f64; LANES],
}

impl Light {
    /// Rays that have not ended before sample k.
    #[inline(always)]
    fn open<S: Simd>(&self, simd: S, k: f64) -> mask64x8<S> {
        f64x8::simd_from(simd, self.farthest).simd_ge(k)
    }

    /// What has come together on each ray.
    #[inline(always)]
    fn opacity<S: Simd>(&self, simd: S) -> f64x8<S> {
        let mut opacity = [0.0; LANES];
        for (opacity, rgba) in opacity.iter_mut().zip(&self.rgba) {
            *opacity = rgba[3];
        }
        opacity.simd_into(simd)
    }
}

impl<S: Simd, V: Packed> Walk<'_, '_, S, V> {
    /// Visits all samples, the nearest plane first, and shows what is seen eight at a time.
    #[inline(always)]
    pub(super) fn run_waiting(&self, packet: &mut Packet<'_, '_>, look: &mut InStyle<'_, S>, counts: &mut Counts) {
        let simd = self.simd;
        let one = f64x8::splat(simd, 1.0);
        let waiting = &mut packet.waiting;
        let mut light = Light { rgba: [[0.0; 4]; LANES], farthest: packet.ends[1] };
        let nearest: f64x8<S> = packet.ends[0].simd_into(simd);
        // About what a ray lets through when all that waits is shown. Below the limit it may have ended by then.
        let (mut through, limit) = (one, 1.0 - self.prepared.stop_at);
        'rays: for &[first, last] in &packet.together {
            for k in first..=last {
                let k = k as f64;
                let open = light.open(simd, k);
                if open.all_false() {
                    break 'rays;
                }
                let active = open & nearest.simd_le(k);
                let at = self.reader.places(self.positions(k), active);
                let values = self.reader.values(&at);
                let Some(mut place) = self.prepared.function.locate_lanes(values, active) else {
                    continue;
                };
                let late = place.visible & through.simd_le(limit).to_bitmask();
                if 2 * late.count_ones() > place.visible.count_ones() {
                    // Most of what would join those that wait comes after the end of its ray.
                    self.show_all(waiting, look, &mut light, counts);
                    place.visible &= light.open(simd, k).to_bitmask();
                    through = one - light.opacity(simd);
                }
                waiting.push(k, at, &place);
                let seen = mask64x8::from_bitmask(simd, place.visible);
                through = seen.select(through * (one - place.alpha_u), through);
                if (through.simd_le(limit) | !open).all_true() {
                    self.show_all(waiting, look, &mut light, counts);
                    through = one - light.opacity(simd);
                } else if waiting.len >= LANES {
                    self.show_batch(&waiting.pop(simd), look, &mut light, counts);
                }
            }
        }
        self.show_all(waiting, look, &mut light, counts);
        packet.ends[1] = light.farthest;
        packet.rgba = light.rgba;
    }

    /// Shows all that wait.
    #[inline(always)]
    fn show_all(&self, waiting: &mut Waiting, look: &mut InStyle<'_, S>, light: &mut Light, counts: &mut Counts) {
        while waiting.len > 0 {
            self.show_batch(&waiting.pop(self.simd), look, light, counts);
        }
    }

    /// Shows samples and lays them behind what is in front of them.
    #[inline(always)]
    fn show_batch(&self, batch: &Batch<S>, look: &mut InStyle<'_, S>, light: &mut Light, counts: &mut Counts) {
        let simd = self.simd;
        let Looks { rgb: [r, g, b], alpha, ratio, counted } = look.show(self, batch);
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
            let ray = usize::from(batch.rays[lane]) % LANES;
            if k[lane] > light.farthest[ray] {
                continue;
            }
            shown |= 1 << lane;
            let sum = f64x4::simd_from(simd, light.rgba[ray]);
            let w = (1.0 - light.rgba[ray][3]) * corrected[lane];
            let sum = sum + rows[lane] * w;
            light.rgba[ray] = sum.into();
            if sum[3] >= self.prepared.stop_at {
                light.farthest[ray] = k[lane];
            }
        }
        counted.add(shown, counts);
    }
}
