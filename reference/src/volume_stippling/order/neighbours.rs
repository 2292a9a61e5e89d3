//! Neighbours of voxels.

use super::Sites;
use drypoint_scene::glam::DVec3;
use drypoint_scene::parallel;

/// Index of the neighbour in a direction: one voxel away, rounded.
pub(super) fn towards(sites: &Sites<'_>, n: DVec3) -> usize {
    let step = sites.axes.inverse() * n * sites.voxel;
    let mut to = step.to_array().map(|x| x.round_ties_even().clamp(-1.0, 1.0));
    if to == [0.0; 3] {
        // Every component rounds to 0, as on a diagonal of a very long voxel: the nearest axis replaces the step.
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

/// The neighbours of each voxel, in the order of all.
pub(super) struct NeighbourLinks {
    /// For each neighbour: its place · 32 + its index among the 27.
    pub(super) all: Vec<u32>,
    /// Start of each voxel's neighbours.
    first: Vec<u32>,
}

/// The largest number of voxels that links can index.
pub(in crate::volume_stippling) const MOST_VOXELS: usize = 1 << 27;

pub(super) fn id_of(link: u32) -> usize {
    (link >> 5) as usize
}

pub(super) fn offset_of(link: u32) -> usize {
    (link & 31) as usize
}

impl NeighbourLinks {
    pub(super) fn new(sites: &Sites<'_>, ids: &[u32]) -> Self {
        let cells = sites.cells;
        let mut order = vec![0; cells.len()];
        for (i, &id) in ids.iter().enumerate() {
            order[id as usize] = i;
        }
        let rows = RowIndex::new(cells);
        let parts = parallel::map_of(order.chunks(4096).collect(), &|_, part: &[usize]| {
            let (mut links, mut counts) = (Vec::new(), Vec::new());
            for &i in part {
                let before = links.len();
                if sites.neighbours {
                    rows.around(cells, cells[i], 1, |j, k| links.push(ids[j] << 5 | k as u32));
                }
                counts.push((links.len() - before) as u32);
            }
            (links, counts)
        });
        let (mut all, mut first) = (Vec::new(), vec![0]);
        for (links, counts) in parts {
            all.extend(links);
            for count in counts {
                first.push(first[first.len() - 1] + count);
            }
        }
        Self { all, first }
    }

    pub(super) fn range(&self, id: usize) -> [u32; 2] {
        [self.first[id], self.first[id + 1]]
    }
}

/// Finds voxels of a list in linear order by their coordinates.
pub(super) struct RowIndex {
    /// y, z and the index of the first voxel of each nonempty row.
    rows: Vec<([u32; 2], usize)>,
}

impl RowIndex {
    pub(super) fn new(cells: &[[u32; 3]]) -> Self {
        let mut rows: Vec<([u32; 2], usize)> = Vec::new();
        for (i, cell) in cells.iter().enumerate() {
            if rows.last().is_none_or(|&(row, _)| row != [cell[1], cell[2]]) {
                rows.push(([cell[1], cell[2]], i));
            }
        }
        Self { rows }
    }

    /// The voxels of the list at most `reach` away along each axis, without the voxel itself, with their indices in
    /// this neighbourhood, x fastest.
    pub(super) fn around(
        &self,
        cells: &[[u32; 3]],
        [x, y, z]: [u32; 3],
        reach: u32,
        mut found: impl FnMut(usize, usize),
    ) {
        let side = 2 * reach + 1;
        for dz in 0..side {
            for dy in 0..side {
                let (Some(y), Some(z)) = ((y + dy).checked_sub(reach), (z + dz).checked_sub(reach)) else { continue };
                let Ok(row) = self.rows.binary_search_by(|(row, _)| (row[1], row[0]).cmp(&(z, y))) else { continue };
                let end = self.rows.get(row + 1).map_or(cells.len(), |next| next.1);
                let line = &cells[self.rows[row].1..end];
                let first = line.partition_point(|cell| cell[0] + reach < x);
                for (i, cell) in line.iter().enumerate().skip(first).take_while(|(_, cell)| cell[0] <= x + reach) {
                    let k = cell[0] + reach - x + side * (dy + side * dz);
                    if 2 * k + 1 != side * side * side {
                        found(self.rows[row].1 + i, k as usize);
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::sites;
    use super::*;
    use drypoint_scene::glam::DMat3;

    #[test]
    fn neighbours_are_found_with_their_offsets() {
        let cells: Vec<[u32; 3]> =
            [[0, 0, 0], [1, 0, 0], [3, 0, 0], [0, 1, 0], [2, 1, 0], [1, 1, 1], [1, 2, 2], [1, 1, 3]].into();
        let rows = RowIndex::new(&cells);
        for (i, &cell) in cells.iter().enumerate() {
            let mut found = Vec::new();
            rows.around(&cells, cell, 1, |j, k| found.push((j, k)));
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
    fn a_normal_leads_to_the_voxel_in_its_direction() {
        let sheared = DMat3::from_cols(DVec3::X, DVec3::Y, DVec3::new(0.0, 0.0, 4.0));
        for (axes, n, k) in [
            (DMat3::IDENTITY, DVec3::X, 14),
            (DMat3::IDENTITY, DVec3::new(1.0, 2.0, 3.0).normalize(), 13 + 3 + 9),
            (DMat3::IDENTITY, DVec3::NEG_ONE.normalize(), 0),
            // A voxel is four long along z. One voxel's length along n stays inside it, but it has no other neighbour
            // there.
            (sheared, DVec3::Z, 22),
        ] {
            let sites = Sites { axes, ..sites(&[], &[], true) };
            assert_eq!(towards(&sites, n), k, "{n}");
        }
    }
}
