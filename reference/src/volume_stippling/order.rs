//! Relaxation and order of a volume's points ([STIP-4]).
//!
//! Each voxel has a pool of random points, more than it draws. One rank after the other, every voxel takes from its pool
//! the point farthest from all points that are taken, its own and those of its 26 neighbours: what is taken is spread
//! evenly at every rank, within a voxel and across its faces, and each prefix is a subset of the next.
//!
//! The voxels of one of the eight parity classes of 2×2×2 have no neighbour in their class, so that a class is taken at
//! once, in parallel; the classes' order is hashed for each rank, so that none is always first. Voxels that came early in a
//! rank could not see the later ones: in the first ranks, where few points fix the spacing, each takes again, now from all
//! others of the rank (`SWEEPS`).
//!
//! What is even has to look so in projection. In a voxel that has no neighbour with points before and behind, along its
//! normal, the face is thin: distances are those in the tangent plane. Elsewhere they are those in space.

use super::slab::{Slab, TRIES};
use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::philox;
use rayon::prelude::*;

/// Points in work side by side.
const LANES: usize = 8;

/// A coordinate or a distance of each.
type Lane = [f32; LANES];

/// Half the side of the neighbourhood's cube of offsets, and the offset's number of a voxel itself.
const SELF: usize = 13;

/// The voxels and how their points lie.
pub(super) struct Sites<'a> {
    /// In ascending linear order.
    pub(super) cells: &'a [[u32; 3]],
    /// n of each.
    pub(super) normals: &'a [DVec3],
    /// D.
    pub(super) axes: DMat3,
    /// The smallest spacing.
    pub(super) voxel: f64,
    /// Half the distance of the two planes, in world units.
    pub(super) slab: f64,
    pub(super) seed: u64,
    /// Whether voxels see their neighbours.
    pub(super) neighbours: bool,
}

/// How often each voxel takes its point of a rank.
fn sweeps(rank: usize) -> usize {
    match rank {
        0..4 => 3,
        _ => 1,
    }
}

/// Points in the pool of a voxel that draws `each`.
fn pool_size(each: usize) -> usize {
    (each + (5 * each).min(each.max(400))).next_multiple_of(LANES)
}

/// Bytes a voxel of what is allocated to order the points, beside the points.
pub(super) fn bytes_a_voxel(each: usize) -> u64 {
    (pool_size(each) * (4 * size_of::<f32>() + size_of::<u32>()) + 26 * size_of::<u32>() + size_of::<Site>()) as u64
}

/// A voxel at work.
struct Site {
    cell: [u32; 3],
    slab: Slab,
    /// n, scaled so that x − (n·x) n has lost its part along the normal; zero where distances are those in space.
    flat: [f32; 3],
    /// No point of the pool is farther from the centre.
    reach: f32,
    /// The largest distance squared that a point of the pool can have to those taken.
    farthest: f32,
    /// Where its neighbours stand in the list of all.
    first: u32,
    end: u32,
}

/// The voxels of a class, with their pools.
struct Class {
    /// The parities of x, y and z, x lowest.
    number: usize,
    /// Of the first in the order of all.
    start: usize,
    sites: Vec<Site>,
    /// For each site x, y, z and the squared distance to what is taken, of every point of its pool. What is not or no
    /// longer in the pool has a distance below 0.
    pools: Vec<[Lane; 4]>,
    /// The draw that made each point of a pool.
    draws: Vec<u32>,
}

/// Takes `each` points for every voxel, in the order in which they are drawn, voxel after voxel. `done` hears how many of
/// the ranks are done.
pub(super) fn points(sites: &Sites<'_>, each: usize, done: &(dyn Fn(usize) + Sync)) -> Vec<[f32; 3]> {
    let n = sites.cells.len();
    let size = pool_size(each);
    let (ids, starts) = by_class(sites.cells);
    let links = Links::new(sites, &ids);
    let around: Vec<[f32; 3]> = (0..27).map(|k| scaled(sites, delta(k))).collect();
    let mut classes: Vec<Class> = (0..8).map(|class| Class::new(sites, &links, &ids, &starts, class, size)).collect();
    let mut taken = [vec![[0f32; 3]; n], vec![[0f32; 3]; n]];
    let mut chosen = vec![0u32; n * each];
    for rank in 0..each {
        let order = class_order(sites.seed, rank);
        let [before, now] = &mut taken;
        std::mem::swap(before, now);
        for sweep in 0..sweeps(rank) {
            for (place, &class) in order.iter().enumerate() {
                let earlier = if sweep == 0 { &order[..place] } else { &order[..] };
                let earlier = earlier.iter().fold(0u8, |set, &c| set | 1 << c);
                let step = Step { rank, sweep, links: &links, around: &around, earlier };
                let class = &mut classes[class];
                let (start, end) = (class.start, class.start + class.sites.len());
                let (left, rest) = now.split_at_mut(start);
                let (own, right) = rest.split_at_mut(end - start);
                let seen = Seen { before, left, right, start, end };
                take(sites, class, own, &mut chosen[start * each..end * each], each, &seen, &step);
            }
        }
        done(rank + 1);
    }
    // From the order of the classes back to that of the voxels.
    let mut points = vec![[0f32; 3]; n * each];
    points.par_chunks_mut(each.max(1)).enumerate().for_each(|(i, points)| {
        let id = ids[i] as usize;
        let slab = Slab::new(sites.axes, sites.normals[i], sites.slab);
        for (point, &draw) in points.iter_mut().zip(&chosen[id * each..][..each]) {
            *point = point_of(&slab, sites.seed, sites.cells[i], draw);
        }
    });
    points
}

/// What a visit of a class is about.
struct Step<'a> {
    rank: usize,
    sweep: usize,
    links: &'a Links,
    /// The offset of each neighbour, scaled.
    around: &'a [[f32; 3]],
    /// The classes, as bits, whose points of this rank are there to be seen.
    earlier: u8,
}

/// The points that are taken, by the voxels' places in the order of all: of the rank before, and of this one in the classes
/// before and after the one at work.
struct Seen<'a> {
    before: &'a [[f32; 3]],
    left: &'a [[f32; 3]],
    right: &'a [[f32; 3]],
    start: usize,
    end: usize,
}

/// Every voxel of a class takes its point of a rank.
fn take(
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
    let (pools, draws) = (class.pools.par_chunks_mut(size / LANES), class.draws.par_chunks_mut(size));
    let voxels = class.sites.par_iter_mut().zip(pools).zip(draws).zip(own).zip(chosen.par_chunks_mut(each));
    voxels.enumerate().with_min_len(256).for_each(|(i, ((((site, pool), draws), own), chosen))| {
        let live = size - step.rank;
        let lanes = live.div_ceil(LANES);
        let neighbours = &step.links.all[site.first as usize..site.end as usize];
        let mut near = Near::new();
        if step.sweep == 0 && step.rank > 0 {
            remove(pool, draws, chosen[step.rank - 1], live);
            near.add(site, seen.before[start + i], [0.0; 3]);
            for &link in neighbours {
                near.add(site, seen.before[id_of(link)], step.around[offset_of(link)]);
            }
            site.farthest = lower(&mut pool[..lanes], near.points());
            near = Near::new();
        }
        for &link in neighbours {
            let id = id_of(link);
            if step.earlier >> (number ^ parities(offset_of(link))) & 1 == 1 {
                let point = if id < seen.start { seen.left[id] } else { seen.right[id - seen.end] };
                near.add(site, point, step.around[offset_of(link)]);
            }
        }
        let slot = farthest(&pool[..lanes], near.points());
        chosen[step.rank] = draws[slot];
        *own = scaled(sites, point_of(&site.slab, sites.seed, site.cell, draws[slot]));
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

/// Lowers the distances of a pool to those to some points, and gives the largest.
#[inline]
fn lower(pool: &mut [[Lane; 4]], points: &[[f32; 3]]) -> f32 {
    let mut largest = [-1f32; LANES];
    for [x, y, z, d] in pool {
        for p in points {
            nearer(x, y, z, d, p);
        }
        for (largest, d) in largest.iter_mut().zip(d) {
            *largest = if *d > *largest { *d } else { *largest };
        }
    }
    largest.into_iter().fold(-1.0, f32::max)
}

/// The place in a pool of the point farthest from what is taken and from some further points: the first of equals.
#[inline]
fn farthest(pool: &[[Lane; 4]], points: &[[f32; 3]]) -> usize {
    let (mut best, mut at) = ([-1f32; LANES], [0u32; LANES]);
    for (i, [x, y, z, d]) in pool.iter().enumerate() {
        let mut d = *d;
        for p in points {
            nearer(x, y, z, &mut d, p);
        }
        for l in 0..LANES {
            at[l] = if d[l] > best[l] { i as u32 } else { at[l] };
            best[l] = if d[l] > best[l] { d[l] } else { best[l] };
        }
    }
    let first = |&a: &usize, &b: &usize| best[a].total_cmp(&best[b]).then((at[b], b).cmp(&(at[a], a)));
    let lane = (0..LANES).max_by(first).unwrap_or(0);
    at[lane] as usize * LANES + lane
}

#[inline(always)]
fn nearer(x: &Lane, y: &Lane, z: &Lane, d: &mut Lane, p: &[f32; 3]) {
    for l in 0..LANES {
        let (dx, dy, dz) = (x[l] - p[0], y[l] - p[1], z[l] - p[2]);
        let to = dx * dx + dy * dy + dz * dz;
        d[l] = if to < d[l] { to } else { d[l] };
    }
}

/// Takes the point of a draw out of a pool; `live` points are left, in front.
fn remove(pool: &mut [[Lane; 4]], draws: &mut [u32], draw: u32, live: usize) {
    let slot = draws[..=live].iter().position(|&d| d == draw).unwrap_or(live);
    draws[slot] = draws[live];
    for c in 0..4 {
        pool[slot / LANES][c][slot % LANES] = pool[live / LANES][c][live % LANES];
    }
    pool[live / LANES][3][live % LANES] = -1.0;
}

impl Class {
    fn new(sites: &Sites<'_>, links: &Links, ids: &[u32], starts: &[usize; 9], class: usize, size: usize) -> Self {
        let (start, end) = (starts[class], starts[class + 1]);
        let mut members = vec![0usize; end - start];
        for (i, &id) in ids.iter().enumerate() {
            if (start..end).contains(&(id as usize)) {
                members[id as usize - start] = i;
            }
        }
        let mut pools = vec![[[0.0; LANES]; 4]; members.len() * size / LANES];
        let mut draws = vec![0; members.len() * size];
        let parts = pools.par_chunks_mut(size / LANES).zip(draws.par_chunks_mut(size));
        let site = |(&i, (pool, draws)): (&usize, (&mut [[Lane; 4]], &mut [u32]))| {
            let id = ids[i] as usize;
            Site::new(sites, i, links.range(id), links, pool, draws)
        };
        let sites = members.par_iter().zip(parts).map(site).collect();
        Self { number: class, start, sites, pools, draws }
    }
}

impl Site {
    /// The voxel with its pool filled.
    fn new(
        sites: &Sites<'_>,
        i: usize,
        [first, end]: [u32; 2],
        links: &Links,
        pool: &mut [[Lane; 4]],
        draws: &mut [u32],
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
        for (slot, draw) in draws.iter_mut().enumerate() {
            let tries = slot as u32 * TRIES..(slot as u32 + 1) * TRIES;
            *draw = tries.into_iter().find(|&d| slab.point(sites.seed, cell, d).is_some()).unwrap_or(CENTRE);
            let p = flattened(flat, scaled(sites, point_of(&slab, sites.seed, cell, *draw)));
            reach = reach.max(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
            for c in 0..3 {
                pool[slot / LANES][c][slot % LANES] = p[c];
            }
            pool[slot / LANES][3][slot % LANES] = f32::MAX;
        }
        Self { cell, slab, flat, reach: reach.sqrt(), farthest: f32::MAX, first, end }
    }
}

/// In place of a draw: the centre of the voxel.
const CENTRE: u32 = u32::MAX;

fn point_of(slab: &Slab, seed: u64, cell: [u32; 3], draw: u32) -> [f32; 3] {
    slab.point(seed, cell, draw).unwrap_or([0.0; 3])
}

/// From index to world space, in voxels.
fn scaled(sites: &Sites<'_>, o: [f32; 3]) -> [f32; 3] {
    let p = sites.axes * DVec3::from_array(o.map(f64::from)) / sites.voxel;
    p.to_array().map(|x| x as f32)
}

fn flattened(f: [f32; 3], p: [f32; 3]) -> [f32; 3] {
    let along = p[0] * f[0] + p[1] * f[1] + p[2] * f[2];
    [p[0] - along * f[0], p[1] - along * f[1], p[2] - along * f[2]]
}

/// The step from a voxel to its neighbour of number k, x fastest.
fn delta(k: usize) -> [f32; 3] {
    [k % 3, k / 3 % 3, k / 9].map(|i| i as f32 - 1.0)
}

/// The axes on which that neighbour's parity is the other, x lowest.
fn parities(k: usize) -> usize {
    usize::from(k % 3 != 1) | usize::from(k / 3 % 3 != 1) << 1 | usize::from(k / 9 != 1) << 2
}

/// The number of the neighbour that lies in a direction: one voxel away, rounded.
fn towards(sites: &Sites<'_>, n: DVec3) -> usize {
    let step = sites.axes.inverse() * n * sites.voxel;
    let mut to = step.to_array().map(|x| x.round_ties_even().clamp(-1.0, 1.0));
    if to == [0.0; 3] {
        // A diagonal of a voxel much longer than wide: the axis that comes nearest.
        let a = step.abs();
        let axis = if a.x >= a.y && a.x >= a.z {
            0
        } else if a.y >= a.z {
            1
        } else {
            2
        };
        to[axis] = step[axis].signum();
    }
    to.iter().rev().fold(0, |k, &x| 3 * k + (x + 1.0) as usize)
}

/// Each voxel's place when classes of equal parities stand together, and where each class begins.
fn by_class(cells: &[[u32; 3]]) -> (Vec<u32>, [usize; 9]) {
    let class = |cell: &[u32; 3]| (cell[0] & 1 | (cell[1] & 1) << 1 | (cell[2] & 1) << 2) as usize;
    let mut starts = [0; 9];
    for cell in cells {
        starts[class(cell) + 1] += 1;
    }
    for c in 0..8 {
        starts[c + 1] += starts[c];
    }
    let mut next = starts;
    let mut place = |cell| {
        let id = next[class(cell)];
        next[class(cell)] += 1;
        id as u32
    };
    (cells.iter().map(&mut place).collect(), starts)
}

/// The classes in the order of a rank: by random numbers.
fn class_order(seed: u64, rank: usize) -> [usize; 8] {
    /// No voxel has this place.
    const NOWHERE: u32 = u32::MAX;
    let key = |class: u32| philox::uniform(seed, [rank as u32, class, NOWHERE], NOWHERE);
    let mut order = [0, 1, 2, 3, 4, 5, 6, 7];
    order.sort_by(|&a, &b| key(a as u32).total_cmp(&key(b as u32)));
    order
}

/// The neighbours of each voxel, in the order of all.
struct Links {
    /// For each the place of the neighbour · 32 + its number among the 27.
    all: Vec<u32>,
    /// Where those of a voxel begin.
    first: Vec<u32>,
}

/// The most voxels that links can tell apart.
pub(super) const MOST_VOXELS: usize = 1 << 27;

fn id_of(link: u32) -> usize {
    (link >> 5) as usize
}

fn offset_of(link: u32) -> usize {
    (link & 31) as usize
}

impl Links {
    fn new(sites: &Sites<'_>, ids: &[u32]) -> Self {
        let cells = sites.cells;
        let mut order = vec![0; cells.len()];
        for (i, &id) in ids.iter().enumerate() {
            order[id as usize] = i;
        }
        let rows = Rows::new(cells);
        let parts: Vec<(Vec<u32>, Vec<u32>)> = order
            .par_chunks(4096)
            .map(|part| {
                let (mut links, mut counts) = (Vec::new(), Vec::new());
                for &i in part {
                    let before = links.len();
                    if sites.neighbours {
                        rows.around(cells, cells[i], |j, k| links.push(ids[j] << 5 | k as u32));
                    }
                    counts.push((links.len() - before) as u32);
                }
                (links, counts)
            })
            .collect();
        let (mut all, mut first) = (Vec::new(), vec![0]);
        for (links, counts) in parts {
            all.extend(links);
            for count in counts {
                first.push(first[first.len() - 1] + count);
            }
        }
        Self { all, first }
    }

    fn range(&self, id: usize) -> [u32; 2] {
        [self.first[id], self.first[id + 1]]
    }
}

/// Finds voxels of a list in linear order by their place.
struct Rows {
    /// y, z and the first voxel of each row that has one.
    rows: Vec<([u32; 2], usize)>,
}

impl Rows {
    fn new(cells: &[[u32; 3]]) -> Self {
        let mut rows: Vec<([u32; 2], usize)> = Vec::new();
        for (i, cell) in cells.iter().enumerate() {
            if rows.last().is_none_or(|&(row, _)| row != [cell[1], cell[2]]) {
                rows.push(([cell[1], cell[2]], i));
            }
        }
        Self { rows }
    }

    /// The neighbours of a voxel that are in the list, with their numbers.
    fn around(&self, cells: &[[u32; 3]], [x, y, z]: [u32; 3], mut found: impl FnMut(usize, usize)) {
        for dz in 0..3 {
            for dy in 0..3 {
                let (Some(y), Some(z)) = ((y + dy).checked_sub(1), (z + dz).checked_sub(1)) else { continue };
                let Ok(row) = self.rows.binary_search_by(|(row, _)| (row[1], row[0]).cmp(&(z, y))) else { continue };
                let end = self.rows.get(row + 1).map_or(cells.len(), |next| next.1);
                let line = &cells[self.rows[row].1..end];
                let first = line.partition_point(|cell| cell[0] + 1 < x);
                for (i, cell) in line.iter().enumerate().skip(first).take_while(|(_, cell)| cell[0] <= x + 1) {
                    let k = (cell[0] + 1 - x + 3 * dy + 9 * dz) as usize;
                    if k != SELF {
                        found(self.rows[row].1 + i, k);
                    }
                }
            }
        }
    }
}
