//! A visit of a class: every voxel of it takes its point of a rank.

use super::class::parities;
use super::groups::{LANES, farthest, lower, settle};
use super::links::{Links, id_of, offset_of};
use super::pool::{Class, Site, point_of, pool_size, rows_of_groups};
use super::{Sites, flattened, scaled};
use rayon::prelude::*;

/// What a visit of a class is about.
pub(super) struct Step<'a> {
    pub(super) rank: usize,
    pub(super) sweep: usize,
    pub(super) links: &'a Links,
    /// The offset of each neighbour, scaled.
    pub(super) around: &'a [[f32; 3]],
    /// The classes, as bits, whose points of this rank are there to be seen.
    pub(super) earlier: u8,
}

/// The points that are taken, by the voxels' places in the order of all: of the rank before, and of this one in the classes
/// before and after the one at work.
pub(super) struct Seen<'a> {
    pub(super) before: &'a [[f32; 3]],
    pub(super) left: &'a [[f32; 3]],
    pub(super) right: &'a [[f32; 3]],
    pub(super) start: usize,
    pub(super) end: usize,
}

/// Every voxel of a class takes its point of a rank.
pub(super) fn take(
    sites: &Sites<'_>,
    class: &mut Class,
    own: &mut [[f32; 3]],
    chosen: &mut [u32],
    each: usize,
    seen: &Seen<'_>,
    step: &Step<'_>,
) {
    let size = pool_size(each);
    let (start, number) = (class.start, class.number);
    let (pools, draws) = (class.pools.par_chunks_mut(size / LANES), class.draws.par_chunks(size));
    let groups = class.groups.par_chunks_mut(rows_of_groups(size));
    let voxels = class.sites.par_iter_mut().zip(pools).zip(groups).zip(draws).zip(own).zip(chosen.par_chunks_mut(each));
    voxels.enumerate().with_min_len(256).for_each(|(i, (((((site, pool), groups), draws), own), chosen))| {
        let neighbours = &step.links.all[site.first as usize..site.end as usize];
        let mut near = Near::new();
        if step.sweep == 0 {
            let group = site.slot / LANES;
            pool[group][3][site.slot % LANES] = -1.0;
            settle(&pool[group], groups, group);
            near.add(site, seen.before[start + i], [0.0; 3]);
            for &link in neighbours {
                near.add(site, seen.before[id_of(link)], step.around[offset_of(link)]);
            }
            site.farthest = lower(pool, groups, near.points());
            near = Near::new();
        }
        for &link in neighbours {
            let id = id_of(link);
            if step.earlier >> (number ^ parities(offset_of(link))) & 1 == 1 {
                let point = if id < seen.start { seen.left[id] } else { seen.right[id - seen.end] };
                near.add(site, point, step.around[offset_of(link)]);
            }
        }
        site.slot = farthest(pool, groups, near.points());
        chosen[step.rank] = draws[site.slot];
        *own = scaled(sites, point_of(&site.slab, sites.seed, site.cell, draws[site.slot]));
    });
}

/// Points that come near enough to a voxel to matter to its pool.
struct Near {
    points: [[f32; 3]; 27],
    len: usize,
}

impl Near {
    fn new() -> Self {
        Self { points: [[0.0; 3]; 27], len: 0 }
    }

    fn points(&self) -> &[[f32; 3]] {
        &self.points[..self.len]
    }

    /// A point of the voxel that lies at `offset` from the site.
    #[inline]
    fn add(&mut self, site: &Site, point: [f32; 3], offset: [f32; 3]) {
        let p = flattened(site.flat, [point[0] + offset[0], point[1] + offset[1], point[2] + offset[2]]);
        let limit = site.farthest.sqrt() + site.reach;
        if p[0] * p[0] + p[1] * p[1] + p[2] * p[2] < limit * limit {
            self.points[self.len] = p;
            self.len += 1;
        }
    }
}
