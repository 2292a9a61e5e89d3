//! Eight rays of a tile: how they run, which samples they visit, and what they found.

use super::intervals;
use super::rays::Rays;
use crate::field::lanes::LANES;
use crate::number::Vec3;
use crate::number::lanes::{columns, rows};
use crate::ray::brick_occupancy::{RayIntervals, merge};
use crate::ray::lattice::IndexRay;
use crate::ray::prepared::Prepared;
use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4, f64x8};

/// Numbers of eight rays.
pub(super) type Column = [f64; LANES];
/// Four numbers of one ray.
pub(super) type Row = [f64; 4];
/// Depths at which each of eight rays is in a visible brick.
pub(super) type Intervals = [Vec<[f64; 2]>; LANES];

/// A plane of a packet on which values were expensive, and the lanes for which they were computed.
pub(super) type Asked = (i64, u64);

/// Number of rays whose samples wait for each other: those of a tile.
pub(super) const RAYS: usize = 8 * LANES;

/// Rays side by side and their results. Lanes without a ray visit nothing.
pub(super) struct Packet<'p, 'v> {
    pub(super) prepared: &'p Prepared<'v, f64>,
    pub(super) origin: [Column; 3],
    pub(super) along: [Column; 3],
    pub(super) depth_step: Column,
    /// Δ_ray.
    pub(super) step: Column,
    /// The smallest sample beyond `near`.
    pub(super) first: i64,
    /// v and Δ_ray of each ray.
    pub(super) sights: [Row; LANES],
    /// v in eye space, and the smallest sample beyond `near`.
    pub(super) eyes: [Row; LANES],
    pub(super) half: [Column; 3],
    /// The visits of the rays, one ray after the other: first and last sample of each interval.
    pub(super) visits: Vec<[i64; 2]>,
    /// The range of each ray's visits among them.
    pub(super) of_ray: [[usize; 2]; LANES],
    /// The union of all visits, in order and without overlap. A ray sees nothing between its own visits, so it may
    /// follow those of its neighbours.
    pub(super) together: Vec<[i64; 2]>,
    /// First and last sample of each ray. After the traversal the last one is where the ray ended.
    pub(super) ends: [Column; 2],
    /// The planes and lanes for which values were computed, if values are expensive.
    pub(super) asked: Vec<Asked>,
    pub(super) rgba: [[f64; 4]; LANES],
}

impl<'p, 'v> Packet<'p, 'v> {
    pub(super) fn new(prepared: &'p Prepared<'v, f64>) -> Self {
        let none = [0.0; LANES];
        Self {
            prepared,
            origin: [none; 3],
            along: [none; 3],
            depth_step: none,
            step: none,
            first: prepared.lattice.first(&prepared.view),
            sights: [[0.0; 4]; LANES],
            eyes: [[0.0; 4]; LANES],
            half: [none; 3],
            visits: Vec::with_capacity(4 * LANES),
            of_ray: [[0; 2]; LANES],
            together: Vec::with_capacity(4 * LANES),
            ends: [none; 2],
            asked: Vec::new(),
            rgba: [[0.0; 4]; LANES],
        }
    }

    /// Takes the rays through other points, with the boxes of visible bricks. The flag tells whether all boxes lie more
    /// than half a voxel inside the volume.
    #[inline(always)]
    pub(super) fn aim<S: Simd>(
        &mut self,
        simd: S,
        points: &[[f64; 2]],
        boxes: Option<(&RayIntervals, bool)>,
        intervals: &mut Intervals,
    ) {
        let prepared = self.prepared;
        self.visits.clear();
        self.asked.clear();
        self.of_ray = [[0; 2]; LANES];
        self.ends = [[f64::INFINITY; LANES], [f64::NEG_INFINITY; LANES]];
        self.rgba = [[0.0; 4]; LANES];
        let rays = Rays::through(simd, prepared, points);
        (self.origin, self.along) = (stored(rays.origin), stored(rays.along));
        (self.depth_step, self.step, self.half) = (rays.depth_step.into(), rays.step.into(), stored(rays.half));
        let first = f64x8::splat(simd, self.first as f64);
        let sights = rows([rays.v.x, rays.v.y, rays.v.z, rays.step]);
        let eyes = rows([rays.v_eye.x, rays.v_eye.y, rays.v_eye.z, first]);
        for lane in 0..LANES {
            (self.sights[lane], self.eyes[lane]) = (sights[lane].into(), eyes[lane].into());
        }
        if let Some((boxes, _)) = boxes {
            intervals::intervals(simd, boxes, &rays, points.len(), intervals);
        }
        for (lane, intervals) in intervals.iter_mut().enumerate().take(points.len()) {
            let (ray, clip) = (self.ray(lane), &prepared.object.clip.planes);
            let before = self.visits.len();
            match boxes {
                None => self.visits.extend(ray.visits(prepared.object.ends, clip, None)),
                Some(_) if intervals.is_empty() => continue,
                Some((_, inside)) => {
                    merge(intervals);
                    let inside = if inside { ray.all_beyond_near() } else { None };
                    let range = inside.filter(|_| clip.is_empty());
                    let ends = prepared.object.ends;
                    let range = range.unwrap_or_else(|| ray.left_by(clip, ends, ray.inside(ends)));
                    self.visits.extend(ray.parts(range, intervals));
                }
            }
            if let [[nearest, _], ..] = self.visits[before..] {
                self.of_ray[lane] = [before, self.visits.len()];
                self.ends[0][lane] = nearest as f64;
                self.ends[1][lane] = self.visits[self.visits.len() - 1][1] as f64;
            }
        }
        self.join();
    }

    /// The ray of a lane.
    #[inline(always)]
    fn ray(&self, lane: usize) -> IndexRay<f64> {
        let vector = |[x, y, z]: &[Column; 3]| Vec3::new(x[lane], y[lane], z[lane]);
        IndexRay {
            origin: vector(&self.origin),
            along: vector(&self.along),
            depth_step: self.depth_step[lane],
            first: self.first,
            step: self.step[lane],
        }
    }

    /// Joins the visits of all rays.
    fn join(&mut self) {
        self.together.clear();
        for [first, end] in self.of_ray {
            let mut from = 0;
            for &range in &self.visits[first..end] {
                from = unite(&mut self.together, range, from);
            }
        }
    }

    /// The number of samples that a ray visited. If values are expensive, it is the number of values that were
    /// computed.
    pub(super) fn samples(&self, lane: usize, dear: bool) -> u64 {
        let [first, end] = self.of_ray[lane];
        let last = self.ends[1][lane] as i64;
        if dear {
            return self.asked.iter().map(|&(k, lanes)| u64::from(k <= last) & lanes >> lane & 1).sum();
        }
        self.visits[first..end].iter().map(|v| (v[1].min(last) + 1 - v[0]).max(0) as u64).sum()
    }
}

/// Adds a range to disjoint ranges in order, and returns its index. No range before `from` lies behind its beginning.
fn unite(ranges: &mut Vec<[i64; 2]>, [first, last]: [i64; 2], mut from: usize) -> usize {
    while from < ranges.len() && ranges[from][1] + 1 < first {
        from += 1;
    }
    if from == ranges.len() || last + 1 < ranges[from][0] {
        ranges.insert(from, [first, last]);
        return from;
    }
    ranges[from] = [ranges[from][0].min(first), ranges[from][1].max(last)];
    while from + 1 < ranges.len() && ranges[from + 1][0] <= ranges[from][1] + 1 {
        ranges[from][1] = ranges[from][1].max(ranges[from + 1][1]);
        ranges.remove(from + 1);
    }
    from
}

#[inline(always)]
fn stored<S: Simd>(v: Vec3<f64x8<S>>) -> [Column; 3] {
    [v.x.into(), v.y.into(), v.z.into()]
}

/// The rows of the rays of all lanes, as columns.
#[inline(always)]
pub(super) fn of_rays<S: Simd, const N: usize>(simd: S, of_ray: &[Row; N], rays: &[u8; LANES]) -> [f64x8<S>; 4] {
    let mut rows = [f64x4::splat(simd, 0.0); LANES];
    for lane in 0..LANES {
        rows[lane] = f64x4::simd_from(simd, of_ray[usize::from(rays[lane]) % N]);
    }
    columns(rows)
}

/// The rays in their order.
pub(super) const IN_ORDER: [u8; LANES] = [0, 1, 2, 3, 4, 5, 6, 7];

#[inline(always)]
pub(super) fn vector<S: Simd>(simd: S, [x, y, z]: [Column; 3]) -> Vec3<f64x8<S>> {
    Vec3::new(x.simd_into(simd), y.simd_into(simd), z.simd_into(simd))
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// United ranges hold what the ranges hold, in whichever order these come. They neither meet nor hold more.
        #[test]
        fn united_ranges_hold_what_they_are_made_of(
            rays in prop::collection::vec(prop::collection::vec((0i64..9, 0i64..9), 0..6), 0..5),
        ) {
            let (mut ranges, mut inside) = (Vec::new(), [false; 128]);
            for ray in rays {
                let (mut next, mut from) = (0, 0);
                for (gap, more) in ray {
                    let range = [next + gap, next + gap + more];
                    next = range[1] + 1;
                    from = unite(&mut ranges, range, from);
                    inside[range[0] as usize..=range[1] as usize].fill(true);
                }
            }
            prop_assert!(ranges.windows(2).all(|w| w[0][1] + 1 < w[1][0]), "{:?}", ranges);
            for (k, inside) in inside.into_iter().enumerate() {
                prop_assert_eq!(ranges.iter().any(|r| r[0] <= k as i64 && k as i64 <= r[1]), inside, "{} {:?}", k, ranges);
            }
        }
    }
}
