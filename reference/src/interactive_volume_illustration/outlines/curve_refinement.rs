//! Newton's method onto a common zero of two functions ([HATCH-18]).

use crate::field::{Field, Sampler};
use crate::number::Vec3;
use drypoint_scene::glam::{DVec2, DVec3};

/// Length of the last step, in voxels.
const CLOSE: f64 = 1e-6;

/// Distance of the places of a difference quotient, in voxels. It lies between the root of an ulp, where rounding
/// would show, and the scale on which a field bends within a cell.
const APART: f64 = 1e-5;

/// Length of the longest step, in voxels.
const LONGEST: f64 = 0.5;

/// The largest distance from the start, in voxels.
const REACH: f64 = 1.75;

/// Number of steps. The last ones are shortened, because at a kink of the field Newton's method may oscillate.
const STEPS: u32 = 24;

/// Moves places in index space along the shortest way onto f = iso, q = 0.
pub(super) struct CurveRefinement<'s, Q> {
    pub(super) field: &'s Field<'s, f64>,
    /// Maps a value to f − iso, scaled.
    pub(super) over: &'s (dyn Fn(f64) -> f64 + Sync),
    /// q at a place, in index space.
    pub(super) q: Q,
    /// The first and the last corner of the box.
    pub(super) bounds: [DVec3; 2],
}

impl<Q: Fn(DVec3) -> f64> CurveRefinement<'_, Q> {
    fn both(&self, at: DVec3) -> DVec2 {
        DVec2::new((self.over)(self.field.value(Vec3::from_glam(at))), (self.q)(at))
    }

    /// Newton's method for two equations with three unknowns. Each step is the shortest that solves the linear
    /// equations. Returns none if the method does not converge near the start.
    pub(super) fn onto_curve(&self, start: DVec3) -> Option<DVec3> {
        let [lo, hi] = self.bounds;
        let mut at = start;
        for step in 0..STEPS {
            let here = self.both(at);
            // The difference goes towards the middle of the box, so that no place lies outside.
            let way = DVec3::select(at.cmpgt((lo + hi) / 2.0), DVec3::NEG_ONE, DVec3::ONE);
            let along = |axis: DVec3| (self.both(at + axis * way * APART) - here) / APART;
            let (dx, dy, dz) = (along(DVec3::X), along(DVec3::Y), along(DVec3::Z));
            let (f, q) = (DVec3::new(dx.x, dy.x, dz.x) * way, DVec3::new(dx.y, dy.y, dz.y) * way);
            let move_by = shortest([f, q], here)?;
            let length = move_by.length();
            let damped = if step < STEPS / 2 { 1.0 } else { 0.5 };
            let scale = if length > LONGEST { LONGEST / length } else { damped };
            at = (at + move_by * scale).clamp(lo, hi);
            if !at.is_finite() || at.distance(start) > REACH {
                return None;
            }
            if length <= CLOSE {
                return Some(at);
            }
        }
        None
    }
}

/// The shortest step to a common zero of two linear functions with these gradients and values. Returns none if the
/// gradients are parallel.
fn shortest([f, q]: [DVec3; 2], values: DVec2) -> Option<DVec3> {
    /// The sine of the angle between gradients below which they are parallel.
    const PARALLEL: f64 = 1e-6;
    let (f_length, q_length) = (f.length(), q.length());
    let (f, q) = (f / f_length, q / q_length);
    let across = f.cross(q).length_squared();
    let (a, b, cos) = (-values.x / f_length, -values.y / q_length, f.dot(q));
    (across > PARALLEL * PARALLEL).then(|| (f * (a - b * cos) + q * (b - a * cos)) / across)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shortest_step_by_hand() {
        // x = 1 and x + y = 3, seen from the origin: (1, 2, 0).
        let step = shortest([DVec3::X * 2.0, DVec3::new(1.0, 1.0, 0.0)], DVec2::new(-2.0, -3.0)).unwrap();
        assert!((step - DVec3::new(1.0, 2.0, 0.0)).length() < 1e-14, "{step}");
        assert_eq!(shortest([DVec3::X, -DVec3::X], DVec2::ONE), None);
        assert_eq!(shortest([DVec3::ZERO, DVec3::X], DVec2::ONE), None);
    }
}
