//! The first point of every voxel.
//!
//! If less than one point per voxel is drawn in opaque ink, a mask of blue noise selects the voxels that draw theirs
//! ([STIP-5]). At a tone t these are the voxels whose rank u exceeds 1 − t. A surface cuts through the mask, and the
//! cut is not even.
//!
//! So first points are placed with regard to the mask. Two points are visible together from the tone 1 − min(u, u′)
//! on. Points are 1/√tone apart at a tone, and distances are measured in this unit. Points that are drawn early keep
//! a larger distance from each other than from those that join later, so every tone is even.

use super::class::{OF_SWEEPS, class_of, class_order};
use super::groups::{
    EightFloats, GroupBounds, LANES, PointGroup, REACH as GROUP_REACH, squared_distances, take_largest,
};
use super::neighbours::RowIndex;
use super::pool::{Class, Site};
use super::{Sites, flattened, scaled};
use crate::number::lanes::widely;
use drypoint_scene::blue_noise;
use drypoint_scene::parallel;

/// Number of times that each voxel takes its first point.
const SWEEPS: u32 = 4;

/// The largest distance along each axis of voxels that affect each other. At tone 0.1 points are three voxels apart.
const REACH: u32 = 2;

/// Number of voxels of the neighbourhood along each axis.
const SIDE: usize = 2 * REACH as usize + 1;

/// Number of classes. Voxels of one class do not affect each other.
const CLASSES: usize = (REACH as usize + 1).pow(3);

/// Temporary memory in bytes per voxel.
pub(super) const BYTES_A_VOXEL: usize =
    (SIDE * SIDE * SIDE - 1) * size_of::<NearVoxel>() + size_of::<u32>() + 2 * size_of::<TakenPoint>();

/// A voxel that affects another one.
#[derive(Clone, Copy)]
struct NearVoxel {
    /// Index in the list of voxels.
    voxel: u32,
    /// Index in the neighbourhood, x fastest.
    offset: u32,
}

/// A taken point, in voxels from its voxel's centre; the voxel's tone; the point's index in the pool.
#[derive(Clone, Copy)]
struct TakenPoint {
    at: [f32; 3],
    tone: f32,
    slot: u32,
}

/// A point near a pool.
struct NearPoint {
    at: [f32; 3],
    /// The tone from which both points are drawn.
    tone: f32,
    /// Lower bound for all points of the pool: the squared distance times the tone.
    least: f32,
}

/// Buffers for one thread.
#[derive(Default)]
struct FirstPointBuffers {
    near: Vec<NearPoint>,
    bounds: Vec<EightFloats>,
}

/// Returns the pool index of each voxel's first point, in the order of the list. `ids` holds the voxels' places in
/// the order of the classes.
pub(super) fn first_points(sites: &Sites<'_>, classes: &[Class], ids: &[u32]) -> Vec<usize> {
    let cells = sites.cells;
    let seen = NearVoxels::new(sites);
    let offsets: Vec<[f32; 3]> = (0..SIDE.pow(3)).map(|k| scaled(sites, step(k))).collect();
    let mut members = vec![Vec::new(); CLASSES];
    for (i, cell) in cells.iter().enumerate() {
        members[class(*cell)].push(i);
    }
    // Points that are not placed yet are NaN, and no comparison with NaN makes them near.
    let not_placed =
        |&cell: &[u32; 3]| TakenPoint { at: [f32::NAN; 3], tone: (1.0 - blue_noise::at(cell)) as f32, slot: 0 };
    let mut taken: Vec<TakenPoint> = cells.iter().map(not_placed).collect();
    // Voxels of a class do not affect each other, so all of them take their points in parallel.
    for sweep in 0..SWEEPS {
        for class in class_order::<CLASSES>(sites.seed, sweep, OF_SWEEPS) {
            let take = |work: &mut FirstPointBuffers, i: usize| {
                let home = &classes[class_of(cells[i])];
                let index = ids[i] as usize - home.start;
                let slot = widely(
                    #[inline(always)]
                    || {
                        work.gather(&home.sites[index], taken[i].tone, seen.of(i), &taken, &offsets);
                        farthest(home.pool(index), home.rows(index), work)
                    },
                );
                TakenPoint { at: scaled(sites, home.point(sites, index, slot)), tone: taken[i].tone, slot: slot as u32 }
            };
            let found = parallel::gather(members[class].len(), 64, &|run, found| {
                let mut work = FirstPointBuffers::default();
                found.extend(members[class][run].iter().map(|&i| take(&mut work, i)));
            });
            for (&i, found) in members[class].iter().zip(found) {
                taken[i] = found;
            }
        }
    }
    taken.into_iter().map(|taken| taken.slot as usize).collect()
}

impl FirstPointBuffers {
    /// Collects the taken points around a voxel, without those that are nowhere nearest to its pool.
    #[inline(always)]
    fn gather(&mut self, site: &Site, tone: f32, seen: &[NearVoxel], taken: &[TakenPoint], offsets: &[[f32; 3]]) {
        self.near.clear();
        let mut most = f32::INFINITY;
        for other in seen {
            let (other, o) = (&taken[other.voxel as usize], offsets[other.offset as usize]);
            let p = [other.at[0] + o[0], other.at[1] + o[1], other.at[2] + o[2]];
            let (at, tone) = (flattened(site.flat, p), if other.tone > tone { other.tone } else { tone });
            let length = (at[0] * at[0] + at[1] * at[1] + at[2] * at[2]).sqrt();
            let (near, far) = (length - site.reach, length + site.reach);
            let (least, largest) = (if near <= 0.0 { 0.0 } else { near * near * tone }, far * far * tone);
            most = if largest < most { largest } else { most };
            // A margin of a thousandth: rounding must not exclude the nearest point.
            if least <= most * 1.001 {
                self.near.push(NearPoint { at, tone, least });
            }
        }
        self.near.retain(|near| near.least <= most * 1.001);
    }
}

/// The pool index of the point farthest from the nearby points, each squared distance times the tone. Groups are
/// visited in the order of their bounds, and only while a bound exceeds the best point.
#[inline(always)]
fn farthest(
    pool: &[PointGroup],
    groups: &[GroupBounds],
    FirstPointBuffers { near, bounds }: &mut FirstPointBuffers,
) -> usize {
    bounds.clear();
    for row in groups {
        bounds.push(bound(row, near));
    }
    let bound = |group: usize| bounds[group / LANES][group % LANES];
    let mut first = 0;
    for group in 1..pool.len() {
        if bound(group) > bound(first) {
            first = group;
        }
    }
    let (mut best, mut at) = (-1f32, 0);
    for group in std::iter::once(first).chain(0..pool.len()) {
        if bound(group) <= best {
            continue;
        }
        let [x, y, z] = &pool[group].at;
        let mut least = pool[group].far;
        for NearPoint { at: p, tone, .. } in near.iter() {
            for l in 0..LANES {
                let (dx, dy, dz) = (x[l] - p[0], y[l] - p[1], z[l] - p[2]);
                let to = (dx * dx + dy * dy + dz * dz) * tone;
                least[l] = if to < least[l] { to } else { least[l] };
            }
        }
        take_largest(&least, group, &mut best, &mut at);
    }
    at
}

/// Upper bounds for the points of eight groups: the squared distance from the nearby points, times the tone.
#[inline(always)]
fn bound(row: &GroupBounds, near: &[NearPoint]) -> EightFloats {
    let mut least = [f32::MAX; LANES];
    for NearPoint { at, tone, .. } in near {
        let to = squared_distances(row, at);
        for l in 0..LANES {
            let far = to[l].sqrt() + row[GROUP_REACH][l];
            let to = far * far * tone;
            least[l] = if to < least[l] { to } else { least[l] };
        }
    }
    least
}

/// The voxels that affect each voxel, in the order of the list, in parts.
struct NearVoxels {
    parts: Vec<NearVoxelsPart>,
}

/// Neighbours of [`PART`] voxels, one voxel after the other, with the end of each.
struct NearVoxelsPart {
    all: Vec<NearVoxel>,
    ends: Vec<u32>,
}

/// Number of voxels of a part.
const PART: usize = 4096;

impl NearVoxels {
    fn new(sites: &Sites<'_>) -> Self {
        let rows = RowIndex::new(sites.cells);
        let part = |cells: &[[u32; 3]]| {
            let (mut all, mut ends) = (Vec::new(), Vec::with_capacity(cells.len()));
            for &cell in cells {
                if sites.neighbours {
                    rows.around(sites.cells, cell, REACH, |voxel, offset| {
                        all.push(NearVoxel { voxel: voxel as u32, offset: offset as u32 });
                    });
                }
                ends.push(all.len() as u32);
            }
            NearVoxelsPart { all, ends }
        };
        Self { parts: parallel::map_of(sites.cells.chunks(PART).collect(), &|_, cells| part(cells)) }
    }

    #[inline(always)]
    fn of(&self, i: usize) -> &[NearVoxel] {
        let (NearVoxelsPart { all, ends }, i) = (&self.parts[i / PART], i % PART);
        let start = if i == 0 { 0 } else { ends[i - 1] };
        &all[start as usize..ends[i] as usize]
    }
}

/// The step from a voxel to voxel k of its neighbourhood.
fn step(k: usize) -> [f32; 3] {
    [k % SIDE, k / SIDE % SIDE, k / (SIDE * SIDE)].map(|i| i as f32 - REACH as f32)
}

fn class([x, y, z]: [u32; 3]) -> usize {
    let side = REACH + 1;
    (x % side + side * (y % side) + side * side * (z % side)) as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::philox;

    #[test]
    fn voxels_of_a_class_do_not_see_each_other() {
        let cells: Vec<[u32; 3]> = (0..9 * 9 * 9).map(|i| [i % 9, i / 9 % 9, i / 81]).collect();
        let mut members = [0; CLASSES];
        cells.iter().for_each(|cell| members[class(*cell)] += 1);
        assert_eq!(members, [27; CLASSES]);
        let normals = vec![drypoint_scene::glam::DVec3::Z; cells.len()];
        let sites = crate::volume_stippling::order::tests::sites(&cells, &normals, true);
        let all = NearVoxels::new(&sites);
        for i in 0..cells.len() {
            let seen = all.of(i);
            assert!(seen.iter().all(|other| class(cells[other.voxel as usize]) != class(cells[i])));
            for other in seen {
                let to = step(other.offset as usize);
                let moved: Vec<f32> = (0..3).map(|a| cells[i][a] as f32 + to[a]).collect();
                assert_eq!(moved, cells[other.voxel as usize].map(|x| x as f32));
            }
        }
        let order = |sweep| class_order::<CLASSES>(1, sweep, OF_SWEEPS);
        let mut sorted = order(0);
        assert_ne!(sorted, order(1));
        sorted.sort_unstable();
        assert_eq!(sorted, std::array::from_fn(|i| i));
    }

    /// Skipped groups do not matter: the point equals that of a search through all pairs.
    #[test]
    fn bounds_hide_no_point() {
        use super::super::class::by_class;
        use super::super::neighbours::NeighbourLinks;
        use super::super::pool::pool_size;
        let (cells, normals) = ([[3, 4, 5]], [drypoint_scene::glam::DVec3::new(1.0, 2.0, 3.0).normalize()]);
        let sites = super::super::tests::sites(&cells, &normals, true);
        let (ids, starts) = by_class(&cells);
        let links = NeighbourLinks::new(&sites, &ids);
        let class = Class::new(&sites, &links, &ids, &starts, 1 + 4, pool_size(25));
        for i in 0..200u32 {
            let point = |k: u32| {
                let [x, y, z, tone] = philox::uniforms(2, [i, k, 0], 0);
                TakenPoint { at: [x, y, z].map(|x| 5.0 * x as f32 - 2.5), tone: tone as f32, slot: 0 }
            };
            let taken: Vec<TakenPoint> = (0..i % 20).map(point).collect();
            let seen: Vec<NearVoxel> = (0..i % 20).map(|voxel| NearVoxel { voxel, offset: 0 }).collect();
            let mut work = FirstPointBuffers::default();
            work.gather(&class.sites[0], 0.0, &seen, &taken, &[[0.0; 3]]);
            let found = farthest(class.pool(0), class.rows(0), &mut work);
            let least = |at: usize| {
                let group = &class.pool(0)[at / LANES];
                let squared = |p: [f32; 3]| (0..3).map(|c| group.at[c][at % LANES] - p[c]).map(|x| x * x).sum::<f32>();
                let scaled = |n: &TakenPoint| squared(flattened(class.sites[0].flat, n.at)) * n.tone;
                taken.iter().map(scaled).fold(group.far[at % LANES], f32::min)
            };
            let most = (0..class.pool(0).len() * LANES).map(least).fold(-1.0, f32::max);
            assert_eq!(least(found), most, "{i}");
        }
    }
}
