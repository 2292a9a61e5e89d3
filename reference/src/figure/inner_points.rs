//! Points well inside the regions of a map of labels, to which leader lines lead.

use std::collections::BTreeMap;

/// A region of a map: the cells of one id.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MapRegion {
    /// The id.
    pub id: u32,
    /// Number of cells.
    pub cells: usize,
    /// The cell that is farthest from the cells of other ids; of several the one nearest to the region's centroid.
    pub inner: usize,
}

/// Returns the regions of a map of `width` cells a row, the largest first, of equal ones that of the smaller id. Cells
/// without an id are in no region; beyond the map nothing is.
pub fn inner_points(ids: &[Option<u32>], width: usize) -> Vec<MapRegion> {
    let mut cells: BTreeMap<u32, Vec<usize>> = BTreeMap::new();
    ids.iter().enumerate().filter_map(|(cell, id)| Some((cell, (*id)?))).for_each(|(cell, id)| {
        cells.entry(id).or_default().push(cell);
    });
    let depth = depths(ids, width);
    let mut regions: Vec<MapRegion> = cells
        .into_iter()
        .map(|(id, cells)| {
            let n = cells.len() as f64;
            let place = |cell: usize| [(cell % width) as f64, (cell / width) as f64];
            let centroid = [0, 1].map(|axis| cells.iter().map(|&cell| place(cell)[axis]).sum::<f64>() / n);
            let from_centroid = |cell: usize| {
                let [x, y] = place(cell);
                (x - centroid[0]).powi(2) + (y - centroid[1]).powi(2)
            };
            let inner = cells.iter().copied().fold(cells[0], |best, cell| {
                let is_deeper = depth[cell] > depth[best]
                    || depth[cell] == depth[best] && from_centroid(cell) < from_centroid(best);
                if is_deeper { cell } else { best }
            });
            MapRegion { id, cells: cells.len(), inner }
        })
        .collect();
    regions.sort_by_key(|region| (std::cmp::Reverse(region.cells), region.id));
    regions
}

/// The distance of each cell to the nearest cell of another id or of none, in thirds of a cell (chamfer distance with
/// weights 3 and 4). The border of the map is as far as a cell of another id.
fn depths(ids: &[Option<u32>], width: usize) -> Vec<u32> {
    let height = ids.len() / width.max(1);
    let mut depth = vec![u32::MAX; ids.len()];
    let relax = |depth: &mut [u32], [x, y]: [usize; 2], steps: [([isize; 2], u32); 4]| {
        let cell = y * width + x;
        let nearest = steps.into_iter().map(|([dx, dy], weight)| {
            let at = [x.wrapping_add_signed(dx), y.wrapping_add_signed(dy)];
            let other = at[1].wrapping_mul(width).wrapping_add(at[0]);
            let is_inside = at[0] < width && at[1] < height;
            if is_inside && ids[other] == ids[cell] { depth[other].saturating_add(weight) } else { weight }
        });
        depth[cell] = nearest.fold(depth[cell], u32::min);
    };
    for y in 0..height {
        for x in 0..width {
            relax(&mut depth, [x, y], [([-1, 0], 3), ([0, -1], 3), ([-1, -1], 4), ([1, -1], 4)]);
        }
    }
    for y in (0..height).rev() {
        for x in (0..width).rev() {
            relax(&mut depth, [x, y], [([1, 0], 3), ([0, 1], 3), ([1, 1], 4), ([-1, 1], 4)]);
        }
    }
    depth
}

#[cfg(test)]
mod tests {
    use super::*;

    fn map(rows: &[&str]) -> (Vec<Option<u32>>, usize) {
        (rows.iter().flat_map(|row| row.chars().map(|c| c.to_digit(10))).collect(), rows[0].len())
    }

    #[test]
    fn the_middle_of_a_square_and_the_bulge_of_a_pan() {
        let (ids, width) =
            map(&["............", ".1111.......", ".1111.222...", ".1111.222222", ".1111.222...", "......3....."]);
        let regions = inner_points(&ids, width);
        let found: Vec<_> = regions.iter().map(|r| (r.id, r.cells, [r.inner % width, r.inner / width])).collect();
        // The square has four cells in its middle. The pan's handle moves its centroid, and not its deepest cell.
        assert_eq!(found, [(1, 16, [2, 2]), (2, 12, [7, 3]), (3, 1, [6, 5])]);
    }

    /// A label's point lies in the label, and no point of it is deeper by brute force.
    #[test]
    fn points_are_inside_and_deepest() {
        let width = 23;
        let ids: Vec<Option<u32>> =
            (0..23 * 17u32).map(|i| Some((i * i / 97 + i / 23) % 3).filter(|id| *id > 0)).collect();
        for region in inner_points(&ids, width) {
            assert_eq!(ids[region.inner], Some(region.id));
            assert_eq!(ids.iter().filter(|id| **id == Some(region.id)).count(), region.cells);
        }
        assert_eq!(inner_points(&[None; 6], 3), []);
        assert_eq!(inner_points(&[], 0), []);
    }
}
