//! Intersection transfer functions (eqs. 6 and 7; [VS-4]): the colour and opacity of places where two objects meet.

use crate::number::Real;
use drypoint_scene::shot::IntersectionOpacity;

/// An unshaded colour and its opacity.
pub type Unshaded<R> = ([R; 3], R);

/// The opacity of an intersection from both opacities: a the selection's, b the other's. The presets after Porter and Duff
/// (1984).
pub fn opacity<R: Real>(preset: IntersectionOpacity, a: R, b: R) -> R {
    let one = R::ONE;
    let alpha = match preset {
        IntersectionOpacity::Max => a.max(b),
        IntersectionOpacity::Over => one - (one - a) * (one - b),
        IntersectionOpacity::In => a * b,
        IntersectionOpacity::Out => a * (one - b),
        IntersectionOpacity::Atop => b,
        IntersectionOpacity::Xor => a * (one - b) + b * (one - a),
        IntersectionOpacity::Plus => (a + b).min(one),
    };
    alpha.clamp_01()
}

/// The mean of two colours by their opacities: (α₁c₁ + α₂c₂)/(α₁ + α₂); none where both are transparent.
pub fn mean<R: Real>((c_1, alpha_1): Unshaded<R>, (c_2, alpha_2): Unshaded<R>) -> Option<[R; 3]> {
    let sum = alpha_1 + alpha_2;
    (sum > R::ZERO).then(|| std::array::from_fn(|i| (c_1[i] * alpha_1 + c_2[i] * alpha_2) / sum))
}

#[cfg(test)]
mod tests {
    use super::*;
    use IntersectionOpacity::{Atop, In, Max, Out, Over, Plus, Xor};
    use proptest::prelude::*;

    const ALL: [IntersectionOpacity; 7] = [Max, Over, In, Out, Atop, Xor, Plus];

    #[test]
    fn by_hand() {
        assert_eq!(ALL.map(|preset| opacity(preset, 0.5, 0.25)), [0.5, 0.625, 0.125, 0.375, 0.25, 0.5, 0.75]);
        assert_eq!(ALL.map(|preset| opacity(preset, 0.25, 0.5)), [0.5, 0.625, 0.125, 0.125, 0.5, 0.5, 0.75]);
        assert_eq!(ALL.map(|preset| opacity(preset, 1.0, 1.0)), [1.0, 1.0, 1.0, 0.0, 1.0, 0.0, 1.0]);
        assert_eq!(mean(([1.0, 0.0, 0.5], 0.75), ([0.0, 1.0, 0.5], 0.25)), Some([0.75, 0.25, 0.5]));
        assert_eq!(mean(([1.0; 3], 0.0), ([0.5; 3], 0.0)), None);
    }

    proptest! {
        /// Opacities stay in [0, 1], and over = in + out + out the other way round: Porter and Duff's areas.
        #[test]
        fn areas_of_porter_and_duff([a, b] in prop::array::uniform2(0.0..=1.0f64)) {
            prop_assert!(ALL.iter().all(|&preset| (0.0..=1.0).contains(&opacity(preset, a, b))));
            let parts = opacity(In, a, b) + opacity(Out, a, b) + opacity(Out, b, a);
            prop_assert!((opacity(Over, a, b) - parts).abs() < 1e-15);
            prop_assert!((opacity(Xor, a, b) - opacity(Out, a, b) - opacity(Out, b, a)).abs() < 1e-15);
        }
    }
}
