//! Principal directions by the matrix of section 3.1 ([HATCH-1]; Monga, Benayoun and Faugeras 1992).
//!
//! With G = ∇F and γ = √(g₀² + g₁²), two orthonormal vectors h = (g₁, −g₀, 0)/γ and f = (g₀g₂, g₁g₂, −γ²)/(γ‖G‖) = n
//! × h span the tangent plane. A direction v at the angle θ from h has the second derivative vᵀHv. Its extremes lie
//! where tan 2θ = 2hᵀHf/(hᵀHh − fᵀHf). (The paper prints +γ² in f, which is then no tangent.)
//!
//! 2θ is an angle in all four quadrants, as `atan2` gives it. Its cosine and sine are known, and those of θ follow by
//! roots alone, in a third of the time.

use crate::field::Outside;
use crate::field::curvature::Curvature;
use crate::number::{Sym3, Vec3};

/// √(a² + b²), and a and b divided by this root. Intermediate results neither overflow nor underflow. Two zeros give
/// 0 and [1, 0].
#[inline(always)]
fn polar(a: f64, b: f64) -> (f64, [f64; 2]) {
    let largest = a.abs().max(b.abs());
    if largest == 0.0 {
        return (0.0, [1.0, 0.0]);
    }
    // A division, not a product with the reciprocal: the reciprocal of the smallest numbers overflows.
    let (a, b) = (a / largest, b / largest);
    let root = (a * a + b * b).sqrt();
    (largest * root, [a / root, b / root])
}

/// Cosine and sine of half an angle in [−π, π], from the angle's cosine and sine. The radicand is a sum without
/// cancellation.
#[inline(always)]
fn half_angle([cos, sin]: [f64; 2]) -> [f64; 2] {
    let larger = (0.5 + 0.5 * cos.abs()).sqrt();
    let smaller = 0.5 * sin / larger;
    if cos >= 0.0 { [larger, smaller] } else { [smaller.abs(), larger.copysign(sin)] }
}

/// h and f for a gradient that was divided by its largest component, and the gradient's length. If γ = 0, h = x and f
/// = y.
#[inline(always)]
fn frame(g: Vec3<f64>) -> (Vec3<f64>, Vec3<f64>, f64) {
    let (gamma, [p, q]) = polar(g.x, g.y);
    if gamma == 0.0 {
        return (Vec3::new(1.0, 0.0, 0.0), Vec3::new(0.0, 1.0, 0.0), g.z.abs());
    }
    // The length is at least 1, since the largest component is.
    let length = (gamma * gamma + g.z * g.z).sqrt();
    (Vec3::new(q, -p, 0.0), Vec3::new(p * g.z, q * g.z, -gamma) * (1.0 / length), length)
}

/// Returns the principal curvatures and directions of the surface with gradient G and Hessian H, both in world space.
/// A common factor of G and H cancels. G must not be 0.
///
/// θ of the largest vᵀHv is that of `atan2`, so a denominator of 0 needs no special case. If numerator and
/// denominator are both 0, every direction is principal, and the result is some frame. [HATCH-3] decides which values
/// count as 0. The curvatures equal those of [`field::curvature`](crate::field::curvature).
#[inline]
pub fn principal(gradient: Vec3<f64>, hessian: Sym3<f64>, outside: Outside) -> Curvature<f64> {
    let largest = gradient.x.abs().max(gradient.y.abs()).max(gradient.z.abs());
    let (h, f, length) = frame(Vec3::new(gradient.x / largest, gradient.y / largest, gradient.z / largest));
    let (hh, hf, ff) = (hessian.form(h, h), hessian.form(h, f), hessian.form(f, f));
    // The largest and the smallest vᵀHv are m ± r.
    let (m, (r, double)) = (0.5 * (hh + ff), polar(0.5 * (hh - ff), hf));
    let [cos, sin] = half_angle(double);
    let (large, small) = (h * cos + f * sin, f * cos - h * sin);
    let norm = length * largest;
    match outside {
        Outside::Low => Curvature { k1: (r - m) / norm, k2: -(m + r) / norm, e1: small, e2: large },
        Outside::High => Curvature { k1: (m + r) / norm, k2: (m - r) / norm, e1: large, e2: small },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::curvature;
    use drypoint_scene::math;
    use drypoint_scene::philox::uniform;

    fn vector(v: [f64; 3]) -> Vec3<f64> {
        Vec3::new(v[0], v[1], v[2])
    }

    /// Numbers in [−1, 1).
    struct Random(u32);

    impl Random {
        fn next(&mut self) -> f64 {
            self.0 += 1;
            2.0 * uniform(11, [self.0, 0, 0], 0) - 1.0
        }

        fn vector(&mut self) -> Vec3<f64> {
            Vec3::new(self.next(), self.next(), self.next())
        }
    }

    /// (a bᵀ + b aᵀ)/2.
    fn product(a: Vec3<f64>, b: Vec3<f64>, s: f64) -> Sym3<f64> {
        let h = 0.5 * s;
        Sym3 {
            xx: s * a.x * b.x,
            xy: h * (a.x * b.y + a.y * b.x),
            xz: h * (a.x * b.z + a.z * b.x),
            yy: s * a.y * b.y,
            yz: h * (a.y * b.z + a.z * b.y),
            zz: s * a.z * b.z,
        }
    }

    fn sum(terms: &[Sym3<f64>]) -> Sym3<f64> {
        terms.iter().fold(Sym3::default(), |s, t| Sym3 {
            xx: s.xx + t.xx,
            xy: s.xy + t.xy,
            xz: s.xz + t.xz,
            yy: s.yy + t.yy,
            yz: s.yz + t.yz,
            zz: s.zz + t.zz,
        })
    }

    fn norm(h: Sym3<f64>) -> f64 {
        (h.xx * h.xx + h.yy * h.yy + h.zz * h.zz + 2.0 * (h.xy * h.xy + h.xz * h.xz + h.yz * h.yz)).sqrt()
    }

    /// θ = ½ atan2: roots and a quotient of numbers with a few roundings each.
    #[test]
    fn half_angles_are_those_of_the_arc_tangent() {
        let mut r = Random(1 << 24);
        for i in 0..10_000 {
            let size = 10f64.powi(i % 601 - 300);
            let (a, b) = (r.next() * size, r.next() * if i % 3 == 0 { size * 1e-12 } else { size });
            let (length, double) = polar(a, b);
            assert!((length / math::hypot(a, b) - 1.0).abs() <= 2.0 * f64::EPSILON);
            let theta = 0.5 * math::atan2(b, a);
            let [cos, sin] = half_angle(double);
            assert!((cos - math::cos(theta)).abs() <= 2.0 * f64::EPSILON, "{a:e} {b:e}");
            assert!((sin - math::sin(theta)).abs() <= 2.0 * f64::EPSILON, "{a:e} {b:e}");
        }
        assert_eq!(half_angle(polar(0.0, 0.0).1), [1.0, 0.0]);
        assert_eq!(half_angle(polar(-2.0, 0.0).1), [0.0, 1.0]);
    }

    /// The frame is orthonormal and tangent. With the sign that the paper prints, f is not tangent: then G·f =
    /// 2g₂γ/‖G‖.
    #[test]
    fn the_printed_sign_is_an_erratum() {
        let mut r = Random(0);
        for _ in 0..1000 {
            let g = r.vector();
            let g = g * (1.0 / g.x.abs().max(g.y.abs()).max(g.z.abs()));
            let (h, f, length) = frame(g);
            for zero in [g.dot(h), g.dot(f), h.dot(f), h.length() - 1.0, f.length() - 1.0, length - g.length()] {
                assert!(zero.abs() < 8.0 * f64::EPSILON, "{zero:e}");
            }
            let n = g * (1.0 / length);
            assert!((n.cross(h) - f).length() < 8.0 * f64::EPSILON);
            let printed = Vec3::new(f.x, f.y, -f.z);
            let gamma = math::hypot(g.x, g.y);
            assert!((g.dot(printed) - 2.0 * gamma * g.z / length).abs() < 8.0 * f64::EPSILON);
        }
    }

    /// Worked by hand: a vanishing denominator is θ = π/4, not an umbilic.
    #[test]
    fn a_denominator_of_zero_is_a_fine_answer() {
        // f = xy − z at the origin: G = (0, 0, −1), curved along the diagonals.
        let hessian = Sym3 { xy: 1.0, ..Sym3::default() };
        let c = principal(vector([0.0, 0.0, -1.0]), hessian, Outside::Low);
        assert!((c.k1 - 1.0).abs() < 1e-15 && (c.k2 + 1.0).abs() < 1e-15, "{c:?}");
        let half = 0.5f64.sqrt();
        assert!((c.e2.dot(vector([half, half, 0.0])).abs() - 1.0).abs() < 1e-15);
        assert!((c.e1.dot(vector([half, -half, 0.0])).abs() - 1.0).abs() < 1e-15);
        // A cylinder about z, bright inside: ½ around it.
        let around = Sym3 { xx: -1.0, yy: -1.0, ..Sym3::default() };
        let c = principal(vector([-2.0, 0.0, 0.0]), around, Outside::Low);
        assert_eq!((c.k1, c.k2, c.e1.y.abs(), c.e2.z.abs()), (0.5, 0.0, 1.0, 1.0));
        let dark = principal(vector([-2.0, 0.0, 0.0]), around, Outside::High);
        assert_eq!((dark.k1, dark.k2, dark.e2.y.abs()), (-0.0, -0.5, 1.0));
    }

    /// The paper's frame jumps where γ → 0; the lines do not. They equal the eigenvectors in another frame within 16
    /// u ‖H‖/(‖G‖ |κ₁ − κ₂|). 10⁵ random fields have gaps from 1 to 10⁻¹² and γ/‖G‖ from 1 to 10⁻³⁰⁰ ([HATCH-2]).
    #[test]
    fn the_paper_s_frame_and_another_give_the_same_lines() {
        let mut r = Random(1 << 20);
        let mut tested = 0;
        for i in 0..100_000 {
            let tilt = 10f64.powf(-150.0 * (r.next() + 1.0));
            let (x, y) = (r.next(), r.next());
            let across = tilt / x.hypot(y);
            let g = if i % 3 == 0 { r.vector() } else { Vec3::new(x * across, y * across, r.next()) };
            let size = 10f64.powi(i % 13 - 6);
            let g = g * size;
            let n = g * (1.0 / g.length());
            // A multiple of I in the tangent plane, a gap about some direction, and any part along the normal.
            let gap = 10f64.powf(-6.0 * (r.next() + 1.0));
            let along = r.vector();
            let t = n.cross(along) * (1.0 / n.cross(along).length());
            let identity = Sym3 { xx: 1.0, yy: 1.0, zz: 1.0, ..Sym3::default() };
            let hessian = sum(&[identity.scaled(r.next()), product(t, t, gap), product(n, r.vector(), 1.0)]);
            let hessian = hessian.scaled(10f64.powi(i % 7 - 3));
            let [paper, oracle] = [principal, curvature::principal].map(|f| f(g, hessian, Outside::Low));
            let bound = 8.0 * f64::EPSILON * norm(hessian) / (g.length() * (oracle.k1 - oracle.k2));
            for (a, b) in [(paper.e1, oracle.e1), (paper.e2, oracle.e2)] {
                assert!(a.cross(b).length() <= bound, "{i}: {:e} > {bound:e}", a.cross(b).length());
            }
            let rounding = 8.0 * f64::EPSILON * norm(hessian) / g.length();
            assert!((paper.k1 - oracle.k1).abs() <= rounding && (paper.k2 - oracle.k2).abs() <= rounding);
            tested += usize::from(bound < 1e-2);
        }
        assert!(tested > 90_000, "{tested}");
    }

    /// 2ᵏ times the values: the same bits.
    #[test]
    fn powers_of_two_cancel() {
        let mut r = Random(1 << 22);
        for k in [-900, -40, 1, 300] {
            let (g, h) =
                (r.vector(), sum(&[product(r.vector(), r.vector(), 1.0), product(r.vector(), r.vector(), 2.0)]));
            let two = math::scale_by_power_of_two(1.0, k);
            assert_eq!(principal(g, h, Outside::Low), principal(g * two, h.scaled(two), Outside::Low));
        }
    }
}
