//! Distinction of label volumes from scans and simulations.

use drypoint_scene::parallel;
use drypoint_scene::volume::{Access, Volume, Voxel};
use drypoint_scene::with_access;

/// Least share of neighbouring pairs of ids that are equal.
const EQUAL: f64 = 0.7;
/// Largest share of the changes in a row that pass a value between two others. Ids jump; measured and computed values
/// pass intermediate ones.
const BETWEEN: f64 = 0.1;

/// Whether the voxels are ids of parts: integers, mostly equal to their neighbours, that jump where they change.
pub(super) fn are_ids(volume: &Volume) -> bool {
    if !volume.is_integer() || volume.range()[1] <= 0.0 {
        return false;
    }
    let c = with_access!(volume, |a| count(volume, a));
    let share = |part: u64, all: u64| part as f64 / all.max(1) as f64;
    c.changes > 0 && share(c.equal, c.pairs) >= EQUAL && share(c.between, c.changes) <= BETWEEN
}

/// Counts over all rows along all axes.
#[derive(Clone, Copy, Default)]
struct NeighbourCounts {
    /// Number of neighbouring pairs without 0, and number of equal ones.
    pairs: u64,
    equal: u64,
    /// Number of triples in a row in which a neighbour differs from a middle other than 0, and number of monotonic
    /// ones.
    changes: u64,
    between: u64,
}

impl NeighbourCounts {
    fn add(&mut self, [p, q, r]: [f64; 3]) {
        if p != 0.0 && q != 0.0 {
            self.pairs += 1;
            self.equal += u64::from(p == q);
        }
        if q != 0.0 && (p != q || q != r) {
            self.changes += 1;
            self.between += u64::from((p < q && q < r) || (p > q && q > r));
        }
    }

    fn plus(self, other: Self) -> Self {
        Self {
            pairs: self.pairs + other.pairs,
            equal: self.equal + other.equal,
            changes: self.changes + other.changes,
            between: self.between + other.between,
        }
    }
}

fn count<A: Access>(volume: &Volume, a: A) -> NeighbourCounts {
    let [nx, ny, nz] = volume.dims();
    let (slope, intercept) = (volume.slope(), volume.intercept());
    let row = |y: usize, z: usize, out: &mut Vec<f64>| {
        out.clear();
        out.extend((0..nx).map(|x| slope * a.at(x, y, z).to_f64() + intercept));
    };
    // Sums of integers do not depend on the order of the parts.
    let slices = parallel::map(nz, &|z| {
        let mut rows = NeighbourCounts::default();
        let [mut here, mut next, mut last] = [const { Vec::new() }; 3];
        for y in 0..ny {
            row(y, z, &mut here);
            here.windows(3).for_each(|v| rows.add([v[0], v[1], v[2]]));
            for (along_y, inside) in [(true, y + 2 < ny), (false, z + 2 < nz)] {
                if inside {
                    let beyond = |i: usize| if along_y { (y + i, z) } else { (y, z + i) };
                    row(beyond(1).0, beyond(1).1, &mut next);
                    row(beyond(2).0, beyond(2).1, &mut last);
                    (0..nx).for_each(|x| rows.add([here[x], next[x], last[x]]));
                }
            }
        }
        rows
    });
    slices.into_iter().fold(NeighbourCounts::default(), NeighbourCounts::plus)
}

#[cfg(test)]
mod tests {
    use super::super::tests::{radius, typed};
    use super::*;
    use drypoint_scene::volume::VoxelType;

    #[test]
    fn parts_with_ids_are_labels_and_smooth_or_noisy_data_are_not() {
        let parts = |p: [usize; 3]| if radius(p) > 12.0 { 0.0 } else { 1.0 + (p[0] / 11 + 40 * (p[1] / 16)) as f64 };
        assert!(are_ids(&typed(parts, VoxelType::I16)));
        assert!(are_ids(&typed(|p| f64::from(u8::from(radius(p) < 9.0)), VoxelType::U8)));
        // Floating-point volumes are not labels, even with the same numbers.
        assert!(!are_ids(&typed(parts, VoxelType::F32)));
        // A ball with a soft edge, flat inside; a ramp; noise; one value everywhere.
        assert!(!are_ids(&typed(|p| 255.0 / (1.0 + (radius(p) - 9.0).exp()), VoxelType::U8)));
        assert!(!are_ids(&typed(radius, VoxelType::U16)));
        assert!(!are_ids(&typed(|p| ((p[0] * 7 + p[1] * 13 + p[2] * 29) % 11) as f64, VoxelType::U8)));
        assert!(!are_ids(&typed(|_| 3.0, VoxelType::U8)));
        assert!(!are_ids(&typed(|_| 0.0, VoxelType::U8)));
    }
}
