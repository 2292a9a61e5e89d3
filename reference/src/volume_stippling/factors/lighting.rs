//! Eq. 10: fewer points where light falls ([STIP-12]).

use drypoint_scene::math::pow;
use drypoint_scene::shot::stipples::Lighting;

/// T_l = 1 − max(0, L·n)^k_le on surfaces that face the eye, 0 on others. k = 0 turns the factor off. `lit` is L·n,
/// `facing` n·E.
pub(super) fn lighting(t: &Lighting, lit: f64, facing: f64) -> f64 {
    if t.le == 0.0 {
        1.0
    } else if facing < 0.0 {
        0.0
    } else {
        // The product of two unit vectors can exceed 1 by rounding.
        1.0 - pow(lit.clamp(0.0, 1.0), t.le)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_worked() {
        let t = Lighting { le: 2.0, light: None };
        assert_eq!([-0.5, 0.0, 0.5, 1.0].map(|lit| lighting(&t, lit, 0.1)), [1.0, 1.0, 0.75, 0.0]);
        assert_eq!(lighting(&t, 0.5, -0.1), 0.0);
        assert_eq!(lighting(&t, 1f64.next_up(), 1.0), 0.0);
        let off = Lighting { le: 0.0, light: None };
        assert_eq!([lighting(&off, 0.5, -0.1), lighting(&off, 0.0, 0.1)], [1.0, 1.0]);
    }
}
