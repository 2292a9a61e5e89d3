//! Writing of PNG ([IO-2], [VAL-3]).

use crate::encode::{quantize, straight_srgb};
use crate::layers::{fault, fitting, side};
use crate::{OutputError, atomic};
use drypoint_scene::picture::{LayerKind, Picture, Provenance};
use png::text_metadata::ITXtChunk;
use std::path::Path;

/// Keywords of the text chunks: program with version, hash of the scene, plan.
pub const KEYWORDS: [&str; 3] = ["Software", "Drypoint scene", "Drypoint plan"];

/// Writes the layer `beauty` as an RGBA PNG of 8 or 16 bits a channel, in straight sRGB.
///
/// Text chunks carry the provenance, an `sRGB` chunk the colour space. There is no date: equal pictures give equal
/// bytes. The file appears whole or not at all.
///
/// # Errors
/// [`OutputError::Bits`], [`OutputError::Layer`] if the picture has no beauty or one that does not fit its size,
/// [`OutputError::Io`].
pub fn write_png(picture: &Picture, bits: u8, provenance: &Provenance, path: &Path) -> Result<(), OutputError> {
    atomic::write(path, &encode_png(picture, bits, provenance)?)
}

/// Returns the bytes of [`write_png`].
///
/// # Errors
/// Same errors as [`write_png`], except those of the file.
pub fn encode_png(picture: &Picture, bits: u8, provenance: &Provenance) -> Result<Vec<u8>, OutputError> {
    let data = rgba_codes(picture, bits)?;
    let info = info([picture.width, picture.height], bits, provenance)?;
    let mut bytes = Vec::new();
    write_chunks(&mut bytes, info, &data).map_err(|error| fault(LayerKind::Beauty, error.to_string()))?;
    Ok(bytes)
}

/// Returns the layer `beauty` as a PNG's bytes before compression: RGBA in straight sRGB, row by row from the top. The
/// higher byte of a 16-bit code comes first.
///
/// # Errors
/// Same errors as [`encode_png`].
pub fn rgba_codes(picture: &Picture, bits: u8) -> Result<Vec<u8>, OutputError> {
    let channels = &fitting(picture, LayerKind::Beauty)?.channels;
    let pixels =
        (0..channels[0].len()).map(|i| straight_srgb([channels[0][i], channels[1][i], channels[2][i], channels[3][i]]));
    match bits {
        8 => Ok(pixels.flat_map(|p| p.map(|c| quantize(c, 255) as u8)).collect()),
        16 => Ok(pixels.flat_map(|p| p.map(|c| quantize(c, 65535).to_be_bytes())).flatten().collect()),
        _ => Err(OutputError::Bits { bits }),
    }
}

/// Returns the chunks before the pixels: size and depth, the colour space and the provenance.
pub(crate) fn info(size: [usize; 2], bits: u8, provenance: &Provenance) -> Result<png::Info<'static>, OutputError> {
    let depth = match bits {
        8 => png::BitDepth::Eight,
        16 => png::BitDepth::Sixteen,
        _ => return Err(OutputError::Bits { bits }),
    };
    let mut info = png::Info::with_size(side(size[0], LayerKind::Beauty)?, side(size[1], LayerKind::Beauty)?);
    info.color_type = png::ColorType::Rgba;
    info.bit_depth = depth;
    info.srgb = Some(png::SrgbRenderingIntent::Perceptual);
    for (keyword, text) in KEYWORDS.into_iter().zip([&provenance.software, &provenance.scene_hash, &provenance.plan]) {
        info.utf8_text.push(ITXtChunk::new(keyword, text.as_str()));
    }
    Ok(info)
}

/// Writes numbers in [0, 1] as a grey PNG of 8 or 16 bits. The codes are proportional to the numbers, and no chunk
/// names a colour space. Row 0 is the top. The file appears whole or not at all.
///
/// # Errors
/// [`OutputError::Bits`], [`OutputError::Layer`] for numbers that do not fit the size, [`OutputError::Io`].
pub fn write_grey_png(size: [usize; 2], values: &[f64], bits: u8, path: &Path) -> Result<(), OutputError> {
    atomic::write(path, &encode_grey_png(size, values, bits)?)
}

/// Returns the bytes of [`write_grey_png`].
///
/// # Errors
/// Same errors as [`write_grey_png`], except those of the file.
pub fn encode_grey_png(size: [usize; 2], values: &[f64], bits: u8) -> Result<Vec<u8>, OutputError> {
    encode_numbers(size, values, bits, png::ColorType::Grayscale)
}

/// Writes quadruples of numbers in [0, 1] as an RGBA PNG of 8 or 16 bits. The codes are proportional to the numbers,
/// which are not premultiplied, and no chunk names a colour space. Row 0 is the top. The file appears whole or not at
/// all.
///
/// # Errors
/// [`OutputError::Bits`], [`OutputError::Layer`] for numbers that do not fit the size, [`OutputError::Io`].
pub fn write_rgba_table(size: [usize; 2], values: &[[f64; 4]], bits: u8, path: &Path) -> Result<(), OutputError> {
    atomic::write(path, &encode_numbers(size, values.as_flattened(), bits, png::ColorType::Rgba)?)
}

/// Returns a PNG whose codes are proportional to numbers in [0, 1], pixel by pixel.
fn encode_numbers(size: [usize; 2], values: &[f64], bits: u8, color: png::ColorType) -> Result<Vec<u8>, OutputError> {
    let pixels = size[0].checked_mul(size[1]);
    if pixels.and_then(|pixels| pixels.checked_mul(color.samples())) != Some(values.len()) {
        let text = format!("{} numbers for {}x{} pixels", values.len(), size[0], size[1]);
        return Err(fault(LayerKind::Beauty, text));
    }
    let codes = |largest: u16| values.iter().map(move |v| quantize(v.clamp(0.0, 1.0), largest));
    let (depth, data): (_, Vec<u8>) = match bits {
        8 => (png::BitDepth::Eight, codes(255).map(|code| code as u8).collect()),
        16 => (png::BitDepth::Sixteen, codes(65535).flat_map(u16::to_be_bytes).collect()),
        _ => return Err(OutputError::Bits { bits }),
    };
    let mut info = png::Info::with_size(side(size[0], LayerKind::Beauty)?, side(size[1], LayerKind::Beauty)?);
    info.color_type = color;
    info.bit_depth = depth;
    let mut bytes = Vec::new();
    write_chunks(&mut bytes, info, &data).map_err(|error| fault(LayerKind::Beauty, error.to_string()))?;
    Ok(bytes)
}

fn write_chunks(bytes: &mut Vec<u8>, info: png::Info<'_>, data: &[u8]) -> Result<(), png::EncodingError> {
    let mut writer = png::Encoder::with_info(bytes, info)?.write_header()?;
    writer.write_image_data(data)?;
    writer.finish()
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::picture::Layer;

    fn picture(pixels: &[[f64; 4]]) -> Picture {
        let channels = (0..4).map(|c| pixels.iter().map(|p| p[c]).collect()).collect();
        Picture { width: pixels.len(), height: 1, layers: vec![Layer { kind: LayerKind::Beauty, channels }] }
    }

    fn provenance() -> Provenance {
        Provenance {
            software: "Drypoint 0.1.0".into(),
            scene_hash: "00ff".into(),
            plan: "κ along v: from [contours]\nvalue".into(),
        }
    }

    /// Names of the chunks in a PNG, and its pixels without any transformation.
    fn read(bytes: &[u8]) -> (Vec<String>, png::Info<'static>, Vec<u8>) {
        let (mut names, mut at) = (Vec::new(), 8);
        while at < bytes.len() {
            let length = u32::from_be_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
            names.push(String::from_utf8(bytes[at + 4..at + 8].to_vec()).unwrap());
            at += 12 + length;
        }
        let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().unwrap();
        let mut data = vec![0; reader.output_buffer_size().unwrap()];
        reader.next_frame(&mut data).unwrap();
        (names, reader.info().clone(), data)
    }

    #[test]
    fn pixels_of_both_depths() {
        // Worked out in `encode`: straight, encoded, ties to even, clamped.
        let pixels = [[0.5, 0.25, 0.0, 0.5], [0.3, 0.2, 0.1, 0.0], [-1.0, 2.0, 0.215_860_500_1, 1.0]];
        let (_, info, data) = read(&encode_png(&picture(&pixels), 8, &provenance()).unwrap());
        assert_eq!((info.bit_depth, info.color_type), (png::BitDepth::Eight, png::ColorType::Rgba));
        assert_eq!(data, [255, 188, 0, 128, 0, 0, 0, 0, 0, 255, 128, 255]);
        let (_, info, data) = read(&encode_png(&picture(&pixels), 16, &provenance()).unwrap());
        assert_eq!(info.bit_depth, png::BitDepth::Sixteen);
        let words: Vec<_> = data.chunks(2).map(|w| u16::from_be_bytes([w[0], w[1]])).collect();
        assert_eq!(words, [65535, 48192, 0, 32768, 0, 0, 0, 0, 0, 65535, 32896, 65535]);
    }

    #[test]
    fn grey_codes_are_the_numbers() {
        let values = [0.0, 0.5, 1.0, -1.0, 2.0, 0.25];
        let (names, info, data) = read(&encode_grey_png([3, 2], &values, 8).unwrap());
        assert_eq!(names, ["IHDR", "IDAT", "IEND"]);
        assert_eq!((info.bit_depth, info.color_type), (png::BitDepth::Eight, png::ColorType::Grayscale));
        assert_eq!(data, [0, 128, 255, 0, 255, 64]);
        let (_, info, data) = read(&encode_grey_png([3, 2], &values, 16).unwrap());
        assert_eq!(info.bit_depth, png::BitDepth::Sixteen);
        let words: Vec<_> = data.chunks(2).map(|w| u16::from_be_bytes([w[0], w[1]])).collect();
        assert_eq!(words, [0, 32768, 65535, 0, 65535, 16384]);
        assert!(matches!(encode_grey_png([3, 2], &values, 4), Err(OutputError::Bits { bits: 4 })));
        for size in [[2, 2], [0, 0], [usize::MAX, 2]] {
            assert!(matches!(encode_grey_png(size, &values, 8), Err(OutputError::Layer { .. })));
        }
    }

    #[test]
    fn provenance_and_colour_space_but_no_date() {
        let bytes = encode_png(&picture(&[[1.0; 4]]), 8, &provenance()).unwrap();
        let (names, info, _) = read(&bytes);
        assert_eq!(names, ["IHDR", "sRGB", "iTXt", "iTXt", "iTXt", "IDAT", "IEND"]);
        let texts: Vec<_> =
            info.utf8_text.iter().map(|chunk| (chunk.keyword.clone(), chunk.get_text().unwrap())).collect();
        let expected = provenance();
        let expected = [expected.software, expected.scene_hash, expected.plan];
        assert_eq!(texts, KEYWORDS.map(String::from).into_iter().zip(expected).collect::<Vec<_>>());
    }

    #[test]
    fn same_picture_same_bytes() {
        let picture = picture(&[[0.1, 0.2, 0.3, 0.4], [0.5; 4]]);
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        write_png(&picture, 16, &provenance(), &path).unwrap();
        assert_eq!(std::fs::read(path).unwrap(), encode_png(&picture, 16, &provenance()).unwrap());
    }

    #[test]
    fn bad_requests_are_errors() {
        assert!(matches!(encode_png(&picture(&[[1.0; 4]]), 12, &provenance()), Err(OutputError::Bits { bits: 12 })));
        assert!(matches!(
            encode_png(&Picture { width: 1, height: 1, layers: vec![] }, 8, &provenance()),
            Err(OutputError::Layer { .. })
        ));
    }
}
