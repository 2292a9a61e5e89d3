//! The positional influence h_p (3.1, [HALO-2]).

use drypoint_scene::glam::DVec3;
use drypoint_scene::shot::SeedFocus;

/// h_p over the distance to a point or a polyline, in world space.
#[derive(Clone, Debug, PartialEq)]
pub struct FocusInfluence(SeedFocus);

impl FocusInfluence {
    /// Prepares a focus of at least one point.
    pub fn new(focus: &SeedFocus) -> Self {
        Self(focus.clone())
    }

    /// h_p = clamp₀₁(1 − (dist − inner)/falloff) at a place in world space. For falloff 0 it is a step at `inner`.
    pub fn at(&self, p: DVec3) -> f64 {
        self.of_distance(self.distance(p))
    }

    /// The least and the largest h_p of a place that is displaced by up to a distance, which changes its own by as much.
    pub(crate) fn range(&self, p: DVec3, displaced: f64) -> [f64; 2] {
        let distance = self.distance(p);
        [self.of_distance(distance + displaced), self.of_distance(distance - displaced)]
    }

    /// Whether h_p can be above 0 within a distance of a place.
    pub fn can_reach(&self, p: DVec3, radius: f64) -> bool {
        let nearest = self.distance(p) - radius;
        // Both distances are rounded.
        nearest <= (self.0.inner + self.0.falloff) * (1.0 + 1e-9) + 1e-9 * (p.length() + radius)
    }

    fn of_distance(&self, distance: f64) -> f64 {
        let beyond = distance - self.0.inner;
        if beyond <= 0.0 {
            1.0
        } else if beyond >= self.0.falloff {
            0.0
        } else {
            1.0 - beyond / self.0.falloff
        }
    }

    /// The distance to the point, or to the nearest segment of the polyline.
    fn distance(&self, p: DVec3) -> f64 {
        let at = &self.0.at;
        let to_vertex = at.first().map_or(f64::INFINITY, |vertex| vertex.distance(p));
        at.windows(2).map(|ends| to_segment(p, ends[0], ends[1])).fold(to_vertex, f64::min)
    }
}

/// The distance of p to the segment from a to b.
fn to_segment(p: DVec3, a: DVec3, b: DVec3) -> f64 {
    let along = b - a;
    let square = along.length_squared();
    let t = if square > 0.0 { ((p - a).dot(along) / square).clamp(0.0, 1.0) } else { 0.0 };
    p.distance(a + along * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn focus(at: &[[f64; 3]], inner: f64, falloff: f64) -> FocusInfluence {
        let at = at.iter().copied().map(DVec3::from_array).collect();
        FocusInfluence::new(&SeedFocus { at, inner, falloff })
    }

    #[test]
    fn distances_by_hand() {
        let point = focus(&[[1.0, 0.0, 0.0]], 2.0, 4.0);
        let at = |focus: &FocusInfluence, x: f64, y: f64| focus.at(DVec3::new(x, y, 0.0));
        assert_eq!([1.0, 3.0, 4.0, 5.0, 7.0, 9.0].map(|x| at(&point, x, 0.0)), [1.0, 1.0, 0.75, 0.5, 0.0, 0.0]);
        // A segment from (0, 0) to (4, 0), then up to (4, 4); (4, 4) again.
        let line = focus(&[[0.0; 3], [4.0, 0.0, 0.0], [4.0, 4.0, 0.0], [4.0, 4.0, 0.0]], 0.0, 2.0);
        assert_eq!([at(&line, 2.0, 1.0), at(&line, 5.0, 3.0), at(&line, -1.0, 0.0)], [0.5; 3]);
        assert_eq!(at(&line, 4.0, 5.0), 0.5);
    }

    #[test]
    fn a_step_without_falloff() {
        let step = focus(&[[0.0; 3]], 1.0, 0.0);
        assert_eq!([0.5, 1.0, 1.0 + 1e-12].map(|x| step.at(DVec3::X * x)), [1.0, 1.0, 0.0]);
    }

    #[test]
    fn no_place_that_it_reaches_is_missed() {
        let focus = focus(&[[10.0, 0.0, 0.0], [20.0, 0.0, 0.0]], 1.0, 2.0);
        for i in 0..400 {
            let p = DVec3::new(f64::from(i) * 0.1, 2.5, 1.0);
            let reached = (0..27).any(|j| {
                let offset = DVec3::new(f64::from(j % 3 - 1), f64::from(j / 3 % 3 - 1), f64::from(j / 9 - 1));
                focus.at(p + offset) > 0.0
            });
            assert!(!reached || focus.can_reach(p, 3f64.sqrt()), "{p}");
        }
        assert!(!focus.can_reach(DVec3::new(0.0, 0.0, 0.0), 1.0));
    }
}
