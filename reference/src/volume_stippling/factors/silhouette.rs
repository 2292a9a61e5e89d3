//! Eq. 6: more points where surfaces turn away from the eye ([STIP-8]).

use super::unit;
use drypoint_scene::math::pow;
use drypoint_scene::shot::stipples::{FactorRange, Silhouette};

/// T_s = V (k_sc + k_ss (1 − |n·E|)^k_se), in [0, 1]. `facing` is n·E. As printed, with ∇V between the bars, the term
/// is ‖∇V‖ n·E.
pub(super) fn silhouette(t: &Silhouette, range: FactorRange, value: f64, magnitude: f64, facing: f64) -> f64 {
    let within = if t.literal { magnitude * facing } else { facing };
    // The product of two unit vectors can exceed 1 by rounding.
    let across = (1.0 - within.abs()).max(0.0);
    unit(range, t.sc + t.ss, value * (t.sc + t.ss * pow(across, t.se)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_worked() {
        let t = Silhouette { sc: 0.25, ss: 0.5, se: 2.0, literal: false };
        // 0.8·(¼ + ½·0.5²) = 0.3, whichever way the normal points.
        for facing in [0.5, -0.5] {
            assert!((silhouette(&t, FactorRange::Clamp, 0.8, 0.1, facing) - 0.3).abs() < 1e-16);
        }
        // The printed form: 1 − |0.1·0.5| = 0.95.
        let literal = Silhouette { literal: true, ..t };
        let want = 0.8 * (0.25 + 0.5 * 0.95 * 0.95);
        assert!((silhouette(&literal, FactorRange::Clamp, 0.8, 0.1, 0.5) - want).abs() < 1e-16);
        let fig9 = Silhouette { sc: 0.5, ss: 5.0, se: 1.0, literal: false };
        assert_eq!(silhouette(&fig9, FactorRange::Clamp, 1.0, 1.0, 0.5), 1.0);
        // (½ + 5·½)/5.5.
        assert!((silhouette(&fig9, FactorRange::Normalize, 1.0, 1.0, 0.5) - 3.0 / 5.5).abs() < 1e-16);
    }

    #[test]
    fn rounding_above_one_is_no_nan() {
        let t = Silhouette { sc: 0.0, ss: 1.0, se: 1.11, literal: false };
        assert_eq!(silhouette(&t, FactorRange::Clamp, 1.0, 1.0, 1f64.next_up()), 0.0);
        assert_eq!(silhouette(&t, FactorRange::Clamp, 1.0, 1.0, 0.0), 1.0);
    }
}
