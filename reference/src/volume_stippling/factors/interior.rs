//! Eq. 9: parts with a small gradient become transparent ([STIP-11]).

use drypoint_scene::math::pow;
use drypoint_scene::shot::stipples::Interior;

/// T_t = ‖∇V‖^k_te.
pub(super) fn interior(t: &Interior, magnitude: f64) -> f64 {
    pow(magnitude, t.te)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_worked() {
        assert_eq!([0.0, 0.5, 1.0].map(|g| interior(&Interior { te: 2.0 }, g)), [0.0, 0.25, 1.0]);
        assert_eq!(interior(&Interior { te: 0.0 }, 0.0), 1.0);
        assert!((interior(&Interior { te: 0.5 }, 0.25) - 0.5).abs() < 1e-16);
    }
}
