//! Eq. 5: more points where the gradient is large ([STIP-7]).

use super::unit;
use drypoint_scene::math::pow;
use drypoint_scene::shot::stipples::{Boundary, FactorRange};

/// T_b = V (k_gc + k_gs ‖∇V‖^k_ge), in [0, 1].
pub(super) fn boundary(t: &Boundary, range: FactorRange, value: f64, magnitude: f64) -> f64 {
    unit(range, t.gc + t.gs, value * (t.gc + t.gs * pow(magnitude, t.ge)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_worked() {
        let t = Boundary { gc: 0.25, gs: 0.5, ge: 2.0 };
        // ½ (¼ + ½·¼) = 0.1875.
        assert_eq!(boundary(&t, FactorRange::Clamp, 0.5, 0.5), 0.1875);
        assert_eq!(boundary(&t, FactorRange::Clamp, 1.0, 1.0), 0.75);
        // k_gc + k_gs below 1: normalizing changes nothing.
        assert_eq!(boundary(&t, FactorRange::Normalize, 1.0, 1.0), 0.75);
        let t = Boundary { gc: 0.5, gs: 1.5, ge: 1.0 };
        // 1·(½ + 1.5·½) = 1.25 is 1 clamped, and 1.25/2 normalized.
        assert_eq!(boundary(&t, FactorRange::Clamp, 1.0, 0.5), 1.0);
        assert_eq!(boundary(&t, FactorRange::Normalize, 1.0, 0.5), 0.625);
    }

    #[test]
    fn a_sharp_boundary_is_a_step_without_nan() {
        let t = Boundary { gc: 0.0, gs: 1.0, ge: 1e3 };
        let at = |magnitude| boundary(&t, FactorRange::Clamp, 1.0, magnitude);
        assert_eq!([at(1.0), at(0.0)], [1.0, 0.0]);
        // 2⁻¹⁰⁰⁰.
        assert!((0.0..1e-300).contains(&at(0.5)));
        // With exponent 0 the gradient has no influence, even if it is 0.
        let flat = Boundary { ge: 0.0, ..t };
        assert_eq!(boundary(&flat, FactorRange::Clamp, 1.0, 0.0), 1.0);
    }
}
