//! Where eight rays meet the boxes of visible bricks ([RAY-2]).

use super::Column;
use crate::field::lanes::LANES;
use crate::ray::skip::{Line, add};
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x8};

/// The depths at which each line is in each of the boxes, as [`Line::meets`] has them; none of lanes without a line.
#[inline(always)]
pub(super) fn intervals<S: Simd>(
    simd: S,
    boxes: &[[[f64; 2]; 3]],
    lines: &[Option<Line>; LANES],
    intervals: &mut [Vec<[f64; 2]>; LANES],
) {
    for intervals in intervals.iter_mut() {
        intervals.clear();
    }
    let mut known = lines.iter().flatten();
    let Some(first) = known.next().map(|line| line.first) else { return };
    if known.any(|line| line.first != first) {
        // Lines that run towards different octants.
        for (line, intervals) in lines.iter().zip(intervals) {
            if let Some(line) = line {
                boxes.iter().filter_map(|ends| line.meets(ends)).for_each(|range| add(intervals, range));
            }
        }
        return;
    }
    let mut columns = [[[0.0; LANES]; 3]; 3];
    let mut there = 0u64;
    for (lane, line) in lines.iter().enumerate() {
        if let Some(line) = line {
            there |= 1 << lane;
            for (columns, of_axes) in columns.iter_mut().zip([line.inverse, line.enter, line.leave]) {
                for (column, number) in columns.iter_mut().zip(of_axes) {
                    column[lane] = number;
                }
            }
        }
    }
    let zero = f64x8::splat(simd, 0.0);
    let mut lanes = [[zero; 3]; 3];
    for (lanes, columns) in lanes.iter_mut().zip(columns) {
        for (lanes, column) in lanes.iter_mut().zip(columns) {
            *lanes = column.simd_into(simd);
        }
    }
    let [inverse, enter, leave] = lanes;
    for ends in boxes {
        let (mut from, mut to) =
            (inverse[0] * ends[0][first[0]] - enter[0], inverse[0] * ends[0][1 - first[0]] - leave[0]);
        for axis in 1..3 {
            let (a, b) = (ends[axis][first[axis]], ends[axis][1 - first[axis]]);
            let (later, earlier) = (inverse[axis] * a - enter[axis], inverse[axis] * b - leave[axis]);
            from = later.simd_gt(from).select(later, from);
            to = earlier.simd_lt(to).select(earlier, to);
        }
        let mut met = from.simd_le(to).to_bitmask() & there;
        if met != 0 {
            let (from, to): (Column, Column) = (from.into(), to.into());
            while met != 0 {
                let lane = met.trailing_zeros() as usize;
                met &= met - 1;
                add(&mut intervals[lane], [from[lane], to[lane]]);
            }
        }
    }
}
