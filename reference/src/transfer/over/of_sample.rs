//! Quantities that a sample knows by itself: value, gradient magnitude, curvatures.

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

/// How strongly the value changes.
pub enum Magnitude {
    /// ‖g‖, times the power of two of [SPACE-4], by which the nodes are multiplied too.
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
