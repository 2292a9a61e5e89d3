//! Partition of translucent dots into sets of disjoint ones.
//!
//! A path inks a place only once, but the ink of two overlapping dots must add. Dots that touch therefore go into
//! different paths.

use super::groups::PagePoint;
use crate::grid::{CellGrid, NONE};

/// Largest number of sets, each drawn as one path. Each further dot becomes an element of its own. The cost of many
/// dots in one place is then bounded by their number.
const SETS: usize = 64;

/// Partitions dots of one diameter into sets without overlap. Each set keeps their order.
pub(super) fn disjoint_sets(dots: &[PagePoint], diameter: i64) -> Vec<Vec<PagePoint>> {
    let Some(grid) = CellGrid::new(dots, diameter) else { return Vec::new() };
    let mut heads = vec![NONE; grid.cells()];
    let mut nexts = vec![NONE; dots.len()];
    let mut set_of = vec![0; dots.len()];
    let mut sets: Vec<Vec<PagePoint>> = Vec::new();
    let mut single: Vec<Vec<PagePoint>> = Vec::new();
    for (i, dot) in dots.iter().enumerate() {
        // A bit for each set that holds a dot overlapping this one.
        let mut taken = 0_u64;
        grid.around(dot, |cell| {
            let mut other = heads[cell];
            while other != NONE {
                let [dx, dy] = [dots[other][0] - dot[0], dots[other][1] - dot[1]];
                if dx * dx + dy * dy < diameter * diameter {
                    taken |= 1 << set_of[other];
                }
                other = nexts[other];
            }
        });
        let set = taken.trailing_ones() as usize;
        if set == SETS {
            single.push(vec![*dot]);
            continue;
        }
        if set == sets.len() {
            sets.push(Vec::new());
        }
        sets[set].push(*dot);
        set_of[i] = set;
        let cell = grid.index(grid.cell_of(dot));
        nexts[i] = std::mem::replace(&mut heads[cell], i);
    }
    sets.append(&mut single);
    sets
}

#[cfg(test)]
mod tests {
    use super::*;

    fn overlap(a: &PagePoint, b: &PagePoint, diameter: i64) -> bool {
        (a[0] - b[0]).pow(2) + (a[1] - b[1]).pow(2) < diameter * diameter
    }

    #[test]
    fn no_set_overlaps_and_none_is_lost() {
        // 3000 dots of 0.5 mm on 20 × 20 mm, about ten on each other.
        let mut state = 1_u64;
        let mut draw = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) as i64 % 20_000 - 7000
        };
        let dots: Vec<PagePoint> = (0..3000).map(|_| [draw(), draw()]).collect();
        let sets = disjoint_sets(&dots, 500);
        assert!(sets.len() > 1 && sets.len() < 30, "{}", sets.len());
        for set in &sets {
            for (i, a) in set.iter().enumerate() {
                assert!(set[..i].iter().all(|b| !overlap(a, b, 500)));
            }
        }
        let mut all = sets.concat();
        all.sort();
        let mut expected = dots;
        expected.sort();
        assert_eq!(all, expected);
    }

    #[test]
    fn few_dots() {
        assert!(disjoint_sets(&[], 100).is_empty());
        assert_eq!(disjoint_sets(&[[5, 5]], 100), [[[5, 5]]]);
        // Touching is not overlapping.
        assert_eq!(disjoint_sets(&[[0, 0], [100, 0], [199, 0]], 100), [vec![[0, 0], [100, 0]], vec![[199, 0]]]);
        // All on a line, and far apart.
        assert_eq!(disjoint_sets(&[[0, 7], [1_000_000_000, 7]], 2).len(), 1);
    }

    #[test]
    fn a_heap_is_sets_of_one() {
        let sets = disjoint_sets(&vec![[3, 4]; 20_000], 100);
        assert_eq!(sets.len(), 20_000);
    }
}
