//! One visit of a class: every voxel of the class takes its point of a rank.

use super::class::parities;
use super::groups::{GroupBounds, LANES, PointGroup, farthest, lower, settle};
use super::neighbours::{NeighbourLinks, id_of, offset_of};
use super::pool::{Class, Site, point_of, rows_of_groups};
use super::{Sites, flattened, scaled};
use crate::number::lanes::widely;
use drypoint_scene::parallel;

/// The parameters of a visit.
pub(super) struct Visit<'a> {
    pub(super) sweep: usize,
    pub(super) links: &'a NeighbourLinks,
    /// The scaled offset of each neighbour.
    pub(super) around: &'a [[f32; 3]],
    /// Bits of the classes whose points of this rank are taken already.
    pub(super) earlier: u8,
    /// Bits of the classes whose points of the previous rank have not been counted yet.
    pub(super) missed: u8,
    /// Whether visible points of this rank are final.
    pub(super) is_last: bool,
}

/// The taken points of the previous rank, and of this rank in the classes before and after the current one. Indices
/// are the voxels' places in the order of all.
pub(super) struct TakenPoints<'a> {
    pub(super) before: &'a [[f32; 3]],
    pub(super) left: &'a [[f32; 3]],
    pub(super) right: &'a [[f32; 3]],
    pub(super) start: usize,
    pub(super) end: usize,
}

/// Lets every voxel of a class take its point of a rank. `chosen` holds the draws of the rank.
pub(super) fn take(
    sites: &Sites<'_>,
    class: &mut Class,
    own: &mut [[f32; 3]],
    chosen: &mut [u32],
    size: usize,
    seen: &TakenPoints<'_>,
    step: &Visit<'_>,
) {
    let (start, number) = (class.start, class.number);
    let (pool, rows) = (size / LANES, rows_of_groups(size));
    let of_pools = class.pools.chunks_mut(parallel::RUN * pool).zip(class.rows.chunks_mut(parallel::RUN * rows));
    let of_sites =
        class.sites.chunks_mut(parallel::RUN).zip(own.chunks_mut(parallel::RUN)).zip(chosen.chunks_mut(parallel::RUN));
    parallel::each_of(of_pools.zip(of_sites).collect(), &|run, ((pools, all_rows), ((of_run, own), chosen))| {
        let of_pools = pools.chunks_mut(pool).zip(all_rows.chunks_mut(rows));
        let voxels = of_run.iter_mut().zip(of_pools).zip(own).zip(chosen);
        for (i, (((site, (pool, rows)), own), chosen)) in (start + run * parallel::RUN..).zip(voxels) {
            widely(
                #[inline(always)]
                || site.slot = visit(site, pool, rows, [i, number], seen, step),
            );
            *chosen = pool[site.slot / LANES].draws[site.slot % LANES];
            *own = scaled(sites, point_of(&site.slab, sites.seed, site.cell, *chosen));
        }
    });
}

/// Returns the pool index of the point that a voxel takes. `id` is the voxel's place in the order of all, `number`
/// its class.
#[inline(always)]
fn visit(
    site: &mut Site,
    pool: &mut [PointGroup],
    rows: &mut [GroupBounds],
    [id, number]: [usize; 2],
    seen: &TakenPoints<'_>,
    step: &Visit<'_>,
) -> usize {
    let neighbours = &step.links.all[site.first as usize..site.end as usize];
    let is_in = |set: u8, link: u32| set >> (number ^ parities(offset_of(link))) & 1 == 1;
    let mut near = NearbyPoints::new(site);
    // The first sweep removes the previous point from the pool, and adds all points of the previous rank to the
    // distances.
    if step.sweep == 0 {
        let group = site.slot / LANES;
        pool[group].far[site.slot % LANES] = -1.0;
        settle(pool[group].far, rows, group);
        near.add(seen.before[id], [0.0; 3]);
        for &link in neighbours.iter().filter(|&&link| is_in(step.missed, link)) {
            near.add(seen.before[id_of(link)], step.around[offset_of(link)]);
        }
        if !step.is_last {
            site.farthest = lower(pool, rows, near.points());
            near.clear(site);
        }
    }
    // Points of this rank that neighbours have already taken.
    for &link in neighbours.iter().filter(|&&link| is_in(step.earlier, link)) {
        let id = id_of(link);
        let point = if id < seen.start { seen.left[id] } else { seen.right[id - seen.end] };
        near.add(point, step.around[offset_of(link)]);
    }
    if step.is_last {
        site.farthest = lower(pool, rows, near.points());
        near.clear(site);
    }
    farthest(pool, rows, near.points())
}

/// The largest number of points near a voxel: its own of the previous rank, and two of each neighbour.
const MOST: usize = 1 + 2 * 26;

/// Points near enough to a voxel to affect its pool.
struct NearbyPoints {
    flat: [f32; 3],
    /// The largest squared distance from the centre at which a point has an effect.
    limit: f32,
    points: [[f32; 3]; MOST],
    len: usize,
}

impl NearbyPoints {
    #[inline(always)]
    fn new(site: &Site) -> Self {
        let mut near = Self { flat: site.flat, limit: 0.0, points: [[0.0; 3]; MOST], len: 0 };
        near.clear(site);
        near
    }

    /// Clears the points, and takes the current distances for the next ones.
    #[inline(always)]
    fn clear(&mut self, site: &Site) {
        let limit = site.farthest.sqrt() + site.reach;
        (self.limit, self.len) = (limit * limit, 0);
    }

    #[inline(always)]
    fn points(&self) -> &[[f32; 3]] {
        &self.points[..self.len]
    }

    /// Adds a point of a voxel that lies at `offset` from the site.
    #[inline(always)]
    fn add(&mut self, point: [f32; 3], offset: [f32; 3]) {
        let p = flattened(self.flat, [point[0] + offset[0], point[1] + offset[1], point[2] + offset[2]]);
        if p[0] * p[0] + p[1] * p[1] + p[2] * p[2] < self.limit {
            self.points[self.len] = p;
            self.len += 1;
        }
    }
}
