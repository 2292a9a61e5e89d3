//! Selection sets at a place (eq. 1; [VS-3]): the shares of the background and of the selections in it.

use super::fuzzy;
use crate::number::Real;
use drypoint_scene::shot::Fuzzy;

/// The membership of the background's selection set, and the factor of each f_i that a ghost has: 1, or 1/max(1, Σf).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shares<R> {
    /// μ_{S_B}.
    pub background: R,
    /// The factor of f_i.
    pub of_each: R,
}

impl<R: Real> Shares<R> {
    /// The shares without a selection.
    pub fn whole() -> Self {
        Self { background: R::ONE, of_each: R::ONE }
    }

    /// The shares of selections with memberships f_i and of the background. Zadeh: f_i, and 1 − max f_i for the
    /// background. Product: f_i/max(1, Σf_i), and max(0, 1 − Σf_i), which sum to 1.
    pub fn beside(fuzzy: Fuzzy, selections: impl Iterator<Item = R>) -> Self {
        match fuzzy {
            Fuzzy::Zadeh => {
                let largest = selections.fold(R::ZERO, |most, f| fuzzy::union(fuzzy, most, f));
                Self { background: R::ONE - largest, of_each: R::ONE }
            }
            Fuzzy::Product => {
                let sum = selections.fold(R::ZERO, |sum, f| sum + f);
                let over = sum.max(R::ONE);
                Self { background: (R::ONE - sum).max(R::ZERO), of_each: R::ONE / over }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn shares(fuzzy: Fuzzy, selections: &[f64]) -> (f64, f64) {
        let Shares { background, of_each } = Shares::beside(fuzzy, selections.iter().copied());
        (background, of_each)
    }

    #[test]
    fn by_hand() {
        assert_eq!(shares(Fuzzy::Zadeh, &[]), (1.0, 1.0));
        assert_eq!(shares(Fuzzy::Zadeh, &[0.25, 0.5]), (0.5, 1.0));
        assert_eq!(shares(Fuzzy::Product, &[0.25, 0.5]), (0.25, 1.0));
        assert_eq!(shares(Fuzzy::Product, &[1.0, 1.0]), (0.0, 0.5));
    }

    proptest! {
        /// With product the selection sets sum to 1. With Zadeh one selection and the background do.
        #[test]
        fn shares_sum_to_one(f in prop::collection::vec(0.0..=1.0f64, 0..5)) {
            let (background, of_each) = shares(Fuzzy::Product, &f);
            let sum = background + f.iter().map(|f| f * of_each).sum::<f64>();
            prop_assert!((sum - 1.0).abs() < 1e-15);
            if let [one] = f[..] {
                prop_assert_eq!(shares(Fuzzy::Zadeh, &[one]), (1.0 - one, 1.0));
            }
        }
    }
}
