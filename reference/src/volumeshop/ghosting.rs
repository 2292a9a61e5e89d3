//! Ghosting (6.2; [VS-7]): fading of the background in front of an object.

use crate::number::Real;

/// The factor of an occluder's opacity: max(0, 1 − γ(2 − e)), where e in [0, 1] is its enhancement. γ = 0 changes
/// nothing, and γ = 1 removes everything. Enhanced places, such as contours of strong boundaries, fade last.
#[inline]
pub fn factor<R: Real>(gamma: R, enhancement: R) -> R {
    (R::ONE - gamma * (R::ONE + R::ONE - enhancement)).max(R::ZERO)
}

/// e = 1 − min(1, s_α + (1 − |N|)): the enhancement of a sample whose opacity eq. 8 enhances by s_α.
#[inline]
pub fn enhancement<R: Real>(s_alpha: R, magnitude: R) -> R {
    R::ONE - (s_alpha + (R::ONE - magnitude)).min(R::ONE)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn by_hand() {
        assert_eq!(factor(0.0, 0.3), 1.0);
        assert_eq!([0.0, 0.5, 1.0].map(|e| factor(1.0, e)), [0.0; 3]);
        assert_eq!([0.0, 0.5, 1.0].map(|e| factor(0.5, e)), [0.0, 0.25, 0.5]);
        assert_eq!(enhancement(0.25, 0.75), 0.5);
        assert_eq!([enhancement(1.0, 1.0), enhancement(0.0, 0.0), enhancement(0.0, 1.0)], [0.0, 0.0, 1.0]);
    }

    proptest! {
        /// The factor falls with γ and rises with e, within [0, 1].
        #[test]
        fn fading_is_monotone([g, h] in prop::array::uniform2(0.0..=1.0f64), [d, e] in prop::array::uniform2(0.0..=1.0f64)) {
            let ([g, h], [d, e]) = ([g.min(h), g.max(h)], [d.min(e), d.max(e)]);
            prop_assert!(factor(h, e) <= factor(g, e) && factor(g, d) <= factor(g, e));
            prop_assert!((0.0..=1.0).contains(&factor(g, e)));
        }
    }
}
