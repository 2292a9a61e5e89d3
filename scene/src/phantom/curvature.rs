//! Principal curvatures from gradient and Hessian ([CUR-1]).

use glam::{DMat3, DVec3};

/// κ₁ ≥ κ₂, in 1 / world unit, of the iso-surface through a point with gradient `g` and Hessian `h`: the eigenvalues of
/// G = −P H P / ‖g‖ in the tangent plane, P = I − n nᵀ (Kindlmann et al. 2003), κ = m ± hypot((a − c)/2, b) on its 2×2
/// block [CUR-1]. On a sphere that is bright inside, both are positive. None where the gradient is 0 or not finite.
pub fn curvatures(g: DVec3, h: DMat3) -> Option<[f64; 2]> {
    let length = g.length();
    if !(length > 0.0 && length.is_finite()) {
        return None;
    }
    let (t, u) = (g / length).any_orthonormal_pair();
    let form = |v: DVec3, w: DVec3| -v.dot(h * w) / length;
    let (a, b, c) = (form(t, t), form(t, u), form(u, u));
    let (mean, half) = (0.5 * (a + c), 0.5 * (a - c));
    let radius = (half * half + b * b).sqrt();
    Some([mean + radius, mean - radius])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quadric_by_hand() {
        // f = −z − ½ (3 x² + 2·1·xy − y²): G is [[3, 1], [1, −1]] at the origin, κ = 1 ± √5.
        let h = DMat3::from_cols(DVec3::new(-3.0, -1.0, 0.0), DVec3::new(-1.0, 1.0, 0.0), DVec3::ZERO);
        let [k1, k2] = curvatures(DVec3::new(0.0, 0.0, -1.0), h).unwrap();
        let root = 5f64.sqrt();
        assert!((k1 - 1.0 - root).abs() < 1e-15 && (k2 - 1.0 + root).abs() < 1e-15);
        // The same surface with value and gradient doubled is the same surface.
        let twice = curvatures(DVec3::new(0.0, 0.0, -2.0), h * 2.0).unwrap();
        assert_eq!(twice, [k1, k2]);
    }

    #[test]
    fn no_gradient_no_curvature() {
        assert_eq!(curvatures(DVec3::ZERO, DMat3::IDENTITY), None);
        assert_eq!(curvatures(DVec3::splat(f64::NAN), DMat3::IDENTITY), None);
    }
}
