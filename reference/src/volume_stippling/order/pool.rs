//! Pools of random points from which voxels take theirs.

use super::groups::{GroupBounds, LANES, PointGroup, REACH, settle};
use super::neighbours::{NeighbourLinks, offset_of, towards};
use super::{Sites, flattened, scaled};
use crate::number::lanes::widely;
use crate::volume_stippling::slab::{Slab, TRIES};
use drypoint_scene::glam::DVec3;
use drypoint_scene::parallel;

/// Pool size of a voxel that draws `each` points.
pub(super) fn pool_size(each: usize) -> usize {
    (each + (5 * each).min(each.max(400))).next_multiple_of(LANES)
}

/// The largest number of points of a voxel. The draw of the pool's last point must have a number below [`CENTRE`].
pub(in crate::volume_stippling) const MOST_EACH: usize = (CENTRE / TRIES / 2) as usize - LANES;

/// Replaces a draw: the centre of the voxel.
const CENTRE: u32 = u32::MAX;

/// The point of a draw, as an offset from the voxel's centre in index space.
pub(super) fn point_of(slab: &Slab, seed: u64, cell: [u32; 3], draw: u32) -> [f32; 3] {
    slab.point(seed, cell, draw).unwrap_or([0.0; 3])
}

/// The current state of a voxel.
pub(super) struct Site {
    pub(super) cell: [u32; 3],
    pub(super) slab: Slab,
    /// n, scaled so that x − (n·x) n has no part along the normal; zero if distances are measured in space.
    pub(super) flat: [f32; 3],
    /// The largest distance of the pool's points from the centre.
    pub(super) reach: f32,
    /// Upper bound of the squared distance from a point of the pool to the taken points.
    pub(super) farthest: f32,
    /// Pool index of the point taken last.
    pub(super) slot: usize,
    /// Start of its neighbours in the list of all.
    pub(super) first: u32,
    pub(super) end: u32,
}

/// The voxels of a class, with their pools.
pub(super) struct Class {
    /// The parities of x, y and z, x lowest.
    pub(super) number: usize,
    /// Place of the first voxel in the order of all.
    pub(super) start: usize,
    pub(super) sites: Vec<Site>,
    /// The groups of each site's pool.
    pub(super) pools: Vec<PointGroup>,
    /// The rows of each site's groups.
    pub(super) rows: Vec<GroupBounds>,
}

impl Class {
    pub(super) fn new(
        sites: &Sites<'_>,
        links: &NeighbourLinks,
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
        let group = PointGroup { at: [[0.0; LANES]; 3], far: [0.0; LANES], draws: [0; LANES] };
        let mut pools = vec![group; members.len() * size / LANES];
        let mut rows = vec![[[-1.0; LANES]; 6]; members.len() * rows_of_groups(size)];
        let pools_of_run = pools.chunks_mut(parallel::RUN * size / LANES);
        let runs =
            pools_of_run.zip(rows.chunks_mut(parallel::RUN * rows_of_groups(size))).zip(members.chunks(parallel::RUN));
        let made = parallel::map_of(runs.collect(), &|_, ((pools, rows), members)| {
            let mut scratch = Vec::new();
            let parts = pools.chunks_mut(size / LANES).zip(rows.chunks_mut(rows_of_groups(size)));
            let sites = members.iter().zip(parts).map(|(&i, (pool, rows))| {
                let site = widely(
                    #[inline(always)]
                    || Site::new(sites, i, links.range(ids[i] as usize), links, size, &mut scratch),
                );
                site.fill(pool, rows, &scratch);
                site
            });
            sites.collect::<Vec<_>>()
        });
        let sites = made.into_iter().flatten().collect();
        Self { number: class, start, sites, pools, rows }
    }

    /// The pool of a voxel of the class.
    pub(super) fn pool(&self, index: usize) -> &[PointGroup] {
        let groups = self.pools.len() / self.sites.len();
        &self.pools[index * groups..][..groups]
    }

    /// Bounds of the groups of a voxel's pool.
    pub(super) fn rows(&self, index: usize) -> &[GroupBounds] {
        let rows = self.rows.len() / self.sites.len();
        &self.rows[index * rows..][..rows]
    }

    /// The draw that made a point of a pool.
    pub(super) fn draw(&self, index: usize, slot: usize) -> u32 {
        self.pool(index)[slot / LANES].draws[slot % LANES]
    }

    /// A point of a pool, as an offset from the voxel's centre in index space.
    pub(super) fn point(&self, sites: &Sites<'_>, index: usize, slot: usize) -> [f32; 3] {
        let site = &self.sites[index];
        point_of(&site.slab, sites.seed, site.cell, self.draw(index, slot))
    }
}

impl Site {
    /// A voxel, with `size` points of its pool in `points`, sorted so that near points are close in memory.
    #[inline(always)]
    fn new(
        sites: &Sites<'_>,
        i: usize,
        [first, end]: [u32; 2],
        links: &NeighbourLinks,
        size: usize,
        points: &mut Vec<PoolPoint>,
    ) -> Self {
        let (cell, n) = (sites.cells[i], sites.normals[i]);
        let slab = sites.slab_of(i);
        // A face with neighbours on neither or only one side along n is thin: distances are in the tangent plane.
        let has = |side: f64| {
            let to = towards(sites, n * side);
            links.all[first as usize..end as usize].iter().any(|&link| offset_of(link) == to)
        };
        let flat = if has(1.0) && has(-1.0) { DVec3::ZERO } else { n };
        let flat = flat.to_array().map(|x| x as f32);
        let mut reach = 0f32;
        points.clear();
        // Random points inside the slab, eight draws at a time. Draws that miss are repeated one by one.
        for group in 0..(size / LANES) as u32 {
            let mut draws = [0; LANES];
            for (l, draw) in (0..).zip(&mut draws) {
                *draw = (group * LANES as u32 + l) * TRIES;
            }
            let (offsets, is_inside) = slab.points(sites.seed, cell, draws);
            for l in 0..LANES {
                let (draw, o) =
                    if is_inside[l] { (draws[l], offsets[l]) } else { next_inside(&slab, sites.seed, cell, draws[l]) };
                let at = flattened(flat, scaled(sites, o));
                reach = reach.max(at[0] * at[0] + at[1] * at[1] + at[2] * at[2]);
                points.push(PoolPoint { key: 0, draw, at });
            }
        }
        // Sorting by Morton code keeps near points in one group, so that bounds of groups are tight.
        let reach = reach.sqrt();
        let scale = 0.5 / reach.max(f32::MIN_POSITIVE);
        for point in points.iter_mut() {
            point.key = u64::from(morton(point.at.map(|x| 0.5 + scale * x))) << 32 | u64::from(point.draw);
        }
        points.sort_unstable_by_key(|point| point.key);
        Self { cell, slab, flat, reach, farthest: f32::MAX, slot: 0, first, end }
    }

    /// Fills the pool with the points and computes the bounds of its groups.
    fn fill(&self, pool: &mut [PointGroup], rows: &mut [GroupBounds], points: &[PoolPoint]) {
        for (number, (group, points)) in pool.iter_mut().zip(points.chunks_exact(LANES)).enumerate() {
            let row = &mut rows[number / LANES];
            let mut reach = 0f32;
            for (c, (at, means)) in group.at.iter_mut().zip(row.iter_mut()).enumerate() {
                for (at, point) in at.iter_mut().zip(points) {
                    *at = point.at[c];
                }
                means[number % LANES] = at.iter().sum::<f32>() / LANES as f32;
            }
            for (l, point) in points.iter().enumerate() {
                group.draws[l] = point.draw;
                // Before any point is taken the first draw counts as the farthest: a random point, wherever sorting
                // puts it.
                group.far[l] = f32::MAX / (1.0 + point.draw as f32);
                let off: f32 = (0..3).map(|c| point.at[c] - row[c][number % LANES]).map(|x| x * x).sum();
                reach = reach.max(off);
            }
            // A margin of a thousandth, far more than the rounding of middle and distances, which must not exclude a
            // point.
            row[REACH][number % LANES] = reach.sqrt() * 1.001 + f32::MIN_POSITIVE;
            settle(group.far, rows, number);
        }
    }
}

/// The next draw that falls inside, and its point.
#[cold]
fn next_inside(slab: &Slab, seed: u64, cell: [u32; 3], draw: u32) -> (u32, [f32; 3]) {
    let found = (draw + 1..draw + TRIES).find_map(|draw| slab.point(seed, cell, draw).map(|o| (draw, o)));
    found.unwrap_or((CENTRE, [0.0; 3]))
}

/// A random point of a pool.
struct PoolPoint {
    /// Key for sorting: the Morton code of the place, then the draw.
    key: u64,
    draw: u32,
    at: [f32; 3],
}

/// Morton code: the bits of three numbers from 0 to 1, ten bits each, interleaved.
#[inline(always)]
fn morton(at: [f32; 3]) -> u32 {
    let spread = |x: f32| {
        // `as` clamps at 0.
        let x = ((x * 1024.0) as i32).clamp(0, 1023) as u32;
        // Spreads the bits, halving the groups until two places are free after each bit.
        let x = (x | x << 16) & 0x0300_00ff;
        let x = (x | x << 8) & 0x0300_f00f;
        let x = (x | x << 4) & 0x030c_30c3;
        (x | x << 2) & 0x0924_9249
    };
    spread(at[0]) | spread(at[1]) << 1 | spread(at[2]) << 2
}

/// Rows of eight groups of eight points.
pub(super) fn rows_of_groups(size: usize) -> usize {
    size.div_ceil(LANES * LANES)
}
