//! Reading of PNG as linear premultiplied light ([VAL-3]).

use super::{DEFLATE, Image, ImageLimits, check_claim};
use crate::OutputError;
use drypoint_scene::color::srgb_to_linear;
use png::{BitDepth, ColorType, DecodeOptions, Decoder, DecodingError, Info, Limits, Transformations};
use std::io::Cursor;
use std::path::Path;

/// Bytes of memory of a decoded pixel: four channels.
const DECODED: usize = 4 * 8;

/// Most bytes of memory that a pixel takes while decoding: four channels of 16 bits, their codes, and light.
const PIXEL: usize = 4 * (2 + 2) + DECODED;

/// Decodes a PNG of any colour type and depth.
pub(super) fn decode(bytes: &[u8], path: &Path, limits: &ImageLimits) -> Result<Image, OutputError> {
    let broken = |error: DecodingError| OutputError::Malformed {
        path: path.into(),
        field: "PNG".into(),
        fault: error.to_string(),
    };
    // Text and colour profiles do not affect the numbers, so they are not unpacked.
    let mut options = DecodeOptions::default();
    options.set_ignore_text_chunk(true);
    options.set_ignore_iccp_chunk(true);
    let mut decoder = Decoder::new_with_options(Cursor::new(bytes), options);
    let info = decoder.read_header_info().map_err(broken)?;
    let (claimed, size) = (raw_bytes(info), [info.width, info.height].map(|n| n as usize));
    check_claim(claimed, DEFLATE, bytes, path)?;
    limits.check(path, size, PIXEL, DECODED)?;
    // The claim is checked above. The decoder's own limit would refuse large honest pictures.
    decoder.set_limits(Limits { bytes: usize::MAX });
    // Palette to colours, grey of 1, 2 and 4 bits to 8 (a whole factor), transparent colours to alpha.
    decoder.set_transformations(Transformations::EXPAND);
    let mut reader = decoder.read_info().map_err(broken)?;
    let too_large = OutputError::TooLarge { path: path.into(), claimed: u64::MAX, length: bytes.len() as u64 };
    let mut data = vec![0; reader.output_buffer_size().ok_or(too_large)?];
    let info = reader.next_frame(&mut data).map_err(broken)?;

    let (width, height) = (info.width as usize, info.height as usize);
    let codes: Vec<u16> = match info.bit_depth {
        BitDepth::Sixteen => data.chunks_exact(2).map(|c| u16::from_be_bytes([c[0], c[1]])).collect(),
        _ => data.iter().map(|&c| u16::from(c)).collect(),
    };
    let largest = if info.bit_depth == BitDepth::Sixteen { 65535 } else { 255 };
    let light: Vec<f64> = (0..=largest).map(|code| srgb_to_linear(f64::from(code) / f64::from(largest))).collect();
    // Indices of red, green, blue and alpha among the samples of a pixel. No alpha: opaque.
    let (samples, places, alpha) = match info.color_type {
        ColorType::Grayscale => (1, [0, 0, 0], None),
        ColorType::GrayscaleAlpha => (2, [0, 0, 0], Some(1)),
        ColorType::Rgb | ColorType::Indexed => (3, [0, 1, 2], None),
        ColorType::Rgba => (4, [0, 1, 2], Some(3)),
    };
    let pixels = || codes.chunks_exact(samples).take(width * height);
    let opacity: Vec<f64> =
        pixels().map(|p| alpha.map_or(1.0, |at: usize| f64::from(p[at]) / f64::from(largest))).collect();
    let mut channels: Vec<(String, Vec<f64>)> = ["R", "G", "B"]
        .into_iter()
        .zip(places)
        .map(|(name, at)| (name.into(), pixels().zip(&opacity).map(|(p, a)| light[usize::from(p[at])] * a).collect()))
        .collect();
    channels.push(("A".into(), opacity));
    Ok(Image { width, height, channels })
}

/// Whether a PNG contains opacity: an alpha channel, or a transparent colour.
pub(super) fn has_alpha(bytes: &[u8]) -> bool {
    let reader = Decoder::new(Cursor::new(bytes)).read_info();
    reader.is_ok_and(|reader| {
        let info = reader.info();
        matches!(info.color_type, ColorType::GrayscaleAlpha | ColorType::Rgba) || info.trns.is_some()
    })
}

/// Returns the bytes of the unpacked rows, with a filter byte a row; none if the number overflows.
fn raw_bytes(info: &Info<'_>) -> Option<u64> {
    let bits = u64::from(info.width) * info.color_type.samples() as u64 * info.bit_depth as u64;
    (bits.div_ceil(8) + 1).checked_mul(u64::from(info.height))
}

#[cfg(test)]
mod tests {
    use super::super::{ColorChannels, decode};
    use super::{BitDepth, ColorType, OutputError, Path, srgb_to_linear};
    use png::Encoder;

    fn file(width: u32, color: ColorType, depth: BitDepth, data: &[u8], palette: Option<(&[u8], &[u8])>) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = Encoder::new(&mut bytes, width, 1);
        encoder.set_color(color);
        encoder.set_depth(depth);
        if let Some((colors, alphas)) = palette {
            if !colors.is_empty() {
                encoder.set_palette(colors);
            }
            encoder.set_trns(alphas);
        }
        // A gamma and chromaticities that would change everything, were they read.
        encoder.set_source_gamma(png::ScaledFloat::new(1.0));
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(data).unwrap();
        writer.finish().unwrap();
        bytes
    }

    fn pixels(bytes: &[u8]) -> Vec<[f64; 4]> {
        let image = decode(bytes, Path::new("a.png")).unwrap();
        let ColorChannels { rgb: [r, g, b], alpha } = image.colors().unwrap();
        (0..r.len()).map(|i| [r[i], g[i], b[i], alpha.unwrap()[i]]).collect()
    }

    #[test]
    fn every_colour_type() {
        let l = |code: u8| srgb_to_linear(f64::from(code) / 255.0);
        let w = |code: u16| srgb_to_linear(f64::from(code) / 65535.0);
        use {BitDepth as D, ColorType as C};
        // Grey of 1, 2, 4 bits: code/(2ⁿ − 1), which is a whole number of 255ths.
        assert_eq!(pixels(&file(2, C::Grayscale, D::One, &[0b1000_0000], None)), [[1.0; 4], [0.0, 0.0, 0.0, 1.0]]);
        let (third, seven) = (l(85), l(119));
        assert_eq!(pixels(&file(1, C::Grayscale, D::Two, &[0b0100_0000], None)), [[third, third, third, 1.0]]);
        assert_eq!(pixels(&file(1, C::Grayscale, D::Four, &[0x70], None)), [[seven, seven, seven, 1.0]]);
        assert_eq!(pixels(&file(1, C::Grayscale, D::Sixteen, &[1, 2], None)), [[w(258), w(258), w(258), 1.0]]);
        // Alpha is divided by 255 and never decoded; colours are multiplied by it after decoding.
        let a = 51.0 / 255.0;
        let grey = l(100) * a;
        assert_eq!(pixels(&file(1, C::GrayscaleAlpha, D::Eight, &[100, 51], None)), [[grey, grey, grey, a]]);
        assert_eq!(
            pixels(&file(1, C::Rgba, D::Eight, &[9, 80, 200, 51], None)),
            [[l(9) * a, l(80) * a, l(200) * a, a]]
        );
        assert_eq!(pixels(&file(1, C::Rgb, D::Sixteen, &[0, 1, 2, 3, 4, 5], None)), [[w(1), w(515), w(1029), 1.0]]);
        // A palette whose second colour is half transparent, and a transparent colour of an RGB picture.
        let palette = (&[255, 0, 0, 0, 0, 255][..], &[255, 102][..]);
        assert_eq!(
            pixels(&file(2, C::Indexed, D::One, &[0b0100_0000], Some(palette))),
            [[1.0, 0.0, 0.0, 1.0], [0.0, 0.0, 0.4, 0.4]]
        );
        let key = (&[][..], &[0, 1, 0, 2, 0, 3][..]);
        assert_eq!(pixels(&file(2, C::Rgb, D::Eight, &[1, 2, 3, 255, 255, 255], Some(key))), [[0.0; 4], [1.0; 4]]);
    }

    #[test]
    fn a_header_that_lies_allocates_nothing() {
        let mut bytes = file(1, ColorType::Rgba, BitDepth::Eight, &[0; 4], None);
        bytes[16..24].copy_from_slice(&[0x7f, 0xff, 0xff, 0xff, 0x7f, 0xff, 0xff, 0xff]);
        let check = crc(&bytes[12..29]);
        bytes[29..33].copy_from_slice(&check.to_be_bytes());
        assert!(matches!(decode(&bytes, Path::new("a.png")), Err(OutputError::TooLarge { .. })));
    }

    /// The check sum of a chunk: CRC-32, bit by bit.
    fn crc(bytes: &[u8]) -> u32 {
        !bytes.iter().fold(!0u32, |crc, &byte| {
            (0..8).fold(crc ^ u32::from(byte), |c, _| if c & 1 == 1 { c >> 1 ^ 0xedb8_8320 } else { c >> 1 })
        })
    }
}
