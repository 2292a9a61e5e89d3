//! The directional influence h_d (3.1, [HALO-2]).

use drypoint_scene::math;
use drypoint_scene::shot::SeedDirection;

/// The ‖N_xy‖ up to which a normal points along v and has no direction in the picture.
const ALONG_VIEW: f64 = 1.0 / (1u64 << 26) as f64;

/// h_d over the angle of a normal in the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DirectionInfluence(SeedDirection);

impl DirectionInfluence {
    /// Prepares a range of directions. Returns none for the full circle, where h_d is 1 everywhere.
    pub fn new(direction: SeedDirection) -> Option<Self> {
        (direction.width < 360.0).then_some(Self(direction))
    }

    /// h_d of a normal, given by its coordinates to the right and upwards in eye space.
    ///
    /// θ = atan2(N_x, N_y) in degrees, and d is the distance of θ to `toward` on the circle. h_d is 1 for d ≤ width/2
    /// and falls by 1 − smoothstep to 0 at width/2 + softness. A normal along v has h_d = 0.
    pub fn at(&self, normal: [f64; 2]) -> f64 {
        if math::hypot(normal[0], normal[1]) <= ALONG_VIEW { 0.0 } else { self.within(self.degrees_apart(normal)) }
    }

    /// The least and the largest h_d of a normal that is displaced by up to `turned`. The angle changes by the angle of
    /// the displacement at most, and by the roundings of an arc tangent.
    pub(crate) fn range(&self, normal: [f64; 2], turned: f64) -> [f64; 2] {
        /// Roundings of the angle in f32, in degrees.
        const ROUNDED: f64 = 32.0 * 180.0 * f32::EPSILON as f64;
        let length = math::hypot(normal[0], normal[1]);
        if length - turned <= ALONG_VIEW {
            return [0.0, 1.0];
        }
        let more = (turned / length).min(1.0).asin().to_degrees() + ROUNDED;
        let d = self.degrees_apart(normal);
        [self.within(d + more), self.within(d - more)]
    }

    /// d in degrees.
    fn degrees_apart(&self, [x, y]: [f64; 2]) -> f64 {
        let theta = math::atan2(x, y).to_degrees();
        // The remainder is exact, so a whole turn of `toward` changes d by the rounding of the difference alone.
        let apart = (theta - self.0.toward).rem_euclid(360.0);
        apart.min(360.0 - apart)
    }

    /// h_d at a distance of d degrees.
    fn within(&self, d: f64) -> f64 {
        let SeedDirection { width, softness, .. } = self.0;
        let beyond = d - 0.5 * width;
        if beyond <= 0.0 {
            1.0
        } else if beyond >= softness {
            0.0
        } else {
            let t = beyond / softness;
            1.0 - t * t * (3.0 - 2.0 * t)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn influence(toward: f64, width: f64, softness: f64) -> DirectionInfluence {
        DirectionInfluence::new(SeedDirection { toward, width, softness }).unwrap()
    }

    /// A normal whose angle is θ in degrees: 0 up, 90 right.
    fn normal(theta: f64) -> [f64; 2] {
        [math::sin(theta.to_radians()), math::cos(theta.to_radians())]
    }

    #[test]
    fn ranges_by_hand() {
        let right = influence(90.0, 60.0, 20.0);
        assert_eq!([[1.0, 0.0], [0.0, 1.0], [-1.0, 0.0]].map(|n| right.at(n)), [1.0, 0.0, 0.0]);
        // Half of the softness: 1 − smoothstep(½) = ½.
        for theta in [90.0 + 40.0, 90.0 - 40.0] {
            assert!((right.at(normal(theta)) - 0.5).abs() < 1e-12);
        }
        // On the circle: 350° and −10° are one place.
        for toward in [350.0, -10.0, 710.0] {
            let up = influence(toward, 30.0, 0.0);
            assert_eq!([0.0, 354.0, 336.0, 6.0, 334.0].map(|t| up.at(normal(t))), [1.0, 1.0, 1.0, 0.0, 0.0]);
        }
    }

    #[test]
    fn a_step_without_softness_and_normals_along_v() {
        let step = influence(0.0, 90.0, 0.0);
        assert_eq!([44.9, 45.1].map(|t| step.at(normal(t))), [1.0, 0.0]);
        assert_eq!(step.at([0.0, 0.0]), 0.0);
        assert_eq!(step.at([0.0, ALONG_VIEW]), 0.0);
        assert_eq!(step.at([0.0, 2.0 * ALONG_VIEW]), 1.0);
        assert_eq!(DirectionInfluence::new(SeedDirection { toward: 5.0, width: 360.0, softness: 0.0 }), None);
    }
}
