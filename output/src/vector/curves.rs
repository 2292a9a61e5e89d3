//! Cubic Bézier curves through the points of lines ([HATCH-10]), with as few segments as their shape allows.

use super::fit::{CubicBezier, fewer};
use super::groups::PagePoint;
use crate::grid::micrometres;
use drypoint_scene::glam::DVec2;
use drypoint_scene::math;

/// Largest distance of chords from their curve, in mm ([HATCH-10]). A bend with a larger distance is a corner.
const CHORD: f64 = 0.05;

/// cos 60°: a sharper bend is a corner.
const SHARP: f64 = 0.5;

/// Points nearer than this, in mm, count as one: the rounding to 0.001 mm would make bends.
const NEAR: f64 = 0.01;

/// A segment of a path, from the end of the one before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum PathSegment {
    /// A straight line to a point.
    Line(PagePoint),
    /// Two control points and the end.
    Curve([PagePoint; 3]),
}

impl PathSegment {
    /// Returns the end point.
    pub(super) fn end(&self) -> PagePoint {
        match self {
            Self::Line(at) | Self::Curve([.., at]) => *at,
        }
    }
}

/// Returns the first point and the curve through the points of a line; none with fewer than three points. The last
/// segment of a closed line ends at the first point.
///
/// The curve's direction at a point is that of the circle through it and its neighbours, so points on a circle give
/// that circle. The curve keeps the line's corners.
pub(super) fn curves(points: &[DVec2], closed: bool) -> Option<(PagePoint, Vec<PathSegment>)> {
    let points = distinct(points, closed);
    let n = points.len();
    if n < 3 {
        return None;
    }
    let ways = directions(&points, closed);
    let place = |p: DVec2| p.to_array().map(micrometres);
    let mut steps = Vec::new();
    // Curves that follow each other without a corner.
    let mut run: Vec<CubicBezier> = Vec::new();
    let flush = |run: &mut Vec<CubicBezier>, steps: &mut Vec<PathSegment>| {
        steps.extend(fewer(run).map(|[_, a, b, to]| PathSegment::Curve([a, b, to].map(place))));
        run.clear();
    };
    for i in 0..if closed { n } else { n - 1 } {
        let j = (i + 1) % n;
        let [from, to] = [points[i], points[j]];
        let chord = to - from;
        // At an end, and beside a corner, the curve bends as it does at its other end.
        let mirrored = |way: DVec2| 2.0 * way.project_onto(chord) - way;
        let ends = match (ways[i], ways[j]) {
            (None, None) => None,
            (leaves, comes) => leaves.or(comes.map(mirrored)).zip(comes.or(leaves.map(mirrored))),
        };
        if ways[i].is_none() {
            flush(&mut run, &mut steps);
        }
        match ends {
            Some((leaves, comes)) => {
                // An arc over 2α has handles of length chord · ⅔ / (1 + cos α).
                let handle = chord.length() * 2.0 / 3.0 / (1.0 + 0.5 * (leaves + comes).dot(chord.normalize()));
                run.push([from, from + handle * leaves, to - handle * comes, to]);
            }
            None => steps.push(PathSegment::Line(place(to))),
        }
    }
    flush(&mut run, &mut steps);
    Some((place(points[0]), steps))
}

/// Returns the points without near repetitions. The ends of an open line stay.
fn distinct(points: &[DVec2], closed: bool) -> Vec<DVec2> {
    let mut kept: Vec<DVec2> = Vec::with_capacity(points.len());
    for &at in points {
        if kept.last().is_none_or(|last| last.distance(at) >= NEAR) {
            kept.push(at);
        }
    }
    let (Some(&first), Some(&last)) = (points.first(), points.last()) else { return kept };
    if closed {
        while kept.len() > 1 && kept[kept.len() - 1].distance(first) < NEAR {
            kept.pop();
        }
    } else if kept[kept.len() - 1] != last {
        if kept.len() > 1 {
            kept.pop();
        }
        kept.push(last);
    }
    kept
}

/// Returns the unit direction at each point; none at the ends of a line and at corners.
fn directions(points: &[DVec2], closed: bool) -> Vec<Option<DVec2>> {
    let n = points.len();
    let at = |i: usize| {
        if !closed && (i == 0 || i + 1 == n) {
            return None;
        }
        let [before, after] = [points[i] - points[(i + n - 1) % n], points[(i + 1) % n] - points[i]];
        let [h, k] = [before.length(), after.length()];
        let [from, to] = [before / h, after / k];
        // A chord lies ½ chord · tan ½α off its arc, where α is half the arc's turn. The bend at a point is shared
        // between its two chords by their lengths.
        let bend = math::atan2(from.perp_dot(to).abs(), from.dot(to));
        let longer = h.max(k);
        let half = 0.5 * bend * longer / (h + k);
        let off = 0.5 * longer * math::tan(half);
        (from.dot(to) > SHARP && off <= CHORD).then(|| (k * from + h * to).normalize())
    };
    (0..n).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::super::fit::ACCURACY;
    use super::*;
    use std::f64::consts::TAU;

    fn mm(place: PagePoint) -> DVec2 {
        DVec2::from_array(place.map(|n| n as f64 / 1000.0))
    }

    fn places(points: impl IntoIterator<Item = DVec2>) -> Vec<DVec2> {
        points.into_iter().map(drypoint_scene::marks::on_step).collect()
    }

    /// Places all along a curve, by de Casteljau's scheme.
    fn along(points: &[DVec2], closed: bool) -> (Vec<DVec2>, usize) {
        let (start, steps) = curves(points, closed).unwrap();
        let mut all = vec![mm(start)];
        for step in &steps {
            let from = all[all.len() - 1];
            let [a, b, to] = match *step {
                PathSegment::Line(to) => [from.lerp(mm(to), 1.0 / 3.0), from.lerp(mm(to), 2.0 / 3.0), mm(to)],
                PathSegment::Curve(places) => places.map(mm),
            };
            for t in (1..=64).map(|i| f64::from(i) / 64.0) {
                let [p, q, r] = [from.lerp(a, t), a.lerp(b, t), b.lerp(to, t)];
                all.push(p.lerp(q, t).lerp(q.lerp(r, t), t));
            }
        }
        (all, steps.len())
    }

    fn distance(at: DVec2, line: &[DVec2]) -> f64 {
        let each = line.windows(2).map(|pair| {
            let way = pair[1] - pair[0];
            let s = ((at - pair[0]).dot(way) / way.length_squared().max(1e-300)).clamp(0.0, 1.0);
            at.distance(pair[0] + way * s)
        });
        each.fold(f64::INFINITY, f64::min)
    }

    /// Points on circles, so far apart that chords are 0.05 mm off, give the circle in a few pieces. The error is at
    /// most the allowed one and that of rounding points.
    #[test]
    fn a_circle_is_round() {
        for radius in [0.4, 1.0, 5.0, 40.0] {
            for share in [1.0, 0.6] {
                let closed = share == 1.0;
                let n = (TAU * share / (2.0 * (1.0 - CHORD / radius).acos())).ceil();
                let at = |i: usize| {
                    let angle = TAU * share * i as f64 / n;
                    DVec2::new(50.0, 60.0) + radius * DVec2::new(math::cos(angle), math::sin(angle))
                };
                let points = places((0..n as usize + usize::from(!closed)).map(at));
                let (curve, pieces) = along(&points, closed);
                let off = curve.iter().map(|p| (p.distance(DVec2::new(50.0, 60.0)) - radius).abs()).fold(0.0, f64::max);
                assert!(off < ACCURACY + 0.0015, "{radius} {share}: {off}");
                assert!(pieces <= 8, "{radius} {share}: {pieces}");
                let [first, last] = [curve[0], curve[curve.len() - 1]];
                assert_eq!((first, last), (points[0], if closed { points[0] } else { points[points.len() - 1] }));
            }
        }
    }

    /// Waves r·sin(x/r) in chords of up to 0.05 mm beside them. Where curvature changes with the length by κ′ the direction at an
    /// end, mirrored from the next point, is off by κ′h²/2, and the curve by 4/27 of h times that; κ′ is ¼/r² where a wave
    /// goes through 0, and all chords begin there.
    #[test]
    fn a_wave_is_nearer_than_its_chords() {
        for (r, step) in [(1.0, 0.6), (4.0, 1.2), (10.0, 1.9)] {
            let wave = |x: f64| DVec2::new(x, r * math::sin(x / r));
            let points = places((0..60).map(|i| wave(step * f64::from(i))));
            let fine: Vec<DVec2> = (0..36_000).map(|i| wave(step * f64::from(i) / 600.0)).collect();
            let middles = points.windows(2).map(|pair| distance(pair[0].lerp(pair[1], 0.5), &fine));
            assert!(middles.fold(0.0, f64::max) > 0.035);
            let (curve, pieces) = along(&points, false);
            let off = curve.iter().map(|&p| distance(p, &fine)).fold(0.0, f64::max);
            let derived = 2.0 / 27.0 * 0.25 / (r * r) * (2f64.sqrt() * step).powi(3);
            assert!(off < derived + ACCURACY + 0.001, "{r}: {off} {derived}");
            assert!(pieces < if r < 2.0 { points.len() } else { points.len() / 3 }, "{r}: {pieces}");
        }
    }

    /// A corner between two arcs stays where it is, and two straight legs stay straight.
    #[test]
    fn corners_stay() {
        let p = DVec2::new;
        let legs = [p(0.0, 0.0), p(3.0, 0.0), p(3.0, 2.0)];
        assert_eq!(
            curves(&legs, false),
            Some(([0, 0], vec![PathSegment::Line([3000, 0]), PathSegment::Line([3000, 2000])]))
        );
        let square = [p(0.0, 0.0), p(3.0, 0.0), p(3.0, 3.0), p(0.0, 3.0)];
        let round = [[3000, 0], [3000, 3000], [0, 3000], [0, 0]].map(PathSegment::Line);
        assert_eq!(curves(&square, true), Some(([0, 0], round.to_vec())));
        let arch = |left: f64| {
            (0..=20).map(move |i| {
                let angle = TAU / 2.0 * (1.0 - f64::from(i) / 20.0);
                p(left + 2.0 + 2.0 * math::cos(angle), 2.0 * math::sin(angle))
            })
        };
        let (curve, _) = along(&places(arch(0.0).chain(arch(4.0))), false);
        assert!(curve.contains(&p(4.0, 0.0)));
        let off = |at: &DVec2| (at.distance(p(if at.x < 4.0 { 2.0 } else { 6.0 }, 0.0)) - 2.0).abs();
        assert!(curve.iter().map(off).fold(0.0, f64::max) < ACCURACY + 0.0015);
    }

    /// Any line's curve goes from its first point to its last and is no farther from the line than a chord may be.
    #[test]
    fn no_line_is_left() {
        for seed in 0..2000 {
            let unit = |draw| drypoint_scene::philox::uniform(seed, [0; 3], draw);
            let size = [0.003, 0.05, 0.6, 4.0][seed as usize % 4];
            let n = 2 + (unit(0) * 12.0) as u32;
            let mut at = DVec2::splat(30.0);
            let mut points = vec![at];
            for i in 1..n {
                at += size * (DVec2::new(unit(2 * i), unit(2 * i + 1)) - 0.3);
                points.push(at);
            }
            let points = places(points);
            for closed in [false, true] {
                if curves(&points, closed).is_none() {
                    assert!(distinct(&points, closed).len() < 3);
                    continue;
                }
                let ring: Vec<DVec2> = points.iter().copied().chain(closed.then_some(points[0])).collect();
                let (curve, _) = along(&points, closed);
                assert_eq!((curve[0], curve[curve.len() - 1]), (ring[0], ring[ring.len() - 1]), "{seed}");
                let off = curve.iter().map(|&p| distance(p, &ring)).fold(0.0, f64::max);
                assert!(off < CHORD + 2.0 * NEAR + ACCURACY, "{seed}: {off}");
                // Nor is any of its points left far beside: one at the end stands for those near it and near the one before.
                let missed = points.iter().map(|&p| distance(p, &curve)).fold(0.0, f64::max);
                assert!(missed < 2.0 * NEAR + ACCURACY, "{seed}: {missed}");
            }
        }
    }
}
