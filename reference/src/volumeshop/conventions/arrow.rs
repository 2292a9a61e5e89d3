//! The curve of an arrow.

use super::CurvePoint;
use crate::convex_hull::hull;
use drypoint_scene::glam::{DVec2, DVec3};
use drypoint_scene::view::View;

/// The largest coordinate of a curve, in pixels. Up to there, its part in the picture is known to 0.001 pixels.
const LARGEST: f64 = 1e12;

/// The quadratic curve of an arrow between two places.
///
/// Its control point is the middle of the chord, moved by β·|Δz| to the chord's left, where Δz is the way in depth between
/// both ends, in pixels at their mean depth. So the curve is at least β·|Δz| long, even if both ends are at one pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ArrowCurve {
    ends: [CurvePoint; 2],
    control: DVec2,
}

impl ArrowCurve {
    /// Returns the curve from one place to another, in world space, with the bend β. Returns none if the curve has no
    /// length, if an end is not before the eye, or if a coordinate is larger than 10¹² pixels.
    pub fn new(view: &View, places: [DVec3; 2], bend: f64) -> Option<Self> {
        let [from, to] = places.map(|place| {
            let at = view.point_of(place)?;
            Some(CurvePoint { at: DVec2::from(at), depth: -view.to_eye(place).z })
        });
        let [from, to] = [from?, to?];
        let depth = if view.perspective { (from.depth + to.depth) / 2.0 } else { 1.0 };
        let offset = bend * (to.depth - from.depth).abs() / (view.pixel * depth);
        let chord = to.at - from.at;
        // The left of the direction (x, y) is (y, −x), since y goes down. Without a chord the curve bends to +x.
        let left = if chord == DVec2::ZERO { DVec2::X } else { DVec2::new(chord.y, -chord.x).normalize() };
        let control = (from.at + to.at) / 2.0 + left * offset;
        let has_length = chord != DVec2::ZERO || offset > 0.0;
        let is_drawn = [from.at, to.at, control].iter().all(|point| point.abs().cmple(DVec2::splat(LARGEST)).all());
        (has_length && is_drawn).then_some(Self { ends: [from, to], control })
    }

    /// Returns the length of the part of the curve between two t, in pixels: that of 256 chords.
    pub fn length(&self, [from, to]: [f64; 2]) -> f64 {
        const CHORDS: u32 = 256;
        let at = |i: u32| self.at(from + (to - from) * f64::from(i) / f64::from(CHORDS)).at;
        (0..CHORDS).map(|i| at(i).distance(at(i + 1))).sum()
    }

    /// Returns the point at t, from 0 at the begin to 1 at the tip. The depth is linear in t.
    pub fn at(&self, t: f64) -> CurvePoint {
        let [from, to] = self.ends;
        let s = 1.0 - t;
        let at = from.at * (s * s) + self.control * (2.0 * s * t) + to.at * (t * t);
        CurvePoint { at, depth: from.depth * s + to.depth * t }
    }

    /// Returns points of the part of the curve between two t, at most a pixel apart, up to `most` points.
    pub fn points(&self, [from, to]: [f64; 2], most: usize) -> Vec<CurvePoint> {
        // The speed of a quadratic curve is at most that at its ends.
        let speed = 2.0 * self.control.distance(self.ends[0].at).max(self.control.distance(self.ends[1].at));
        let steps = (speed * (to - from)).ceil().clamp(1.0, most.max(2) as f64 - 1.0) as usize;
        (0..=steps).map(|i| self.at(from + (to - from) * (i as f64 / steps as f64))).collect()
    }

    /// Returns the first t, on the way back from `to`, at which the curve is `length` pixels away from its point there.
    /// Returns 0 if it is nowhere so far away.
    pub fn before(&self, to: f64, length: f64) -> f64 {
        /// Steps of the search; bisection goes on from there.
        const STEPS: usize = 256;
        let tip = self.at(to).at;
        let is_far = |t: f64| self.at(t).at.distance(tip) >= length;
        let Some(i) = (0..STEPS).rev().find(|&i| is_far(to * i as f64 / STEPS as f64)) else { return 0.0 };
        let [mut far, mut near] = [i, i + 1].map(|i| to * i as f64 / STEPS as f64);
        for _ in 0..40 {
            let middle = (far + near) / 2.0;
            *(if is_far(middle) { &mut far } else { &mut near }) = middle;
        }
        far
    }

    /// Returns the first and the last t at which the curve is inside the convex hull of points of the picture. Returns none
    /// if it nowhere is.
    pub fn inside(&self, points: &[DVec2]) -> Option<[f64; 2]> {
        /// Steps of the search.
        const STEPS: usize = 1024;
        let hull = hull(points.to_vec());
        let is_inside = |t: f64| {
            let p = self.at(t).at;
            hull.len() > 2
                && (0..hull.len()).all(|i| (hull[(i + 1) % hull.len()] - hull[i]).perp_dot(p - hull[i]) >= 0.0)
        };
        let mut inside = (0..=STEPS).map(|i| i as f64 / STEPS as f64).filter(|&t| is_inside(t));
        let first = inside.next()?;
        Some([first, inside.next_back().unwrap_or(first)])
    }

    /// Returns the outline of the arrow's head with its tip at t, `length` pixels long: tip, corner, notch, corner.
    /// The shaft ends at the notch.
    pub fn head(&self, t: f64, length: f64) -> [DVec2; 4] {
        /// Half the head's width, as a share of its length.
        const HALF_WIDTH: f64 = 0.32;
        /// The distance of the notch from the tip, as a share of the head's length.
        const NOTCH: f64 = 0.8;
        let (tip, back) = (self.at(t).at, self.at(self.before(t, length)).at);
        let along = (tip - back).normalize_or(DVec2::X);
        let across = along.perp() * (length * HALF_WIDTH);
        let base = tip - along * length;
        [tip, base + across, tip - along * (length * NOTCH), base - across]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::space::Grid;
    use drypoint_scene::tables::{Camera, Projection};

    /// Along −z on 100 × 100 pixels, a world unit a pixel.
    fn view(perspective: bool) -> View {
        let grid = Grid::with_spacing([101; 3], [1.0; 3]).unwrap();
        let projection = match perspective {
            true => Projection::Perspective { fov: 40.0 },
            false => Projection::Orthographic { height: Some(drypoint_scene::tables::Length::World(100.0)) },
        };
        let camera = Camera {
            projection,
            direction: DVec3::NEG_Z,
            direction_given: true,
            up: DVec3::Y,
            eye: (!perspective).then(|| DVec3::new(50.0, 50.0, 200.0)),
            ..Camera::default()
        };
        View::new(&camera, &grid, [100, 100]).unwrap()
    }

    /// The chord goes 40 px to the right and 30 units back: with β = ½ its middle is raised by 15 px, and the curve by half
    /// of that.
    #[test]
    fn an_arrow_by_hand() {
        let places = [DVec3::new(20.0, 50.0, 60.0), DVec3::new(60.0, 50.0, 30.0)];
        let curve = ArrowCurve::new(&view(false), places, 0.5).unwrap();
        assert_eq!(curve.control, DVec2::new(40.0, 35.0));
        assert_eq!(curve.at(0.5), CurvePoint { at: DVec2::new(40.0, 42.5), depth: 155.0 });
        assert_eq!(curve.at(0.0).at, DVec2::new(20.0, 50.0));
        // The other way round its left is below.
        let back = ArrowCurve::new(&view(false), [places[1], places[0]], 0.5).unwrap();
        assert_eq!(back.control, DVec2::new(40.0, 65.0));
    }

    /// Both ends at one pixel: the curve goes to +x by half of β·|Δz| and back. Without any way there is no arrow.
    #[test]
    fn an_arrow_is_never_shorter_than_its_depth_asks() {
        let at = |x: f64, z: f64| DVec3::new(x, 50.0, z);
        let curve = ArrowCurve::new(&view(false), [at(50.0, 80.0), at(50.0, 20.0)], 0.5).unwrap();
        assert_eq!((curve.control, curve.at(0.5).at.x), (DVec2::new(80.0, 50.0), 65.0));
        for (dx, dz, bend) in [(0.0, 60.0, 0.5), (3.0, 60.0, 0.5), (40.0, 10.0, 2.0), (1.0, 90.0, 1.0)] {
            for perspective in [false, true] {
                let places = [at(50.0, 95.0), at(50.0 + dx, 95.0 - dz)];
                let view = view(perspective);
                let curve = ArrowCurve::new(&view, places, bend).unwrap();
                let depth = if perspective { (curve.at(0.0).depth + curve.at(1.0).depth) / 2.0 } else { 1.0 };
                let least = bend * dz / (view.pixel * depth);
                // A chain of chords is shorter than its curve.
                let length = curve.length([0.0, 1.0]);
                assert!(length >= least * (1.0 - 1e-4), "{length} {least}");
            }
        }
        assert_eq!(ArrowCurve::new(&view(false), [at(50.0, 20.0); 2], 0.5), None);
        for (x, bend) in [(1e300, 0.5), (60.0, 1e308)] {
            assert_eq!(ArrowCurve::new(&view(false), [at(50.0, 80.0), at(x, 20.0)], bend), None);
        }
        assert_eq!(ArrowCurve::new(&view(false), [at(50.0, 80.0), at(50.0, 20.0)], 0.0), None);
    }

    /// A straight arrow from the middle of a square of 20 px to that of another, 40 px away: it leaves the first one at a
    /// quarter and enters the second one at three quarters.
    #[test]
    fn an_arrow_leaves_a_box_and_enters_another() {
        let places = [DVec3::new(20.0, 50.0, 60.0), DVec3::new(60.0, 50.0, 60.0)];
        let curve = ArrowCurve::new(&view(false), places, 0.5).unwrap();
        let square = |x: f64| [[x, 40.0], [x + 20.0, 40.0], [x + 20.0, 60.0], [x, 60.0]].map(DVec2::from);
        let near = |found: Option<[f64; 2]>, expected: [f64; 2]| {
            found.unwrap().iter().zip(expected).all(|(a, b)| (a - b).abs() < 2e-3)
        };
        assert!(near(curve.inside(&square(10.0)), [0.0, 0.25]) && near(curve.inside(&square(50.0)), [0.75, 1.0]));
        assert_eq!([curve.inside(&square(200.0)), curve.inside(&[])], [None, None]);
    }

    #[test]
    fn the_head_ends_at_the_tip() {
        let places = [DVec3::new(20.0, 50.0, 60.0), DVec3::new(60.0, 50.0, 60.0)];
        let curve = ArrowCurve::new(&view(false), places, 0.5).unwrap();
        let head = curve.head(1.0, 10.0);
        let expected = [[60.0, 50.0], [50.0, 53.2], [52.0, 50.0], [50.0, 46.8]];
        assert!(head.iter().zip(expected).all(|(a, b)| a.distance(DVec2::from(b)) < 1e-9), "{head:?}");
        assert!((curve.at(curve.before(1.0, 10.0)).at.x - 50.0).abs() < 1e-9);
        assert_eq!(curve.before(1.0, 100.0), 0.0);
        assert!((curve.length([0.25, 0.75]) - 20.0).abs() < 1e-9);
    }
}
