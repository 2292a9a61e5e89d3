//! Curvature of the iso-surface through a point ([CUR-1], [CUR-2]).
//!
//! The shape operator is G = −P H P / ‖g‖ with P = I − nnᵀ, n = g/‖g‖ (Kindlmann, Whitaker, Tasdizen, Möller,
//! *Curvature-Based Transfer Functions for Direct Volume Rendering*, IEEE Visualization 2003). G is negated for
//! `outside = "high"`. A sphere that is bright inside has two positive curvatures for `outside = "low"`. g and H belong
//! to one field, as [`Sampler::hessian`](super::Sampler::hessian) gives them, and a common factor cancels. If g is
//! negligible ([PREC-3]) there is no surface, and curvature must not be asked for.

use super::Outside;
use super::normal::outwards;
use crate::number::{Arithmetic, Mask, Real, Sym3, Vec3};

/// Principal curvatures, in 1/(world unit), and their directions, orthonormal in the tangent plane. The sign of a
/// direction means nothing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Curvature<R> {
    /// κ₁ ≥ κ₂, by value.
    pub k1: R,
    /// κ₂.
    pub k2: R,
    /// The direction of κ₁.
    pub e1: Vec3<R>,
    /// The direction of κ₂.
    pub e2: Vec3<R>,
}

impl<R: Real> Curvature<R> {
    /// (κ₁ + κ₂)/2.
    pub fn mean(&self) -> R {
        (self.k1 + self.k2) * R::HALF
    }

    /// κ₁κ₂.
    pub fn gaussian(&self) -> R {
        self.k1 * self.k2
    }
}

/// G in the tangent plane of a surface: −H/‖g‖. P drops out, because the form is evaluated for tangent vectors only.
struct Shape<R> {
    /// The outward normal, [NORM-1]'s N.
    n: Vec3<R>,
    hessian: Sym3<R>,
    /// −1/‖g‖; 1/‖g‖ for `outside = "high"`.
    scale: R,
}

impl<A: Arithmetic> Shape<A> {
    #[inline(always)]
    fn new(gradient: Vec3<A>, hessian: Sym3<A>, outside: Outside) -> Self {
        let scale = outwards(gradient.length(), outside);
        Self { n: gradient * scale, hessian, scale }
    }

    /// aᵀ G b of tangent vectors.
    #[inline(always)]
    fn form(&self, a: Vec3<A>, b: Vec3<A>) -> A {
        self.scale * self.hessian.form(a, b)
    }

    /// tᵀ G t in the direction t = Pv/‖Pv‖, and ‖Pv‖.
    #[inline(always)]
    fn along(&self, v: Vec3<A>) -> (A, A) {
        // n × (v × n) is Pv without the cancellation of v − n(n·v).
        let across = v.cross(self.n);
        let length = across.length();
        let t = self.n.cross(across) * (length.one() / length);
        (self.form(t, t), length)
    }

    /// An orthonormal tangent frame, t × u = n, without a square root (Duff et al., *Building an Orthonormal Basis,
    /// Revisited*, JCGT 6(1), 2017).
    #[inline(always)]
    fn frame(&self) -> [Vec3<A>; 2] {
        let Vec3 { x, y, z } = self.n;
        let one = z.one();
        let sign = A::select(z.below(z.zero()), -one, one);
        let a = -one / (sign + z);
        let b = x * y * a;
        [Vec3::new(one + sign * x * x * a, sign * b, -(sign * x)), Vec3::new(b, sign + y * y * a, -y)]
    }

    /// The 2×2 block (a, b; b, c) of G in a frame.
    #[inline(always)]
    fn block(&self, [t, u]: [Vec3<A>; 2]) -> [A; 3] {
        [self.form(t, t), self.form(t, u), self.form(u, u)]
    }
}

/// The principal curvatures and directions of the surface with gradient g and Hessian H.
///
/// κ = m ± hypot((a − c)/2, b) on the 2×2 block of G. Near umbilics, a formula from trace and norm loses half the
/// digits; the difference a − c keeps them. At an exact umbilic the directions are an arbitrary frame.
#[inline]
pub fn principal<R: Real>(gradient: Vec3<R>, hessian: Sym3<R>, outside: Outside) -> Curvature<R> {
    let shape = Shape::new(gradient, hessian, outside);
    let [t, u] = shape.frame();
    let [a, b, c] = shape.block([t, u]);
    let (m, h) = ((a + c) * R::HALF, (a - c) * R::HALF);
    let r = h.hypot(b);
    // (h + r, b) and (b, r − h) are both eigenvectors for m + r; the longer one is taken.
    let (p, q) = if h < R::ZERO { (b, r - h) } else { (h + r, b) };
    let length = p.hypot(q);
    let (p, q) = if length > R::ZERO { (p / length, q / length) } else { (R::ONE, R::ZERO) };
    Curvature { k1: m + r, k2: m - r, e1: t * p + u * q, e2: u * p - t * q }
}

/// κ_v, the normal curvature in the direction of the unit vector v projected to the tangent plane: tᵀ G t, t = Pv/‖Pv‖.
/// Returns the mean curvature if the projection is lost to rounding, ‖Pv‖ ≤ 2⁻²⁶ ([CUR-2]).
#[inline(always)]
pub fn along_view<A: Arithmetic>(gradient: Vec3<A>, hessian: Sym3<A>, v: Vec3<A>, outside: Outside) -> A {
    let shape = Shape::new(gradient, hessian, outside);
    let (kappa, length) = shape.along(v);
    let lost = length.at_most(length.constant(A::Number::NO_DIRECTION));
    if !lost.any() {
        return kappa;
    }
    let [a, _, c] = shape.block(shape.frame());
    A::select(lost, (a + c).half(), kappa)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::number::lanes::{LANES, wide};
    use fearless_simd::f64x8;
    use fearless_simd::prelude::*;
    use nalgebra::{Matrix3, SymmetricEigen, Vector3};
    use proptest::prelude::*;

    fn vector(v: [f64; 3]) -> Vec3<f64> {
        Vec3::new(v[0], v[1], v[2])
    }

    fn sym([xx, xy, xz, yy, yz, zz]: [f64; 6]) -> Sym3<f64> {
        Sym3 { xx, xy, xz, yy, yz, zz }
    }

    /// The apex of a paraboloid and a plane: no direction is principal there, and some frame is given, not a quotient of 0.
    #[test]
    fn an_exact_umbilic_has_some_frame() {
        for curved in [0.0, -2.0, 0.5] {
            let c = principal(vector([0.0, 0.0, -4.0]), sym([curved, 0.0, 0.0, curved, 0.0, 1.0]), Outside::Low);
            assert_eq!(c.k1, c.k2);
            for (e, other) in [(c.e1, c.e2), (c.e2, c.e1)] {
                assert!(
                    (e.length() - 1.0).abs() < 1e-15 && e.z == 0.0 && e.dot(other).abs() < 1e-15,
                    "{e:?} {other:?}"
                );
            }
        }
    }

    /// G = −PHP/‖g‖ as it is written, and n.
    fn shape_operator(g: Vec3<f64>, h: Sym3<f64>) -> (Matrix3<f64>, Vector3<f64>) {
        let g = Vector3::new(g.x, g.y, g.z);
        let h = Matrix3::new(h.xx, h.xy, h.xz, h.xy, h.yy, h.yz, h.xz, h.yz, h.zz);
        let n = g / g.norm();
        let p = Matrix3::identity() - n * n.transpose();
        (-(p * h * p) / g.norm(), n)
    }

    #[test]
    fn a_bright_sphere_has_two_equal_positive_curvatures() {
        // f = −(x² + y² + z²)/2: g = −p, H = −I, κ = 1/‖p‖ at every point.
        for p in [[3.0, 0.0, 0.0], [0.0, 0.0, -2.0], [1.0, 2.0, 2.0], [1e-3, 5.0, -7.0], [-0.3, -0.4, -1e-9]] {
            let p = vector(p);
            let c = principal(-p, sym([-1.0, 0.0, 0.0, -1.0, 0.0, -1.0]), Outside::Low);
            let want = 1.0 / p.length();
            // An umbilic: both to a few last places, not to the root of one.
            assert!((c.k1 - want).abs() <= 4.0 * f64::EPSILON * want, "{c:?}");
            assert!((c.k2 - want).abs() <= 4.0 * f64::EPSILON * want, "{c:?}");
            let dark = principal(-p, sym([-1.0, 0.0, 0.0, -1.0, 0.0, -1.0]), Outside::High);
            assert_eq!((dark.k1, dark.k2), (-c.k2, -c.k1));
        }
    }

    #[test]
    fn a_cylinder_and_a_saddle() {
        // f = −(x² + y²)/2 at (2, 0, 5): ½ around, 0 along z.
        let c = principal(vector([-2.0, 0.0, 0.0]), sym([-1.0, 0.0, 0.0, -1.0, 0.0, 0.0]), Outside::Low);
        assert_eq!((c.k1, c.k2), (0.5, 0.0));
        assert_eq!((c.e1.y.abs(), c.e2.z.abs()), (1.0, 1.0));
        // f = (y² − x²)/2 − z at the origin: outwards is +z; it falls away along x.
        let c = principal(vector([0.0, 0.0, -1.0]), sym([-1.0, 0.0, 0.0, 1.0, 0.0, 0.0]), Outside::Low);
        assert_eq!((c.k1, c.k2, c.mean(), c.gaussian()), (1.0, -1.0, 0.0, -1.0));
        assert_eq!((c.e1.x.abs(), c.e2.y.abs()), (1.0, 1.0));
    }

    /// Looking along the normal there is no direction in the tangent plane; looking past it there is.
    #[test]
    fn along_the_normal_the_mean_curvature() {
        let (g, h) = (vector([0.0, 0.0, -1.0]), sym([-3.0, 0.0, 0.0, -1.0, 0.0, 0.0]));
        assert_eq!(along_view(g, h, vector([0.0, 0.0, 1.0]), Outside::Low), 2.0);
        assert_eq!(along_view(g, h, vector([0.0, 0.0, -1.0]), Outside::Low), 2.0);
        let tilted = |sin: f64| vector([sin, 0.0, (1.0 - sin * sin).sqrt()]);
        assert_eq!(along_view(g, h, tilted(2f64.powi(-27)), Outside::Low), 2.0);
        assert_eq!(along_view(g, h, tilted(2f64.powi(-25)), Outside::Low), 3.0);
        assert_eq!(along_view(g, h, tilted(2f64.powi(-25)), Outside::High), -3.0);
    }

    /// The bound in f32 is 2⁻¹²: a unit vector is off by 2⁻²⁴, and so is the rest of it in the tangent plane.
    #[test]
    fn along_the_normal_in_f32() {
        let g = Vec3::new(0.0f32, 0.0, -1.0);
        let h = Sym3 { xx: -3.0f32, xy: 0.0, xz: 0.0, yy: -1.0, yz: 0.0, zz: 0.0 };
        for (power, kappa) in [(-24, 2.0), (-13, 2.0), (-11, 3.0)] {
            let tilted = Vec3::new(2f32.powi(power), 0.0, 1.0);
            assert_eq!(along_view(g, h, tilted, Outside::Low), kappa, "2^{power}");
        }
    }

    /// View directions along the normal, past it, and in every direction between, next to any other lanes.
    #[test]
    fn lanes_have_the_bits_of_one() {
        let Some(simd) = wide() else { return };
        let bound = 1e-3;
        let z = |length: f64| [0.0, 0.0, length];
        let tilted = |sin: f64| [sin, 0.0, (1.0 - sin * sin).sqrt()];
        let [past, within] = [-25, -27].map(|power| tilted(2f64.powi(power)));
        let gradients = [z(-1.0), z(-1.0), z(3.0), z(-1.0), [1.0, -2.0, 0.5], z(0.0), z(-bound), z(-bound.next_up())];
        let views = [z(1.0), z(-1.0), within, past, [0.6, 0.0, 0.8], z(1.0), [0.6, 0.0, 0.8], z(1.0)];
        let h = [-3.0, 0.5, 0.25, -1.0, -0.125, 2.0];
        let column = |vectors: &[[f64; 3]; LANES], axis: usize| f64x8::simd_from(simd, vectors.map(|v| v[axis]));
        let columns =
            |vectors: &[[f64; 3]; LANES]| Vec3::new(column(vectors, 0), column(vectors, 1), column(vectors, 2));
        let [xx, xy, xz, yy, yz, zz] = h.map(|x| f64x8::splat(simd, x));
        // Each in each lane: what is done lane by lane is done where it has to be.
        for turn in 0..LANES {
            let turned = |vectors: [[f64; 3]; LANES]| std::array::from_fn(|lane| vectors[(lane + turn) % LANES]);
            let (gradients, views): ([[f64; 3]; LANES], [[f64; 3]; LANES]) = (turned(gradients), turned(views));
            for outside in [Outside::Low, Outside::High] {
                let all = Sym3 { xx, xy, xz, yy, yz, zz };
                let got = along_view(columns(&gradients), all, columns(&views), outside);
                for lane in (0..LANES).filter(|&lane| vector(gradients[lane]).length() > bound) {
                    let want = along_view(vector(gradients[lane]), sym(h), vector(views[lane]), outside);
                    assert_eq!(got[lane].to_bits(), want.to_bits(), "{:?} {:?} {want}", gradients[lane], views[lane]);
                }
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(200))]

        /// Comparison with the eigenvectors of the 3×3 matrix, by another library. Both sides round −PHP/‖g‖ with at
        /// most some twenty operations on numbers up to ‖H‖/‖g‖.
        #[test]
        fn principal_curvatures_are_eigenvalues(
            g in prop::array::uniform3(-10.0f64..10.0),
            h in prop::array::uniform6(-10.0f64..10.0),
            v in prop::array::uniform3(-1.0f64..1.0),
        ) {
            let (g, h, v) = (vector(g), sym(h), vector(v));
            prop_assume!(g.length() > 0.1 && v.length() > 0.1);
            let c = principal(g, h, Outside::Low);
            let (matrix, n) = shape_operator(g, h);
            let eigen = SymmetricEigen::new(matrix);
            // The third eigenvector is n, with eigenvalue 0.
            let along_n = |i: usize| eigen.eigenvectors.column(i).dot(&n).abs();
            let normal = (0..3).max_by(|&i, &j| along_n(i).total_cmp(&along_n(j))).unwrap();
            let mut want: Vec<f64> = (0..3).filter(|&i| i != normal).map(|i| eigen.eigenvalues[i]).collect();
            want.sort_by(|a, b| b.total_cmp(a));
            let size = 10.0 * 3.0 / g.length();
            let bound = 64.0 * f64::EPSILON * size;
            // Where an eigenvalue is near 0 its vector and n mix, and the oracle's own choice is uncertain.
            if along_n(normal) > 0.999 {
                prop_assert!((c.k1 - want[0]).abs() <= bound && (c.k2 - want[1]).abs() <= bound, "{c:?} {want:?}");
            }
            prop_assert!(c.k1 >= c.k2);
            let frame = [c.e1, c.e2].map(|e| Vector3::new(e.x, e.y, e.z));
            for (e, k) in frame.iter().zip([c.k1, c.k2]) {
                prop_assert!((e.norm() - 1.0).abs() <= 8.0 * f64::EPSILON && e.dot(&n).abs() <= 8.0 * f64::EPSILON);
                prop_assert!((matrix * e - e * k).norm() <= bound, "G e = κ e");
            }
            prop_assert!(frame[0].dot(&frame[1]).abs() <= 8.0 * f64::EPSILON);

            // Euler: κ_v = κ₁ cos² + κ₂ sin² of the angle from e₁.
            let v = v * (1.0 / v.length());
            let (p, q) = (v.dot(c.e1), v.dot(c.e2));
            let sine = (p * p + q * q).sqrt();
            if sine > 1e-3 {
                let want = (c.k1 * p * p + c.k2 * q * q) / (p * p + q * q);
                let got = along_view(g, h, v, Outside::Low);
                prop_assert!((got - want).abs() <= bound / sine, "{got} {want}");
            }
        }

        /// A surface 10⁻¹² away from an umbilic keeps the difference of its curvatures to four digits: the block's
        /// entries are off by an ε of κ, the square root of a discriminant would be by √ε.
        #[test]
        fn near_umbilics_the_difference_is_kept(angle in 0.0f64..6.0, p in prop::array::uniform3(0.2f64..1.0)) {
            // G = I + δ (e eᵀ − u uᵀ)/2 in the frame of the normal: κ₁ − κ₂ = δ.
            let n = vector(p) * (1.0 / vector(p).length());
            let shape = Shape { n, hessian: Sym3::default(), scale: 1.0 };
            let [t, u] = shape.frame();
            let (cos, sin) = (angle.cos(), angle.sin());
            let (a, b) = (t * cos + u * sin, u * cos - t * sin);
            let delta = 1e-12;
            let entry = |i: fn(Vec3<f64>) -> f64, j: fn(Vec3<f64>) -> f64, one: f64| {
                -(one + delta * 0.5 * (i(a) * j(a) - i(b) * j(b)))
            };
            let (x, y, z) = (|v: Vec3<f64>| v.x, |v: Vec3<f64>| v.y, |v: Vec3<f64>| v.z);
            let h = sym([entry(x, x, 1.0), entry(x, y, 0.0), entry(x, z, 0.0), entry(y, y, 1.0), entry(y, z, 0.0), entry(z, z, 1.0)]);
            let c = principal(-n, h, Outside::Low);
            prop_assert!((c.k1 - c.k2 - delta).abs() <= 16.0 * f64::EPSILON, "{}", c.k1 - c.k2);
        }
    }
}
