//! Pictures behind the volume ([IO-6]).

use super::{ColorChannels, Image, bytes, decode};
use crate::OutputError;
use drypoint_scene::color::Rgba;
use drypoint_scene::source::Source;
use std::path::Path;

/// Returns the picture in a file, stretched to `width` × `height` pixels: linear premultiplied, row by row from the
/// top.
///
/// # Errors
/// Same errors as [`read_image`](super::read_image); [`OutputError::NoColor`]; [`OutputError::Malformed`] for a colour
/// that is not finite, which would spread through the picture as NaN.
pub fn read_background(
    source: &dyn Source,
    path: &Path,
    width: usize,
    height: usize,
) -> Result<Vec<Rgba>, OutputError> {
    let image = decode(&bytes(source, path)?, path)?;
    for name in ["R", "G", "B", "A"] {
        if image.channel(name).is_some_and(|channel| channel.iter().any(|v| !v.is_finite())) {
            return Err(OutputError::Malformed {
                path: path.into(),
                field: name.into(),
                fault: "it has values that are not finite".into(),
            });
        }
    }
    stretch(&image, width, height)
        .ok_or_else(|| OutputError::NoColor { name: path.display().to_string(), found: image.names() })
}

/// Returns the colours of an image at the pixel centres of a frame that it is stretched to. Interpolation is bilinear
/// in linear premultiplied light. An image without α is opaque. None without colours or pixels.
///
/// Pixel centre i + ½ of W lies at (i + ½)·w/W − ½ in the image's pixels. The outermost pixels extend to the edge.
pub fn stretch(image: &Image, width: usize, height: usize) -> Option<Vec<Rgba>> {
    let ColorChannels { rgb, alpha } = image.colors().filter(|_| image.width > 0 && image.height > 0)?;
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
            let [r, g, b] = rgb.map(sample);
            pixels.push([r, g, b, alpha.map_or(1.0, sample)]);
        }
    }
    Some(pixels)
}

/// Returns the two of `n` pixels around the centre of pixel `i` of `size`, and the weight of the second one.
fn between(i: usize, size: usize, n: usize) -> (usize, usize, f64) {
    let x = ((i as f64 + 0.5) * n as f64 / size as f64 - 0.5).clamp(0.0, (n - 1) as f64);
    let first = x as usize;
    (first, (first + 1).min(n - 1), x - first as f64)
}

/// Returns a + w(b − a), which is exactly a if a = b.
fn mix(a: f64, b: f64, w: f64) -> f64 {
    a + w * (b - a)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::exr::write_exr;
    use drypoint_scene::picture::{Layer, LayerKind, Picture, Provenance};
    use drypoint_scene::source::Disk;

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
        let error = read_written(LayerKind::Z, 1.0).unwrap_err();
        assert!(error.to_string().ends_with("b.exr: has no channels R, G and B; it has Z"), "{error}");
    }

    #[test]
    fn what_is_not_finite_is_refused() {
        assert_eq!(read_written(LayerKind::Beauty, 0.5).unwrap(), [[0.5; 4]; 4]);
        let error = read_written(LayerKind::Beauty, f64::INFINITY).unwrap_err();
        assert!(error.to_string().ends_with("b.exr: R: it has values that are not finite"), "{error}");
    }

    /// A picture of one pixel, stretched to four.
    fn read_written(kind: LayerKind, value: f64) -> Result<Vec<Rgba>, OutputError> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("b.exr");
        let layer = Layer { kind, channels: vec![vec![value]; kind.channels().len()] };
        let picture = Picture { width: 1, height: 1, layers: vec![layer] };
        write_exr(&picture, &Provenance::default(), &path).unwrap();
        read_background(&Disk, &path, 2, 2)
    }
}
