//! Triaxial ellipsoid: d = ± ‖p − x‖, x the nearest point of x²/a² + y²/b² + z²/c² = 1, positive inside.
//!
//! The nearest point is xᵢ = aᵢ² pᵢ / (t + aᵢ²) with t the largest root of Σ (aᵢ pᵢ / (t + aᵢ²))² = 1 (D. Eberly:
//! Distance from a point to an ellipse, an ellipsoid, or a hyperellipsoid, 2013). With c the smallest half axis,
//! u = 1 + t/c² and rᵢ = (aᵢ/c)² that is
//!
//! g(u) = Σ (rᵢ pᵢ/aᵢ / (u + rᵢ − 1))² − 1 = 0, u ≥ 0, d = (1 − u) √(Σ (pᵢ / (u + rᵢ − 1))²).
//!
//! u is 1 on the surface and 0 on the medial surface, the part of the plane across c where the nearest point is not
//! unique; on it, f has no derivative. Elsewhere derivatives are exact: two of Newton's steps on jets.
//!
//! The surface has the curvatures a/b² and a/c² at the end of the axis a, and likewise for the other axes. At depth d
//! they are κ / (1 − d κ), κ those at the nearest point.

use super::jet::{Scalar, length};
use super::params::{About, Allowed, HIGH, Param, Preset, W};
use super::placed::Formula;

pub(super) const ELLIPSOID: About = About {
    name: "ellipsoid",
    doc: "distance to a triaxial ellipsoid (x/a)² + (y/b)² + (z/c)² = 1",
    params: &[
        Param { name: "a", doc: "half axis along x", default: Preset::Side(0.42), allowed: Allowed::Positive },
        Param { name: "b", doc: "half axis along y", default: Preset::Side(0.3), allowed: Allowed::Positive },
        Param { name: "c", doc: "half axis along z", default: Preset::Side(0.2), allowed: Allowed::Positive },
        W,
        HIGH,
    ],
    build: |args| {
        let [a, b, c, w, high] = args.values();
        Ok(args.distance(Ellipsoid::new([a, b, c]), w, high))
    },
};

/// The share of the half axis below which a coordinate counts as 0: its reciprocal's cube would overflow.
const TINY: f64 = 1e-90;

struct Ellipsoid {
    axes: [f64; 3],
    /// The smallest half axis.
    c: f64,
    /// rᵢ − 1 = (aᵢ − c)(aᵢ + c) / c², without cancellation.
    excess: [f64; 3],
}

impl Ellipsoid {
    fn new(axes: [f64; 3]) -> Self {
        let c = axes[0].min(axes[1]).min(axes[2]);
        Self { axes, c, excess: axes.map(|a| (a - c) / c * ((a + c) / c)) }
    }

    /// g(u) and g′(u) at p. At u = 0 a coordinate along the smallest half axis is 0 and adds nothing.
    fn equation<S: Scalar>(&self, p: [S; 3], u: S) -> [S; 2] {
        let mut sum = [S::constant(-1.0), S::constant(0.0)];
        for i in (0..3).filter(|&i| u.real() + self.excess[i] != 0.0) {
            let below = u + self.excess[i];
            let square = (p[i] * ((self.excess[i] + 1.0) / self.axes[i]) / below).squared();
            sum = [sum[0] + square, sum[1] - square / below * 2.0];
        }
        sum
    }

    /// The root u; 0 where p lies on the medial surface.
    fn root(&self, p: [f64; 3]) -> f64 {
        // Each term of g alone is at most 1, which bounds u from below.
        let bound = |i: usize| (self.excess[i] + 1.0) * (p[i].abs() / self.axes[i]) - self.excess[i];
        let mut u = bound(0).max(bound(1)).max(bound(2)).max(0.0);
        if u == 0.0 && self.equation(p, 0.0)[0] <= 0.0 {
            return 0.0;
        }
        // g falls and is convex, so Newton's steps from the left never pass the root; they end where rounding does.
        for _ in 0..100 {
            let [g, slope] = self.equation(p, u);
            let next = u - g / slope;
            if next <= u || next.is_nan() {
                break;
            }
            u = next;
        }
        u
    }

    /// The distance where u = 0: all coordinates across the smallest axis are 0, and the nearest points lie on either
    /// side of the medial surface.
    fn on_medial(&self, p: [f64; 3]) -> f64 {
        let (mut rest, mut square) = (1.0, 0.0);
        for i in (0..3).filter(|&i| self.excess[i] != 0.0) {
            let share = p[i] / self.excess[i];
            square += share * share;
            rest -= (share * ((self.excess[i] + 1.0) / self.axes[i])).powi(2);
        }
        // Rounding may leave −ε at the rim.
        (square + self.c * self.c * rest.max(0.0)).sqrt()
    }
}

impl Formula for Ellipsoid {
    fn at<S: Scalar>(&self, p: [S; 3]) -> S {
        let flush = |i: usize| if p[i].real().abs() < TINY * self.axes[i] { 0.0 } else { p[i].real() };
        let place = std::array::from_fn(flush);
        let root = self.root(place);
        if root == 0.0 {
            return S::constant(self.on_medial(place));
        }
        // From the root's value alone, the first step finds its gradient and the second its Hessian.
        let mut u = S::constant(root);
        for _ in 0..2 {
            let [g, slope] = self.equation(p, u);
            u = u - g / slope;
        }
        let share = |i: usize| p[i] / (u + self.excess[i]);
        (S::constant(1.0) - u) * length([share(0), share(1), share(2)])
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::{assert_near, made};
    use super::*;
    use glam::DVec3;

    const AXES: [f64; 3] = [0.4, 0.3, 0.2];

    #[test]
    fn vertices_by_hand() {
        let (ellipsoid, centre) = made("ellipsoid", &[("a", 0.4), ("b", 0.3), ("c", 0.2)]);
        for i in 0..3 {
            let (a, others) = (AXES[i], [AXES[(i + 1) % 3], AXES[(i + 2) % 3]]);
            for side in [-1.0, 1.0] {
                let p = centre + DVec3::AXES[i] * (side * a);
                assert_near(ellipsoid.value(p), 0.0, 1e-16);
                let mut want = others.map(|b| a / (b * b));
                want.sort_by(|x, y| y.total_cmp(x));
                let got = ellipsoid.curvatures(p).unwrap();
                assert_near(got[0], want[0], 1e-13);
                assert_near(got[1], want[1], 1e-13);
                assert!((ellipsoid.gradient(p) + DVec3::AXES[i] * side).length() < 1e-14);
            }
            // Outside on the axis the vertex is the nearest point: radii of curvature grow by the distance.
            let p = centre + DVec3::AXES[i] * (a + 0.25);
            assert_near(ellipsoid.value(p), -0.25, 1e-15);
            let k = others[0].min(others[1]).powi(2) / a;
            assert_near(ellipsoid.curvatures(p).unwrap()[0], 1.0 / (k + 0.25), 1e-13);
        }
    }

    #[test]
    fn known_nearest_points_are_found() {
        // From a point x of the surface along its normal by h: the nearest point of x + h n is x, down to the smaller
        // radius of curvature (here at least c²/a = 0.1 inside). Rounding of p moves d by ε.
        let ellipsoid = Ellipsoid::new(AXES);
        for k in 0..200 {
            let (theta, phi) = (0.1 + 2.9 * f64::from(k) / 200.0, f64::from(k) * 2.4);
            let dir = [theta.sin() * phi.cos(), theta.sin() * phi.sin(), theta.cos()];
            let x = DVec3::from_array(std::array::from_fn(|i| AXES[i] * dir[i]));
            let n = DVec3::from_array(std::array::from_fn(|i| dir[i] / AXES[i])).normalize();
            for h in [-0.09, -1e-9, 0.0, 0.03, 2.0] {
                assert_near(ellipsoid.at((x + n * h).to_array()), -h, 1e-15);
            }
        }
    }

    #[test]
    fn the_medial_surface_and_its_neighbourhood() {
        let ellipsoid = Ellipsoid::new(AXES);
        assert_eq!(ellipsoid.at([0.0; 3]), 0.2);
        // In the plane across c the nearest points of (x, 0, 0) have x / (1 − c²/a²): at x = 0.15 that is 0.2, where
        // the surface is c √0.75 high: d² = 0.05² + 0.03.
        let d = 0.0325f64.sqrt();
        assert_near(ellipsoid.at([0.15, 0.0, 0.0]), d, 1e-16);
        for z in [1e-300, 1e-120, 1e-60, 1e-17, 1e-9] {
            // Leaving that plane brings the surface nearer by less than z.
            assert_near(ellipsoid.at([0.15, 0.0, z]), d, 1e-15 + z);
        }
        // Beyond the medial surface the vertex is nearest: it ends at a − c²/a = 0.3.
        assert_near(ellipsoid.at([0.35, 0.0, 0.0]), 0.05, 1e-15);
        // Spheroids and spheres: two or three coordinates across the smallest axis.
        assert_near(Ellipsoid::new([0.4, 0.2, 0.2]).at([0.15, 0.0, 0.0]), d, 1e-16);
        assert_eq!(Ellipsoid::new([0.5; 3]).at([0.0; 3]), 0.5);
        assert_near(Ellipsoid::new([0.5; 3]).at([0.0, 0.3, 0.4]), 0.0, 1e-16);
    }

    #[test]
    fn a_needle_and_a_disc() {
        // Half axes over six decades; the far vertices are still exact to rounding of the largest axis.
        for axes in [[1.0, 1e-6, 1e-6], [1.0, 1.0, 1e-6]] {
            let ellipsoid = Ellipsoid::new(axes);
            assert_near(ellipsoid.at([1.5, 0.0, 0.0]), -0.5, 1e-15);
            assert_near(ellipsoid.at([0.0, 0.0, 0.25]), 1e-6 - 0.25, 1e-15);
        }
    }
}
