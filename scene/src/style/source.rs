//! A picture that a style is taken from: of any size, PNG, JPEG or OpenEXR ([STF-2], [VAL-3]).

use super::PictureFault;
use super::decode::{Codes, DecodedPicture, of_light, shares};
use crate::color::{Rgba, premultiply, srgb_to_linear};

/// The largest side of a source picture, in pixels, which is enough for large scans of works of art.
const MAX_SIDE: usize = 16384;

/// Bytes of a pixel at the most: four channels as the decoder and the file have them.
const EACH: u64 = 2 * 16;

/// A decoded picture. Its pixels are kept as the file has them, a byte or two a channel, and are converted to light on
/// demand: a style needs few pixels of a large scan.
#[derive(Clone, Debug, PartialEq)]
pub struct SourcePicture {
    width: usize,
    height: usize,
    linear: bool,
    pixels: Pixels,
}

#[derive(Clone, Debug, PartialEq)]
enum Pixels {
    /// Codes, so many to a pixel.
    File(Codes, usize),
    Straight(Vec<Rgba>),
}

impl SourcePicture {
    /// Decodes the bytes of a PNG, JPEG or OpenEXR file. Channels of the first two are divided by 2ⁿ − 1 and, unless
    /// the picture is `linear`, decoded from sRGB. gAMA, cHRM and ICC chunks are ignored ([VAL-3]). A picture without
    /// an alpha channel is opaque.
    ///
    /// # Errors
    /// Bytes that are no such picture; sides above 16384 and more pixels than memory has room for (found before
    /// anything is allocated).
    pub fn decode(bytes: &[u8], linear: bool) -> Result<Self, PictureFault> {
        let DecodedPicture { width, height, channels, codes } = DecodedPicture::new(bytes, MAX_SIDE, EACH)?;
        let linear = linear || matches!(codes, Codes::Light(_));
        Ok(Self { width, height, linear, pixels: Pixels::File(codes, channels) })
    }

    /// A picture of straight RGBA in [0, 1], row by row from the top, encoded as sRGB unless `linear`.
    ///
    /// # Errors
    /// A picture without pixels, or a number of pixels other than width × height.
    pub fn from_straight(width: usize, height: usize, straight: Vec<Rgba>, linear: bool) -> Result<Self, PictureFault> {
        if straight.is_empty() || width.checked_mul(height) != Some(straight.len()) {
            return Err(PictureFault::Pixels { width, height, found: straight.len() });
        }
        Ok(Self { width, height, linear, pixels: Pixels::Straight(straight) })
    }

    /// Pixels from left to right; at least one.
    pub fn width(&self) -> usize {
        self.width
    }

    /// Pixels from top to bottom; at least one.
    pub fn height(&self) -> usize {
        self.height
    }

    /// Linear premultiplied light of the pixel in column i from the left and row j from the top.
    ///
    /// # Panics
    /// Beyond the picture.
    pub fn pixel(&self, i: usize, j: usize) -> Rgba {
        assert!(i < self.width && j < self.height, "pixel ({i}, {j}) of {} × {}", self.width, self.height);
        let at = j * self.width + i;
        let [r, g, b, a] = match &self.pixels {
            Pixels::File(Codes::Eight(codes), n) => shares(&codes[at * n..][..*n], 255.0),
            Pixels::File(Codes::Sixteen(codes), n) => shares(&codes[at * n..][..*n], 65535.0),
            Pixels::File(Codes::Light(light), n) => of_light(&light[at * n..][..*n]),
            Pixels::Straight(pixels) => pixels[at],
        };
        let light = if self.linear { [r, g, b] } else { [r, g, b].map(srgb_to_linear) };
        premultiply([light[0], light[1], light[2], a])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::style::Style;
    use image::{DynamicImage, GrayAlphaImage, ImageBuffer, ImageFormat, LumaA, Rgb, RgbImage};
    use std::io::Cursor;

    fn file(picture: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        picture.into().write_to(&mut bytes, format).unwrap();
        bytes.into_inner()
    }

    /// A square picture is the same read as a style and read as a source.
    #[test]
    fn pixels_are_those_of_a_style() {
        // All texels of a side of 3 are inside the disk.
        let grey = GrayAlphaImage::from_fn(3, 3, |x, y| LumaA([50 * x as u8, 255 - 70 * y as u8]));
        let deep: ImageBuffer<Rgb<u16>, Vec<u16>> =
            ImageBuffer::from_fn(3, 3, |x, y| Rgb([257 * x as u16, 65535 - y as u16, 1000]));
        for bytes in [file(grey, ImageFormat::Png), file(deep, ImageFormat::Png)] {
            for linear in [false, true] {
                let source = SourcePicture::decode(&bytes, linear).unwrap();
                let style = Style::decode("s", &bytes, linear).unwrap();
                assert_eq!((source.width(), source.height()), (3, 3));
                for (i, j) in (0..9).map(|t| (t % 3, t / 3)) {
                    assert_eq!(source.pixel(i, j), style.texel(i, j));
                }
            }
        }
    }

    #[test]
    fn straight_numbers_are_decoded_then_premultiplied() {
        let source = SourcePicture::from_straight(1, 1, vec![[0.5, 1.0, 0.0, 0.5]], true).unwrap();
        assert_eq!(source.pixel(0, 0), [0.25, 0.5, 0.0, 0.5]);
        let encoded = SourcePicture::from_straight(1, 1, vec![[0.5, 1.0, 0.0, 0.5]], false).unwrap();
        assert!((encoded.pixel(0, 0)[0] - 0.5 * 0.214_041_140_5).abs() < 1e-10);
    }

    #[test]
    fn oblong_pictures_and_jpeg_are_read() {
        let oblong = RgbImage::from_fn(24, 8, |x, _| Rgb([if x < 16 { 0 } else { 255 }; 3]));
        let source = SourcePicture::decode(&file(oblong, ImageFormat::Jpeg), false).unwrap();
        assert_eq!((source.width(), source.height()), (24, 8));
        // Blocks of 8 × 8 of one colour survive JPEG.
        assert_eq!((source.pixel(3, 3), source.pixel(20, 5)), ([0.0, 0.0, 0.0, 1.0], [1.0; 4]));
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        assert!(matches!(SourcePicture::decode(b"P6", false), Err(PictureFault::Unreadable { .. })));
        for (width, height, found) in [(0, 0, 0), (2, 2, 3), (usize::MAX, 2, 1)] {
            let pixels = vec![[0.0; 4]; found];
            let fault = SourcePicture::from_straight(width, height, pixels, false);
            assert_eq!(fault, Err(PictureFault::Pixels { width, height, found }));
        }
    }
}
