//! Fits of one cubic Bézier curve to several smooth ones (after Schneider, An algorithm for automatically fitting
//! digitized curves, Graphics Gems, 1990).

use drypoint_scene::glam::DVec2;

/// Start, two control points, end.
pub(super) type CubicBezier = [DVec2; 4];

/// Largest distance of a fitted curve from the original ones, in mm: half a dot at 2400 dpi.
pub(super) const ACCURACY: f64 = 0.005;

/// Most curves that one fit replaces.
const MOST: usize = 64;

/// Rounds of reparametrization: sample points move to their nearest points on the fit.
const ROUNDS: usize = 4;

/// Weight of the previous handle lengths against the sample points.
const HOLD: f64 = 0.01;

/// Distance, in units of [`ACCURACY`], above which no further rounds are tried.
const HOPELESS: f64 = 40.0;

/// Returns as few curves as stay within [`ACCURACY`] of a smooth run and keep the directions at their ends.
pub(super) fn fewer(run: &[CubicBezier]) -> impl Iterator<Item = CubicBezier> {
    let mut rest = run;
    std::iter::from_fn(move || {
        let mut found = *rest.first()?;
        // The number of curves doubles while they fit, then bisection finds the largest that fits.
        let (mut fits, mut too_many) = (1, rest.len().min(MOST) + 1);
        while fits + 1 < too_many {
            let next = if too_many <= MOST && too_many <= rest.len() { fits.midpoint(too_many) } else { 2 * fits };
            let next = next.min(too_many - 1);
            match one(&rest[..next]) {
                Some(cubic) => (found, fits) = (cubic, next),
                None => too_many = next,
            }
        }
        rest = &rest[fits..];
        Some(found)
    })
}

/// Returns one curve for several; none if it is farther than [`ACCURACY`] from them.
fn one(run: &[CubicBezier]) -> Option<CubicBezier> {
    let [first, .., last] = run else { return None };
    let ([from, leaves, ..], [.., comes, to]) = (*first, *last);
    let [leaves, comes] = [(leaves - from).try_normalize()?, (to - comes).try_normalize()?];
    // Four samples a curve, with their share of the chord length as first parameters.
    let places: Vec<DVec2> = run.iter().flat_map(|cubic| [0.25, 0.5, 0.75, 1.0].map(|t| at(cubic, t))).collect();
    let mut length = 0.0;
    let mut last = from;
    let mut along: Vec<f64> = places
        .iter()
        .map(|&place| {
            length += place.distance(std::mem::replace(&mut last, place));
            length
        })
        .collect();
    along.iter_mut().for_each(|t| *t /= length);
    // The end tangents are fixed, so that a fit has two unknowns: the lengths of its handles.
    let cubic = |[a, b]: [f64; 2]| [from, from + a * leaves, to - b * comes, to];
    let mut lengths = [from.distance(to) / 3.0; 2];
    for round in 0..ROUNDS {
        // The first round fits the whole distance. Later rounds, at the nearest points, fit only the part across the
        // curve.
        let mut sums = NormalEquations::default();
        let drawn = cubic(lengths);
        for (&place, &t) in places.iter().zip(&along) {
            let s = 1.0 - t;
            let [u, v] = [3.0 * s * s * t * leaves, -3.0 * s * t * t * comes];
            let rest = place - from * (s * s * (s + 3.0 * t)) - to * (t * t * (t + 3.0 * s));
            let across = if round == 0 { None } else { slope(&drawn, t).perp().try_normalize() };
            match across {
                Some(n) => sums.add(n.dot(u), n.dot(v), n.dot(rest)),
                None => (0..2).for_each(|axis| sums.add(u[axis], v[axis], rest[axis])),
            }
        }
        if round > 0 {
            sums.hold(lengths);
        }
        lengths = sums.solved().unwrap_or(lengths);
        let [a, b] = lengths;
        // Handles longer than the curve cross and make a loop.
        if !(a > 0.0 && b > 0.0 && a + b < length) {
            return None;
        }
        let drawn = cubic(lengths);
        let mut off: f64 = 0.0;
        for (place, t) in places.iter().zip(&mut along) {
            *t = nearer(&drawn, *place, *t);
            off = off.max(at(&drawn, *t).distance(*place));
        }
        if off <= ACCURACY && along.is_sorted() {
            return Some(drawn);
        }
        if off > HOPELESS * ACCURACY {
            return None;
        }
    }
    None
}

/// The normal equations of a u + b v = r.
#[derive(Default)]
struct NormalEquations {
    uu: f64,
    uv: f64,
    vv: f64,
    ur: f64,
    vr: f64,
}

impl NormalEquations {
    fn add(&mut self, u: f64, v: f64, r: f64) {
        self.uu += u * u;
        self.uv += u * v;
        self.vv += v * v;
        self.ur += u * r;
        self.vr += v * r;
    }

    /// Regularizes towards the given solution where the equations hardly determine it.
    fn hold(&mut self, [a, b]: [f64; 2]) {
        let weight = HOLD * (self.uu + self.vv);
        self.uu += weight;
        self.vv += weight;
        self.ur += weight * a;
        self.vr += weight * b;
    }

    /// Returns a and b; none if they are not independent, as on a straight line.
    fn solved(&self) -> Option<[f64; 2]> {
        let Self { uu, uv, vv, ur, vr } = *self;
        let over = uu * vv - uv * uv;
        (over > 1e-9 * uu * vv).then(|| [(ur * vv - vr * uv) / over, (vr * uu - ur * uv) / over])
    }
}

/// Returns the point of a curve at t.
fn at([a, b, c, d]: &CubicBezier, t: f64) -> DVec2 {
    let [p, q, r] = [a.lerp(*b, t), b.lerp(*c, t), c.lerp(*d, t)];
    p.lerp(q, t).lerp(q.lerp(r, t), t)
}

/// Returns a third of the derivative at t.
fn slope([a, b, c, d]: &CubicBezier, t: f64) -> DVec2 {
    let s = 1.0 - t;
    s * s * (*b - *a) + 2.0 * s * t * (*c - *b) + t * t * (*d - *c)
}

/// Returns t after one step of Newton's method towards the nearest point.
fn nearer(cubic: &CubicBezier, place: DVec2, t: f64) -> f64 {
    let [a, b, c, d] = *cubic;
    let s = 1.0 - t;
    let off = at(cubic, t) - place;
    let first = 3.0 * slope(cubic, t);
    let second = 6.0 * (s * (c - 2.0 * b + a) + t * (d - 2.0 * c + b));
    let slope = first.length_squared() + off.dot(second);
    if slope > 0.0 { (t - off.dot(first) / slope).clamp(0.0, 1.0) } else { t }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A curve cut into parts comes back whole, but for what it may miss.
    #[test]
    fn parts_of_one_curve_are_one() {
        let p = DVec2::new;
        for whole in [
            [p(0.0, 0.0), p(2.0, 0.0), p(4.0, 2.0), p(4.0, 4.0)],
            [p(0.0, 0.0), p(1.0, 1.0), p(2.0, -1.0), p(3.0, 0.0)],
            [p(0.0, 0.0), p(1.0, 0.0), p(2.0, 0.0), p(3.0, 0.0)],
        ] {
            let cut = |from: f64, to: f64| {
                let [first, last] = [from, to].map(|t| at(&whole, t));
                let [leaves, comes] = [from, to].map(|t| (to - from) * slope(&whole, t));
                [first, first + leaves, last - comes, last]
            };
            let run: Vec<CubicBezier> = [0.0, 0.1, 0.3, 0.55, 0.6, 1.0].windows(2).map(|t| cut(t[0], t[1])).collect();
            let found: Vec<CubicBezier> = fewer(&run).collect();
            assert_eq!(found.len(), 1, "{found:?}");
            for t in (0..=100).map(|i| f64::from(i) / 100.0) {
                let place = at(&found[0], t);
                let near =
                    (0..=2000).map(|i| at(&whole, f64::from(i) / 2000.0).distance(place)).fold(f64::MAX, f64::min);
                assert!(near < ACCURACY + 0.001, "{t}: {near}");
            }
        }
        assert_eq!(fewer(&[]).count(), 0);
    }

    /// A run that needs several curves keeps several, end by end.
    #[test]
    fn a_circle_is_four_at_least() {
        let run: Vec<CubicBezier> = (0..40)
            .map(|i| {
                let way = |i: u32| DVec2::from_angle(std::f64::consts::TAU * f64::from(i) / 40.0);
                let [a, b] = [way(i), way(i + 1)].map(|p| 20.0 * p);
                let handle = 20.0 * 4.0 / 3.0 * (std::f64::consts::TAU / 160.0).tan();
                [a, a + handle * way(i).perp(), b - handle * way(i + 1).perp(), b]
            })
            .collect();
        let found: Vec<CubicBezier> = fewer(&run).collect();
        assert!((4..=6).contains(&found.len()), "{}", found.len());
        assert!(found.windows(2).all(|pair| pair[0][3] == pair[1][0]));
        assert_eq!((found[0][0], found[found.len() - 1][3]), (run[0][0], run[39][3]));
        let round = found.iter().flat_map(|cubic| (0..=50).map(|i| at(cubic, f64::from(i) / 50.0).length()));
        assert!(round.map(|r| (r - 20.0).abs()).fold(0.0, f64::max) < 1.2 * ACCURACY);
    }
}
