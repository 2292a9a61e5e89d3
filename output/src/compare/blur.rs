//! Blurred pictures of dots, as seen from farther away ([COST-1]). A blur keeps the tone, which is the mean coverage
//! around a place, but not the position of each dot.

use super::flip::filter::{separable, unit_sum, weights};
use crate::read::Image;
use drypoint_scene::math;

/// Returns the picture blurred by a Gaussian of `sigma` pixels, cut off at 3 `sigma`. Beyond the border the outermost
/// pixels repeat. With `sigma` = 0 the picture is unchanged.
pub fn blurred(image: &Image, sigma: f64) -> Image {
    let kernel = if sigma > 0.0 {
        unit_sum(weights((3.0 * sigma).ceil(), |i| math::exp(-i * i / (2.0 * sigma * sigma))))
    } else {
        vec![1.0]
    };
    let Image { width, height, channels } = image;
    let blur = |plane: &[f64]| separable(plane, *width, *height, &kernel, &kernel);
    let channels = channels.iter().map(|(name, plane)| (name.clone(), blur(plane))).collect();
    Image { width: *width, height: *height, channels }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn grey(width: usize, height: usize, plane: Vec<f64>) -> Image {
        Image { width, height, channels: vec![("Y".into(), plane)] }
    }

    /// A point of light becomes 1/2πσ² in its middle and 1/√e of that one σ away; nothing of it is lost. The sum over pixels
    /// misses the integral by less than the cut at 3σ, which takes 0.27 % of each pass.
    #[test]
    fn a_point_spreads_as_the_gaussian() {
        let (n, sigma) = (41, 4.0);
        let mut plane = vec![0.0; n * n];
        plane[20 * n + 20] = 1.0;
        let image = blurred(&grey(n, n, plane), sigma);
        let light = &image.channels[0].1;
        let peak = 1.0 / (2.0 * PI * sigma * sigma);
        assert!((light[20 * n + 20] / peak - 1.0).abs() < 0.006, "{}", light[20 * n + 20] / peak);
        let falls = light[20 * n + 24] / light[20 * n + 20];
        assert!((falls - (-0.5_f64).exp()).abs() < 1e-12, "{falls}");
        assert!((light.iter().sum::<f64>() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn an_even_tone_stays_and_nothing_is_blurred_by_nothing() {
        let even = grey(7, 5, vec![0.3; 35]);
        assert!(blurred(&even, 2.5).channels[0].1.iter().all(|y| (y - 0.3).abs() < 1e-15));
        let any = grey(3, 2, vec![0.1, 0.9, 0.4, 0.3, 0.0, 1.0]);
        assert_eq!(blurred(&any, 0.0), any);
    }

    /// Dots at random of the area a, λ of them in a pixel, have the variance λa²/4πσ² after a Gaussian of σ pixels
    /// (Campbell's theorem): the white noise that a difference of two such lists is made of. 96² pixels hold
    /// 96²/4πσ² = 46 cells that know nothing of each other, so that the variance is known to √(2/46) = 21 %.
    #[test]
    fn random_dots_leave_the_noise_that_campbell_says() {
        let (n, sigma, density, area) = (96, 4.0, 0.05, 0.5);
        let mut plane = vec![0.0; n * n];
        let mut state = 1_u64;
        for _ in 0..(density * (n * n) as f64) as usize {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            plane[(state >> 33) as usize % (n * n)] += area;
        }
        let image = blurred(&grey(n, n, plane), sigma);
        let mean = density * area;
        let variance = image.channels[0].1.iter().map(|y| (y - mean).powi(2)).sum::<f64>() / (n * n) as f64;
        let expected = density * area * area / (4.0 * PI * sigma * sigma);
        assert!((variance / expected - 1.0).abs() < 2.5 * 0.21, "{variance} for {expected}");
    }
}
