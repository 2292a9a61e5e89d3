//! Polylines with the fewest vertices that stay within a distance of a curve ([HATCH-10]).

use super::CubicSegment;
use drypoint_scene::glam::DVec3;

/// Number of places at which the distance to a chord is taken: on each segment, and on a chord that is shorter than a
/// segment.
const PLACES: usize = 4;

/// Share of the allowed distance from which a chord counts as long enough. A few hundredths of the distance are half
/// as many of the length.
const ENOUGH: f64 = 0.96;

/// The least growth of a chord that is not yet too long.
const LONGER: f64 = 1.125;

/// Number of trials that find the end of a chord.
const TRIALS: usize = 24;

/// Returns the vertices of a polyline as parameters on the curve of these segments: the integer part is the segment's
/// index, the fraction its parameter. Each chord is as long as possible within the distance `chord` of the curve.
/// Both ends of the curve are vertices.
pub fn vertices(segments: &[CubicSegment], chord: f64) -> Vec<f64> {
    let curve = SampledCurve::new(segments);
    let end = segments.len() as f64;
    let mut at = Vec::with_capacity(2 * segments.len() + 1);
    at.push(0.0);
    let (mut from, mut long) = (0.0, 1.0);
    while from < end {
        let to = curve.chord_end(from, long, chord);
        at.push(to);
        (from, long) = (to, to - from);
    }
    at
}

/// The point of a curve.
///
/// # Panics
/// If the curve has no piece.
#[inline]
pub fn point(segments: &[CubicSegment], t: f64) -> DVec3 {
    let i = (t as usize).min(segments.len() - 1);
    segments[i].point(t - i as f64)
}

/// A curve with sampled places.
struct SampledCurve<'a> {
    segments: &'a [CubicSegment],
    /// Places at the quarters of segments, from the first segment's beginning on.
    places: Vec<DVec3>,
}

impl<'a> SampledCurve<'a> {
    fn new(segments: &'a [CubicSegment]) -> Self {
        let on = |segment: &'a CubicSegment| (0..PLACES).map(|i| segment.point(i as f64 / PLACES as f64));
        let mut places = Vec::with_capacity(PLACES * segments.len());
        segments.iter().for_each(|segment| places.extend(on(segment)));
        Self { segments, places }
    }

    /// Returns the end of the longest chord from a place. The first trial is as long as the chord before. Longer ones
    /// follow until one is too long, then trials between the two.
    fn chord_end(&self, from: f64, long: f64, chord: f64) -> f64 {
        let end = self.segments.len() as f64;
        let (enough, aim) = (ENOUGH.sqrt(), (0.5 * (1.0 + ENOUGH)).sqrt());
        // Ends of chords that are good and bad, with √(distance/allowed distance), which is nearly linear in the
        // length.
        let mut good = [from, 0.0];
        let mut bad: Option<[f64; 2]> = None;
        let mut to = (from + long).min(end);
        for trial in 1..=TRIALS {
            let found = (self.error(from, to) / chord).sqrt();
            if found <= 1.0 {
                good = [to, found];
                if to >= end || found >= enough {
                    return to;
                }
            } else {
                bad = Some([to, found]);
            }
            to = match bad {
                None => (from + (to - from) * (aim / found).clamp(LONGER, 2.0)).min(end),
                Some(bad) => {
                    let share = (aim - good[1]) / (bad[1] - good[1]);
                    // If the root is far from linear, every fourth trial bisects.
                    let share = if trial % 4 != 0 && share > 0.0 && share < 1.0 { share } else { 0.5 };
                    good[0] + (bad[0] - good[0]) * share
                }
            };
        }
        // No chord reaches a distance of 0; then the segment's end serves.
        if good[0] == from { (from.floor() + 1.0).min(end) } else { good[0] }
    }

    /// The largest distance from a chord, from parabolas through neighbouring places.
    fn error(&self, from: f64, to: f64) -> f64 {
        let chord = Chord::new(point(self.segments, from), point(self.segments, to));
        let mut largest = RunningMaximum { before: [from, 0.0], last: [from, 0.0], found: 0.0 };
        if to - from >= 1.0 {
            let first = (from * PLACES as f64) as usize + 1;
            for (i, place) in self.places.iter().enumerate().take((to * PLACES as f64).ceil() as usize).skip(first) {
                largest.add(i as f64 / PLACES as f64, chord.square_distance(*place));
            }
        } else {
            let step = (to - from) / PLACES as f64;
            for t in (1..PLACES).map(|i| from + step * i as f64) {
                largest.add(t, chord.square_distance(point(self.segments, t)));
            }
        }
        largest.add(to, 0.0);
        largest.found
    }
}

struct Chord {
    from: DVec3,
    along: DVec3,
    /// 1/‖along‖², or 0 if this is not finite.
    inverse: f64,
}

impl Chord {
    fn new(from: DVec3, to: DVec3) -> Self {
        let along = to - from;
        let inverse = 1.0 / along.length_squared();
        Self { from, along, inverse: if inverse.is_finite() { inverse } else { 0.0 } }
    }

    #[inline]
    fn square_distance(&self, place: DVec3) -> f64 {
        let way = place - self.from;
        let s = (way.dot(self.along) * self.inverse).clamp(0.0, 1.0);
        (way - self.along * s).length_squared()
    }
}

/// The running maximum of distances along a curve. Squared distances come in.
struct RunningMaximum {
    /// The last two places: parameter and squared distance.
    before: [f64; 2],
    last: [f64; 2],
    found: f64,
}

impl RunningMaximum {
    #[inline]
    fn add(&mut self, t: f64, square: f64) {
        let [before, last, next] = [self.before, self.last, [t, square]];
        if last[1] >= before[1] && last[1] >= square {
            self.found = self.found.max(top(before, last, next));
        }
        (self.before, self.last) = (last, next);
    }
}

/// The maximum of the parabola through three places whose middle one is not lower than the others.
fn top(before: [f64; 2], last: [f64; 2], next: [f64; 2]) -> f64 {
    let distance = last[1].sqrt();
    let (back, ahead) = (last[0] - before[0], next[0] - last[0]);
    let (rise, fall) = ((distance - before[1].sqrt()) / back, (distance - next[1].sqrt()) / ahead);
    let bend = (rise + fall) / (back + ahead);
    let slope = rise - bend * back;
    let above = slope * slope / (4.0 * bend);
    // Coincident places and equal heights have no parabola; the result is not finite.
    if above.is_finite() { distance + above } else { distance }
}

#[cfg(test)]
mod tests {
    use super::super::{Control, LineField, trace};
    use super::*;

    struct Circle;

    impl LineField for Circle {
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
            let at = vertices(&half.segments, 0.1);
            let chords = at.len() - 1;
            assert!(chords >= fewest && chords as f64 <= 1.3 * fewest as f64, "{r}: {chords}");
            for pair in at.windows(2) {
                let middle = (point(&half.segments, pair[0]) + point(&half.segments, pair[1])) / 2.0;
                assert!(r - middle.length() <= 0.1 + 1e-4);
            }
        }
    }

    /// h − a(t − m)² through three unequally spaced places.
    #[test]
    fn the_top_of_a_parabola() {
        let (h, a, m) = (2.0, 0.7, 0.4);
        let at = |t: f64| [t, f64::powi(h - a * (t - m) * (t - m), 2)];
        assert!((top(at(0.1), at(0.3), at(1.1)) - h).abs() < 1e-12);
        assert!((top(at(-0.2), at(0.5), at(0.7)) - h).abs() < 1e-12);
        assert_eq!(top([0.0, 4.0], [1.0, 4.0], [2.0, 4.0]), 2.0);
        assert_eq!(top([1.0, 0.0], [1.0, 4.0], [2.0, 1.0]), 2.0);
    }

    #[test]
    fn a_straight_line_is_one_chord() {
        let segment = |x: f64| CubicSegment { ends: [DVec3::X * x, DVec3::X * (x + 1.0)], tangents: [DVec3::X; 2] };
        assert_eq!(vertices(&[segment(0.0), segment(1.0), segment(2.0)], 1e-9), [0.0, 3.0]);
        assert_eq!(vertices(&[], 0.1), [0.0]);
    }
}
