//! A picture behind the volume ([IO-6]).

use super::{Image, read_image};
use crate::OutputError;
use drypoint_scene::color::Rgba;
use std::path::Path;

/// The picture in a file, stretched to `width` × `height` pixels: linear premultiplied, row by row from the top.
///
/// # Errors
/// Those of [`read_image`], and [`OutputError::NoColour`].
pub fn read_background(path: &Path, width: usize, height: usize) -> Result<Vec<Rgba>, OutputError> {
    let image = read_image(path)?;
    stretch(&image, width, height)
        .ok_or_else(|| OutputError::NoColour { name: path.display().to_string(), found: image.names() })
}

/// The colours of an image at the pixel centres of a frame that it is stretched to, bilinearly in linear premultiplied
/// light; opaque where it has no α. Nothing if it has no colours or no pixels.
///
/// Pixel centre i + ½ of W lies at (i + ½)·w/W − ½ in the image's own pixels, whose outermost ones extend to its edge.
pub fn stretch(image: &Image, width: usize, height: usize) -> Option<Vec<Rgba>> {
    let (colours, alpha) = image.colour().filter(|_| image.width > 0 && image.height > 0)?;
    let columns: Vec<_> = (0..width).map(|i| between(i, width, image.width)).collect();
    let mut pixels = Vec::with_capacity(width.saturating_mul(height));
    for j in 0..height {
        let (top, bottom, v) = between(j, height, image.height);
        let (top, bottom) = (top * image.width, bottom * image.width);
        for &(left, right, u) in &columns {
            let sample = |channel: &[f64]| {
                let upper = mix(channel[top + left], channel[top + right], u);
                let lower = mix(channel[bottom + left], channel[bottom + right], u);
                mix(upper, lower, v)
            };
            let [r, g, b] = colours.map(sample);
            pixels.push([r, g, b, alpha.map_or(1.0, sample)]);
        }
    }
    Some(pixels)
}

/// The two of `n` pixels between which the centre of pixel `i` of `size` lies, and how far from the first to the second.
fn between(i: usize, size: usize, n: usize) -> (usize, usize, f64) {
    let x = ((i as f64 + 0.5) * n as f64 / size as f64 - 0.5).clamp(0.0, (n - 1) as f64);
    let first = x as usize;
    (first, (first + 1).min(n - 1), x - first as f64)
}

/// a + w(b − a), which is a where both are equal.
fn mix(a: f64, b: f64, w: f64) -> f64 {
    a + w * (b - a)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(width: usize, height: usize, value: impl Fn(usize, usize) -> f64, alpha: Option<f64>) -> Image {
        let plane: Vec<f64> =
            (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).map(|(x, y)| value(x, y)).collect();
        let mut channels: Vec<_> = ["R", "G", "B"].map(|n| (n.to_string(), plane.clone())).into();
        channels.extend(alpha.map(|a| ("A".to_string(), vec![a; plane.len()])));
        Image { width, height, channels }
    }

    #[test]
    fn its_own_size_gives_its_own_pixels() {
        let source = image(3, 2, |x, y| (x * x + 5 * y) as f64, Some(0.5));
        let pixels = stretch(&source, 3, 2).unwrap();
        assert_eq!(pixels.iter().map(|p| p[0]).collect::<Vec<_>>(), source.channels[0].1);
        assert!(pixels.iter().all(|p| p[3] == 0.5));
    }

    #[test]
    fn twice_the_width_by_hand() {
        // Centres of four pixels over two lie at −¼, ¼, ¾, 1¼ of theirs: the ends are clamped.
        let pixels = stretch(&image(2, 1, |x, _| x as f64, None), 4, 1).unwrap();
        assert_eq!(pixels.iter().map(|p| p[1]).collect::<Vec<_>>(), [0.0, 0.25, 0.75, 1.0]);
        assert!(pixels.iter().all(|p| p[3] == 1.0));
    }

    #[test]
    fn a_linear_picture_stays_linear_inside() {
        // f = 2x − 3y at pixel centres; frame pixel (i, j) looks at x = (i + ½)·8/5 − ½, y = (j + ½)·6/7 − ½.
        let pixels = stretch(&image(8, 6, |x, y| 2.0 * x as f64 - 3.0 * y as f64, None), 5, 7).unwrap();
        for j in 1..6 {
            for i in 0..5 {
                let (x, y) = ((i as f64 + 0.5) * 1.6 - 0.5, (j as f64 + 0.5) * 6.0 / 7.0 - 0.5);
                // A few roundings of numbers below 32.
                assert!((pixels[j * 5 + i][2] - (2.0 * x - 3.0 * y)).abs() < 1e-13);
            }
        }
    }

    #[test]
    fn what_has_no_colours_is_named() {
        let grey = Image { width: 1, height: 1, channels: vec![("Y".into(), vec![1.0])] };
        assert!(stretch(&grey, 2, 2).is_none());
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("depth.exr");
        let layer =
            drypoint_scene::picture::Layer { kind: drypoint_scene::picture::LayerKind::Z, channels: vec![vec![1.0]] };
        let picture = drypoint_scene::picture::Picture { width: 1, height: 1, layers: vec![layer] };
        crate::exr::write_exr(&picture, &Default::default(), &path).unwrap();
        let error = read_background(&path, 2, 2).unwrap_err();
        assert!(error.to_string().ends_with("depth.exr: has no channels R, G and B; it has Z"), "{error}");
    }
}
