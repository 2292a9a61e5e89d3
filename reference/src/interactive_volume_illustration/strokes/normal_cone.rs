//! The cone of a stroke's normals, which culls strokes that face away as a whole ([HATCH-10]).

use drypoint_scene::glam::DVec3;
use drypoint_scene::math::{angle, atan2};
use drypoint_scene::strokes::Stroke;
use std::f64::consts::FRAC_PI_2;

/// A bounding cone of a stroke's normals and a bounding sphere of its vertices.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NormalCone {
    /// The normalized sum of the normals; 0 where they cancel.
    pub axis: DVec3,
    /// The largest angle of a normal to the axis, in radians.
    pub half_angle: f64,
    /// The middle of the vertices' box, in world space.
    pub center: DVec3,
    /// The largest distance of a vertex from `center`.
    pub radius: f64,
}

/// The angle between two vectors; 0 if one of them is 0 ([CUR-3]).
fn between(a: DVec3, b: DVec3) -> f64 {
    angle(a.cross(b).length(), a.dot(b))
}

impl NormalCone {
    /// The cone of a stroke that has at least one vertex.
    pub fn new(stroke: &Stroke) -> Self {
        let normals = || stroke.vertices.iter().map(|v| v.normal);
        let places = || stroke.vertices.iter().map(|v| v.world);
        let axis = normals().sum::<DVec3>().normalize_or_zero();
        let half_angle =
            if axis == DVec3::ZERO { FRAC_PI_2 } else { normals().map(|n| between(axis, n)).fold(0.0, f64::max) };
        let lo = places().fold(DVec3::INFINITY, DVec3::min);
        let hi = places().fold(DVec3::NEG_INFINITY, DVec3::max);
        let center = lo + (hi - lo) * 0.5;
        Self { axis, half_angle, center, radius: places().map(|p| p.distance(center)).fold(0.0, f64::max) }
    }

    /// Whether no vertex faces an eye at a place of the world. Let β be the angular radius of the bounding sphere as
    /// the eye sees it. Then the angle from the axis to the eye exceeds 90° + `half_angle` + β.
    pub fn culled(&self, eye: DVec3) -> bool {
        let to_eye = eye - self.center;
        let square = to_eye.length_squared() - self.radius * self.radius;
        square > 0.0 && self.faces_away(to_eye, atan2(self.radius, square.sqrt()))
    }

    /// Like [`culled`](Self::culled), but for an eye infinitely far away in a direction.
    pub fn culled_from(&self, to_eye: DVec3) -> bool {
        self.faces_away(to_eye, 0.0)
    }

    fn faces_away(&self, to_eye: DVec3, beta: f64) -> bool {
        // Bound on the rounding errors of the three angles.
        let rounding = 16.0 * f64::EPSILON;
        self.half_angle < FRAC_PI_2 && between(self.axis, to_eye) > FRAC_PI_2 + self.half_angle + beta + rounding
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::philox::uniform;
    use drypoint_scene::strokes::StrokeVertex;

    /// On 10⁵ random strokes, no culled stroke has a vertex that faces the eye. Of the strokes that turn little, are
    /// seen from far and face away, most are culled.
    #[test]
    fn no_culled_stroke_faces_the_eye() {
        let (mut culled, mut away) = (0, 0);
        for i in 0..100_000u32 {
            let draw = |a: u32| {
                let r = |k: u32| 2.0 * uniform(4, [i, a, k], 0) - 1.0;
                DVec3::new(r(0), r(1), r(2))
            };
            let bend = uniform(4, [i, 0, 0], 1);
            let (first, at) = (draw(0), draw(1) * 10.0);
            let vertex = |k: u32| {
                let normal = (first + draw(10 + k) * bend).normalize_or(DVec3::X);
                StrokeVertex { world: at + draw(20 + k) * 3.0 * bend, normal, u: 0.0 }
            };
            let stroke = Stroke { vertices: (0..2 + i % 7).map(vertex).collect(), closed: false, key: 0 };
            let cone = NormalCone::new(&stroke);
            let eye = draw(2) * 40.0;
            let faces = |v: DVec3, to: DVec3| v.dot(to) > 0.0;
            if cone.culled(eye) {
                culled += 1;
                assert!(stroke.vertices.iter().all(|v| !faces(v.normal, eye - v.world)));
            }
            if cone.culled_from(eye) {
                assert!(stroke.vertices.iter().all(|v| !faces(v.normal, eye)));
            }
            away += usize::from(stroke.vertices.iter().all(|v| !faces(v.normal, eye - v.world)));
        }
        assert!(3 * culled > away, "{culled} of {away}");
    }
}
