//! Distances of a pool's points to those that are taken, eight side by side, without looking at groups that they cannot
//! matter to.

/// Points in work side by side.
pub(super) const LANES: usize = 8;

/// A coordinate or a distance of each.
pub(super) type Lane = [f32; LANES];

/// Rows of a group's numbers: the middle, no point is farther from it, the largest distance squared to what is taken, and
/// the distance squared up to which a point can lower one.
pub(super) const FAR: usize = 4;
pub(super) const REACH: usize = 3;
pub(super) const LIMIT: usize = 5;

/// Lowers the distances of a pool to those to some points, and gives the largest.
pub(super) fn lower(pool: &mut [[Lane; 4]], groups: &mut [[Lane; 6]], points: &[[f32; 3]]) -> f32 {
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
pub(super) fn settle(points: &[Lane; 4], groups: &mut [[Lane; 6]], group: usize) {
    let far = points[3].into_iter().fold(-1.0, f32::max);
    let (row, l) = (&mut groups[group / LANES], group % LANES);
    row[FAR][l] = far;
    row[LIMIT][l] = if far < 0.0 { -1.0 } else { (far.sqrt() + row[REACH][l]) * (far.sqrt() + row[REACH][l]) };
}

/// The place in a pool of the point farthest from what is taken and from some further points. A group is looked into only
/// if its farthest could be it, that of the largest distance first.
pub(super) fn farthest(pool: &[[Lane; 4]], groups: &[[Lane; 6]], points: &[[f32; 3]]) -> usize {
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

#[cfg(test)]
mod tests {
    use super::super::class::by_class;
    use super::super::links::Links;
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
}
