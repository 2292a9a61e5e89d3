//! The outline of a line whose width changes along it ([HATCH-21]): two curves beside it, joined at its ends.

use super::fewer::fewer;
use super::loops::{OffsetPoint, without_loops};
use crate::math;
use glam::DVec2;
use std::f64::consts::PI;

/// The largest distance, in mm, by which chords of an outline may leave an arc: one step of places.
const OFF: f64 = 0.001;

/// The cosine of a bend by which a line turns back on itself.
const TURNED_BACK: f64 = -1.0 + 1e-9;

/// Returns the outlines, for the nonzero rule, of a line. The half width is given at each point, and linear between the
/// points.
///
/// On either side the outline keeps the distance of the half width from each segment, at right angles to it. Outside a
/// bend it goes round the point; inside a bend it is cut where both sides meet. An outline does not cross itself if its
/// line does not come back to itself and all bends have a larger radius than half the width. The sides of a sharper
/// bend may not meet, for example at the end of a short line. The outline then goes through the bend's point, and
/// overlaps are filled once.
pub(super) fn outlines(points: &[DVec2], radii: &[f64], closed: bool, round: [bool; 2]) -> Vec<Vec<DVec2>> {
    // Points equal to the one before are merged; the wider of the two counts.
    let mut line: Vec<(DVec2, f64)> = Vec::with_capacity(points.len());
    for (&at, &radius) in points.iter().zip(radii) {
        match line.last_mut() {
            Some(last) if last.0 == at => last.1 = last.1.max(radius),
            _ => line.push((at, radius)),
        }
    }
    let closed = closed && line.first().zip(line.last()).is_some_and(|(a, b)| a.0 != b.0) && line.len() > 2;
    if closed {
        // A closed line begins where it is straightest, so that no loop goes over its beginning.
        let n = line.len();
        let bent = |i: usize| towards(line[(i + n - 1) % n], line[i]).dot(towards(line[i], line[(i + 1) % n]));
        let first = (0..n).max_by(|&i, &j| bent(i).total_cmp(&bent(j))).unwrap_or(0);
        line.rotate_left(first);
        line.push(line[0]);
    }
    line = fewer(&line);
    if closed {
        line.pop();
    }
    let closed = closed && line.len() > 2;
    // One side of the line, then the same side of the reversed line; open lines join both by caps.
    let back: Vec<(DVec2, f64)> = line.iter().rev().copied().collect();
    match line.as_slice() {
        [] => Vec::new(),
        [(at, radius)] => {
            let mut disc = vec![*at + *radius * DVec2::X];
            arc(*at, *radius, DVec2::X, -2.0 * PI, &mut disc);
            vec![disc]
        }
        _ if closed => vec![side(&line, true), side(&back, true)],
        _ => {
            let mut outline = side(&line, false);
            cap(&line, round[1], &mut outline);
            outline.extend(side(&back, false));
            cap(&back, round[0], &mut outline);
            vec![outline]
        }
    }
}

/// The unit vector from one point to the next.
fn towards(a: (DVec2, f64), b: (DVec2, f64)) -> DVec2 {
    (b.0 - a.0).normalize_or(DVec2::X)
}

/// The offset curve on one side of a line, which is the side of +y for a line along +x.
fn side(line: &[(DVec2, f64)], closed: bool) -> Vec<DVec2> {
    let n = line.len();
    let mut all: Vec<OffsetPoint> = Vec::with_capacity(n + 8);
    let mut out = Vec::new();
    for (i, &(at, radius)) in line.iter().enumerate() {
        let before = (closed || i > 0).then(|| line[(i + n - 1) % n]);
        let after = (closed || i + 1 < n).then(|| line[(i + 1) % n]);
        match (before, after) {
            (Some(a), Some(b)) => {
                let [to_a, to_b] = [a, b].map(|other| at.distance(other.0));
                let ends = !closed && if to_a < to_b { i == 1 } else { i + 2 == n };
                let ways = [towards(a, line[i]), towards(line[i], b)];
                bend((at, radius), ways, (to_a.min(to_b), ends), &mut out);
            }
            (Some(a), None) => out.push(at + radius * beside(towards(a, line[i]))),
            (None, Some(b)) => out.push(at + radius * beside(towards(line[i], b))),
            (None, None) => {}
        }
        all.extend(out.drain(..).map(|at| (at, i)));
    }
    without_loops(&all, line)
}

/// The unit normal of a direction: +y for +x.
fn beside(along: DVec2) -> DVec2 {
    DVec2::new(-along.y, along.x)
}

/// Adds the outline of a point at which the line changes its direction. `shorter` is the length of the shorter segment
/// there, and whether that segment is the line's first or last.
fn bend((at, radius): (DVec2, f64), [from, to]: [DVec2; 2], (shorter, ends): (f64, bool), out: &mut Vec<DVec2>) {
    let [first, last] = [from, to].map(beside);
    let (sine, cosine) = (from.perp_dot(to), from.dot(to));
    // Where both sides meet, measured along them from the point: radius times the tangent of half the angle.
    // Where the line turns back sides do not meet, whatever rounding leaves of 1 + cos.
    let meets = if cosine > TURNED_BACK { radius * sine.abs() / (1.0 + cosine) } else { f64::INFINITY };
    let corner = || at + radius * (first + last) / (1.0 + cosine);
    let beyond = radius * ((2.0 / (1.0 + cosine)).sqrt() - 1.0);
    if sine > 0.0 {
        if meets <= shorter {
            out.push(corner());
        } else if !(ends && cosine > 0.5) {
            // Where a line bends a little just before its end, the side there goes straight to its end instead.
            out.extend([at + radius * first, at, at + radius * last]);
        }
    } else if beyond <= OFF {
        out.push(corner());
    } else {
        out.push(at + radius * first);
        arc(at, radius, first, -math::atan2(sine.abs(), cosine), out);
        out.push(at + radius * last);
    }
}

/// Adds half a disc round the end of a line, from one side to the other.
fn cap(line: &[(DVec2, f64)], round: bool, out: &mut Vec<DVec2>) {
    if let (true, [.., before, end]) = (round, line) {
        arc(end.0, end.1, beside(towards(*before, *end)), -PI, out);
    }
}

/// The corners of an arc between its ends, from a direction on, by an angle.
fn arc(at: DVec2, radius: f64, from: DVec2, angle: f64, out: &mut Vec<DVec2>) {
    // Half a chord over an angle φ leaves the arc by r(1 − cos ½φ) ≤ rφ²/8.
    let steps = (angle.abs() / (8.0 * OFF / radius).sqrt()).ceil().clamp(1.0, 1000.0) as u32;
    for k in 1..steps {
        let turned = angle * f64::from(k) / f64::from(steps);
        out.push(at + radius * DVec2::new(math::cos(turned), math::sin(turned)).rotate(from));
    }
}

#[cfg(test)]
mod tests {
    use super::super::loops::crossing;
    use super::*;

    /// Half the sum of cross products: below 0 for what turns the way of these outlines.
    fn area(outlines: &[Vec<DVec2>]) -> f64 {
        let of = |outline: &Vec<DVec2>| {
            let next = outline.iter().cycle().skip(1);
            outline.iter().zip(next).map(|(a, b)| a.perp_dot(*b) / 2.0).sum::<f64>()
        };
        outlines.iter().map(of).sum()
    }

    fn straight(radii: &[f64]) -> Vec<DVec2> {
        (0..radii.len()).map(|i| DVec2::new(3.0, 1.0) + DVec2::new(0.8, 0.6) * i as f64).collect()
    }

    /// Area between arcs and their chords, for arcs of the length `arcs`: ⅔ of OFF times that length.
    fn missing(arcs: f64) -> f64 {
        arcs * OFF * 2.0 / 3.0
    }

    /// ∫ width of straight segments is exact; half discs miss what their chords do.
    #[test]
    fn a_straight_taper_has_the_area_of_its_widths() {
        let radii = [0.0, 0.1, 0.25, 0.25, 0.05];
        let widths: f64 = radii.windows(2).map(|r| r[0] + r[1]).sum();
        let flat = outlines(&straight(&radii), &radii, false, [false; 2]);
        assert!((-area(&flat) - widths).abs() < 1e-12);
        let round = outlines(&straight(&radii), &radii, false, [true; 2]);
        let caps = PI / 2.0 * 0.05 * 0.05;
        let found = -area(&round) - widths;
        assert!(found <= caps && found >= caps - missing(PI * 0.05), "{found} {caps}");
        // Turned round it is the same outline, turning the same way.
        let (points, back): (Vec<_>, Vec<_>) =
            (straight(&radii).into_iter().rev().collect(), radii.into_iter().rev().collect());
        assert!((area(&outlines(&points, &back, false, [true; 2])) - area(&round)).abs() < 1e-12);
    }

    /// The area about an arc of radius R is ∫ width ds, in both directions: the two sides lose and gain alike. Chords
    /// of the middle line have it as 1 − φ²/24.
    #[test]
    fn an_arc_has_the_area_of_its_widths() {
        for turn in [1.0, -1.0] {
            let n = 60;
            let radius = |i: usize| 0.05 + 0.2 * i as f64 / f64::from(n);
            let at = |i: usize| {
                let angle = turn * 1.5 * PI * i as f64 / f64::from(n);
                2.0 * DVec2::new(math::cos(angle), math::sin(angle))
            };
            let all = 0..=n as usize;
            let (points, radii): (Vec<_>, Vec<_>) = all.map(|i| (at(i), radius(i))).unzip();
            let found = -area(&outlines(&points, &radii, false, [false; 2]));
            let widths = 1.5 * PI * 2.0 * (2.0 * 0.15);
            // φ is 0.079, and corners outside lie up to OFF beyond the arc.
            assert!((found / widths - 1.0).abs() < 0.079f64.powi(2) / 24.0 + OFF / 0.3, "{found} {widths}");
        }
    }

    /// A ring of width w has 2πRw, whichever way it goes: its outer outline turns the other way than its inner one.
    #[test]
    fn a_ring() {
        for turn in [1.0, -1.0] {
            let at = |i: u32| {
                let angle = turn * PI * f64::from(i) / 180.0;
                DVec2::new(5.0 + 3.0 * math::cos(angle), 3.0 * math::sin(angle))
            };
            let points: Vec<DVec2> = (0..360).map(at).collect();
            let found = outlines(&points, &[0.2; 360], true, [true; 2]);
            assert_eq!(found.len(), 2);
            // The polygon's area is r²·n·sin(2π/n)/2: 1 − φ²/6 of the ring's.
            assert!((-area(&found) / (PI * (3.2 * 3.2 - 2.8 * 2.8)) - 1.0).abs() < 1e-3, "{}", area(&found));
        }
    }

    /// Nothing reaches farther than the width at a sharp bend or where a line turns back, and the point itself is
    /// inside.
    #[test]
    fn sharp_bends_stay_round() {
        for end in [DVec2::new(0.0, 1.0), DVec2::new(-1.0, 0.001), DVec2::new(-1.0, 0.0), DVec2::new(0.3, -0.2)] {
            let points = [DVec2::new(-1.0, 0.0), DVec2::ZERO, end];
            let outline = &outlines(&points, &[0.1, 0.2, 0.1], false, [true; 2])[0];
            let near = |at: DVec2| points.iter().zip([0.1, 0.2, 0.1]).any(|(p, r)| p.distance(at) < r + 1e-9);
            let along = |at: DVec2| {
                points.windows(2).any(|pair| {
                    let way = pair[1] - pair[0];
                    let s = ((at - pair[0]).dot(way) / way.length_squared()).clamp(0.0, 1.0);
                    (pair[0] + way * s).distance(at) < 0.2 + 1e-9
                })
            };
            assert!(outline.iter().all(|&at| near(at) || along(at)), "{end}: {outline:?}");
            let farthest = outline.iter().map(|at| at.x).fold(f64::MIN, f64::max);
            assert!(farthest > 0.19 && farthest < 0.21 + end.x.max(0.0), "{end}: {farthest}");
        }
    }

    /// A line on the steps of the page, and ∫ width ds before the steps. None of its bends has a smaller radius than
    /// `bend`. Places are 0.01 to 0.15 mm apart, half widths 0.02 to 0.25 mm.
    fn random(seed: u64, bend: f64) -> (Vec<DVec2>, Vec<f64>, f64) {
        let mut drawn = 0;
        let mut unit = || {
            drawn += 1;
            crate::philox::uniform(seed, [0; 3], drawn)
        };
        // The way of a wave of the angle of travel is as long as its steepest place has the radius.
        let (swing, start, phase) = (0.3 + 1.1 * unit(), PI * unit(), 2.0 * PI * unit());
        let wave = bend * swing * (1.0 + unit());
        let (mean, change, beat) = (0.14, 0.1 * unit(), 3.0 + 4.0 * unit());
        let radius = |s: f64| mean + change * math::sin(s / beat + phase);
        let (mut at, mut s, mut widths, mut next) = (DVec2::splat(20.0), 0.0, 0.0, 0.0);
        let (mut points, mut radii) = (Vec::new(), Vec::new());
        let fine = 0.002;
        while s < 8.0 {
            if s >= next {
                points.push(crate::marks::on_step(at));
                radii.push((radius(s) * 200.0).round_ties_even() / 200.0);
                next = s + 0.01 + 0.14 * unit();
            }
            // Up to the last point, which may be as far before the end as two are apart.
            if points.len() > 1 || s < next {
                widths += 2.0 * radius(s + fine / 2.0) * fine;
            }
            let angle = start + swing * math::sin((s + fine / 2.0) / wave + phase);
            at += fine * DVec2::new(math::cos(angle), math::sin(angle));
            s += fine;
        }
        points.push(crate::marks::on_step(at));
        radii.push((radius(s) * 200.0).round_ties_even() / 200.0);
        (points, radii, widths)
    }

    /// Number of pairs of segments of an outline that cross.
    fn crossings(outline: &[DVec2]) -> usize {
        let n = outline.len();
        let segment = |i: usize| [outline[i], outline[(i + 1) % n]];
        let pairs = (0..n).flat_map(|i| (i + 2..n).map(move |j| [i, j])).filter(|[i, j]| (j + 1) % n != *i);
        pairs.filter(|&[i, j]| crossing(segment(i), segment(j)).is_some()).count()
    }

    /// Outlines of smooth lines do not cross themselves if all bends are wider than half the width. The area is then ∫
    /// width ds: the two sides lose and gain alike. The middle line is off by a step of rounded places and one of
    /// places left out, on both sides alike. Half its width is off by half a step in the same two ways, chords by their
    /// sagitta, φ²/24 of all, and corners outside by OFF.
    #[test]
    fn outlines_of_smooth_lines_do_not_cross() {
        for seed in 0..300 {
            let (points, radii, widths) = random(seed, 0.27);
            let found = outlines(&points, &radii, false, [false; 2]);
            assert_eq!((found.len(), crossings(&found[0])), (1, 0), "{seed}");
            let steps = 2.0 * 8.0 * (0.0025 + 0.005 + OFF);
            let chords = (0.15f64 / 0.27).powi(2) / 24.0 * widths;
            assert!((-area(&found) - widths).abs() < steps + chords, "{seed}: {} {widths}", -area(&found));
            let round = outlines(&points, &radii, false, [true; 2]);
            assert_eq!(crossings(&round[0]), 0, "{seed}");
        }
    }

    /// Nor of those that bend more sharply than half their width, where the line is long enough before and after.
    #[test]
    fn nor_do_those_of_sharp_bends() {
        for turn in [-2.2, -1.0, 0.7, 1.5, 2.2] {
            for parts in [1, 4, 9] {
                let mut at = DVec2::ZERO;
                let mut points = vec![at];
                for k in 0..=parts {
                    let angle = turn * f64::from(k) / f64::from(parts);
                    let length = if k == 0 || k == parts { 2.0 } else { 0.02 };
                    at += length * DVec2::new(math::cos(angle), math::sin(angle));
                    points.push(at);
                }
                let found = outlines(&points, &vec![0.25; points.len()], false, [true; 2]);
                assert_eq!(crossings(&found[0]), 0, "{turn} {parts}");
            }
        }
    }

    /// Rounding throws no corner away from a line that turns back on itself, in any direction.
    #[test]
    fn turning_back_throws_no_corner_away() {
        for seed in 0..20_000 {
            let unit = |draw| crate::philox::uniform(seed, [0; 3], draw);
            let way = DVec2::new(0.001 * (60.0 * unit(0)).round(), 0.001 * (60.0 * unit(1)).round());
            let at = DVec2::new(100.0 + 50.0 * unit(2), 100.0 + 50.0 * unit(3));
            let [at, to] = [at, at + way].map(crate::marks::on_step);
            let points = [at, to, crate::marks::on_step(at - 2.0 * way)];
            let all = outlines(&points, &[0.5, 0.4, 0.3], false, [true; 2]);
            assert!(all.iter().flatten().all(|corner| corner.distance(at) < 0.8), "{seed}: {points:?} {all:?}");
        }
    }

    /// A point twice is one; a line of one place is a disc.
    #[test]
    fn what_has_no_length() {
        let disc = outlines(&[DVec2::ONE; 3], &[0.1, 0.3, 0.2], false, [true; 2]);
        assert_eq!(disc.len(), 1);
        let found = -area(&disc);
        assert!(found < PI * 0.09 && found > PI * 0.09 - missing(2.0 * PI * 0.3) * 1.5, "{found}");
        assert!(outlines(&[], &[], true, [true; 2]).is_empty());
    }
}
