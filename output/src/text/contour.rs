//! Contours of glyphs: closed paths of lines and cubic curves, and polygons near them.

use drypoint_scene::glam::DVec2;
use harfrust::font::glyph::outline::PathSink;

/// Largest distance, in mm, of a polygon from its curve: the step of places on the page.
const TOLERANCE: f64 = 0.001;

/// Most chords of one curve. They reach the tolerance for a glyph up to a metre.
const MOST_CHORDS: f64 = 512.0;

/// A closed path on the page, in mm, y down. Its last segment ends at the start.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Contour {
    /// The first point.
    pub(crate) start: DVec2,
    /// The segments in order.
    pub(crate) segments: Vec<ContourSegment>,
}

/// A segment of a contour, from the end of the one before.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum ContourSegment {
    /// A straight line to a point.
    Line(DVec2),
    /// A cubic Bézier curve: two control points and the end.
    Curve([DVec2; 3]),
}

impl Contour {
    /// Returns a polygon within the tolerance of the contour, without its first point at the end.
    pub(crate) fn flattened(&self) -> Vec<DVec2> {
        let mut points = vec![self.start];
        let mut from = self.start;
        for segment in &self.segments {
            from = match *segment {
                ContourSegment::Line(to) => {
                    points.push(to);
                    to
                }
                ContourSegment::Curve([a, b, to]) => {
                    flatten([from, a, b, to], &mut points);
                    to
                }
            };
        }
        if points.len() > 1 && points.last() == points.first() {
            points.pop();
        }
        points
    }
}

/// Appends the ends of the chords of a cubic curve.
///
/// A chord over a step h of the parameter lies within h²/8 of the largest second derivative, which is six times the
/// larger second difference m of the control points. So n equal steps stay within 6m/8n².
fn flatten([p, a, b, q]: [DVec2; 4], points: &mut Vec<DVec2>) {
    let bend = (p - 2.0 * a + b).length().max((a - 2.0 * b + q).length());
    let steps = (0.75 * bend / TOLERANCE).sqrt().ceil().clamp(1.0, MOST_CHORDS);
    for step in 1..steps as u32 {
        let t = f64::from(step) / steps;
        let s = 1.0 - t;
        points.push(s * s * s * p + 3.0 * s * s * t * a + 3.0 * s * t * t * b + t * t * t * q);
    }
    points.push(q);
}

/// Takes the path of a glyph in font units, y up, and makes contours on the page.
pub(super) struct ContourPen {
    origin: DVec2,
    scale: f64,
    at: DVec2,
    contours: Vec<Contour>,
}

impl ContourPen {
    /// Begins a glyph whose origin lies at that place. `scale` is the size of a font unit in mm.
    pub(super) fn new(origin: DVec2, scale: f64) -> Self {
        Self { origin, scale, at: origin, contours: Vec::new() }
    }

    /// Returns the contours of the glyph that have an area.
    pub(super) fn finish(self) -> impl Iterator<Item = Contour> {
        self.contours.into_iter().filter(|contour| contour.segments.len() > 1)
    }

    fn place(&self, x: f32, y: f32) -> DVec2 {
        self.origin + self.scale * DVec2::new(f64::from(x), -f64::from(y))
    }

    fn push(&mut self, segment: ContourSegment, end: DVec2) {
        self.at = end;
        if let Some(contour) = self.contours.last_mut() {
            contour.segments.push(segment);
        }
    }
}

impl PathSink for ContourPen {
    fn move_to(&mut self, x: f32, y: f32) {
        self.at = self.place(x, y);
        self.contours.push(Contour { start: self.at, segments: Vec::new() });
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let to = self.place(x, y);
        self.push(ContourSegment::Line(to), to);
    }

    fn quad_to(&mut self, cx0: f32, cy0: f32, x: f32, y: f32) {
        // The cubic curve of the same points: its controls lie two thirds of the way to the quadratic one.
        let (from, control, to) = (self.at, self.place(cx0, cy0), self.place(x, y));
        let toward = |end: DVec2| end + (control - end) * 2.0 / 3.0;
        self.push(ContourSegment::Curve([toward(from), toward(to), to]), to);
    }

    fn curve_to(&mut self, cx0: f32, cy0: f32, cx1: f32, cy1: f32, x: f32, y: f32) {
        let to = self.place(x, y);
        self.push(ContourSegment::Curve([self.place(cx0, cy0), self.place(cx1, cy1), to]), to);
    }

    fn close(&mut self) {
        let Some(contour) = self.contours.last() else { return };
        let start = contour.start;
        if self.at != start {
            self.push(ContourSegment::Line(start), start);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A quarter turn of a parabola, its chords compared with a thousand points of the curve.
    #[test]
    fn chords_stay_within_the_tolerance() {
        for size in [0.01, 1.0, 10.0, 300.0] {
            let mut pen = ContourPen::new(DVec2::ZERO, size);
            pen.move_to(0.0, 0.0);
            pen.quad_to(0.0, 1.0, 1.0, 1.0);
            pen.close();
            let contour = pen.finish().next().unwrap();
            let points = contour.flattened();
            let curve = |t: f64| size * DVec2::new(t * t, -(2.0 * t * (1.0 - t) + t * t));
            for i in 0..=1000 {
                let at = curve(f64::from(i) / 1000.0);
                let nearest = points.windows(2).map(|w| distance(at, w[0], w[1])).fold(f64::INFINITY, f64::min);
                assert!(nearest <= TOLERANCE, "{size}: {nearest}");
            }
            // Half as many would not do: the bound is tight for a parabola.
            let chords = (points.len() - 1) as f64;
            assert!(size < 1.0 || size * 2.0_f64.sqrt() / 4.0 / (chords - 1.0).powi(2) > TOLERANCE, "{size}: {chords}");
        }
    }

    fn distance(at: DVec2, a: DVec2, b: DVec2) -> f64 {
        let along = b - a;
        let s = ((at - a).dot(along) / along.length_squared()).clamp(0.0, 1.0);
        at.distance(a + s * along)
    }

    #[test]
    fn a_closed_contour_ends_at_its_start() {
        let mut pen = ContourPen::new(DVec2::new(1.0, 1.0), 2.0);
        pen.move_to(0.0, 0.0);
        pen.line_to(1.0, 0.0);
        pen.line_to(1.0, 1.0);
        pen.close();
        // A point without a line has no area.
        pen.move_to(5.0, 5.0);
        pen.close();
        let contours: Vec<Contour> = pen.finish().collect();
        assert_eq!(contours.len(), 1);
        assert_eq!(contours[0].segments.last(), Some(&ContourSegment::Line(DVec2::ONE)));
        assert_eq!(contours[0].flattened(), [DVec2::ONE, DVec2::new(3.0, 1.0), DVec2::new(3.0, -1.0)]);
    }
}
