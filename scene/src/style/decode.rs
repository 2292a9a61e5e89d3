//! PNG, JPEG and OpenEXR bytes as straight RGBA numbers ([VAL-3]).

use super::PictureFault;
use crate::color::Rgba;
use crate::memory;
use image::{ColorType, ImageError, ImageReader};
use std::io::Cursor;

/// The largest side of a style's picture, in texels: 512 MiB decoded, far beyond what a lookup can tell apart.
pub const MAX_SIDE: usize = 4096;

/// Most bytes of memory of a texel: four channels for the decoder, for the file, as straight numbers, and in the style.
const EACH: u64 = 2 * 16 + 2 * 32;

/// A square or other picture of straight RGBA in [0, 1], row by row from the top.
pub(super) struct StraightPicture {
    pub(super) width: usize,
    pub(super) height: usize,
    pub(super) texels: Vec<Rgba>,
    /// Whether its colours are linear light by the file's kind.
    pub(super) light: bool,
}

/// A picture whose channels are divided by 2ⁿ − 1, with no other change. Grey is repeated, and a missing alpha is 1.
/// OpenEXR light, which is multiplied by alpha, is divided by alpha; values above 1 become 1.
///
/// # Errors
/// Bytes that are no PNG, JPEG or OpenEXR, damaged ones, and sides above [`MAX_SIDE`] (seen before anything is
/// allocated).
pub(super) fn straight(bytes: &[u8]) -> Result<StraightPicture, PictureFault> {
    let DecodedPicture { width, height, channels, codes } = DecodedPicture::new(bytes, MAX_SIDE, EACH)?;
    let light = matches!(codes, Codes::Light(_));
    let texels = match codes {
        Codes::Eight(codes) => codes.chunks_exact(channels).map(|codes| shares(codes, 255.0)).collect(),
        Codes::Sixteen(codes) => codes.chunks_exact(channels).map(|codes| shares(codes, 65535.0)).collect(),
        Codes::Light(light) => light.chunks_exact(channels).map(of_light).collect(),
    };
    Ok(StraightPicture { width, height, texels, light })
}

/// A decoded picture's channels as the file has them, without the decoder's own colour conversions.
pub(super) struct DecodedPicture {
    pub(super) width: usize,
    pub(super) height: usize,
    /// Channels of a pixel, from one to four.
    pub(super) channels: usize,
    pub(super) codes: Codes,
}

/// The channels of all pixels, row by row from the top.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Codes {
    /// Channels from 0 to 2⁸ − 1.
    Eight(Vec<u8>),
    /// Channels from 0 to 2¹⁶ − 1.
    Sixteen(Vec<u16>),
    /// Linear light, multiplied by alpha where there is one.
    Light(Vec<f32>),
}

impl DecodedPicture {
    /// Decodes the bytes of a PNG, JPEG or OpenEXR file. `each` is the most bytes that a pixel takes, with everything
    /// made from it.
    ///
    /// # Errors
    /// Bytes that are no such picture, damaged ones; sides above `limit` and more pixels than memory has room for
    /// (found before anything is allocated).
    pub(super) fn new(bytes: &[u8], limit: usize, each: u64) -> Result<Self, PictureFault> {
        // Some decoders end their message with a line break, and a fault is told on one line.
        let one_line = |text: String| text.split_whitespace().collect::<Vec<_>>().join(" ");
        let unreadable = |e: ImageError| PictureFault::Unreadable { reason: one_line(e.to_string()) };
        let reader = || ImageReader::new(Cursor::new(bytes)).with_guessed_format().map_err(|e| unreadable(e.into()));
        let (width, height) = reader()?.into_dimensions().map_err(unreadable)?;
        let [width, height] = [width, height].map(|n| n as usize);
        if width > limit || height > limit {
            return Err(PictureFault::TooLarge { width, height, limit });
        }
        memory::room_for((width * height) as u64, each).map_err(|no_room| PictureFault::Memory {
            width,
            height,
            no_room,
        })?;
        let picture = reader()?.decode().map_err(unreadable)?;
        let color = picture.color();
        let bytes = picture.into_bytes();
        let codes = match color {
            ColorType::L8 | ColorType::La8 | ColorType::Rgb8 | ColorType::Rgba8 => Codes::Eight(bytes),
            ColorType::L16 | ColorType::La16 | ColorType::Rgb16 | ColorType::Rgba16 => {
                Codes::Sixteen(bytes.chunks_exact(2).map(|b| u16::from_ne_bytes([b[0], b[1]])).collect())
            }
            ColorType::Rgb32F | ColorType::Rgba32F => {
                Codes::Light(bytes.chunks_exact(4).map(|b| f32::from_ne_bytes([b[0], b[1], b[2], b[3]])).collect())
            }
            other => return Err(PictureFault::Unreadable { reason: format!("texels of type {other:?}") }),
        };
        Ok(Self { width, height, channels: usize::from(color.channel_count()), codes })
    }
}

/// Channels as shares of the largest code.
pub(super) fn shares<C: Copy + Into<f64>>(codes: &[C], largest: f64) -> Rgba {
    let mut numbers = [0.0; 4];
    for (number, &code) in numbers.iter_mut().zip(codes) {
        *number = code.into() / largest;
    }
    rgba(&numbers[..codes.len()])
}

/// Converts light multiplied by alpha to straight RGBA in [0, 1]; NaN becomes 0.
pub(super) fn of_light(channels: &[f32]) -> Rgba {
    let [r, g, b, a] = shares(channels, 1.0).map(|c| c.max(0.0));
    let a = a.min(1.0);
    let straight = |c: f64| if a > 0.0 { (c / a).min(1.0) } else { 0.0 };
    [straight(r), straight(g), straight(b), a]
}

/// The channels of a pixel as red, green, blue and alpha.
fn rgba(channels: &[f64]) -> Rgba {
    match *channels {
        [grey] => [grey, grey, grey, 1.0],
        [grey, a] => [grey, grey, grey, a],
        [r, g, b] => [r, g, b, 1.0],
        [r, g, b, a, ..] => [r, g, b, a],
        [] => [0.0; 4],
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::style::Style;
    use image::{
        DynamicImage, GrayAlphaImage, GrayImage, ImageBuffer, ImageFormat, Luma, LumaA, Rgb, RgbImage, Rgba as Texel,
        RgbaImage,
    };
    use proptest::prelude::*;

    fn png(picture: impl Into<DynamicImage>) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        picture.into().write_to(&mut bytes, ImageFormat::Png).unwrap();
        bytes.into_inner()
    }

    #[test]
    fn every_channel_layout_and_depth() {
        let first = |bytes: &[u8]| straight(bytes).unwrap().texels[0];
        assert_eq!(first(&png(GrayImage::from_pixel(2, 2, Luma([51])))), [0.2, 0.2, 0.2, 1.0]);
        assert_eq!(first(&png(GrayAlphaImage::from_pixel(2, 2, LumaA([51, 102])))), [0.2, 0.2, 0.2, 0.4]);
        assert_eq!(first(&png(RgbImage::from_pixel(2, 2, Rgb([51, 102, 255])))), [0.2, 0.4, 1.0, 1.0]);
        assert_eq!(first(&png(RgbaImage::from_pixel(2, 2, Texel([0, 51, 102, 153])))), [0.0, 0.2, 0.4, 0.6]);
        let deep: ImageBuffer<Texel<u16>, Vec<u16>> = ImageBuffer::from_pixel(2, 2, Texel([1, 13107, 65535, 0]));
        assert_eq!(first(&png(deep)), [1.0 / 65535.0, 0.2, 1.0, 0.0]);
    }

    fn exr(picture: impl Into<DynamicImage>) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        picture.into().write_to(&mut bytes, ImageFormat::OpenExr).unwrap();
        bytes.into_inner()
    }

    /// OpenEXR keeps light times alpha: (¼, ⅛, 1) at alpha ½ is the straight (½, ¼, 1) after the clip, and stays so
    /// whether or not a scene says `linear`.
    #[test]
    fn openexr_is_light_times_alpha() {
        let texel = Texel([0.25_f32, 0.125, 1.0, 0.5]);
        let bytes = exr(ImageBuffer::from_pixel(2, 2, texel));
        for linear in [false, true] {
            let style = Style::decode("lamp", &bytes, linear).unwrap();
            assert_eq!(style.texel(0, 0), [0.25, 0.125, 0.5, 0.5]);
        }
        let bytes = exr(ImageBuffer::from_pixel(2, 2, Rgb([0.5_f32, 14.0, f32::NAN])));
        assert_eq!(Style::decode("chrome", &bytes, false).unwrap().texel(0, 0), [0.5, 1.0, 0.0, 1.0]);
        let clear = exr(ImageBuffer::from_pixel(2, 2, Texel([0.5_f32, 0.5, 0.5, 0.0])));
        assert_eq!(Style::decode("clear", &clear, false).unwrap().texel(0, 0), [0.0; 4]);
    }

    #[test]
    fn rows_come_from_the_top() {
        let picture = RgbaImage::from_fn(2, 2, |x, y| Texel([x as u8 * 255, y as u8 * 255, 0, 255]));
        let style = Style::decode("corners", &png(picture), true).unwrap();
        assert_eq!(style.texel(1, 0), [1.0, 0.0, 0.0, 1.0]);
        assert_eq!(style.texel(0, 1), [0.0, 1.0, 0.0, 1.0]);
    }

    #[test]
    fn what_is_no_square_picture_is_refused() {
        let oblong = png(GrayImage::new(3, 2));
        assert_eq!(Style::decode("s", &oblong, false), Err(PictureFault::NotSquare { width: 3, height: 2 }));
        let wide = png(GrayImage::new(MAX_SIDE as u32 + 1, 1));
        assert!(matches!(Style::decode("s", &wide, false), Err(PictureFault::TooLarge { width: 4097, .. })));
        for bytes in [&b""[..], b"not a picture", &oblong[..oblong.len() / 2]] {
            assert!(matches!(Style::decode("s", bytes, false), Err(PictureFault::Unreadable { .. })));
        }
    }

    /// The decoder's own message ends with a line break.
    #[test]
    fn a_fault_is_told_on_one_line() {
        let cut_off = include_bytes!("../../../fuzz/findings/pictures/cut-off.jpg");
        let fault = Style::decode("s", cut_off, false).unwrap_err().to_string();
        assert!(fault.starts_with("not a readable PNG, JPEG or OpenEXR: ") && !fault.contains('\n'), "{fault:?}");
    }

    #[test]
    fn a_header_that_promises_a_huge_picture_allocates_nothing() {
        let mut bytes = png(GrayImage::new(2, 2));
        // Width and height of IHDR; its checksum no longer fits, which some decoders only notice later.
        bytes[16..24].copy_from_slice(&[0x7f, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff]);
        assert!(Style::decode("s", &bytes, false).is_err());
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(256))]
        #[test]
        fn damaged_pictures_are_errors_and_never_panics(at in 0usize..90, byte: u8, keep in 0usize..=100) {
            let mut bytes = png(RgbaImage::from_fn(8, 8, |x, y| Texel([x as u8, y as u8, 7, 200])));
            let length = bytes.len();
            bytes[at % length] = byte;
            bytes.truncate(length * keep / 100);
            if let Ok(style) = Style::decode("s", &bytes, false) {
                prop_assert_eq!(style.texels.len(), style.side * style.side);
            }
        }
    }
}
