//! The fewest vertices of a polyline that stays within a distance of a curve ([HATCH-10]).

use super::Piece;
use drypoint_scene::glam::DVec3;

/// Places at which the distance to a chord is taken: on each piece, and on a chord at least.
const PLACES: usize = 4;
const LEAST: usize = 8;

/// A chord is long enough whose distance is at least this share of what it may be: some hundredths of the distance are half as
/// many of the length.
const ENOUGH: f64 = 0.96;

/// Trials that find the end of a chord.
const TRIALS: usize = 24;

/// Where the vertices of a polyline lie on the curve of these pieces: whole parts number the piece, the rest is its
/// parameter. From each vertex the chord is as long as it can be without leaving the curve by more than `chord`; both ends of
/// the curve are vertices.
pub fn vertices(pieces: &[Piece], chord: f64) -> Vec<f64> {
    let end = pieces.len() as f64;
    let mut at = vec![0.0];
    let mut from = 0.0;
    while from < end {
        from = chord_end(pieces, from, chord);
        at.push(from);
    }
    at
}

/// The point of a curve.
///
/// # Panics
/// If the curve has no piece.
#[inline]
pub fn point(pieces: &[Piece], t: f64) -> DVec3 {
    let i = (t as usize).min(pieces.len() - 1);
    pieces[i].point(t - i as f64)
}

/// Where the longest chord from a place on the curve ends: twice as many pieces each time, then back.
fn chord_end(pieces: &[Piece], from: f64, chord: f64) -> f64 {
    let end = pieces.len() as f64;
    // Distances grow with the square of the length: their roots, in those of what they may be, are nearly linear.
    let root = |to: f64| match error(pieces, from, to) {
        0.0 => 0.0,
        distance => (distance / chord).sqrt(),
    };
    // Places with their roots.
    let mut good = [from, 0.0];
    let mut more = 1.0;
    let mut bad = loop {
        let next = (good[0].floor() + more).min(end);
        let found = root(next);
        if found > 1.0 {
            break [next, found];
        }
        if next >= end {
            return end;
        }
        (good, more) = ([next, found], next - from.floor());
    };
    let (enough, aim) = (ENOUGH.sqrt(), (0.5 * (1.0 + ENOUGH)).sqrt());
    for trial in 1..=TRIALS {
        if good[1] >= enough && good[0] > from {
            break;
        }
        let share = (aim - good[1]) / (bad[1] - good[1]);
        // What is far from linear is halved now and then.
        let share = if trial % 4 != 0 && share > 0.0 && share < 1.0 { share } else { 0.5 };
        let t = good[0] + (bad[0] - good[0]) * share;
        let found = root(t);
        *(if found <= 1.0 { &mut good } else { &mut bad }) = [t, found];
    }
    // No chord is short enough for a distance of 0: the piece's end has to do.
    if good[0] == from { (from.floor() + 1.0).min(end) } else { good[0] }
}

/// The largest distance of the curve from its chord: of parabolas through neighbouring places.
fn error(pieces: &[Piece], from: f64, to: f64) -> f64 {
    let (a, b) = (point(pieces, from), point(pieces, to));
    let along = b - a;
    let square = along.length_squared();
    let places = (PLACES * (to - from).ceil() as usize).max(LEAST);
    let step = (to - from) / places as f64;
    let (mut before, mut last, mut largest) = (0.0f64, 0.0f64, 0.0f64);
    for i in 1..=places {
        let next = if i < places {
            let way = point(pieces, from + step * i as f64) - a;
            let s = if square > 0.0 { (way.dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
            (way - along * s).length()
        } else {
            0.0
        };
        if last >= before.max(next) {
            let bend = (last - before) + (last - next);
            let above = if bend > 0.0 { (next - before) * (next - before) / (8.0 * bend) } else { 0.0 };
            largest = largest.max(last + above);
        }
        (before, last) = (last, next);
    }
    largest
}

#[cfg(test)]
mod tests {
    use super::super::{Control, Lines, trace};
    use super::*;

    struct Circle;

    impl Lines for Circle {
        type Cause = ();
        fn at(&mut self, x: DVec3) -> Result<DVec3, ()> {
            Ok(DVec3::new(-x.y, x.x, 0.0).normalize())
        }
    }

    /// ⌈L/(2r·arccos(1 − c/r))⌉ chords leave a circle by c at most: 20, 10 and 5 for an arc of 40, c = 0.1.
    #[test]
    fn a_circle_has_the_fewest_chords() {
        for (r, want) in [(5.0, 20), (20.0, 10), (80.0, 5)] {
            let fewest = (40.0 / (2.0 * r * f64::acos(1.0 - 0.1 / r))).ceil() as usize;
            assert_eq!(fewest, want);
            let control = Control {
                tolerance: 1e-5,
                first: 1.0,
                min_step: 1e-6,
                max_step: f64::INFINITY,
                length: 40.0,
                cos_max_angle: -1.0,
                goal: None,
            };
            let half = trace(&mut Circle, DVec3::X * r, DVec3::Y, &control);
            let at = vertices(&half.pieces, 0.1);
            let chords = at.len() - 1;
            assert!(chords >= fewest && chords as f64 <= 1.3 * fewest as f64, "{r}: {chords}");
            for pair in at.windows(2) {
                let middle = (point(&half.pieces, pair[0]) + point(&half.pieces, pair[1])) / 2.0;
                assert!(r - middle.length() <= 0.1 + 1e-4);
            }
        }
    }

    #[test]
    fn a_straight_line_is_one_chord() {
        let piece = |x: f64| Piece { ends: [DVec3::X * x, DVec3::X * (x + 1.0)], tangents: [DVec3::X; 2] };
        assert_eq!(vertices(&[piece(0.0), piece(1.0), piece(2.0)], 1e-9), [0.0, 3.0]);
        assert_eq!(vertices(&[], 0.1), [0.0]);
    }
}
