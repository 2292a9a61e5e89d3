//! Strokes that begin or end near each other.

use crate::grid::{CellGrid, micrometres};
use drypoint_scene::glam::DVec2;

/// Number of near strokes that are kept for each end.
const NEAREST: usize = 8;

/// The strokes near each stroke by both of its ends, nearest first.
pub(super) struct Neighbours {
    lists: Vec<u32>,
    /// Start of each stroke's list, and the end of the last.
    begins: Vec<usize>,
}

impl Neighbours {
    /// Finds the neighbours of strokes given by their ends; fewer than 2³² strokes.
    pub(super) fn new(ends: &[[DVec2; 2]]) -> Self {
        let places = EndpointGrid::new(ends);
        let (mut lists, mut begins) = (Vec::with_capacity(ends.len() * NEAREST), vec![0]);
        let mut near = Vec::new();
        for (item, &[a, b]) in ends.iter().enumerate() {
            for end in [a, b].into_iter().take(if a == b { 1 } else { 2 }) {
                places.nearest(item, end, &mut near);
                for &(_, other) in &near {
                    let known = lists[begins[item]..].contains(&other);
                    if !known {
                        lists.push(other);
                    }
                }
            }
            begins.push(lists.len());
        }
        Self { lists, begins }
    }

    /// Returns the strokes near a stroke.
    pub(super) fn of(&self, item: usize) -> impl Iterator<Item = usize> {
        self.lists[self.begins[item]..self.begins[item + 1]].iter().map(|&other| other as usize)
    }
}

/// Ends of strokes, sorted into cells.
struct EndpointGrid {
    grid: Option<CellGrid>,
    /// Each end in micrometres with its stroke, cell by cell.
    ends: Vec<([i64; 2], u32)>,
    /// Start of each cell, and the end of the last.
    begins: Vec<usize>,
}

fn steps(place: DVec2) -> [i64; 2] {
    place.to_array().map(micrometres)
}

impl EndpointGrid {
    fn new(strokes: &[[DVec2; 2]]) -> Self {
        let mut ends: Vec<([i64; 2], u32)> = Vec::with_capacity(strokes.len());
        for (item, &[a, b]) in strokes.iter().enumerate() {
            ends.push((steps(a), item as u32));
            if a != b {
                ends.push((steps(b), item as u32));
            }
        }
        let all: Vec<[i64; 2]> = ends.iter().map(|end| end.0).collect();
        let Some(grid) = CellGrid::new(&all, 1) else { return Self { grid: None, ends, begins: Vec::new() } };
        let cell = |end: &([i64; 2], u32)| grid.index(grid.cell_of(&end.0));
        ends.sort_by_key(cell);
        let mut begins = vec![0; grid.cells() + 1];
        ends.iter().for_each(|end| begins[cell(end) + 1] += 1);
        for i in 1..begins.len() {
            begins[i] += begins[i - 1];
        }
        Self { grid: Some(grid), ends, begins }
    }

    /// Finds the strokes whose ends are nearest to a point, as squared distances and indices. Ties go to the smaller
    /// index.
    fn nearest(&self, item: usize, place: DVec2, near: &mut Vec<(i64, u32)>) {
        near.clear();
        let Some(grid) = &self.grid else { return };
        let place = steps(place);
        let [i, j] = grid.cell_of(&place);
        for ring in 0..grid.columns.max(grid.rows) {
            // Everything in this ring is at least `least` away.
            let least = (ring as i64 - 1).max(0) * grid.side;
            if near.len() == NEAREST && near[NEAREST - 1].0 < least * least {
                break;
            }
            let (top, bottom) = (j as i64 - ring as i64, j as i64 + ring as i64);
            for row in top.max(0)..=bottom.min(grid.rows as i64 - 1) {
                let whole = row == top || row == bottom;
                let step = if whole || ring == 0 { 1 } else { 2 * ring };
                for column in (0..=2 * ring).step_by(step).filter_map(|k| (i + k).checked_sub(ring)) {
                    if column < grid.columns {
                        self.cell(grid.index([column, row as usize]), item, place, near);
                    }
                }
            }
        }
    }

    fn cell(&self, cell: usize, item: usize, place: [i64; 2], near: &mut Vec<(i64, u32)>) {
        for &(end, other) in &self.ends[self.begins[cell]..self.begins[cell + 1]] {
            let found = ((end[0] - place[0]).pow(2) + (end[1] - place[1]).pow(2), other);
            if other as usize == item || (near.len() == NEAREST && found >= near[NEAREST - 1]) {
                continue;
            }
            if let Some(known) = near.iter().position(|n| n.1 == other) {
                if found >= near[known] {
                    continue;
                }
                near.remove(known);
            }
            near.insert(near.partition_point(|n| *n < found), found);
            near.truncate(NEAREST);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_finds_what_looking_at_all_finds() {
        let mut state = 5_u64;
        let mut draw = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as f64 / (1_u64 << 31) as f64 * 30.0
        };
        // Half of them crowded in a corner, every third a line.
        let ends: Vec<[DVec2; 2]> = (0..300)
            .map(|i| {
                let at = DVec2::new(draw(), draw()) * if i % 2 == 0 { 1.0 } else { 0.05 };
                [at, if i % 3 == 0 { at + DVec2::new(draw(), draw()) } else { at }]
            })
            .collect();
        let near = Neighbours::new(&ends);
        for (item, [a, b]) in ends.iter().enumerate() {
            let of_end = |end: &DVec2| {
                let square = |e: &DVec2| {
                    let ([x, y], [u, v]) = (steps(*e), steps(*end));
                    (x - u).pow(2) + (y - v).pow(2)
                };
                let mut all: Vec<(i64, usize)> = ends
                    .iter()
                    .enumerate()
                    .filter(|(i, _)| *i != item)
                    .map(|(i, [c, d])| (square(c).min(square(d)), i))
                    .collect();
                all.sort();
                all.truncate(NEAREST);
                all.into_iter().map(|(_, i)| i)
            };
            let mut expected: Vec<usize> = of_end(a).collect();
            if a != b {
                expected.extend(of_end(b).filter(|i| !expected.contains(i)).collect::<Vec<_>>());
            }
            assert_eq!(near.of(item).collect::<Vec<_>>(), expected, "{item}");
        }
    }
}
