//! Silhouettes: black where the surface turns away from the eye (4.4, [HATCH-15]).

use crate::number::{Decision, Real};

/// The test (N·V)² + offset > ½.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SilhouetteTest<R> {
    offset: R,
}

impl<R: Real> SilhouetteTest<R> {
    /// The test with its offset.
    pub fn new(offset: f64) -> Self {
        Self { offset: R::from_f64(offset) }
    }

    /// Whether a place with this N·V, of either sign, is black.
    #[inline]
    pub fn is_black(self, n_dot_v: R) -> bool {
        (n_dot_v * n_dot_v + self.offset).deciding(Decision::Silhouette) <= R::from_f64(0.5)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The edge lies at |N·V| = √(½ − offset) and belongs to the black part. Squares have no sign.
    #[test]
    fn black_up_to_the_root() {
        let black = |offset: f64, x: f64| {
            let silhouette = SilhouetteTest::<f64>::new(offset);
            assert_eq!(silhouette.is_black(x), silhouette.is_black(-x));
            assert_eq!(silhouette.is_black(x), SilhouetteTest::<f32>::new(offset).is_black(x as f32));
            silhouette.is_black(x)
        };
        assert!(black(0.25, 0.5) && !black(0.25, 0.53125) && black(0.25, 0.0));
        assert!(black(0.5, 0.0) && !black(0.5, 0.125));
        assert!(!black(0.75, 0.0));
        assert!(black(-0.5, 1.0));
        // √0.05 = 0.2236…
        assert!(black(0.45, 0.2236) && !black(0.45, 0.2237));
    }
}
