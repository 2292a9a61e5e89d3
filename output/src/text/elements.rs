//! The two elements of strokes, and their points.

use drypoint_scene::math;

/// An element of a stroke. A straight line joins it to the next.
#[derive(Clone, Copy, Debug)]
pub(super) enum StrokeElement {
    /// A point.
    P(f64, f64),
    /// An arc of an ellipse with upright axes.
    Arc {
        /// Centre.
        centre: (f64, f64),
        /// Half the width and the height.
        radii: (f64, f64),
        /// Angles of both ends, in degrees, anticlockwise from the right.
        angles: (f64, f64),
    },
}

/// Shorthand for [`StrokeElement::Arc`].
pub(super) const fn arc(centre: (f64, f64), radii: (f64, f64), from: f64, to: f64) -> StrokeElement {
    StrokeElement::Arc { centre, radii, angles: (from, to) }
}

/// Points of an arc a quarter turn. The chord of an eleventh of 90° stays within 0.3 % of the radius.
const STEPS: f64 = 11.0;

/// Returns the points of a stroke without repetitions. A single point becomes a dot of two equal ones.
pub(super) fn polyline(pieces: &[StrokeElement]) -> Vec<[f64; 2]> {
    let mut points: Vec<[f64; 2]> = Vec::new();
    let mut add = |point: [f64; 2]| {
        // Rounding of sine and cosine must leave no tiny segment where elements join.
        let apart = |last: &[f64; 2]| (last[0] - point[0]).abs() + (last[1] - point[1]).abs() > 1e-9;
        if points.last().is_none_or(apart) {
            points.push(point);
        }
    };
    for &piece in pieces {
        match piece {
            StrokeElement::P(x, y) => add([x, y]),
            StrokeElement::Arc { centre, radii, angles: (from, to) } => {
                let steps = ((to - from).abs() / 90.0 * STEPS).ceil().max(1.0);
                for step in 0..=steps as u32 {
                    let angle = (from + (to - from) * f64::from(step) / steps).to_radians();
                    add([centre.0 + radii.0 * math::cos(angle), centre.1 + radii.1 * math::sin(angle)]);
                }
            }
        }
    }
    if let [dot] = points[..] {
        points.push(dot);
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn joined_pieces_share_their_point() {
        let points = polyline(&[
            StrokeElement::P(0.0, 5.0),
            arc((5.0, 5.0), (5.0, 5.0), 180.0, 90.0),
            StrokeElement::P(9.0, 10.0),
        ]);
        assert_eq!(points.len(), 13);
        assert_eq!((points[0], points[12]), ([0.0, 5.0], [9.0, 10.0]));
        assert!(points[1..12].iter().all(|[x, y]| ((x - 5.0).hypot(y - 5.0) - 5.0).abs() < 1e-12));
    }

    #[test]
    fn one_point_is_a_dot() {
        assert_eq!(polyline(&[StrokeElement::P(1.0, 2.0)]), [[1.0, 2.0]; 2]);
    }
}
