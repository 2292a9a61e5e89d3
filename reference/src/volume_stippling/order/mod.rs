//! Relaxation and order of a volume's points ([STIP-4]).
//!
//! Each voxel has a pool of random points, more than it draws. Rank by rank, every voxel takes from its pool the
//! point farthest from all taken points, its own and those of its 26 neighbours. So the taken points are spread
//! evenly at every rank, within a voxel and across its faces, and each prefix is a subset of the next.
//!
//! The voxels of one of the eight parity classes of 2×2×2 have no neighbour in their class, so a class is processed
//! in parallel. The order of the classes is hashed for each rank, so that none is always first. Voxels that come
//! early in a rank cannot see the later ones. In the first ranks, where few points fix the spacing, each voxel
//! therefore takes its point again with all others of the rank in view (`SWEEPS`).
//!
//! Points must look even in projection. A face is thin at a voxel that lacks a neighbour with points before or behind
//! it, along its normal. Distances are then measured in the tangent plane, elsewhere in space.
mod class;
mod first_points;
mod groups;
mod neighbours;
mod pool;
mod visit;

use super::slab::Slab;
use class::{OF_RANKS, by_class, class_of, class_order};
use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::parallel;
use groups::{GroupBounds, LANES, PointGroup};
use neighbours::NeighbourLinks;
use pool::{Class, Site, point_of, pool_size, rows_of_groups};
use visit::{TakenPoints, Visit, take};

pub(super) use neighbours::MOST_VOXELS;
pub(super) use pool::MOST_EACH;

/// The voxels that get points, and the shape of their slabs.
pub(super) struct Sites<'a> {
    /// Voxels in ascending linear order.
    pub(super) cells: &'a [[u32; 3]],
    /// The normal n of each voxel.
    pub(super) normals: &'a [DVec3],
    /// The grid's axes D.
    pub(super) axes: DMat3,
    /// The smallest spacing.
    pub(super) voxel: f64,
    /// Half the distance of the two planes, in world units.
    pub(super) slab: f64,
    /// The displacement from each centre to the edge, in index space; empty if points are not moved.
    pub(super) to_edge: &'a [DVec3],
    pub(super) seed: u64,
    /// Whether voxels take their neighbours into account.
    pub(super) neighbours: bool,
}

impl Sites<'_> {
    /// The slab of a voxel's points.
    fn slab_of(&self, i: usize) -> Slab {
        match self.to_edge.get(i) {
            Some(&to_edge) => Slab::on_edge(self.axes, self.normals[i], to_edge),
            None => Slab::new(self.axes, self.normals[i], self.slab),
        }
    }
}

/// Number of times that each voxel takes its point of a rank after the first.
fn sweeps(rank: usize) -> usize {
    match rank {
        1..4 => 3,
        _ => 1,
    }
}

/// Temporary memory of ordering in bytes per voxel, without the points.
pub(super) fn bytes_a_voxel(each: usize) -> u64 {
    (pool_size(each) / LANES * size_of::<PointGroup>()
        + rows_of_groups(pool_size(each)) * size_of::<GroupBounds>()
        + 26 * size_of::<u32>()
        + first_points::BYTES_A_VOXEL
        + size_of::<Site>()) as u64
}

/// Takes `each` points for every voxel, in the order in which they are drawn, voxel after voxel. `done` receives the
/// number of finished ranks.
pub(super) fn points(sites: &Sites<'_>, each: usize, done: &(dyn Fn(usize) + Sync)) -> Vec<[f32; 3]> {
    let n = sites.cells.len();
    let size = pool_size(each);
    // Voxels are sorted by parity class, so that a class is a slice whose voxels can be processed in parallel.
    let (ids, starts) = by_class(sites.cells);
    let links = NeighbourLinks::new(sites, &ids);
    let around: Vec<[f32; 3]> = (0..27).map(|k| scaled(sites, delta(k))).collect();
    let mut classes: Vec<Class> = (0..8).map(|class| Class::new(sites, &links, &ids, &starts, class, size)).collect();
    let mut taken = [vec![[0f32; 3]; n], vec![[0f32; 3]; n]];
    // Sorted by rank, so that a visit writes contiguous memory.
    let mut chosen = vec![0u32; n * each];
    // Rank 0.
    for (i, slot) in first_points::first_points(sites, &classes, &ids).into_iter().enumerate() {
        let id = ids[i] as usize;
        let class = &mut classes[class_of(sites.cells[i])];
        let index = id - class.start;
        class.sites[index].slot = slot;
        chosen[id] = class.draw(index, slot);
        taken[1][id] = scaled(sites, class.point(sites, index, slot));
    }
    done(1);
    // Further ranks: every class in hashed order, `sweeps` times. `before` holds the points of the previous rank.
    for rank in 1..each {
        let order = class_order::<8>(sites.seed, rank as u32, OF_RANKS);
        let order_before = class_order::<8>(sites.seed, rank as u32 - 1, OF_RANKS);
        let [before, now] = &mut taken;
        std::mem::swap(before, now);
        for sweep in 0..sweeps(rank) {
            for (place, &class) in order.iter().enumerate() {
                let earlier = if sweep == 0 { &order[..place] } else { &order[..] };
                let earlier = set(earlier);
                let missed = match order_before.iter().position(|&c| c == class) {
                    Some(place) if rank > 1 && sweeps(rank - 1) == 1 => set(&order_before[place..]),
                    _ => set(&order),
                };
                let is_last = sweeps(rank) == 1;
                let step = Visit { sweep, links: &links, around: &around, earlier, missed, is_last };
                let class = &mut classes[class];
                // The class writes its own slice and reads the other classes on both sides of it.
                let (start, end) = (class.start, class.start + class.sites.len());
                let (left, rest) = now.split_at_mut(start);
                let (own, right) = rest.split_at_mut(end - start);
                let seen = TakenPoints { before, left, right, start, end };
                take(sites, class, own, &mut chosen[rank * n..][start..end], size, &seen, &step);
            }
        }
        done(rank + 1);
    }
    // Back from the order of the classes to that of the voxels.
    let mut points = vec![[0f32; 3]; n * each];
    parallel::chunks_mut(&mut points, each.max(1), &|i, points| {
        let id = ids[i] as usize;
        let slab = sites.slab_of(i);
        for (rank, point) in points.iter_mut().enumerate() {
            *point = point_of(&slab, sites.seed, sites.cells[i], chosen[rank * n + id]);
        }
    });
    points
}

/// A bit set of classes.
fn set(classes: &[usize]) -> u8 {
    classes.iter().fold(0, |set, &class| set | 1 << class)
}

/// Maps an offset from index to world space, in units of the voxel.
fn scaled(sites: &Sites<'_>, o: [f32; 3]) -> [f32; 3] {
    let p = sites.axes * DVec3::from_array(o.map(f64::from)) / sites.voxel;
    p.to_array().map(|x| x as f32)
}

#[inline(always)]
fn flattened(f: [f32; 3], p: [f32; 3]) -> [f32; 3] {
    let along = p[0] * f[0] + p[1] * f[1] + p[2] * f[2];
    [p[0] - along * f[0], p[1] - along * f[1], p[2] - along * f[2]]
}

/// The step from a voxel to neighbour k, x fastest.
fn delta(k: usize) -> [f32; 3] {
    [k % 3, k / 3 % 3, k / 9].map(|i| i as f32 - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    pub(super) fn sites<'a>(cells: &'a [[u32; 3]], normals: &'a [DVec3], neighbours: bool) -> Sites<'a> {
        Sites { cells, normals, axes: DMat3::IDENTITY, voxel: 1.0, slab: 0.5, to_edge: &[], seed: 1, neighbours }
    }
}
