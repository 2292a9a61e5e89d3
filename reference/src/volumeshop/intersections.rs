//! Intersection transfer functions (eqs. 6 and 7; [VS-4]): the colour and opacity of places where two objects meet.

use crate::bilinear::{cell, mix};
use crate::number::Real;
use drypoint_scene::intersection_picture::IntersectionPicture;
use drypoint_scene::math;
use drypoint_scene::shot::{Dab, IntersectionOpacity};

/// An unshaded colour and its opacity.
pub type Unshaded<R> = ([R; 3], R);

/// The opacity of an intersection from the selection's opacity a and the other object's opacity b. The presets follow
/// Porter and Duff (1984).
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

/// The mean of two colours by their opacities: (α₁c₁ + α₂c₂)/(α₁ + α₂). Returns none if both are transparent.
pub fn mean<R: Real>((c_1, alpha_1): Unshaded<R>, (c_2, alpha_2): Unshaded<R>) -> Option<[R; 3]> {
    let sum = alpha_1 + alpha_2;
    let mean = |i: usize| ((c_1[i] * alpha_1 + c_2[i] * alpha_2) / sum).known_between(c_1[i], c_2[i]);
    (sum > R::ZERO).then(|| std::array::from_fn(mean))
}

/// Colour and opacity of a picture at shares of both ranges, clamped to [0, 1]: bilinear between the centres of pixels.
/// The ends of a range lie at the centres of the first and the last pixel.
pub fn pictured<R: Real>(picture: &IntersectionPicture, [x, y]: [R; 2]) -> [R; 4] {
    let [width, height] = picture.size;
    let place = |share: R, n: usize| cell(share.clamp_01() * R::from_index(n - 1), n);
    let ((i, u), (j, v)) = (place(x, width), place(R::ONE - y, height));
    let pixel = |i: usize, j: usize| picture.pixels[j.min(height - 1) * width + i.min(width - 1)].map(R::from_f64);
    mix(mix(pixel(i, j), pixel(i + 1, j), u), mix(pixel(i, j + 1), pixel(i + 1, j + 1), u), v)
}

/// The result of a function under a dab, at the value at p and the value at T p. It is *over* of Porter and Duff (1984):
/// α' = w + α(1 − w), c' = (w·c_dab + α(1 − w)·c)/α'. Here a and c_dab are the dab's, and the weight is
/// w = a·exp(−½(((v₀ − at₀)/width₀)² + ((v₁ − at₁)/width₁)²)). If α' is 0, nothing changes.
pub fn painted<R: Real>((c, alpha): Unshaded<R>, dab: &Dab, values: [R; 2]) -> Unshaded<R> {
    let [u, v] = std::array::from_fn(|i| (values[i] - R::from_f64(dab.at[i])) / R::from_f64(dab.width[i]));
    let [r, g, b, a] = dab.color;
    let w = R::monotone([u * u + v * v], |[square]| a * math::exp(-0.5 * square));
    let painted = w + alpha * (R::ONE - w);
    // The share w/α' of the dab in the colour; α(1 − w)/α' is the rest of it. Both ends are exact.
    let share = if painted > R::ZERO { (w / painted).known_between(R::ZERO, R::ONE) } else { R::ZERO };
    let of_dab = [r, g, b].map(R::from_f64);
    (std::array::from_fn(|i| c[i] * (R::ONE - share) + of_dab[i] * share), painted)
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

    /// An orange dab of opacity ¾ about (80, 120).
    const ORANGE: Dab = Dab { at: [80.0, 120.0], width: [10.0, 20.0], color: [1.0, 0.25, 0.0, 0.75] };
    const UNDER: Unshaded<f64> = ([0.0, 0.5, 1.0], 0.5);

    fn near(found: Unshaded<f64>, expected: Unshaded<f64>) {
        let off = (0..3).map(|i| (found.0[i] - expected.0[i]).abs()).fold((found.1 - expected.1).abs(), f64::max);
        assert!(off < 1e-15, "{found:?}, not {expected:?}");
    }

    /// At the centre w = ¾: α' = ¾ + ⅛ = ⅞, and the dab has 6/7 of the colour. One width away along either value
    /// w = ¾·e^(−½).
    #[test]
    fn a_dab_by_hand() {
        near(painted(UNDER, &ORANGE, [80.0, 120.0]), ([6.0 / 7.0, 2.0 / 7.0, 1.0 / 7.0], 0.875));
        let w = 0.75 * 0.606_530_659_712_633_4;
        let alpha = w + 0.5 * (1.0 - w);
        let (dab, under) = (w / alpha, 0.5 * (1.0 - w) / alpha);
        let beside = ([dab, 0.25 * dab + 0.5 * under, under], alpha);
        for values in [[90.0, 120.0], [70.0, 120.0], [80.0, 140.0], [80.0, 100.0]] {
            near(painted(UNDER, &ORANGE, values), beside);
        }
        // Over a transparent function it is the dab: e⁻¹ along the diagonal.
        near(painted(([0.0; 3], 0.0), &ORANGE, [90.0, 140.0]), ([1.0, 0.25, 0.0], 0.75 * 0.367_879_441_171_442_33));
    }

    /// A dab of opacity 0, and one too far away, leave every bit; an opaque one of endless width leaves none.
    #[test]
    fn ends_of_dabs_are_exact() {
        let clear = Dab { color: [1.0, 0.25, 0.0, 0.0], ..ORANGE };
        let point = Dab { width: [f64::MIN_POSITIVE; 2], ..ORANGE };
        let opaque = Dab { width: [f64::MAX; 2], color: [1.0, 0.25, 0.0, 1.0], ..ORANGE };
        for under in [UNDER, ([0.1, 0.7, 0.3], 0.3), ([0.1, 0.7, 0.3], 0.0), ([0.9, 0.1, 0.3], 1.0)] {
            for values in [[80.0, 120.0], [3.0, -7.0], [1e9, 120.0]] {
                assert_eq!(painted(under, &clear, values), under);
                assert_eq!(painted(under, &opaque, values), ([1.0, 0.25, 0.0], 1.0));
            }
            assert_eq!(painted(under, &point, [80.0, 120.5]), under);
            assert_eq!(painted(under, &ORANGE, [-f64::MAX, f64::MAX]), under);
        }
    }

    /// The last of two dabs at one place is on top: with w₁ = ½ and w₂ = ¼ over nothing α = ⅝; the second has ¼ of it, the
    /// first ⅜.
    #[test]
    fn a_later_dab_lies_over_an_earlier() {
        let dab = |color| Dab { color, ..ORANGE };
        let (red, blue) = (dab([1.0, 0.0, 0.0, 0.5]), dab([0.0, 0.0, 1.0, 0.25]));
        let both = |dabs: [Dab; 2]| dabs.iter().fold(([0.0; 3], 0.0), |under, dab| painted(under, dab, ORANGE.at));
        near(both([red, blue]), ([0.6, 0.0, 0.4], 0.625));
        near(both([blue, red]), ([0.8, 0.0, 0.2], 0.625));
    }

    /// Two by three pixels, by hand.
    #[test]
    fn ends_lie_at_the_centres_of_pixels() {
        let pixels = (0..6).map(|i| [f64::from(i), 0.0, 1.0, 0.5]).collect();
        let picture = IntersectionPicture { size: [2, 3], pixels, has_opacity: true };
        let red = |x, y| pictured(&picture, [x, y])[0];
        assert_eq!([red(0.0, 1.0), red(1.0, 1.0), red(0.0, 0.0), red(1.0, 0.0)], [0.0, 1.0, 4.0, 5.0]);
        assert_eq!([red(0.5, 0.5), red(0.25, 0.75), red(-3.0, 7.0), red(9.0, -9.0)], [2.5, 1.25, 0.0, 5.0]);
        let one = IntersectionPicture { size: [1, 1], pixels: vec![[0.5; 4]], has_opacity: false };
        assert_eq!(pictured(&one, [0.3, 0.9]), [0.5; 4]);
    }

    /// A picture with the same dabs on it is the same function, but for bilinear interpolation: half the distance between
    /// pixels is a quarter of the error.
    #[test]
    fn dabs_on_a_function_are_dabs_on_a_picture() {
        let dabs = [ORANGE, Dab { at: [100.0, 90.0], width: [15.0, 30.0], color: [0.2, 0.9, 0.4, 0.6] }];
        let function = |values| dabs.iter().fold(UNDER, |under, dab| painted(under, dab, values));
        let error = |n: usize| {
            let value = |share: f64| 200.0 * share;
            let end = (n - 1) as f64;
            let pixel = |i: usize| {
                let ([r, g, b], a) = function([value((i % n) as f64 / end), value(1.0 - (i / n) as f64 / end)]);
                [r, g, b, a]
            };
            let picture =
                IntersectionPicture { size: [n; 2], pixels: (0..n * n).map(pixel).collect(), has_opacity: true };
            let at = (0..97 * 97).map(|i| [(i % 97) as f64 / 96.0, (i / 97) as f64 / 96.0]);
            let off = at.flat_map(|[x, y]| {
                let ([r, g, b], a) = function([value(x), value(y)]);
                let found = pictured(&picture, [x, y]);
                [r - found[0], g - found[1], b - found[2], a - found[3]]
            });
            off.fold(0.0, |largest: f64, off| largest.max(off.abs()))
        };
        let errors = [81, 161, 321].map(error);
        assert!(errors[0] < 0.02, "{errors:?}");
        for pair in errors.windows(2) {
            assert!((3.0..5.0).contains(&(pair[0] / pair[1])), "{errors:?}");
        }
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
