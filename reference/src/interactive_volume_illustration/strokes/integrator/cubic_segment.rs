//! A cubic Hermite segment of a curve, between two places with their directions ([HATCH-8]).

use drypoint_scene::glam::DVec3;

/// Number of places on a segment among which the start of a search is chosen.
const STARTS: u32 = 8;

/// Number of bisections that find a place on a segment, to 2⁻⁴⁰ of it.
const BISECTIONS: u32 = 40;

/// The least difference of cosines that is not rounding.
const CLEAR: f64 = 1e-9;

/// A cubic Hermite, p(s) for s in [0, 1].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CubicSegment {
    /// p(0) and p(1).
    pub ends: [DVec3; 2],
    /// p'(0) and p'(1): the directions times the step.
    pub tangents: [DVec3; 2],
}

impl CubicSegment {
    /// p(s) = (1 + 2s)(1 − s)² p₀ + s(1 − s)² p'₀ + s²(3 − 2s) p₁ − s²(1 − s) p'₁.
    #[inline]
    pub fn point(&self, s: f64) -> DVec3 {
        let r = 1.0 - s;
        let ([p, q], [t, u]) = (self.ends, self.tangents);
        p * ((1.0 + 2.0 * s) * r * r) + t * (s * r * r) + q * (s * s * (3.0 - 2.0 * s)) - u * (s * s * r)
    }

    /// p'(s).
    pub fn tangent(&self, s: f64) -> DVec3 {
        let r = 1.0 - s;
        let ([p, q], [t, u]) = (self.ends, self.tangents);
        (q - p) * (6.0 * s * r) + t * (r * (1.0 - 3.0 * s)) - u * (s * (2.0 - 3.0 * s))
    }

    /// p''(s).
    fn second(&self, s: f64) -> DVec3 {
        let ([p, q], [t, u]) = (self.ends, self.tangents);
        (q - p) * (6.0 - 12.0 * s) + t * (6.0 * s - 4.0) + u * (6.0 * s - 2.0)
    }

    /// Returns the first place at which the direction differs from a unit vector by more than an angle with this
    /// cosine. Returns none if there is no such place.
    ///
    /// The largest angle may lie between the ends, where (p''·a)(p'·p') − (p'·a)(p'·p'') grows through 0. This
    /// expression has the sign of the cosine's derivative. It is a polynomial of degree four, whose roots are
    /// bracketed in eighths of the segment.
    pub fn turned(&self, along: DVec3, cos: f64) -> Option<f64> {
        if self.stays_within(along, cos) {
            return None;
        }
        let beyond = |s: f64| {
            let t = self.tangent(s);
            t.dot(along) < cos * t.length()
        };
        let falls = |s: f64| {
            let (t, d) = (self.tangent(s), self.second(s));
            d.dot(along) * t.length_squared() < t.dot(along) * t.dot(d)
        };
        if beyond(0.0) {
            return Some(0.0);
        }
        (0..STARTS).find_map(|i| {
            let [from, to] = [i, i + 1].map(|i| f64::from(i) / f64::from(STARTS));
            let furthest =
                if !beyond(to) && falls(from) && !falls(to) { bisect([from, to], |s| !falls(s)) } else { to };
            beyond(furthest).then(|| bisect([from, furthest], beyond))
        })
    }

    /// Whether all directions differ from a unit vector by less than an angle of at most 90°. p' = (1 − s)² p'₀ +
    /// 2s(1 − s) m + s² p'₁ is a mean of three vectors, and the test checks these. Differences within rounding count
    /// as too large.
    fn stays_within(&self, along: DVec3, cos: f64) -> bool {
        let ([p, q], [t, u]) = (self.ends, self.tangents);
        let within = |v: DVec3| v.dot(along) > (cos + CLEAR) * v.length();
        cos >= 0.0 && within(t) && within(u) && within((q - p) * 3.0 - t - u)
    }

    /// Returns the part of this segment on [0, s]. It is the same cubic.
    pub fn until(&self, s: f64) -> Self {
        Self { ends: [self.ends[0], self.point(s)], tangents: [self.tangents[0] * s, self.tangent(s) * s] }
    }

    /// Returns the parameter between two of its places at which the segment first meets a plane with an integer
    /// coordinate. Returns none if both places lie between the same planes.
    pub fn face(&self, [from, to]: [f64; 2]) -> Option<f64> {
        if from >= to {
            return None;
        }
        let [a, b] = [from, to].map(|s| self.point(s));
        let meets = |axis: usize| {
            let (lo, hi) = (a[axis].min(b[axis]), a[axis].max(b[axis]));
            let up = b[axis] > a[axis];
            let face = if up { lo.floor() + 1.0 } else { hi.ceil() - 1.0 };
            let beyond = |s: f64| if up { self.point(s)[axis] >= face } else { self.point(s)[axis] <= face };
            (lo < face && face < hi).then(|| bisect([from, to], beyond))
        };
        (0..3).filter_map(meets).reduce(f64::min)
    }

    /// Maps the curve affinely: `place` maps places and `direction` maps directions.
    pub fn mapped(&self, place: impl Fn(DVec3) -> DVec3, direction: impl Fn(DVec3) -> DVec3) -> Self {
        Self { ends: self.ends.map(place), tangents: self.tangents.map(direction) }
    }

    /// The curve from its end to its beginning.
    pub fn reversed(&self) -> Self {
        let ([p, q], [t, u]) = (self.ends, self.tangents);
        Self { ends: [q, p], tangents: [-u, -t] }
    }

    /// Returns the parameter of the point nearest to a place, and its distance: Gauss–Newton on (p(s) − x)·p'(s) from
    /// the best of nine starts. The second derivative is neglected, since segments hardly bend.
    pub fn nearest(&self, x: DVec3) -> (f64, f64) {
        let distance = |s: f64| self.point(s).distance(x);
        let starts = (0..=STARTS).map(|i| f64::from(i) / f64::from(STARTS));
        let (mut s, mut at) = (0.0, f64::INFINITY);
        for (start, d) in starts.map(|start| (start, distance(start))) {
            if d < at {
                (s, at) = (start, d);
            }
        }
        loop {
            let t = self.tangent(s);
            let square = t.length_squared();
            if square == 0.0 {
                return (s, at);
            }
            let next = (s - (self.point(s) - x).dot(t) / square).clamp(0.0, 1.0);
            let d = distance(next);
            if d >= at || d.is_nan() {
                return (s, at);
            }
            (s, at) = (next, d);
        }
    }
}

/// Bisects for the place at which a condition begins to hold. It does not hold at `lo` and holds at `hi`.
fn bisect([mut lo, mut hi]: [f64; 2], holds: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..BISECTIONS {
        let s = 0.5 * (lo + hi);
        if holds(s) { hi = s } else { lo = s }
    }
    lo
}

#[cfg(test)]
mod tests {
    use super::*;

    fn segment() -> CubicSegment {
        let (a, b) = (DVec3::new(1.0, 2.0, 3.0), DVec3::new(2.0, 1.5, 4.0));
        CubicSegment { ends: [a, b], tangents: [DVec3::new(0.5, 0.7, 0.1), DVec3::new(1.1, -0.4, 0.9)] }
    }

    /// The Hermite segment of a cubic is this cubic: p(s) = (s³, s², s).
    #[test]
    fn it_is_the_cubic_of_its_ends() {
        let p = CubicSegment { ends: [DVec3::ZERO, DVec3::ONE], tangents: [DVec3::Z, DVec3::new(3.0, 2.0, 1.0)] };
        for s in [0.0, 0.25, 0.5, 0.8, 1.0] {
            assert!(p.point(s).distance(DVec3::new(s * s * s, s * s, s)) < 1e-15);
            assert!(p.tangent(s).distance(DVec3::new(3.0 * s * s, 2.0 * s, 1.0)) < 1e-15);
        }
    }

    #[test]
    fn a_part_and_the_way_back_are_the_same_curve() {
        let (whole, part, back) = (segment(), segment().until(0.3), segment().reversed());
        for s in [0.0, 0.2, 0.7, 1.0] {
            assert!(part.point(s).distance(whole.point(0.3 * s)) < 1e-15);
            assert!(back.point(1.0 - s).distance(whole.point(s)) < 1e-15);
            assert!(back.tangent(1.0 - s).distance(-whole.tangent(s)) < 1e-15);
        }
    }

    /// p(s) = (s, s − s², 0), and a cubic with a second bend out of its plane. The largest angle is found between the
    /// ends, as is the first place beyond an angle.
    #[test]
    fn the_largest_angle_is_found_between_the_ends() {
        // Directions (1, 1 − 2s): along (1, 0) the angle is 45° at both ends, and its limit is met at s = (1 − tan)/2.
        let bent = CubicSegment {
            ends: [DVec3::ZERO, DVec3::X],
            tangents: [DVec3::new(1.0, 1.0, 0.0), DVec3::new(1.0, -1.0, 0.0)],
        };
        let away = DVec3::new(-1.0, 0.0, 0.0);
        assert_eq!(bent.turned(away, -1.0), None);
        for degrees in [136.0f64, 150.0, 170.0, 179.0, 179.99] {
            // Away from −x the angle is largest in the middle, 180°.
            let s = bent.turned(away, degrees.to_radians().cos()).unwrap();
            let want = 0.5 * (1.0 - (180.0 - degrees).to_radians().tan());
            assert!((s - want).abs() < 1e-9, "{degrees}: {s} {want}");
        }
        assert_eq!(bent.turned(DVec3::X, 46f64.to_radians().cos()), None);
        // On any piece as a search in small steps has it.
        let p = segment();
        for along in [DVec3::X, DVec3::Y, DVec3::NEG_ONE.normalize(), -p.tangent(0.37).normalize()] {
            let cosine = |s: f64| p.tangent(s).normalize().dot(along);
            for cos in [0.9, 0.0, -0.7, -0.98, -0.999_999] {
                let searched = (0..=100_000).map(|i| f64::from(i) * 1e-5).find(|&s| cosine(s) < cos);
                match (p.turned(along, cos), searched) {
                    (Some(s), Some(want)) => assert!((s - want).abs() <= 1.1e-5, "{along} {cos}: {s} {want}"),
                    (found, searched) => assert_eq!(found, searched, "{along} {cos}"),
                }
            }
        }
    }

    /// p(s) = (1.2 + s, 0.1 + 3s², 2) meets x = 2 at 0.8 and y = 1 at √0.3. It stays on the face z = 2.
    #[test]
    fn faces_are_met() {
        let ends = [DVec3::new(1.2, 0.1, 2.0), DVec3::new(2.2, 3.1, 2.0)];
        let p = CubicSegment { ends, tangents: [DVec3::X, DVec3::new(1.0, 6.0, 0.0)] };
        let first = 0.3f64.sqrt();
        assert!((p.face([0.0, 1.0]).unwrap() - first).abs() < 1e-11);
        assert!((p.face([first + 1e-6, 1.0]).unwrap() - (1.9f64 / 3.0).sqrt()).abs() < 1e-11);
        assert_eq!([p.face([0.0, first - 1e-6]), p.face([0.9, 0.97]), p.face([0.6, 0.4])], [None; 3]);
        let back = p.reversed();
        assert!((back.face([0.1, 0.9]).unwrap() - 0.2).abs() < 1e-11);
        let finer = p.mapped(|x| x * 2.0, |t| t * 2.0);
        assert!((finer.face([0.0, 1.0]).unwrap() - 0.3).abs() < 1e-11);
    }

    #[test]
    fn the_nearest_point_is_found() {
        let p = segment();
        for s in [0.0, 0.13, 0.5, 0.77, 1.0] {
            let off = p.tangent(s).normalize().any_orthonormal_vector() * 0.05;
            let (found, distance) = p.nearest(p.point(s) + off);
            assert!((found - s).abs() < 1e-6 && (distance - 0.05).abs() < 1e-9, "{s} {found} {distance}");
        }
    }
}
