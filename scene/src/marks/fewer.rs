//! Simplification of lines: points that leave the line only by rounding are left out.

use glam::DVec2;

/// The largest distance, in mm, of a left-out point from the kept line. The point and the ends of the kept line are
/// each up to 0.00071 off by rounding to steps of 0.001, so rounding alone makes no bend.
const PLACE: f64 = 0.0015;

/// The largest error, in mm, of half the width at a left-out point: two rounding errors of half a step of 0.005. For
/// comparison, a dot at 2400 dpi is 0.0106.
const RADIUS: f64 = 0.005;

/// Returns the line without the points whose position and half width are linear between two others, up to [`PLACE`] and
/// [`RADIUS`]. The line's ends are kept.
pub(super) fn fewer(line: &[(DVec2, f64)]) -> Vec<(DVec2, f64)> {
    let mut kept = vec![false; line.len()];
    let mut open = match line.len() {
        0 => Vec::new(),
        n => vec![[0, n - 1]],
    };
    for [first, last] in &open {
        (kept[*first], kept[*last]) = (true, true);
    }
    while let Some([first, last]) = open.pop() {
        let off = (first + 1..last).map(|i| (i, off(line[i], [line[first], line[last]])));
        if let Some((i, most)) = off.max_by(|a, b| a.1.total_cmp(&b.1))
            && most > 1.0
        {
            kept[i] = true;
            open.extend([[first, i], [i, last]]);
        }
    }
    line.iter().zip(kept).filter(|(_, kept)| *kept).map(|(point, _)| *point).collect()
}

/// Distance of a point from a segment, in units of the allowed distance.
fn off((at, radius): (DVec2, f64), [a, b]: [(DVec2, f64); 2]) -> f64 {
    let way = b.0 - a.0;
    let length = way.length_squared();
    let s = if length > 0.0 { ((at - a.0).dot(way) / length).clamp(0.0, 1.0) } else { 0.0 };
    let place = at.distance(a.0.lerp(b.0, s)) / PLACE;
    place.max((radius - (a.1 + (b.1 - a.1) * s)).abs() / RADIUS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_steps_have_moved_is_left_out() {
        let p = |x: f64, y: f64, radius: f64| (DVec2::new(x, y), radius);
        let line = [p(0.0, 0.0, 0.1), p(0.3, 0.0009, 0.102), p(0.31, -0.0009, 0.1), p(1.0, 0.0, 0.1)];
        assert_eq!(fewer(&line), [line[0], line[3]]);
        // A bend, a width, and the way there and back are kept.
        let bent = [p(0.0, 0.0, 0.1), p(0.5, 0.002, 0.1), p(1.0, 0.0, 0.1)];
        let wide = [p(0.0, 0.0, 0.1), p(0.5, 0.0, 0.106), p(1.0, 0.0, 0.1)];
        let back = [p(0.0, 0.0, 0.1), p(0.5, 0.0, 0.1), p(0.2, 0.0, 0.1)];
        for line in [&bent, &wide, &back] {
            assert_eq!(fewer(line), line.to_vec());
        }
        assert_eq!((fewer(&[]), fewer(&line[..1])), (Vec::new(), line[..1].to_vec()));
    }
}
