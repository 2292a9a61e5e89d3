//! Distances from a pool's points to the taken points, eight side by side, skipping groups that cannot matter.

/// Number of points processed side by side.
pub(super) const LANES: usize = 8;

/// One number for each of eight points.
pub(super) type EightFloats = [f32; LANES];

/// Points of a pool that are close together.
#[derive(Clone, Copy, Debug)]
pub(super) struct PointGroup {
    /// x, y and z of the points, in voxels from the voxel's centre.
    pub(super) at: [EightFloats; 3],
    /// The squared distance of each point to the nearest taken one. It is below 0 after the point has left the pool.
    pub(super) far: EightFloats,
    /// The draw that made each point.
    pub(super) draws: [u32; LANES],
}

/// Bounds of eight groups, which decide whether a group must be visited.
pub(super) type GroupBounds = [EightFloats; 6];

/// Indices into a row. A row has the middle (three numbers), the radius about it, and the largest squared distance to
/// a taken point. The last number is the squared distance within which a new point can lower one.
pub(super) const FAR: usize = 4;
pub(super) const REACH: usize = 3;
pub(super) const LIMIT: usize = 5;

/// Updates the distances of a pool by further points, and returns the largest.
#[inline(always)]
pub(super) fn lower(pool: &mut [PointGroup], groups: &mut [GroupBounds], points: &[[f32; 3]]) -> f32 {
    // Chunks of 32 points, one bit for each in a mask.
    for points in points.chunks(32) {
        lower_by(pool, groups, points);
    }
    farthest_of(groups)
}

/// The largest distance in all groups.
#[inline(always)]
fn farthest_of(groups: &[GroupBounds]) -> f32 {
    let mut most = [-1f32; LANES];
    for row in groups {
        most = larger(most, row[FAR]);
    }
    largest(most)
}

#[inline(always)]
fn lower_by(pool: &mut [PointGroup], groups: &mut [GroupBounds], points: &[[f32; 3]]) {
    for row in 0..groups.len() {
        // For each group, bits of the points that may be nearer to one of its points than all taken ones.
        let mut near = [0u32; LANES];
        for (i, p) in points.iter().enumerate() {
            let to = squared_distances(&groups[row], p);
            for l in 0..LANES {
                near[l] |= u32::from(to[l] < groups[row][LIMIT][l]) << i;
            }
        }
        for (l, mut left) in near.into_iter().enumerate() {
            if left == 0 {
                continue;
            }
            let group = row * LANES + l;
            let PointGroup { at, far, .. } = &mut pool[group];
            while left != 0 {
                nearer(at, far, &points[left.trailing_zeros() as usize]);
                left &= left - 1;
            }
            settle(*far, groups, group);
        }
    }
}

/// Updates the bounds of a group after its distances have changed.
#[inline(always)]
pub(super) fn settle(far: EightFloats, groups: &mut [GroupBounds], group: usize) {
    let far = largest(far);
    let (row, l) = (&mut groups[group / LANES], group % LANES);
    row[FAR][l] = far;
    let limit = far.sqrt() + row[REACH][l];
    row[LIMIT][l] = if far < 0.0 { -1.0 } else { limit * limit };
}

/// The pool index of the point farthest from the taken points and some further points. Groups are visited in the
/// order of their largest distance, and only while it exceeds the best point.
#[inline(always)]
pub(super) fn farthest(pool: &[PointGroup], groups: &[GroupBounds], points: &[[f32; 3]]) -> usize {
    let far = |group: usize| groups[group / LANES][FAR][group % LANES];
    let most = farthest_of(groups);
    let first = (0..pool.len()).find(|&group| far(group) == most).unwrap_or(0);
    let (mut best, mut at) = (-1f32, first * LANES);
    let others = if points.is_empty() { 0..0 } else { 0..pool.len() };
    for group in std::iter::once(first).chain(others) {
        if far(group) <= best {
            continue;
        }
        let mut d = pool[group].far;
        for p in points {
            nearer(&pool[group].at, &mut d, p);
        }
        take_largest(&d, group, &mut best, &mut at);
    }
    at
}

/// Updates the best point by the first of a group's largest distances, if that is larger.
#[inline(always)]
pub(super) fn take_largest(d: &EightFloats, group: usize, best: &mut f32, at: &mut usize) {
    let most = largest(*d);
    if most > *best {
        let lane = d.iter().position(|&d| d == most).unwrap_or(0);
        (*best, *at) = (most, group * LANES + lane);
    }
}

#[inline(always)]
pub(super) fn squared_distances(row: &GroupBounds, p: &[f32; 3]) -> EightFloats {
    let mut to = [0.0; LANES];
    for l in 0..LANES {
        let (dx, dy, dz) = (row[0][l] - p[0], row[1][l] - p[1], row[2][l] - p[2]);
        to[l] = dx * dx + dy * dy + dz * dz;
    }
    to
}

#[inline(always)]
fn nearer([x, y, z]: &[EightFloats; 3], d: &mut EightFloats, p: &[f32; 3]) {
    for l in 0..LANES {
        let (dx, dy, dz) = (x[l] - p[0], y[l] - p[1], z[l] - p[2]);
        let to = dx * dx + dy * dy + dz * dz;
        d[l] = if to < d[l] { to } else { d[l] };
    }
}

/// The larger of each pair; no number is NaN.
#[inline(always)]
fn larger(a: EightFloats, b: EightFloats) -> EightFloats {
    let mut larger = a;
    for l in 0..LANES {
        larger[l] = if a[l] > b[l] { a[l] } else { b[l] };
    }
    larger
}

/// The largest number; no number is NaN. Halves are compared with halves, which has a shorter dependency chain than a
/// loop.
#[inline(always)]
pub(super) fn largest(d: EightFloats) -> f32 {
    let larger = |a: f32, b: f32| if a > b { a } else { b };
    let four = [larger(d[0], d[4]), larger(d[1], d[5]), larger(d[2], d[6]), larger(d[3], d[7])];
    larger(larger(four[0], four[2]), larger(four[1], four[3]))
}

#[cfg(test)]
mod tests {
    use super::super::class::by_class;
    use super::super::neighbours::NeighbourLinks;
    use super::super::pool::{Class, pool_size};
    use super::super::tests::sites;
    use super::*;
    use drypoint_scene::glam::DVec3;
    use drypoint_scene::philox;

    #[test]
    fn groups_hide_no_point() {
        let (cells, normals) = ([[3, 4, 5]], [DVec3::new(1.0, 2.0, 3.0).normalize()]);
        let sites = sites(&cells, &normals, true);
        let (ids, starts) = by_class(&cells);
        let links = NeighbourLinks::new(&sites, &ids);
        let size = pool_size(25);
        let mut class = Class::new(&sites, &links, &ids, &starts, 1 + 4, size);
        let all: Vec<[f32; 3]> =
            class.pools.iter().flat_map(|group| (0..LANES).map(|l| group.at.map(|x| x[l]))).collect();
        let squared = |a: [f32; 3], b: [f32; 3]| (0..3).map(|c| a[c] - b[c]).map(|x| x * x).sum::<f32>();
        let mut wanted: Vec<f32> = class.pools.iter().flat_map(|group| group.far).collect();
        for i in 0..60 {
            let p = philox::uniforms(2, [i, 0, 0], 0);
            let p = [0, 1, 2].map(|c| (1.5 * p[c] - 0.75) as f32);
            let q = [p[1], p[2], -p[0]];
            let nearest: Vec<f32> =
                wanted.iter().zip(&all).map(|(d, a)| d.min(squared(*a, p)).min(squared(*a, q))).collect();
            let slot = farthest(&class.pools, &class.rows, &[p, q]);
            assert_eq!(nearest[slot], nearest.iter().copied().fold(-1.0, f32::max));
            let largest = lower(&mut class.pools, &mut class.rows, &[p]);
            wanted.iter_mut().zip(&all).for_each(|(d, a)| *d = d.min(squared(*a, p)));
            let kept: Vec<f32> = class.pools.iter().flat_map(|group| group.far).collect();
            assert_eq!(kept, wanted);
            assert_eq!(largest, wanted.iter().copied().fold(-1.0, f32::max));
        }
    }
}
