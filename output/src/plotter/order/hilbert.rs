//! The initial tour, along Hilbert's curve.

use super::tour::Tour;
use drypoint_scene::glam::DVec2;

/// Cells along a side of the curve's square: 2¹⁶.
const SIDE: u32 = 1 << 16;

/// Returns the strokes in the order in which the curve meets their midpoints.
pub(super) fn along_curve(tour: &Tour) -> Tour {
    let middles: Vec<DVec2> = tour.ends().iter().map(|[a, b]| (*a + *b) / 2.0).collect();
    let low = middles.iter().copied().reduce(DVec2::min).unwrap_or_default();
    let high = middles.iter().copied().reduce(DVec2::max).unwrap_or_default();
    let scale = f64::from(SIDE - 1) / (high - low).max_element().max(f64::MIN_POSITIVE);
    let mut keys: Vec<(u32, usize)> = middles
        .iter()
        .enumerate()
        .map(|(i, &middle)| {
            let [x, y] = ((middle - low) * scale).to_array().map(|c| (c as u32).min(SIDE - 1));
            (along(x, y), i)
        })
        .collect();
    keys.sort_unstable();
    tour.reordered(keys.into_iter().map(|(_, i)| i))
}

/// Returns the distance of a cell along Hilbert's curve. Each quadrant is turned so that the curve is connected.
fn along(mut x: u32, mut y: u32) -> u32 {
    let mut length = 0;
    let mut half = SIDE / 2;
    while half > 0 {
        let (right, up) = (u32::from(x & half > 0), u32::from(y & half > 0));
        length += half.wrapping_mul(half).wrapping_mul((3 * right) ^ up);
        if up == 0 {
            if right == 1 {
                (x, y) = (SIDE - 1 - x, SIDE - 1 - y);
            }
            (x, y) = (y, x);
        }
        half /= 2;
    }
    length
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_goes_from_cell_to_neighbour() {
        // The corner of 16 × 16 cells is a piece of the curve: each length once, one step apart.
        let mut cells: Vec<(u32, [u32; 2])> =
            (0..256).map(|i| [i % 16, i / 16]).map(|[x, y]| (along(x, y), [x, y])).collect();
        cells.sort();
        assert_eq!(cells.iter().map(|c| c.0).collect::<Vec<_>>(), (0..256).collect::<Vec<_>>());
        for pair in cells.windows(2) {
            let [[x, y], [u, v]] = [pair[0].1, pair[1].1];
            assert_eq!(x.abs_diff(u) + y.abs_diff(v), 1, "{pair:?}");
        }
        assert_eq!(along(0, 0), 0);
        assert_eq!(along(SIDE - 1, 0), u32::MAX);
    }
}
