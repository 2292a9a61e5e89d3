//! Distances of bricks to the nearest brick that can show something.

/// The largest distance that a byte holds.
const FARTHEST: u8 = 255;

/// The distance of each brick to the nearest visible one, in bricks along the axis with the largest difference. It is 0
/// for a visible brick, 1 for its 26 neighbours, and so on, up to 255. All bricks less than d from a brick of distance
/// d are invisible.
///
/// This distance is the number of steps from neighbour to neighbour over 26 neighbours, so two sweeps find it.
pub(super) fn distances(visible: &[bool], [nx, ny, nz]: [usize; 3]) -> Vec<u8> {
    let mut far: Vec<u8> = visible.iter().map(|&is| if is { 0 } else { FARTHEST }).collect();
    // Neighbours that come before a brick, x fastest; those after it lie opposite.
    let before: Vec<[isize; 3]> = (0..13).map(|i| [i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1]).collect();
    let mut sweep = |places: &mut dyn Iterator<Item = usize>, sign: isize| {
        for i in places {
            let at = [i % nx, i / nx % ny, i / nx / ny];
            for step in &before {
                let [x, y, z] = [0, 1, 2].map(|axis| at[axis].wrapping_add_signed(sign * step[axis]));
                if x < nx && y < ny && z < nz {
                    far[i] = far[i].min(far[(z * ny + y) * nx + x].saturating_add(1));
                }
            }
        }
    };
    sweep(&mut (0..visible.len()), 1);
    sweep(&mut (0..visible.len()).rev(), -1);
    far
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The largest of the distances along the axes, by trying all visible bricks.
    #[test]
    fn distances_are_those_to_the_nearest_visible_brick() {
        let dims = [7, 5, 6];
        let place = |i: usize| [i % 7, i / 7 % 5, i / 35].map(|n| n as i32);
        for seed in 0..40_usize {
            let visible: Vec<bool> = (0..210).map(|i| (i * 7919 + seed * 104_729) % 97 < seed / 4).collect();
            for (i, &found) in distances(&visible, dims).iter().enumerate() {
                let to = |j: usize| (0..3).map(|axis| (place(i)[axis] - place(j)[axis]).abs()).max();
                let nearest = (0..210).filter(|&j| visible[j]).filter_map(to).min();
                assert_eq!(i32::from(found), nearest.unwrap_or(255), "{seed}: {i}");
            }
        }
    }
}
