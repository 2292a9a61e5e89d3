//! The fewest vertices of a polyline that stays within a distance of a curve ([HATCH-10]).

use super::Piece;
use drypoint_scene::glam::DVec3;

/// Places on each piece at which the distance to a chord is taken.
const PLACES: usize = 8;

/// Halvings that find the end of a chord: to 2⁻²⁴ of a piece.
const HALVINGS: usize = 24;

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
pub fn point(pieces: &[Piece], t: f64) -> DVec3 {
    let i = (t as usize).min(pieces.len() - 1);
    pieces[i].point(t - i as f64)
}

/// Where the longest chord from a place on the curve ends: whole pieces first, then a part of one.
fn chord_end(pieces: &[Piece], from: f64, chord: f64) -> f64 {
    let end = pieces.len() as f64;
    let mut good = from;
    while good < end {
        let next = (good.floor() + 1.0).min(end);
        if error(pieces, from, next) <= chord {
            good = next;
            continue;
        }
        let mut bad = next;
        for _ in 0..HALVINGS {
            let middle = 0.5 * (good + bad);
            if error(pieces, from, middle) <= chord { good = middle } else { bad = middle }
        }
        // No chord is short enough for a distance of 0: the piece's end has to do.
        return if good == from { next } else { good };
    }
    good
}

/// The largest distance of the curve from its chord.
fn error(pieces: &[Piece], from: f64, to: f64) -> f64 {
    let (a, b) = (point(pieces, from), point(pieces, to));
    let along = b - a;
    let square = along.length_squared();
    let places = PLACES * (to - from).ceil().max(1.0) as usize;
    let distance = |i: usize| {
        let p = point(pieces, from + (to - from) * i as f64 / places as f64);
        let s = if square > 0.0 { ((p - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
        p.distance(a + along * s)
    };
    (1..places).map(distance).fold(0.0, f64::max)
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
