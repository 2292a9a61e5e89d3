//! The depths at which eight rays meet the boxes of visible bricks ([RAY-2]).

use super::packet::Column;
use super::rays::Rays;
use crate::field::lanes::LANES;
use crate::number::Vec3;
use crate::ray::brick_occupancy::{LEAST_ALONG, RayIntervals, add};
use drypoint_scene::glam::DVec3;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8, mask64x8};

/// The depths at which each of the first `n` rays is in one of the boxes, as by [`Line::meets`] and [`add`].
#[inline(always)]
pub(super) fn intervals<S: Simd>(
    simd: S,
    boxes: &RayIntervals,
    rays: &Rays<S>,
    n: usize,
    intervals: &mut [Vec<[f64; 2]>; LANES],
) {
    for intervals in intervals.iter_mut() {
        intervals.clear();
    }
    let there = u64::from(u8::MAX) >> (LANES - n);
    let (mut inverse, mut enter, mut leave) = ([rays.depth_step; 3], [rays.depth_step; 3], [rays.depth_step; 3]);
    let mut first = [0; 3];
    let mut differ = false;
    let axes = [(rays.origin.x, rays.along.x), (rays.origin.y, rays.along.y), (rays.origin.z, rays.along.z)];
    for (axis, (origin, along)) in axes.into_iter().enumerate() {
        // The steps of `Line::new`.
        let across = along.abs().simd_lt(LEAST_ALONG);
        let one_over = across.select(f64x8::splat(simd, 1.0 / LEAST_ALONG), f64x8::splat(simd, 1.0) / along);
        let margin = (origin.abs() + boxes.reach()) * 8.0 * f64::EPSILON * one_over.abs();
        let at = origin * one_over;
        (inverse[axis], enter[axis], leave[axis]) = (one_over, at + margin, at - margin);
        let back = one_over.simd_lt(0.0).to_bitmask() & there;
        first[axis] = usize::from(back != 0);
        differ |= back != 0 && back != there;
    }
    if differ {
        // The lines run towards different octants.
        for (lane, intervals) in intervals.iter_mut().enumerate().take(n) {
            let at = |v: &Vec3<f64x8<S>>| DVec3::new(v.x[lane], v.y[lane], v.z[lane]);
            let line = boxes.line([at(&rays.origin), at(&rays.along)], f64::EPSILON);
            boxes.ends().iter().filter_map(|ends| line.meets(ends)).for_each(|range| add(intervals, range));
        }
        return;
    }
    // The last interval of each line, which the next box mostly continues, as in `add`.
    let (mut last_from, mut last_to) = (f64x8::splat(simd, f64::INFINITY), f64x8::splat(simd, f64::NEG_INFINITY));
    let mut begun = 0;
    for ends in boxes.ends() {
        let (mut from, mut to) =
            (inverse[0] * ends[0][first[0]] - enter[0], inverse[0] * ends[0][1 - first[0]] - leave[0]);
        for axis in 1..3 {
            let (a, b) = (ends[axis][first[axis]], ends[axis][1 - first[axis]]);
            let (later, earlier) = (inverse[axis] * a - enter[axis], inverse[axis] * b - leave[axis]);
            from = later.simd_gt(from).select(later, from);
            to = earlier.simd_lt(to).select(earlier, to);
        }
        let met = from.simd_le(to);
        let goes_on = met & last_from.simd_le(from) & from.simd_le(last_to);
        let new = met.to_bitmask() & !goes_on.to_bitmask() & there;
        last_to = (goes_on & to.simd_gt(last_to)).select(to, last_to);
        if new != 0 {
            push(intervals, new & begun, last_from, last_to);
            begun |= new;
            let new = mask64x8::from_bitmask(simd, new);
            (last_from, last_to) = (new.select(from, last_from), new.select(to, last_to));
        }
    }
    push(intervals, begun, last_from, last_to);
}

/// Appends an interval to those of some lanes.
#[inline(always)]
fn push<S: Simd>(intervals: &mut [Vec<[f64; 2]>; LANES], lanes: u64, from: f64x8<S>, to: f64x8<S>) {
    let (from, to): (Column, Column) = (from.into(), to.into());
    let mut left = lanes;
    while left != 0 {
        let lane = left.trailing_zeros() as usize % LANES;
        left &= left - 1;
        intervals[lane].push([from[lane], to[lane]]);
    }
}
