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

/// The number of a voxel itself among the 27 of its neighbourhood.
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
    (pool_size(each) * (4 * size_of::<f32>() + size_of::<u32>() + 6 * size_of::<f32>() / LANES)
        + 26 * size_of::<u32>()
        + size_of::<Site>()) as u64
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
    /// Of the point that it took last, in its pool.
    slot: usize,
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
    /// For each site x, y, z and the squared distance to what is taken, of every point of its pool. What is no longer in
    /// the pool has a distance below 0.
    pools: Vec<[Lane; 4]>,
    /// For each eight points of a pool, which lie together, what tells from afar whether they matter.
    groups: Vec<[Lane; 6]>,
    /// The draw that made each point of a pool.
    draws: Vec<u32>,
}

/// Rows of a group's numbers: the middle, no point is farther from it, the largest distance squared to what is taken, and
/// the distance squared up to which a point can lower one.
const FAR: usize = 4;
const REACH: usize = 3;
const LIMIT: usize = 5;

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
    let (pools, draws) = (class.pools.par_chunks_mut(size / LANES), class.draws.par_chunks(size));
    let groups = class.groups.par_chunks_mut(rows_of_groups(size));
    let voxels = class.sites.par_iter_mut().zip(pools).zip(groups).zip(draws).zip(own).zip(chosen.par_chunks_mut(each));
    voxels.enumerate().with_min_len(256).for_each(|(i, (((((site, pool), groups), draws), own), chosen))| {
        let neighbours = &step.links.all[site.first as usize..site.end as usize];
        let mut near = Near::new();
        if step.sweep == 0 && step.rank > 0 {
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

/// Lowers the distances of a pool to those to some points, and gives the largest.
fn lower(pool: &mut [[Lane; 4]], groups: &mut [[Lane; 6]], points: &[[f32; 3]]) -> f32 {
    for p in points {
        for row in 0..groups.len() {
            let to = squared_distances(&groups[row], p);
            for l in 0..LANES {
                if to[l] < groups[row][LIMIT][l] {
                    let group = row * LANES + l;
                    let [x, y, z, d] = &mut pool[group];
                    nearer(x, y, z, d, p);
                    settle(&pool[group], groups, group);
                }
            }
        }
    }
    groups.iter().flat_map(|row| row[FAR]).fold(-1.0, f32::max)
}

/// What a group's numbers are after its distances have changed.
#[inline]
fn settle(points: &[Lane; 4], groups: &mut [[Lane; 6]], group: usize) {
    let far = points[3].into_iter().fold(-1.0, f32::max);
    let (row, l) = (&mut groups[group / LANES], group % LANES);
    row[FAR][l] = far;
    row[LIMIT][l] = if far < 0.0 { -1.0 } else { (far.sqrt() + row[REACH][l]) * (far.sqrt() + row[REACH][l]) };
}

/// The place in a pool of the point farthest from what is taken and from some further points. A group is looked into only
/// if its farthest could be it, that of the largest distance first.
fn farthest(pool: &[[Lane; 4]], groups: &[[Lane; 6]], points: &[[f32; 3]]) -> usize {
    let far = |group: usize| groups[group / LANES][FAR][group % LANES];
    let mut first = 0;
    for group in 1..pool.len() {
        if far(group) > far(first) {
            first = group;
        }
    }
    let (mut best, mut at) = (-1f32, first * LANES);
    for group in std::iter::once(first).chain(0..pool.len()) {
        if far(group) <= best {
            continue;
        }
        let ([x, y, z, d], row, l) = (&pool[group], &groups[group / LANES], group % LANES);
        let mut d = *d;
        for p in points {
            let (dx, dy, dz) = (row[0][l] - p[0], row[1][l] - p[1], row[2][l] - p[2]);
            if dx * dx + dy * dy + dz * dz < row[LIMIT][l] {
                nearer(x, y, z, &mut d, p);
            }
        }
        for (l, &d) in d.iter().enumerate() {
            if d > best {
                (best, at) = (d, group * LANES + l);
            }
        }
    }
    at
}

#[inline(always)]
fn squared_distances(row: &[Lane; 6], p: &[f32; 3]) -> Lane {
    let mut to = [0.0; LANES];
    for l in 0..LANES {
        let (dx, dy, dz) = (row[0][l] - p[0], row[1][l] - p[1], row[2][l] - p[2]);
        to[l] = dx * dx + dy * dy + dz * dz;
    }
    to
}

#[inline(always)]
fn nearer(x: &Lane, y: &Lane, z: &Lane, d: &mut Lane, p: &[f32; 3]) {
    for l in 0..LANES {
        let (dx, dy, dz) = (x[l] - p[0], y[l] - p[1], z[l] - p[2]);
        let to = dx * dx + dy * dy + dz * dz;
        d[l] = if to < d[l] { to } else { d[l] };
    }
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
fn rows_of_groups(size: usize) -> usize {
    size.div_ceil(LANES * LANES)
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

#[cfg(test)]
mod tests {
    use super::*;

    fn sites<'a>(cells: &'a [[u32; 3]], normals: &'a [DVec3], neighbours: bool) -> Sites<'a> {
        Sites { cells, normals, axes: DMat3::IDENTITY, voxel: 1.0, slab: 0.5, seed: 1, neighbours }
    }

    /// What is pruned is what does not matter: distances and the farthest point are those of looking at every pair.
    #[test]
    fn groups_hide_no_point() {
        let (cells, normals) = ([[3, 4, 5]], [DVec3::new(1.0, 2.0, 3.0).normalize()]);
        let sites = sites(&cells, &normals, true);
        let (ids, starts) = by_class(&cells);
        let links = Links::new(&sites, &ids);
        let size = pool_size(25);
        let mut class = Class::new(&sites, &links, &ids, &starts, 1 + 4, size);
        let all: Vec<[f32; 3]> =
            class.pools.iter().flat_map(|[x, y, z, _]| (0..LANES).map(|l| [x[l], y[l], z[l]])).collect();
        let squared = |a: [f32; 3], b: [f32; 3]| (0..3).map(|c| a[c] - b[c]).map(|x| x * x).sum::<f32>();
        let mut wanted: Vec<f32> = class.pools.iter().flat_map(|lanes| lanes[3]).collect();
        for i in 0..60 {
            let p = philox::uniforms(2, [i, 0, 0], 0);
            let p = [0, 1, 2].map(|c| (1.5 * p[c] - 0.75) as f32);
            let q = [p[1], p[2], -p[0]];
            let nearest: Vec<f32> =
                wanted.iter().zip(&all).map(|(d, a)| d.min(squared(*a, p)).min(squared(*a, q))).collect();
            let slot = farthest(&class.pools, &class.groups, &[p, q]);
            assert_eq!(nearest[slot], nearest.iter().copied().fold(-1.0, f32::max));
            let largest = lower(&mut class.pools, &mut class.groups, &[p]);
            wanted.iter_mut().zip(&all).for_each(|(d, a)| *d = d.min(squared(*a, p)));
            let kept: Vec<f32> = class.pools.iter().flat_map(|lanes| lanes[3]).collect();
            assert_eq!(kept, wanted);
            assert_eq!(largest, wanted.iter().copied().fold(-1.0, f32::max));
        }
    }

    #[test]
    fn neighbours_are_found_with_their_offsets() {
        let cells: Vec<[u32; 3]> =
            [[0, 0, 0], [1, 0, 0], [3, 0, 0], [0, 1, 0], [2, 1, 0], [1, 1, 1], [1, 2, 2], [1, 1, 3]].into();
        let rows = Rows::new(&cells);
        for (i, &cell) in cells.iter().enumerate() {
            let mut found = Vec::new();
            rows.around(&cells, cell, |j, k| found.push((j, k)));
            let wanted = cells.iter().enumerate().filter(|&(j, _)| j != i).filter_map(|(j, other)| {
                let step: Vec<i64> = (0..3).map(|a| i64::from(other[a]) - i64::from(cell[a])).collect();
                let near = step.iter().all(|s| s.abs() <= 1);
                near.then(|| (j, (step[0] + 1 + 3 * (step[1] + 1) + 9 * (step[2] + 1)) as usize))
            });
            found.sort_unstable();
            assert_eq!(found, wanted.collect::<Vec<_>>(), "{cell:?}");
        }
    }

    #[test]
    fn equal_parities_stand_together_and_a_step_changes_those_of_its_axes() {
        let cells: Vec<[u32; 3]> = (0..60).map(|i| [i % 5, i / 5 % 4, i / 20]).collect();
        let (ids, starts) = by_class(&cells);
        let class = |i: usize| starts[1..8].iter().filter(|&&start| start <= ids[i] as usize).count();
        for (i, cell) in cells.iter().enumerate() {
            assert_eq!(class(i), (cell[0] % 2 + 2 * (cell[1] % 2) + 4 * (cell[2] % 2)) as usize);
        }
        assert_eq!([SELF, 14, 16, 22, 0].map(parities), [0, 1, 2, 4, 7]);
        let orders: Vec<[usize; 8]> = (0..40).map(|rank| class_order(1, rank)).collect();
        assert!(orders.iter().any(|order| order[0] != orders[0][0]));
        for mut order in orders {
            order.sort_unstable();
            assert_eq!(order, [0, 1, 2, 3, 4, 5, 6, 7]);
        }
    }

    #[test]
    fn a_normal_leads_to_the_voxel_in_its_direction() {
        let sheared = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::new(0.0, 0.0, 4.0));
        for (axes, n, k) in [
            (DMat3::IDENTITY, DVec3::X, 14),
            (DMat3::IDENTITY, DVec3::new(1.0, 2.0, 3.0).normalize(), 13 + 3 + 9),
            (DMat3::IDENTITY, DVec3::NEG_ONE.normalize(), 0),
            // A voxel along z is four long: one voxel's way along n does not leave it, but it has no other neighbour there.
            (sheared, DVec3::Z, 22),
        ] {
            let sites = Sites { axes, ..sites(&[], &[], true) };
            assert_eq!(towards(&sites, n), k, "{n}");
        }
    }
}
