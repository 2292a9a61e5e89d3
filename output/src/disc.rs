//! Exact coverage of pixels by discs.
//!
//! Rasterizers that count sample points lose a tenth to a half of the ink of a dot smaller than a pixel ([STIP-16]).
//! The closed form loses no ink.

use drypoint_scene::math::atan2;
use std::f64::consts::PI;

/// Calls `each` with column, row and covered share in (0, 1] of every pixel that a disc touches, in a picture of
/// `width` × `height`. Centre (`x`, `y`) and `radius` are in pixels, y down; the first pixel's centre is (½, ½).
///
/// The shares sum to πr² in an unbounded picture. `scratch` is reused from disc to disc, so that no call allocates.
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
    let edges = |range: &std::ops::Range<usize>, centre: f64, into: &mut Vec<GridLine>| {
        into.clear();
        into.extend((range.start..=range.end).map(|i| GridLine::new(i as f64 - centre, radius)));
    };
    edges(&columns, x, xs);
    edges(&rows, y, ys);
    // Areas to the left of each column's edge and above the row's upper edge. The next row's replace them.
    last.clear();
    last.extend(xs.iter().map(|a| corner(a, &ys[0], radius)));
    for (row, edges) in rows.zip(ys.windows(2)) {
        let mut left = [last[0], corner(&xs[0], &edges[1], radius)];
        last[0] = left[1];
        let [near_y, far_y] = distances(edges);
        for (i, column) in columns.clone().enumerate() {
            let right = [last[i + 1], corner(&xs[i + 1], &edges[1], radius)];
            let share = (right[1] - right[0]) - (left[1] - left[0]);
            last[i + 1] = right[1];
            left = right;
            // Outside the rim and well inside it the difference of areas would be only a rounding error.
            let [near_x, far_x] = distances(&xs[i..i + 2]);
            if far_x * far_x + far_y * far_y <= radius * radius {
                each(column, row, 1.0);
            } else if near_x * near_x + near_y * near_y < radius * radius && share > 0.0 {
                each(column, row, share.min(1.0));
            }
        }
    }
}

/// Returns the least and the largest distance from the centre between two grid lines.
fn distances(edges: &[GridLine]) -> [f64; 2] {
    let [a, b] = [edges[0].a, edges[1].a];
    let near = if a < 0.0 && b > 0.0 { 0.0 } else { a.abs().min(b.abs()) };
    [near, a.abs().max(b.abs())]
}

/// Reusable buffers for the grid lines of one disc.
#[derive(Default)]
pub(crate) struct Scratch {
    xs: Vec<GridLine>,
    ys: Vec<GridLine>,
    last: Vec<f64>,
}

/// Returns the cells that [c − r, c + r] touches.
fn touched(centre: f64, radius: f64, cells: usize) -> Option<std::ops::Range<usize>> {
    // Casts end at 0 and at the largest number; NaN becomes 0.
    let from = (centre - radius).floor() as usize;
    let to = ((centre + radius).ceil() as usize).min(cells);
    (from < to && radius > 0.0).then_some(from..to)
}

/// Whether [c − r, c + r] lies in one cell; the first cell begins at 0.
fn inside(centre: f64, radius: f64) -> bool {
    let cell = centre.floor();
    centre - radius >= cell && centre + radius <= cell + 1.0
}

/// A grid line between two columns or rows of pixels, relative to a disc.
#[derive(Clone, Copy)]
struct GridLine {
    /// Signed distance a from the disc's centre, clamped to [−r, r].
    a: f64,
    /// Area of the disc on the lower side: πr²/2 + a√(r² − a²) + r² asin(a/r).
    below: f64,
}

impl GridLine {
    fn new(a: f64, r: f64) -> Self {
        let a = a.clamp(-r, r);
        // (r − a)(r + a) keeps its digits where a is nearly r; asin(a/r) = atan2(a, √(r² − a²)).
        let half_chord = ((r - a) * (r + a)).sqrt();
        Self { a, below: PI * r * r / 2.0 + a * half_chord + r * r * atan2(a, half_chord) }
    }
}

/// Returns the area of the disc x² + y² ≤ r² with x ≤ a and y ≤ b.
///
/// If the corner (a, b) lies in the disc, the area is a quarter of the disc, two half strips beside the quarter, and a
/// rectangle. If not, the lines cut off disjoint parts of the disc, and areas add.
fn corner(a: &GridLine, b: &GridLine, r: f64) -> f64 {
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
    fn whole_pixels_are_whole_and_others_untouched() {
        // Of a disc of radius 3 about (8.2, 7.9), by the corners of each pixel.
        let (x, y, r) = (8.2, 7.9, 3.0);
        let found = shares(x, y, r);
        for (j, i) in (0..SIDE * SIDE).map(|n| (n / SIDE, n % SIDE)) {
            let square = |dx: f64, dy: f64| dx * dx + dy * dy;
            let [near, far] = [f64::min, f64::max].map(|pick| {
                let of = |c: f64, k: usize| {
                    let (lo, hi) = (k as f64 - c, k as f64 + 1.0 - c);
                    pick(lo.abs(), hi.abs())
                };
                square(of(x, i), of(y, j))
            });
            let share = found[j * SIDE + i];
            assert_eq!(share == 1.0, far <= r * r, "{i}, {j}: {share}");
            // A pixel that the centre's row or column crosses can be touched between its corners.
            if near > r * r && i != 8 && j != 7 {
                assert_eq!(share, 0.0, "{i}, {j}");
            }
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
