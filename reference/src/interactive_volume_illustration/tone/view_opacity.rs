//! View-dependent opacity: a translucent surface is more opaque where it turns away from the eye ([HATCH-15]).

/// α' = 1 − (1 − α)^(1 + s(1/max(|N·V|, 2⁻⁶) − 1)).
///
/// With s = 1 the exponent is 1/|N·V|: the ray through a thin layer seen at a slant is longer by this factor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ViewOpacity {
    /// The strength s.
    strength: f64,
}

/// The lower bound of |N·V|.
const FLOOR: f64 = 1.0 / 64.0;

impl ViewOpacity {
    /// View-dependent opacity of a strength. Returns none if the strength is 0, since the exponent is then 1
    /// everywhere.
    pub fn new(strength: f64) -> Option<Self> {
        (strength > 0.0).then_some(Self { strength })
    }

    /// The exponent for N·V of either sign: at least 1, and 1 where the surface faces the eye.
    #[inline]
    pub fn exponent(self, n_dot_v: f64) -> f64 {
        // The product of unit vectors may round to a number above 1.
        let n_dot_v = n_dot_v.abs().clamp(FLOOR, 1.0);
        1.0 + self.strength * (1.0 / n_dot_v - 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponents_by_hand() {
        let at = |s: f64, x: f64| ViewOpacity::new(s).unwrap().exponent(x);
        for s in [0.25, 1.0, 3.0] {
            assert_eq!([1.0, -1.0, 1.0 + f64::EPSILON].map(|x| at(s, x)), [1.0; 3]);
            assert_eq!([0.5, -0.5].map(|x| at(s, x)), [1.0 + s; 2]);
            // 2⁻⁶ is the floor: 1 + s·63.
            assert_eq!([1.0 / 64.0, 1e-3, 0.0].map(|x| at(s, x)), [1.0 + 63.0 * s; 3]);
        }
        assert_eq!(ViewOpacity::new(1.0).unwrap().exponent(0.25), 4.0);
        assert_eq!(ViewOpacity::new(0.0), None);
    }
}
