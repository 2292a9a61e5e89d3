//! The disk of a lit sphere: its inside texels, and the colours of the texels outside ([STF-1]).

use crate::color::Rgba;
use std::ops::Range;

/// Whether texel (i, j) of an S × S picture is inside: (2i + 1 − S)² + (2j + 1 − S)² ≤ S², that is, whether its centre
/// lies in the closed inscribed disk.
pub fn is_inside(side: usize, i: usize, j: usize) -> bool {
    let [u, v] = [i, j].map(|k| (2 * k + 1).abs_diff(side));
    u * u + v * v <= side * side
}

/// The inside columns of row j. Never empty: |2i + 1 − S| ≤ 1 for a middle column, and 1 + (S − 1)² ≤ S².
pub(super) fn inside_of_row(side: usize, j: usize) -> Range<usize> {
    // The row is symmetric, so the columns left of the disk are as many as the ones right of it.
    let left = (0..side).position(|i| is_inside(side, i, j)).unwrap_or(0);
    left..side - left
}

/// The inside texel whose centre is nearest to that of texel (i, j), given the inside columns of every row; ties go to
/// the smallest j, then i.
fn nearest(rows: &[Range<usize>], i: usize, j: usize) -> [usize; 2] {
    let side = rows.len();
    let above = 2 * j + 1 < side;
    let (mut best, mut best_distance) = ([i, j], usize::MAX);
    // Rows farther from the middle are shorter, so only those from here towards the middle can be nearer.
    for step in 0..=side / 2 {
        let row = if above { j + step } else { j - step };
        if step * step > best_distance {
            break;
        }
        let column = i.clamp(rows[row].start, rows[row].end - 1);
        let distance = step * step + column.abs_diff(i) * column.abs_diff(i);
        // Below the middle the rows come in descending order, so a tie goes to the later one.
        if distance < best_distance || (!above && distance == best_distance) {
            (best, best_distance) = ([column, row], distance);
        }
    }
    best
}

/// Gives each texel outside the disk the colour of its nearest inside one.
pub(super) fn extend(side: usize, texels: &mut [Rgba]) {
    let rows: Vec<Range<usize>> = (0..side).map(|j| inside_of_row(side, j)).collect();
    extend_rows(&rows, texels);
}

/// Like [`extend`], given the inside columns of every row. No row may be empty. Rows are symmetric, and none is longer
/// than a row nearer to the middle.
pub(super) fn extend_rows(rows: &[Range<usize>], texels: &mut [Rgba]) {
    let side = rows.len();
    for j in 0..side {
        for i in (0..rows[j].start).chain(rows[j].end..side) {
            let [from, row] = nearest(rows, i, j);
            texels[j * side + i] = texels[row * side + from];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn insides_of_small_pictures() {
        // (2i + 1 − S)² + (2j + 1 − S)² at a corner is 2(S − 1)²: 2 ≤ 4, 8 ≤ 9, 18 > 16.
        let count = |side| (0..side * side).filter(|t| is_inside(side, t % side, t / side)).count();
        assert_eq!([1, 2, 3, 4].map(count), [1, 4, 9, 12]);
        // The disk covers π/4 of the square, counted to within a texel along its circumference.
        assert!((count(100) as f64 / 1e4 - std::f64::consts::FRAC_PI_4).abs() < 4.0 / 100.0);
    }

    #[test]
    fn nearest_agrees_with_trying_all() {
        for side in 1..=33 {
            let rows: Vec<_> = (0..side).map(|j| inside_of_row(side, j)).collect();
            for j in 0..side {
                for i in 0..side {
                    let mut best = [0, 0];
                    let mut best_distance = usize::MAX;
                    for row in 0..side {
                        for column in 0..side {
                            let distance = column.abs_diff(i).pow(2) + row.abs_diff(j).pow(2);
                            if is_inside(side, column, row) && distance < best_distance {
                                (best, best_distance) = ([column, row], distance);
                            }
                        }
                    }
                    assert_eq!(nearest(&rows, i, j), best, "side {side}, texel ({i}, {j})");
                }
            }
        }
    }

    #[test]
    fn corners_of_a_four_by_four_take_the_upper_neighbour() {
        // Corner (0, 0) has (1, 0) and (0, 1) at the same distance: the smaller j wins. Corner (3, 3) likewise has
        // (3, 2) before (2, 3).
        let rows: Vec<_> = (0..4).map(|j| inside_of_row(4, j)).collect();
        assert_eq!(
            [[0, 0], [3, 0], [0, 3], [3, 3]].map(|[i, j]| nearest(&rows, i, j)),
            [[1, 0], [2, 0], [0, 2], [3, 2]]
        );
    }
}
