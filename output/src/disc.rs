//! Dots to pixels: how much of each pixel a disc covers, exactly.
//!
//! Rasterizers that count places lose a tenth to a half of the ink of a dot below a pixel ([STIP-16]); a closed form loses
//! none.

use drypoint_scene::math::atan2;
use std::f64::consts::PI;

/// Calls `each` with the column, the row and the covered share in (0, 1] of every pixel of a `width` × `height` picture
/// that a disc touches: centre (`x`, `y`) and `radius` in pixels, y down, the centre of the first pixel at (½, ½).
///
/// Summed over an unbounded picture the shares are πr². `scratch` is kept from disc to disc, so that none allocates.
pub(crate) fn cover(
    [x, y, radius]: [f64; 3],
    [width, height]: [usize; 2],
    scratch: &mut Scratch,
    mut each: impl FnMut(usize, usize, f64),
) {
    let (Some(columns), Some(rows)) = (touched(x, radius, width), touched(y, radius, height)) else { return };
    if columns.len() == 1 && rows.len() == 1 && inside(x, radius) && inside(y, radius) {
        return each(columns.start, rows.start, PI * radius * radius);
    }
    let Scratch { xs, ys, last } = scratch;
    let edges = |range: &std::ops::Range<usize>, centre: f64, into: &mut Vec<Edge>| {
        into.clear();
        into.extend((range.start..=range.end).map(|i| Edge::new(i as f64 - centre, radius)));
    };
    edges(&columns, x, xs);
    edges(&rows, y, ys);
    // What lies left of each column's edge and above the row's upper edge; the next row's takes its place.
    last.clear();
    last.extend(xs.iter().map(|a| corner(a, &ys[0], radius)));
    for (row, b) in rows.zip(&ys[1..]) {
        let mut left = [last[0], corner(&xs[0], b, radius)];
        last[0] = left[1];
        for (i, column) in columns.clone().enumerate() {
            let right = [last[i + 1], corner(&xs[i + 1], b, radius)];
            let share = (right[1] - right[0]) - (left[1] - left[0]);
            last[i + 1] = right[1];
            left = right;
            if share > 0.0 {
                each(column, row, share.min(1.0));
            }
        }
    }
}

/// Room for the edges of one disc.
#[derive(Default)]
pub(crate) struct Scratch {
    xs: Vec<Edge>,
    ys: Vec<Edge>,
    last: Vec<f64>,
}

/// The cells of a side that [c − r, c + r] touches.
fn touched(centre: f64, radius: f64, cells: usize) -> Option<std::ops::Range<usize>> {
    // Casts end at 0 and at the largest number; NaN becomes 0.
    let from = (centre - radius).floor() as usize;
    let to = ((centre + radius).ceil() as usize).min(cells);
    (from < to && radius > 0.0).then_some(from..to)
}

/// Whether [c − r, c + r] lies in one cell of the side, the first at 0.
fn inside(centre: f64, radius: f64) -> bool {
    let cell = centre.floor();
    centre - radius >= cell && centre + radius <= cell + 1.0
}

/// A line between two columns or rows of pixels, about a disc.
#[derive(Clone, Copy)]
struct Edge {
    /// Distance a from the disc's centre, within [−r, r].
    a: f64,
    /// Area of the disc on its lower side: πr²/2 + a√(r² − a²) + r² asin(a/r).
    below: f64,
}

impl Edge {
    fn new(a: f64, r: f64) -> Self {
        let a = a.clamp(-r, r);
        // (r − a)(r + a) keeps its digits where a is nearly r; asin(a/r) = atan2(a, √(r² − a²)).
        let half_chord = ((r - a) * (r + a)).sqrt();
        Self { a, below: PI * r * r / 2.0 + a * half_chord + r * r * atan2(a, half_chord) }
    }
}

/// Area of the disc x² + y² ≤ r² with x ≤ a and y ≤ b.
///
/// With the corner (a, b) in the disc: the lower left quarter, half a strip on each side of it, and a rectangle. Without:
/// the lines cut the disc apart from each other, so that areas add.
fn corner(a: &Edge, b: &Edge, r: f64) -> f64 {
    if a.a * a.a + b.a * b.a < r * r {
        return (a.below + b.below) / 2.0 - PI * r * r / 4.0 + a.a * b.a;
    }
    match (a.a >= 0.0, b.a >= 0.0) {
        (true, true) => a.below + b.below - PI * r * r,
        (true, false) => b.below,
        (false, true) => a.below,
        (false, false) => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SIDE: usize = 16;

    fn shares(x: f64, y: f64, radius: f64) -> Vec<f64> {
        let mut shares = vec![0.0; SIDE * SIDE];
        cover([x, y, radius], [SIDE; 2], &mut Scratch::default(), |i, j, share| shares[j * SIDE + i] += share);
        shares
    }

    fn sum(shares: &[f64]) -> f64 {
        shares.iter().sum()
    }

    #[test]
    fn no_ink_is_lost() {
        // [STIP-16] asks for 0.1 % at r = 0.1 … 4; areas up to 50 have a rounding error of 50 · 2⁻⁵³ a pixel, of which
        // there are at most 100.
        for i in 0..500 {
            let [u, v, w] = [0.754_877_666, 0.569_840_291, 0.381_966_011].map(|a| f64::from(i) * a % 1.0);
            let radius = 0.1 * 40f64.powf(w);
            let found = sum(&shares(6.0 + 4.0 * u, 6.0 + 4.0 * v, radius));
            assert!((found - PI * radius * radius).abs() < 1e-12, "{radius}: {found}");
        }
    }

    #[test]
    fn a_disc_in_one_pixel() {
        let found = shares(3.5, 4.5, 0.5);
        assert_eq!(found[4 * SIDE + 3], PI / 4.0);
        assert_eq!(found.iter().filter(|&&share| share > 0.0).count(), 1);
    }

    #[test]
    fn four_quarters_about_a_corner() {
        for radius in [0.3, 1.0] {
            let found = shares(5.0, 7.0, radius);
            for at in [6 * SIDE + 4, 6 * SIDE + 5, 7 * SIDE + 4, 7 * SIDE + 5] {
                assert!((found[at] - PI * radius * radius / 4.0).abs() < 1e-15, "{radius}: {}", found[at]);
            }
        }
    }

    #[test]
    fn half_planes() {
        // An edge at distance a from the centre cuts off a segment of r² acos(a/r) − a√(r² − a²); by hand for r = 1,
        // a = ½: π/3 − √3/4. The disc's other sides stay inside rows of one pixel only for r ≤ ½, so sum the columns.
        let found = shares(7.5, 8.0, 1.0);
        let column = |i: usize| (0..SIDE).map(|j| found[j * SIDE + i]).sum::<f64>();
        let segment = PI / 3.0 - 3f64.sqrt() / 4.0;
        assert!((column(8) - segment).abs() < 1e-14 && (column(6) - segment).abs() < 1e-14);
        assert!((column(7) - (PI - 2.0 * segment)).abs() < 1e-14);
        // A huge disc is a half plane: its left edge at x = 4.25, flat within 16²/(2·10⁶).
        let mut shares = vec![0.0; SIDE * SIDE];
        let disc = [1e6 + 4.25, 8.0, 1e6];
        cover(disc, [SIDE; 2], &mut Scratch::default(), |i, j, share| shares[j * SIDE + i] = share);
        for j in 0..SIDE {
            // Areas of 10¹² leave 10¹² · 2⁻⁵² of a pixel; the curve takes 64/(2·10⁶) at most.
            assert!((shares[j * SIDE + 4] - 0.75).abs() < 2e-3, "{}", shares[j * SIDE + 4]);
            assert!((shares[j * SIDE + 9] - 1.0).abs() < 2e-3);
            assert_eq!(shares[j * SIDE + 3], 0.0);
        }
    }

    #[test]
    fn mirrored_discs_cover_mirrored_pixels() {
        let found = shares(7.3, 6.2, 2.7);
        let mirrored = shares(SIDE as f64 - 7.3, 6.2, 2.7);
        let turned = shares(6.2, 7.3, 2.7);
        for (j, i) in (0..SIDE * SIDE).map(|n| (n / SIDE, n % SIDE)) {
            let share = found[j * SIDE + i];
            assert!((share - mirrored[j * SIDE + SIDE - 1 - i]).abs() < 1e-14);
            assert!((share - turned[i * SIDE + j]).abs() < 1e-14);
        }
    }

    #[test]
    fn each_pixel_is_what_many_places_say() {
        // 256² places a pixel: a border of length ℓ misses at most about ℓ/256 of it; here ℓ ≤ 2.
        let (x, y, r) = (5.37, 4.81, 1.9);
        let found = shares(x, y, r);
        for (j, i) in (0..SIDE * SIDE).map(|n| (n / SIDE, n % SIDE)) {
            let hit = |n: usize| {
                let (u, v) = ((n % 256) as f64 / 256.0 + 1.0 / 512.0, (n / 256) as f64 / 256.0 + 1.0 / 512.0);
                (i as f64 + u - x).powi(2) + (j as f64 + v - y).powi(2) <= r * r
            };
            let counted = (0..65_536).filter(|&n| hit(n)).count() as f64 / 65_536.0;
            assert!((found[j * SIDE + i] - counted).abs() < 2.0 / 256.0, "{i}, {j}");
        }
    }

    #[test]
    fn the_picture_ends_where_it_ends() {
        // A quarter of a disc about each corner of the picture, and nothing of one beyond.
        for (x, y) in [(0.0, 0.0), (16.0, 0.0), (0.0, 16.0), (16.0, 16.0)] {
            assert!((sum(&shares(x, y, 2.0)) - PI).abs() < 1e-13);
        }
        for (x, y, r) in
            [(-3.0, 4.0, 2.0), (4.0, 19.0, 2.0), (f64::NAN, 4.0, 1.0), (4.0, 4.0, 0.0), (4.0, 4.0, f64::NAN)]
        {
            assert_eq!(sum(&shares(x, y, r)), 0.0, "{x} {y} {r}");
        }
    }
}
