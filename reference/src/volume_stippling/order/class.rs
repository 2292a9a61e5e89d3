//! Classes of voxels by the parities of their coordinates. No two voxels of a class are neighbours.

use drypoint_scene::philox;

/// The parities of x, y and z, x lowest.
pub(super) fn class_of([x, y, z]: [u32; 3]) -> usize {
    (x & 1 | (y & 1) << 1 | (z & 1) << 2) as usize
}

/// The axes along which neighbour k has the other parity, x lowest.
pub(super) fn parities(k: usize) -> usize {
    usize::from(k % 3 != 1) | usize::from(k / 3 % 3 != 1) << 1 | usize::from(k / 9 != 1) << 2
}

/// The place of each voxel when classes are sorted one after the other, and the start of each class.
pub(super) fn by_class(cells: &[[u32; 3]]) -> (Vec<u32>, [usize; 9]) {
    let mut starts = [0; 9];
    for cell in cells {
        starts[class_of(*cell) + 1] += 1;
    }
    for c in 0..8 {
        starts[c + 1] += starts[c];
    }
    let mut next = starts;
    let mut place = |cell: &[u32; 3]| {
        let id = next[class_of(*cell)];
        next[class_of(*cell)] += 1;
        id as u32
    };
    (cells.iter().map(&mut place).collect(), starts)
}

/// The draw of the orders of ranks.
pub(super) const OF_RANKS: u32 = u32::MAX;

/// The draw of the orders of the sweeps that find the first points.
pub(super) const OF_SWEEPS: u32 = u32::MAX - 1;

/// N classes in the order of a round, shuffled by random numbers of a draw.
pub(super) fn class_order<const N: usize>(seed: u64, round: u32, draw: u32) -> [usize; N] {
    /// The place of a missing voxel.
    const NOWHERE: u32 = u32::MAX;
    let key = |class: usize| philox::uniform(seed, [round, class as u32, NOWHERE], draw);
    let mut order = std::array::from_fn(|i| i);
    order.sort_by(|&a, &b| key(a).total_cmp(&key(b)));
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_parities_stand_together_and_a_step_changes_those_of_its_axes() {
        let cells: Vec<[u32; 3]> = (0..60).map(|i| [i % 5, i / 5 % 4, i / 20]).collect();
        let (ids, starts) = by_class(&cells);
        let class = |i: usize| starts[1..8].iter().filter(|&&start| start <= ids[i] as usize).count();
        for (i, cell) in cells.iter().enumerate() {
            assert_eq!(class(i), (cell[0] % 2 + 2 * (cell[1] % 2) + 4 * (cell[2] % 2)) as usize);
        }
        assert_eq!([13, 14, 16, 22, 0].map(parities), [0, 1, 2, 4, 7]);
        let orders: Vec<[usize; 8]> = (0..40).map(|rank| class_order(1, rank, OF_RANKS)).collect();
        assert!(orders.iter().any(|order| order[0] != orders[0][0]));
        for mut order in orders {
            order.sort_unstable();
            assert_eq!(order, [0, 1, 2, 3, 4, 5, 6, 7]);
        }
    }
}
