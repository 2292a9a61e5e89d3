//! Quantities of the sample itself: value, gradient magnitude, curvatures.

use super::{AxisMeasure, SampleQuantities};
use crate::number::Real;
use crate::transfer::Coordinate;

/// The value.
pub struct SampleValue;

impl<R: Real> AxisMeasure<R> for SampleValue {
    fn at(&self, here: &SampleQuantities<R>) -> Coordinate<R> {
        Coordinate::Number(here.value)
    }
}

/// The magnitude of the gradient.
pub enum GradientMagnitude {
    /// ‖g‖, times the power of two of [SPACE-4]. The nodes are multiplied by the same power.
    Scaled,
    /// |g| of [VAL-2].
    Normalized,
}

impl<R: Real> AxisMeasure<R> for GradientMagnitude {
    fn at(&self, here: &SampleQuantities<R>) -> Coordinate<R> {
        Coordinate::Number(match self {
            Self::Scaled => here.gradient,
            Self::Normalized => here.magnitude,
        })
    }
}

/// A curvature ([CUR-1], [CUR-2]).
pub enum CurvatureMeasure {
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

impl<R: Real> AxisMeasure<R> for CurvatureMeasure {
    fn at(&self, here: &SampleQuantities<R>) -> Coordinate<R> {
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
        let here = SampleQuantities::<f64> { principal: [3.0, -1.0], kappa: 2.0, ..SampleQuantities::at([0.0; 3]) };
        let number = |axis: CurvatureMeasure| axis.at(&here);
        for (axis, expected) in [
            (CurvatureMeasure::K1, 3.0),
            (CurvatureMeasure::K2, -1.0),
            (CurvatureMeasure::Mean, 1.0),
            (CurvatureMeasure::Gaussian, -3.0),
            (CurvatureMeasure::AlongView, 2.0),
        ] {
            assert_eq!(number(axis), Coordinate::Number(expected));
        }
    }
}
