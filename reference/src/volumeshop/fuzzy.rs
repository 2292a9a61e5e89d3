//! Operators of fuzzy sets ([VS-3]; Zadeh 1965).

use crate::number::Real;
use drypoint_scene::shot::Fuzzy;

/// μ_{A ∩ B}: min(a, b), or ab.
#[inline]
pub fn intersection<R: Real>(fuzzy: Fuzzy, a: R, b: R) -> R {
    match fuzzy {
        Fuzzy::Zadeh => a.min(b),
        Fuzzy::Product => a * b,
    }
}

/// μ_{A ∪ B}: max(a, b), or a + b − ab.
#[inline]
pub fn union<R: Real>(fuzzy: Fuzzy, a: R, b: R) -> R {
    match fuzzy {
        Fuzzy::Zadeh => a.max(b),
        // Rounding may lead above 1.
        Fuzzy::Product => (a + b - a * b).min(R::ONE),
    }
}

/// μ_{A − B}: min(a, 1 − b), or a(1 − b).
#[inline]
pub fn difference<R: Real>(fuzzy: Fuzzy, a: R, b: R) -> R {
    intersection(fuzzy, a, R::ONE - b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const BOTH: [Fuzzy; 2] = [Fuzzy::Zadeh, Fuzzy::Product];

    #[test]
    fn by_hand() {
        let all = |fuzzy| [intersection(fuzzy, 0.25, 0.75), union(fuzzy, 0.25, 0.75), difference(fuzzy, 0.25, 0.75)];
        assert_eq!(all(Fuzzy::Zadeh), [0.25, 0.75, 0.25]);
        assert_eq!(all(Fuzzy::Product), [0.1875, 0.8125, 0.0625]);
        for fuzzy in BOTH {
            let with = |a| [union(fuzzy, a, 0.25), intersection(fuzzy, a, 0.25), difference(fuzzy, 0.25, 1.0 - a)];
            assert_eq!([with(1.0), with(0.0)], [[1.0, 0.25, 0.25], [0.25, 0.0, 0.0]]);
        }
    }

    proptest! {
        /// Commutative, associative, bounded by the smaller and the larger operand, and dual by complements.
        #[test]
        fn laws_of_fuzzy_sets([a, b, c] in prop::array::uniform3(0.0..=1.0f64)) {
            for fuzzy in BOTH {
                for op in [intersection::<f64>, union::<f64>] {
                    prop_assert_eq!(op(fuzzy, a, b), op(fuzzy, b, a));
                    prop_assert!((op(fuzzy, op(fuzzy, a, b), c) - op(fuzzy, a, op(fuzzy, b, c))).abs() < 1e-15);
                    prop_assert!((0.0..=1.0).contains(&op(fuzzy, a, b)));
                }
                prop_assert!(intersection(fuzzy, a, b) <= a.min(b) && union(fuzzy, a, b) >= a.max(b) - 1e-16);
                // De Morgan.
                let dual = 1.0 - intersection(fuzzy, 1.0 - a, 1.0 - b);
                prop_assert!((union(fuzzy, a, b) - dual).abs() < 1e-15);
                prop_assert_eq!(difference(fuzzy, a, b), intersection(fuzzy, a, 1.0 - b));
            }
        }
    }
}
