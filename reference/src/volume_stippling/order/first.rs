//! The first point of every voxel.
//!
//! Where less than a point a voxel is drawn in opaque ink, the mask of blue noise says which voxels draw theirs
//! ([STIP-5]): at a tone t those whose rank u is above 1 − t. In a surface that cuts through the mask, those voxels are no
//! more even than the cut. So first points are placed with the mask in mind: two of them are seen together from the tone
//! 1 − min(u, u′) on, at which points are 1/√tone apart, and their distance counts in that measure. Points that are drawn
//! early keep away from each other farther than from those that join them late, and every tone is even.

use super::class::class_of;
use super::groups::{LANES, Lane, REACH as GROUP_REACH};
use super::links::Rows;
use super::pool::Class;
use super::{Sites, flattened, scaled};
use drypoint_scene::blue_noise;
use drypoint_scene::philox;
use rayon::prelude::*;

/// How often each voxel takes its first point.
const SWEEPS: u32 = 4;

/// Voxels that see each other lie at most so far apart on each axis: at the tone 0.1 points are three voxels apart.
const REACH: u32 = 2;

/// Voxels along each axis of the neighbourhood.
const SIDE: usize = 2 * REACH as usize + 1;

/// Voxels of one of these classes do not see each other.
const CLASSES: usize = (REACH as usize + 1).pow(3);

/// Bytes a voxel of what is allocated meanwhile.
pub(super) const BYTES_A_VOXEL: usize =
    (SIDE * SIDE * SIDE - 1) * size_of::<Seen>() + size_of::<Vec<Seen>>() + 2 * size_of::<Taken>();

/// A voxel that another one sees.
#[derive(Clone, Copy)]
struct Seen {
    /// Its place in the list of voxels.
    voxel: u32,
    /// Its number in the neighbourhood, x fastest.
    offset: u32,
}

/// A point that was taken, in voxels from its voxel's centre, and its place in the pool.
#[derive(Clone, Copy)]
struct Taken {
    at: [f32; 3],
    slot: usize,
}

/// For each voxel, in the order of the list, the place in its pool of its first point. `ids` are the voxels' places in the
/// order of the classes.
pub(super) fn first_points(sites: &Sites<'_>, classes: &[Class], ids: &[u32]) -> Vec<usize> {
    let cells = sites.cells;
    let tones: Vec<f32> = cells.iter().map(|&cell| (1.0 - blue_noise::at(cell)) as f32).collect();
    let seen = seen(sites);
    let offsets: Vec<[f32; 3]> = (0..SIDE.pow(3)).map(|k| scaled(sites, step(k))).collect();
    let mut members = vec![Vec::new(); CLASSES];
    for (i, cell) in cells.iter().enumerate() {
        members[class(*cell)].push(i);
    }
    // Nothing is nearer to a point than what is no number: what is not placed yet is not seen.
    let mut taken = vec![Taken { at: [f32::NAN; 3], slot: 0 }; cells.len()];
    for sweep in 0..SWEEPS {
        for class in order(sites.seed, sweep) {
            let take = |near: &mut Vec<([f32; 3], f32)>, &i: &usize| {
                let home = &classes[class_of(cells[i])];
                let index = ids[i] as usize - home.start;
                near.clear();
                near.extend(seen[i].iter().map(|other| {
                    let (voxel, o) = (other.voxel as usize, offsets[other.offset as usize]);
                    let p = taken[voxel].at;
                    let p = [p[0] + o[0], p[1] + o[1], p[2] + o[2]];
                    (flattened(home.sites[index].flat, p), tones[i].max(tones[voxel]))
                }));
                let slot = farthest(home.pool(index), home.groups(index), near);
                Taken { at: scaled(sites, home.point(sites, index, slot)), slot }
            };
            let found: Vec<Taken> = members[class].par_iter().with_min_len(64).map_init(Vec::new, take).collect();
            for (&i, found) in members[class].iter().zip(found) {
                taken[i] = found;
            }
        }
    }
    taken.into_iter().map(|taken| taken.slot).collect()
}

/// The place in a pool of the point farthest from some points, each squared distance times the tone beside it. A group is
/// looked into only if it can have it, that of the largest bound first.
fn farthest(pool: &[[Lane; 4]], groups: &[[Lane; 6]], near: &[([f32; 3], f32)]) -> usize {
    let bound = |row: &[Lane; 6]| {
        let mut least = [f32::MAX; LANES];
        for (p, tone) in near {
            for l in 0..LANES {
                let (dx, dy, dz) = (row[0][l] - p[0], row[1][l] - p[1], row[2][l] - p[2]);
                let far = (dx * dx + dy * dy + dz * dz).sqrt() + row[GROUP_REACH][l];
                let to = far * far * tone;
                least[l] = if to < least[l] { to } else { least[l] };
            }
        }
        least
    };
    let bounds: Vec<Lane> = groups.iter().map(bound).collect();
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
        let [x, y, z, d] = &pool[group];
        let mut least = *d;
        for (p, tone) in near {
            for l in 0..LANES {
                let (dx, dy, dz) = (x[l] - p[0], y[l] - p[1], z[l] - p[2]);
                let to = (dx * dx + dy * dy + dz * dz) * tone;
                least[l] = if to < least[l] { to } else { least[l] };
            }
        }
        for (l, &d) in least.iter().enumerate() {
            if d > best {
                (best, at) = (d, group * LANES + l);
            }
        }
    }
    at
}

/// Which voxels each voxel sees, in the order of the list.
fn seen(sites: &Sites<'_>) -> Vec<Vec<Seen>> {
    let cells = sites.cells;
    if !sites.neighbours {
        return vec![Vec::new(); cells.len()];
    }
    let rows = Rows::new(cells);
    let around = |&cell: &[u32; 3]| {
        let mut found = Vec::new();
        rows.around(cells, cell, REACH, |voxel, offset| {
            found.push(Seen { voxel: voxel as u32, offset: offset as u32 });
        });
        found
    };
    cells.par_iter().map(around).collect()
}

/// The step from a voxel to another of its neighbourhood.
fn step(k: usize) -> [f32; 3] {
    [k % SIDE, k / SIDE % SIDE, k / (SIDE * SIDE)].map(|i| i as f32 - REACH as f32)
}

fn class([x, y, z]: [u32; 3]) -> usize {
    let side = REACH + 1;
    (x % side + side * (y % side) + side * side * (z % side)) as usize
}

/// The classes in the order of a sweep: by random numbers.
fn order(seed: u64, sweep: u32) -> [usize; CLASSES] {
    /// No voxel has this place.
    const NOWHERE: u32 = u32::MAX;
    let key = |class: usize| philox::uniform(seed, [sweep, class as u32, NOWHERE], NOWHERE - 1);
    let mut order = std::array::from_fn(|i| i);
    order.sort_by(|&a, &b| key(a).total_cmp(&key(b)));
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn voxels_of_a_class_do_not_see_each_other() {
        let cells: Vec<[u32; 3]> = (0..9 * 9 * 9).map(|i| [i % 9, i / 9 % 9, i / 81]).collect();
        let mut members = [0; CLASSES];
        cells.iter().for_each(|cell| members[class(*cell)] += 1);
        assert_eq!(members, [27; CLASSES]);
        let normals = vec![drypoint_scene::glam::DVec3::Z; cells.len()];
        let sites = crate::volume_stippling::order::tests::sites(&cells, &normals, true);
        for (i, seen) in seen(&sites).iter().enumerate() {
            assert!(seen.iter().all(|other| class(cells[other.voxel as usize]) != class(cells[i])));
            for other in seen {
                let to = step(other.offset as usize);
                let moved: Vec<f32> = (0..3).map(|a| cells[i][a] as f32 + to[a]).collect();
                assert_eq!(moved, cells[other.voxel as usize].map(|x| x as f32));
            }
        }
        let mut sorted = order(1, 0);
        assert_ne!(sorted, order(1, 1));
        sorted.sort_unstable();
        assert_eq!(sorted, std::array::from_fn(|i| i));
    }
    /// What is not looked into does not matter: the point is that of looking at every pair.
    #[test]
    fn bounds_hide_no_point() {
        use super::super::class::by_class;
        use super::super::links::Links;
        use super::super::pool::pool_size;
        let (cells, normals) = ([[3, 4, 5]], [drypoint_scene::glam::DVec3::new(1.0, 2.0, 3.0).normalize()]);
        let sites = super::super::tests::sites(&cells, &normals, true);
        let (ids, starts) = by_class(&cells);
        let links = Links::new(&sites, &ids);
        let class = Class::new(&sites, &links, &ids, &starts, 1 + 4, pool_size(25));
        for i in 0..200u32 {
            let point = |k: u32| {
                let [x, y, z, tone] = philox::uniforms(2, [i, k, 0], 0);
                ([x, y, z].map(|x| 5.0 * x as f32 - 2.5), tone as f32)
            };
            let near: Vec<([f32; 3], f32)> = (0..i % 20).map(point).collect();
            let least = |at: usize| {
                let lanes = &class.pool(0)[at / LANES];
                let squared = |p: &[f32; 3]| (0..3).map(|c| lanes[c][at % LANES] - p[c]).map(|x| x * x).sum::<f32>();
                near.iter().map(|(p, tone)| squared(p) * tone).fold(lanes[3][at % LANES], f32::min)
            };
            let found = farthest(class.pool(0), class.groups(0), &near);
            let most = (0..class.pool(0).len() * LANES).map(least).fold(-1.0, f32::max);
            assert_eq!(least(found), most, "{i}");
        }
    }
}
