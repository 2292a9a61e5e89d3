//! One side of a line without the loops that it makes inside a bend ([HATCH-21]).
//!
//! At a bend with a smaller radius than half the width, the inner side runs back and crosses itself. The loop is no
//! part of the outline: all of it lies within half a width of the line.

use crate::math;
use glam::DVec2;
use std::f64::consts::{FRAC_PI_2, TAU};

/// A place beside a line, and the index of the line's point that the place belongs to.
pub(super) type OffsetPoint = (DVec2, usize);

/// The places beside a line, on its left, without the loops of bends to the left. The sides of a bend of less than a
/// whole turn meet within 2πr of the line, r half of the width. Crossings farther apart belong to parts of the line
/// that cross.
pub(super) fn without_loops(side: &[OffsetPoint], line: &[(DVec2, f64)]) -> Vec<DVec2> {
    let (lengths, turns) = along(line);
    let widest = line.iter().map(|&(_, radius)| radius).fold(0.0, f64::max);
    let mut out: Vec<OffsetPoint> = Vec::with_capacity(side.len());
    for &(at, i) in side {
        let mut cut = None;
        if let [before @ .., _, last] = out.as_slice() {
            for (j, from) in before.iter().enumerate().rev() {
                if lengths[last.1] - lengths[out[j + 1].1] > TAU * widest {
                    break;
                }
                let Some(place) = crossing([from.0, out[j + 1].0], [last.0, at]) else { continue };
                // A part that winds to the right although the line does not is a loop of the side, not of the line.
                let turned = turns[i] - turns[from.1];
                if turned > -FRAC_PI_2 && area(place, &out[j + 1..]) < 0.0 {
                    cut = Some((j, place));
                }
            }
        }
        if let Some((j, place)) = cut {
            out.truncate(j + 1);
            out.push((place, out[j].1));
        }
        out.push((at, i));
    }
    out.into_iter().map(|(at, _)| at).collect()
}

/// The length up to each point of a line, and the line's total turn to the left there.
fn along(line: &[(DVec2, f64)]) -> (Vec<f64>, Vec<f64>) {
    let (mut length, mut turn) = (0.0, 0.0);
    let all = (0..line.len()).map(|i| {
        if i > 0 {
            length += line[i].0.distance(line[i - 1].0);
        }
        if i > 0 && i + 1 < line.len() {
            let (from, to) = (line[i].0 - line[i - 1].0, line[i + 1].0 - line[i].0);
            turn += math::atan2(from.perp_dot(to), from.dot(to));
        }
        (length, turn)
    });
    all.unzip()
}

/// The intersection of two segments; none where they are parallel.
pub(super) fn crossing([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> Option<DVec2> {
    let (u, v, w) = (b - a, d - c, c - a);
    let over = u.perp_dot(v);
    let (s, t) = (w.perp_dot(v) / over, w.perp_dot(u) / over);
    let inside = |x: f64| (0.0..=1.0).contains(&x);
    (over != 0.0 && inside(s) && inside(t)).then(|| a + u * s)
}

/// Half the sum of cross products of a loop that begins and ends at a place: positive for a loop that winds to the
/// left.
fn area(place: DVec2, rest: &[OffsetPoint]) -> f64 {
    let pairs = rest.windows(2).map(|pair| (pair[0].0 - place).perp_dot(pair[1].0 - place));
    pairs.sum::<f64>() / 2.0
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Right by 1, then up by 1, half a width of ½ to the left: the loop about the corner goes, its crossing stays.
    #[test]
    fn the_loop_inside_a_corner_goes() {
        let p = DVec2::new;
        let line = [(p(0.0, 0.0), 0.5), (p(1.0, 0.0), 0.5), (p(1.0, 1.0), 0.5)];
        let side = [(p(0.0, 0.5), 0), (p(1.0, 0.5), 1), (p(1.0, 0.0), 1), (p(0.5, 0.0), 1), (p(0.5, 1.0), 2)];
        assert_eq!(without_loops(&side, &line), [p(0.0, 0.5), p(0.5, 0.5), p(0.5, 1.0)]);
    }

    /// A line that makes a loop of its own keeps it, to either side of it.
    #[test]
    fn a_loop_of_the_line_stays() {
        for turn in [1.0, -1.0] {
            // Straight, round a circle of radius 1, straight on.
            let round = |i: u32| {
                let angle = TAU * f64::from(i) / 60.0;
                (DVec2::new(2.0 + math::sin(angle), turn * (1.0 - math::cos(angle))), 0.2)
            };
            let ends = [(DVec2::new(0.0, 0.0), 0.2), (DVec2::new(4.0, 0.0), 0.2)];
            let line: Vec<_> = [ends[0]].into_iter().chain((0..60).map(round)).chain([ends[1]]).collect();
            let side: Vec<OffsetPoint> = line.iter().enumerate().map(|(i, &(at, _))| (at, i)).collect();
            let whole: Vec<DVec2> = line.iter().map(|&(at, _)| at).collect();
            assert_eq!(without_loops(&side, &line), whole, "{turn}");
        }
    }
}
