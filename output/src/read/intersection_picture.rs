//! Pictures of intersection transfer functions ([VS-4]).

use super::{ImageLimits, bytes, decode_within, has_alpha};
use crate::OutputError;
use drypoint_scene::color::unpremultiply;
use drypoint_scene::intersection_picture::{IntersectionPicture, MOST_SIDE};
use drypoint_scene::source::Source;
use std::path::Path;

/// Reads a picture as straight linear colours.
///
/// # Errors
/// Same errors as [`read_image`](super::read_image); [`OutputError::Side`] for a side above [`MOST_SIDE`];
/// [`OutputError::NoColor`]; [`OutputError::Malformed`] for a value that is not finite.
pub fn read_intersection_picture(source: &dyn Source, path: &Path) -> Result<IntersectionPicture, OutputError> {
    let bytes = bytes(source, path)?;
    let image = decode_within(&bytes, path, &ImageLimits { side: MOST_SIDE, each: size_of::<[f64; 4]>() })?;
    let no_color = || OutputError::NoColor { name: path.display().to_string(), found: image.names() };
    let colors = image.colors().filter(|_| image.width > 0 && image.height > 0).ok_or_else(no_color)?;
    let pixel = |i: usize| {
        let [r, g, b] = colors.rgb.map(|channel| channel[i]);
        unpremultiply([r, g, b, colors.alpha.map_or(1.0, |alpha| alpha[i])])
    };
    let pixels: Vec<[f64; 4]> = (0..image.width * image.height).map(pixel).collect();
    if pixels.iter().flatten().any(|c| !c.is_finite()) {
        let fault = "it has values that are not finite".into();
        return Err(OutputError::Malformed { path: path.into(), field: "color".into(), fault });
    }
    Ok(IntersectionPicture { size: [image.width, image.height], pixels, has_opacity: has_alpha(&bytes, &image) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::source::Disk;
    use png::{BitDepth, ColorType, Encoder};

    /// Only a file that contains opacity replaces the opacity of the preset.
    #[test]
    fn a_picture_without_alpha_has_no_opacity() {
        let folder = tempfile::tempdir().unwrap();
        for (color, bytes, transparent, expected) in [
            (ColorType::Rgb, &[10, 20, 30][..], None, false),
            (ColorType::Grayscale, &[10], None, false),
            (ColorType::Rgba, &[10, 20, 30, 255], None, true),
            (ColorType::GrayscaleAlpha, &[10, 255], None, true),
            (ColorType::Rgb, &[10, 20, 30], Some(&[0, 10, 0, 20, 0, 30][..]), true),
        ] {
            let path = folder.path().join("meeting.png");
            let mut encoder = Encoder::new(std::fs::File::create(&path).unwrap(), 1, 1);
            encoder.set_color(color);
            encoder.set_depth(BitDepth::Eight);
            if let Some(color) = transparent {
                encoder.set_trns(color);
            }
            encoder.write_header().unwrap().write_image_data(bytes).unwrap();
            let picture = read_intersection_picture(&Disk, &path).unwrap();
            assert_eq!(picture.has_opacity, expected, "{color:?}");
        }
    }

    /// A picture as large as it may be is read, one pixel more is refused.
    #[test]
    fn a_side_has_a_limit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("wide.png");
        for (width, is_read) in [(MOST_SIDE, true), (MOST_SIDE + 1, false)] {
            let mut encoder = Encoder::new(std::fs::File::create(&path).unwrap(), width as u32, 1);
            encoder.set_color(ColorType::Grayscale);
            encoder.write_header().unwrap().write_image_data(&vec![7; width]).unwrap();
            match read_intersection_picture(&Disk, &path) {
                Ok(picture) => assert!(is_read && picture.size == [width, 1]),
                Err(error) => {
                    let expected =
                        "wide.png: a picture of 4097 × 1 pixels, and at most 4096 along a side are read here";
                    assert!(!is_read && error.to_string().ends_with(expected), "{error}");
                    assert_eq!(error.help(), "make the picture smaller");
                }
            }
        }
    }
}
