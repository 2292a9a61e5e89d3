//! Curvature of the iso-surface through a point ([CUR-1], [CUR-2]).
//!
//! The shape operator is G = −P H P / ‖g‖ with P = I − nnᵀ, n = g/‖g‖ (Kindlmann, Whitaker, Tasdizen, Möller,
//! *Curvature-Based Transfer Functions for Direct Volume Rendering*, IEEE Visualization 2003), negated for
//! `outside = "high"`: a sphere that is bright inside has two positive curvatures. g and H belong to one field, as
//! [`Sampler::hessian`](super::Sampler::hessian) gives them; a common factor cancels. Where g is negligible ([PREC-3])
//! there is no surface, and the caller does not ask.

use super::Outside;
use crate::number::{Real, Sym3, Vec3};

/// Principal curvatures, in 1/(world unit), and their directions, orthonormal in the tangent plane; each direction is a
/// line, its sign means nothing.
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

/// G in the tangent plane of a surface: −H/‖g‖, of which only forms in tangent vectors are taken, so that P drops out.
struct Shape<R> {
    /// The outward normal, [NORM-1]'s N.
    n: Vec3<R>,
    hessian: Sym3<R>,
    /// −1/‖g‖, 1/‖g‖ for `outside = "high"`.
    scale: R,
}

impl<R: Real> Shape<R> {
    #[inline(always)]
    fn new(gradient: Vec3<R>, hessian: Sym3<R>, outside: Outside) -> Self {
        let inverse = R::ONE / gradient.length();
        let scale = match outside {
            Outside::Low => -inverse,
            Outside::High => inverse,
        };
        Self { n: gradient * scale, hessian, scale }
    }

    /// aᵀ G b of tangent vectors.
    #[inline(always)]
    fn form(&self, a: Vec3<R>, b: Vec3<R>) -> R {
        self.scale * self.hessian.form(a, b)
    }

    /// An orthonormal tangent frame, t × u = n, without a square root (Duff et al., *Building an Orthonormal Basis,
    /// Revisited*, JCGT 6(1), 2017).
    #[inline(always)]
    fn frame(&self) -> [Vec3<R>; 2] {
        let Vec3 { x, y, z } = self.n;
        let sign = if z < R::ZERO { -R::ONE } else { R::ONE };
        let a = -R::ONE / (sign + z);
        let b = x * y * a;
        [Vec3::new(R::ONE + sign * x * x * a, sign * b, -(sign * x)), Vec3::new(b, sign + y * y * a, -y)]
    }

    /// The 2×2 block (a, b; b, c) of G in a frame.
    #[inline(always)]
    fn block(&self, [t, u]: [Vec3<R>; 2]) -> [R; 3] {
        [self.form(t, t), self.form(t, u), self.form(u, u)]
    }
}

/// The principal curvatures and directions of the surface with gradient g and Hessian H.
///
/// κ = m ± hypot((a − c)/2, b) on the 2×2 block of G: at umbilics, where trace and norm lose half their digits, the
/// difference of the two keeps them. At an exact umbilic the directions are some frame.
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

/// κ_v, the normal curvature in the direction of the unit vector v projected to the tangent plane: tᵀ G t, t = Pv/‖Pv‖;
/// the mean curvature where the projection is lost to rounding, ‖Pv‖ ≤ 2⁻²⁶ ([CUR-2]).
#[inline]
pub fn along_view<R: Real>(gradient: Vec3<R>, hessian: Sym3<R>, v: Vec3<R>, outside: Outside) -> R {
    let shape = Shape::new(gradient, hessian, outside);
    // n × (v × n) is Pv without the cancellation of v − n(n·v).
    let across = v.cross(shape.n);
    let length = across.length();
    if length <= R::NO_DIRECTION {
        let [a, _, c] = shape.block(shape.frame());
        return (a + c) * R::HALF;
    }
    let t = shape.n.cross(across) * (R::ONE / length);
    shape.form(t, t)
}
