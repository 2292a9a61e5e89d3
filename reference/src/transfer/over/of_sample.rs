//! Quantities of the sample itself: value, gradient magnitude, curvatures.

use super::{Here, Measure};
use crate::number::Real;
use crate::transfer::Coordinate;

/// The value.
pub struct Value;

impl<R: Real> Measure<R> for Value {
    fn at(&self, here: &Here<R>) -> Coordinate<R> {
        Coordinate::Number(here.value)
    }
}

/// The magnitude of the gradient.
pub enum Magnitude {
    /// ‖g‖, times the power of two of [SPACE-4]. The nodes are multiplied by the same power.
    Scaled,
    /// |g| of [VAL-2].
    Normalized,
}

impl<R: Real> Measure<R> for Magnitude {
    fn at(&self, here: &Here<R>) -> Coordinate<R> {
        Coordinate::Number(match self {
            Self::Scaled => here.gradient,
            Self::Normalized => here.magnitude,
        })
    }
}

/// A curvature ([CUR-1], [CUR-2]).
pub enum Differential {
    /// κ₁.
    K1,
    /// κ₂.
    K2,
    /// (κ₁ + κ₂)/2.
    Mean,
    /// κ₁κ₂.
    Gaussian,
    /// κ_v.
    AlongView,
}

impl<R: Real> Measure<R> for Differential {
    fn at(&self, here: &Here<R>) -> Coordinate<R> {
        let [k1, k2] = here.principal;
        Coordinate::Number(match self {
            Self::K1 => k1,
            Self::K2 => k2,
            Self::Mean => (k1 + k2) * R::HALF,
            Self::Gaussian => k1 * k2,
            Self::AlongView => here.kappa,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A saddle by hand: κ₁ = 3, κ₂ = −1, κ_v = 2.
    #[test]
    fn each_curvature_is_its_own() {
        let here = Here::<f64> { principal: [3.0, -1.0], kappa: 2.0, ..Here::at([0.0; 3]) };
        let number = |axis: Differential| axis.at(&here);
        for (axis, expected) in [
            (Differential::K1, 3.0),
            (Differential::K2, -1.0),
            (Differential::Mean, 1.0),
            (Differential::Gaussian, -3.0),
            (Differential::AlongView, 2.0),
        ] {
            assert_eq!(number(axis), Coordinate::Number(expected));
        }
    }
}
