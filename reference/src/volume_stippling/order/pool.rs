//! The pools of random points that voxels take theirs from.

use super::groups::{LANES, Lane, REACH, settle};
use super::links::{Links, offset_of, towards};
use super::{Sites, flattened, scaled};
use crate::volume_stippling::slab::{Slab, TRIES};
use drypoint_scene::glam::DVec3;
use rayon::prelude::*;

/// Points in the pool of a voxel that draws `each`.
pub(super) fn pool_size(each: usize) -> usize {
    (each + (5 * each).min(each.max(400))).next_multiple_of(LANES)
}

/// The most points of a voxel: a draw of the pool's last point has to have a number below [`CENTRE`].
pub(in crate::volume_stippling) const MOST_EACH: usize = (CENTRE / TRIES / 2) as usize - LANES;

/// In place of a draw: the centre of the voxel.
const CENTRE: u32 = u32::MAX;

/// Where a draw lies, from the voxel's centre in index space.
pub(super) fn point_of(slab: &Slab, seed: u64, cell: [u32; 3], draw: u32) -> [f32; 3] {
    slab.point(seed, cell, draw).unwrap_or([0.0; 3])
}

/// A voxel at work.
pub(super) struct Site {
    pub(super) cell: [u32; 3],
    pub(super) slab: Slab,
    /// n, scaled so that x − (n·x) n has lost its part along the normal; zero where distances are those in space.
    pub(super) flat: [f32; 3],
    /// No point of the pool is farther from the centre.
    pub(super) reach: f32,
    /// The largest distance squared that a point of the pool can have to those taken.
    pub(super) farthest: f32,
    /// Of the point that it took last, in its pool.
    pub(super) slot: usize,
    /// Where its neighbours stand in the list of all.
    pub(super) first: u32,
    pub(super) end: u32,
}

/// The voxels of a class, with their pools.
pub(super) struct Class {
    /// The parities of x, y and z, x lowest.
    pub(super) number: usize,
    /// Of the first in the order of all.
    pub(super) start: usize,
    pub(super) sites: Vec<Site>,
    /// For each site x, y, z and the squared distance to what is taken, of every point of its pool. What is no longer in
    /// the pool has a distance below 0.
    pub(super) pools: Vec<[Lane; 4]>,
    /// For each eight points of a pool, which lie together, what tells from afar whether they matter.
    pub(super) groups: Vec<[Lane; 6]>,
    /// The draw that made each point of a pool.
    pub(super) draws: Vec<u32>,
}

impl Class {
    pub(super) fn new(
        sites: &Sites<'_>,
        links: &Links,
        ids: &[u32],
        starts: &[usize; 9],
        class: usize,
        size: usize,
    ) -> Self {
        let (start, end) = (starts[class], starts[class + 1]);
        let mut members = vec![0usize; end - start];
        for (i, &id) in ids.iter().enumerate() {
            if (start..end).contains(&(id as usize)) {
                members[id as usize - start] = i;
            }
        }
        let mut pools = vec![[[0.0; LANES]; 4]; members.len() * size / LANES];
        let mut groups = vec![[[-1.0; LANES]; 6]; members.len() * rows_of_groups(size)];
        let mut draws = vec![0; members.len() * size];
        let parts = pools.par_chunks_mut(size / LANES).zip(groups.par_chunks_mut(rows_of_groups(size)));
        let parts = parts.zip(draws.par_chunks_mut(size));
        let sites = members
            .par_iter()
            .zip(parts)
            .map_init(Vec::new, |scratch, (&i, ((pool, groups), draws))| {
                let site = Site::new(sites, i, links.range(ids[i] as usize), links, draws, scratch);
                site.fill(pool, groups, scratch);
                site
            })
            .collect();
        Self { number: class, start, sites, pools, groups, draws }
    }

    /// The pool of a voxel of the class.
    pub(super) fn pool(&self, index: usize) -> &[[Lane; 4]] {
        let groups = self.pools.len() / self.sites.len();
        &self.pools[index * groups..][..groups]
    }

    /// What is known of the groups of that pool.
    pub(super) fn groups(&self, index: usize) -> &[[Lane; 6]] {
        let rows = self.groups.len() / self.sites.len();
        &self.groups[index * rows..][..rows]
    }

    /// The draw that made a point of a pool.
    pub(super) fn draw(&self, index: usize, slot: usize) -> u32 {
        self.draws[index * (self.draws.len() / self.sites.len()) + slot]
    }

    /// Where a point of a pool lies, from the voxel's centre in index space.
    pub(super) fn point(&self, sites: &Sites<'_>, index: usize, slot: usize) -> [f32; 3] {
        let site = &self.sites[index];
        point_of(&site.slab, sites.seed, site.cell, self.draw(index, slot))
    }
}

impl Site {
    /// The voxel with the draws of its pool, and in `scratch` where they lie, in the same order.
    fn new(
        sites: &Sites<'_>,
        i: usize,
        [first, end]: [u32; 2],
        links: &Links,
        draws: &mut [u32],
        scratch: &mut Vec<Drawn>,
    ) -> Self {
        let (cell, n) = (sites.cells[i], sites.normals[i]);
        let slab = Slab::new(sites.axes, n, sites.slab);
        let has = |side: f64| {
            let to = towards(sites, n * side);
            links.all[first as usize..end as usize].iter().any(|&link| offset_of(link) == to)
        };
        let flat = if has(1.0) && has(-1.0) { DVec3::ZERO } else { n };
        let flat = flat.to_array().map(|x| x as f32);
        let mut reach = 0f32;
        scratch.clear();
        for slot in 0..draws.len() as u32 {
            let mut tries = slot * TRIES..(slot + 1) * TRIES;
            let found = tries.find_map(|draw| slab.point(sites.seed, cell, draw).map(|o| (draw, o)));
            let (draw, o) = found.unwrap_or((CENTRE, [0.0; 3]));
            let at = flattened(flat, scaled(sites, o));
            reach = reach.max(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
            scratch.push(Drawn { key: 0, draw, at });
        }
        let reach = reach.sqrt();
        // Points that lie together stand together.
        for drawn in scratch.iter_mut() {
            drawn.key = morton(drawn.at.map(|x| 0.5 + 0.5 * x / reach.max(f32::MIN_POSITIVE)));
        }
        scratch.sort_unstable_by_key(|drawn| (drawn.key, drawn.draw));
        draws.iter_mut().zip(scratch.iter()).for_each(|(draw, drawn)| *draw = drawn.draw);
        Self { cell, slab, flat, reach, farthest: f32::MAX, slot: 0, first, end }
    }

    /// Puts the points into the pool, and what is known of its groups.
    fn fill(&self, pool: &mut [[Lane; 4]], groups: &mut [[Lane; 6]], points: &[Drawn]) {
        for (group, (lanes, points)) in pool.iter_mut().zip(points.chunks_exact(LANES)).enumerate() {
            let row = &mut groups[group / LANES];
            let mut reach = 0f32;
            for c in 0..3 {
                for (l, point) in points.iter().enumerate() {
                    lanes[c][l] = point.at[c];
                }
                row[c][group % LANES] = lanes[c].iter().sum::<f32>() / LANES as f32;
            }
            // Before anything is taken the first draw counts as the farthest: a random one, wherever it stands here.
            for (d, point) in lanes[3].iter_mut().zip(points) {
                *d = f32::MAX / (1.0 + point.draw as f32);
            }
            for point in points {
                let off: f32 = (0..3).map(|c| point.at[c] - row[c][group % LANES]).map(|x| x * x).sum();
                reach = reach.max(off);
            }
            // Rounding of the middle and of distances must not hide a point: a thousandth is far more than both.
            row[REACH][group % LANES] = reach.sqrt() * 1.001 + f32::MIN_POSITIVE;
            settle(lanes, groups, group);
        }
    }
}

/// A random point of a pool.
struct Drawn {
    /// Its place along a curve that keeps together what lies together.
    key: u32,
    draw: u32,
    at: [f32; 3],
}

/// Bits of three numbers from 0 to 1, ten of each, in turn: Morton's order.
fn morton(at: [f32; 3]) -> u32 {
    let spread = |x: f32| {
        // `as` clamps at 0.
        let x = ((x * 1024.0) as u32).min(1023);
        (0..10).fold(0, |bits, i| bits | (x >> i & 1) << (3 * i))
    };
    spread(at[0]) | spread(at[1]) << 1 | spread(at[2]) << 2
}

/// Rows of eight groups of eight points.
pub(super) fn rows_of_groups(size: usize) -> usize {
    size.div_ceil(LANES * LANES)
}
