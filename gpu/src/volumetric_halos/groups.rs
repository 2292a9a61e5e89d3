//! Groups of planes that rays visit together ([HALO-1], [HALO-8]).

use drypoint_scene::glam::DVec3;
use drypoint_scene::shot::{HaloKind, HaloParams, Shot};
use drypoint_scene::space::Grid;

/// Planes that rays visit together: M of some halo, or fewer if groups of several halos end at different planes. Groups without
/// seeds and without intensities are one with the group that follows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct PlaneGroup {
    /// The first plane and the last one, counted from the eye.
    pub(super) planes: [i64; 2],
    /// Whether intensities change here and a later plane needs them.
    pub(super) spreads: bool,
}

/// The groups of planes of a picture whose samples lie on the planes first..=last. `can_seed` tells whether a sample on some
/// planes can seed.
pub(super) fn groups(
    halos: &[HaloParams],
    is_watched: impl Fn(usize) -> bool,
    [first, last]: [i64; 2],
    can_seed: impl Fn([i64; 2]) -> bool,
) -> Vec<PlaneGroup> {
    let every = |halo: &HaloParams| halo.every.max(1);
    let end_of = |halo: &HaloParams, k: i64| (k.div_euclid(every(halo)) + 1) * every(halo) - 1;
    // Emissive halos go on through the group behind the last seeds.
    let goes_on = |(i, halo): (usize, &HaloParams)| match halo.kind == HaloKind::Emissive || is_watched(i) {
        true => end_of(halo, end_of(halo, last) + 1),
        false => last,
    };
    let end_of_all = halos.iter().enumerate().map(goes_on).max().unwrap_or(last);
    let mut groups: Vec<PlaneGroup> = Vec::new();
    // The first plane of groups at whose ends nothing can change.
    let mut idle = None;
    let mut next = first;
    while next <= end_of_all {
        let end = halos.iter().map(|halo| end_of(halo, next)).min().unwrap_or(end_of_all).min(end_of_all);
        // The seeds of a halo's own group spread here, and intensities of the group before become 0.
        let changes = |halo: &HaloParams| end_of(halo, end) == end && can_seed([end + 1 - 2 * every(halo), end]);
        let spreads = end < end_of_all && halos.iter().any(changes);
        let begin = idle.take().unwrap_or(next);
        match spreads || can_seed([next, end]) || end == end_of_all {
            true => groups.push(PlaneGroup { planes: [begin, end], spreads }),
            false => idle = Some(begin),
        }
        next = end + 1;
    }
    groups
}

/// Depths in planes that the points of a box can have: the nearest one and the farthest one.
fn depths(shot: &Shot, corners: impl Iterator<Item = DVec3>) -> [i64; 2] {
    let depths: Vec<f64> = corners.map(|corner| -shot.view.to_eye(corner).z / shot.lattice.step).collect();
    [f64::min, f64::max].map(|end| depths.iter().copied().reduce(end).unwrap_or(0.0).floor() as i64)
}

/// The planes, counted from the eye, on which any ray can have a sample, an iso-surface or something inside the boxes
/// with the corners `others`.
pub(super) fn reached(shot: &Shot, grid: &Grid, others: &[DVec3]) -> [i64; 2] {
    let [near, far] = depths(shot, grid.world_corners().into_iter().chain(others.iter().copied()));
    [(near - 1).max(shot.lattice.first(&shot.view)), far + 2]
}

/// Boxes in index space outside of which no sample seeds: least corner and largest corner.
pub(super) type SeedBoxes = Vec<[DVec3; 2]>;

/// The planes, counted from the eye, on which samples in boxes can lie: ranges in order, apart from each other.
pub(super) fn seed_planes(shot: &Shot, grid: &Grid, boxes: &SeedBoxes) -> Vec<[i64; 2]> {
    let corner = |[low, high]: [DVec3; 2], i: usize| {
        let ends = [low, high];
        grid.to_world(DVec3::new(ends[i & 1].x, ends[i >> 1 & 1].y, ends[i >> 2].z))
    };
    let of_box = |&own: &[DVec3; 2]| depths(shot, (0..8).map(|i| corner(own, i)));
    let mut ranges: Vec<[i64; 2]> = boxes.iter().map(of_box).map(|[near, far]| [near - 1, far + 2]).collect();
    ranges.sort_unstable();
    let mut apart: Vec<[i64; 2]> = Vec::new();
    for [near, far] in ranges {
        match apart.last_mut() {
            Some(before) if near <= before[1] + 1 => before[1] = before[1].max(far),
            _ => apart.push([near, far]),
        }
    }
    apart
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::shot::{HaloAccumulation, HaloSeed, HaloSource, HaloSpread, SeedSide};

    fn halo(kind: HaloKind, every: i64) -> HaloParams {
        let side = SeedSide::Power { exponent: 1.0 };
        HaloParams {
            name: "halo".into(),
            kind,
            seed: HaloSeed { value: None, direction: None, focus: None, labels: None, gradient_exponent: 1.0, side },
            spread: HaloSpread { from: HaloSource::Gradient, passes: 4, delta: 0.8, stretch: 1.0, median: false },
            profile: Vec::new(),
            opacity: 1.0,
            floor: 0.0,
            every,
            accumulate: HaloAccumulation::Max,
            tints: Vec::new(),
        }
    }

    fn dark(every: i64) -> HaloParams {
        halo(HaloKind::Occlusive, every)
    }

    fn bright(every: i64) -> HaloParams {
        halo(HaloKind::Emissive, every)
    }

    /// Groups follow each other without a gap, end where some halo's do, and go on until no halo shines any more.
    #[test]
    fn groups_of_planes_by_hand() {
        let planes = |halos: &[HaloParams], ends: [i64; 2]| {
            groups(halos, |_| false, ends, |_| true).iter().map(|group| group.planes).collect::<Vec<_>>()
        };
        assert_eq!(planes(&[dark(4)], [-3, 6]), [[-3, -1], [0, 3], [4, 6]]);
        // Seeds of plane 6 shine behind the planes 8 to 11.
        assert_eq!(planes(&[bright(4)], [2, 6]), [[2, 3], [4, 7], [8, 11]]);
        assert_eq!(planes(&[dark(2), bright(3)], [0, 3]), [[0, 1], [2, 2], [3, 3], [4, 5], [6, 7], [8, 8]]);
        let all = groups(&[dark(2), bright(3)], |_| false, [0, 3], |_| true);
        assert_eq!(all.iter().map(|group| group.spreads).collect::<Vec<_>>(), [true, true, true, true, true, false]);
        // Nothing is reached.
        assert_eq!(planes(&[dark(4)], [5, 2]), [[0; 2]; 0]);
    }

    /// Without seeds all planes are one group. Seeds part the groups in which they lie, and those in which they are seen.
    #[test]
    fn groups_without_seeds_are_one() {
        let found = |halos: &[HaloParams], seeds: [i64; 2]| {
            let can_seed = |[near, far]: [i64; 2]| near <= seeds[1] && far >= seeds[0];
            let found = groups(halos, |_| false, [0, 39], can_seed);
            found.iter().map(|group| (group.planes, group.spreads)).collect::<Vec<_>>()
        };
        assert_eq!(found(&[dark(4)], [50, 60]), [([0, 39], false)]);
        // Planes 10 and 11 seed in the group [8, 11]; [12, 15] has their intensities, which are gone behind it.
        let expected = [([0, 11], true), ([12, 15], true), ([16, 39], false)];
        assert_eq!(found(&[dark(4)], [10, 11]), expected);
        // The groups of two halos end apart: seeds of [10, 11] are gone behind 15 for one, and behind 19 for the other.
        let expected = [([0, 11], true), ([12, 14], true), ([15, 15], true), ([16, 19], true), ([20, 39], false)];
        assert_eq!(found(&[dark(4), dark(5)], [10, 11]), expected);
    }
}
