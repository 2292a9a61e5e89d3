//! Pictures at another size.

use crate::read::{ColorChannels, Image};

/// Returns linear premultiplied pixels of the image at another size: the mean over the area of each new pixel. None if
/// the image has no colours.
pub(super) fn scaled(image: &Image, width: usize, height: usize) -> Option<Vec<[f64; 4]>> {
    let ColorChannels { rgb: [r, g, b], alpha } = image.colors()?;
    let opaque = alpha.is_none().then(|| vec![1.0; image.width * image.height]);
    let alpha = alpha.or(opaque.as_deref()).unwrap_or_default();
    let [across, down] = [shares(image.width, width), shares(image.height, height)];
    // The mean is separable: across each row first, then down each column.
    let mut rows = vec![[0.0; 4]; width * image.height];
    for (y, row) in rows.chunks_exact_mut(width).enumerate() {
        for (pixel, (first, weights)) in row.iter_mut().zip(&across) {
            for (i, weight) in (y * image.width + first..).zip(weights) {
                for (sum, channel) in pixel.iter_mut().zip([r, g, b, alpha]) {
                    *sum += weight * channel[i];
                }
            }
        }
    }
    let mut pixels = vec![[0.0; 4]; width * height];
    for (row, (first, weights)) in pixels.chunks_exact_mut(width).zip(&down) {
        for (source, weight) in rows[first * width..].chunks_exact(width).zip(weights) {
            for (pixel, source) in row.iter_mut().zip(source) {
                for (sum, value) in pixel.iter_mut().zip(source) {
                    *sum += weight * value;
                }
            }
        }
    }
    Some(pixels)
}

/// Divides `from` pixels into `to` equal parts. Returns, for each part, its first pixel, and the shares of the part in
/// this pixel and the following ones.
fn shares(from: usize, to: usize) -> Vec<(usize, Vec<f64>)> {
    // In units of 1/to of a pixel all ends are integers, so no share is lost to rounding.
    (0..to)
        .map(|part| {
            let (begin, end) = (part * from, (part + 1) * from);
            let (first, last) = (begin / to, end.div_ceil(to));
            let share = |pixel: usize| end.min((pixel + 1) * to) - begin.max(pixel * to);
            (first, (first..last).map(|pixel| share(pixel) as f64 / from as f64).collect())
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(width: usize, height: usize, value: impl Fn(usize, usize) -> f64, alpha: f64) -> Image {
        let plane: Vec<f64> = (0..width * height).map(|i| value(i % width, i / width)).collect();
        let opacity = vec![alpha; plane.len()];
        let channels = [("R", &plane), ("G", &plane), ("B", &plane), ("A", &opacity)];
        Image { width, height, channels: channels.map(|(n, v)| (n.to_string(), v.clone())).into() }
    }

    #[test]
    fn shares_by_hand() {
        // Five pixels to two: 2½ each. Two to three: ⅔ each.
        assert_eq!(shares(5, 2), [(0, vec![0.4, 0.4, 0.2]), (2, vec![0.2, 0.4, 0.4])]);
        assert_eq!(shares(2, 3), [(0, vec![1.0]), (0, vec![0.5, 0.5]), (1, vec![1.0])]);
        assert_eq!(shares(3, 3), [(0, vec![1.0]), (1, vec![1.0]), (2, vec![1.0])]);
    }

    #[test]
    fn scaling_keeps_the_mean() {
        let source = image(7, 5, |x, y| (x * 3 + y * y) as f64 / 40.0, 1.0);
        let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
        for (w, h) in [(3, 2), (7, 5), (16, 11)] {
            let pixels: Vec<f64> = scaled(&source, w, h).unwrap().iter().map(|p| p[0]).collect();
            // Some hundred roundings of numbers below 1.
            assert!((mean(&pixels) - mean(&source.channels[0].1)).abs() < 1e-14);
        }
    }
}
