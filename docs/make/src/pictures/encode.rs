//! PNG files for pages: small, opaque, without metadata.

use drypoint::output::encode::{quantize, straight_srgb};
use drypoint::scene::picture::{LayerKind, Picture};

/// Black ink on white as 16 greys, which is all that the edge of a dot needs, the smallest file.
pub(super) fn ink_png(picture: &Picture) -> Result<Vec<u8>, png::EncodingError> {
    let mut data = Vec::with_capacity((picture.width / 2 + 1) * picture.height);
    if let Some([r, g, b, ..]) = picture.layer(LayerKind::Beauty).map(|layer| layer.channels.as_slice()) {
        let grey = |i: usize| quantize(straight_srgb([r[i], g[i], b[i], 1.0])[1], 15) as u8;
        for row in 0..picture.height {
            let pixels: Vec<u8> = (0..picture.width).map(|x| grey(row * picture.width + x)).collect();
            data.extend(pixels.chunks(2).map(|pair| (pair[0] << 4) | pair.get(1).copied().unwrap_or(0)));
        }
    }
    encode(picture, (png::ColorType::Grayscale, None), png::BitDepth::Four, &data)
}

/// Ink of several colours on white, each channel in six steps: a table of 216 colours, a third of the file.
pub(super) fn inks_png(picture: &Picture) -> Result<Vec<u8>, png::EncodingError> {
    let mut data = Vec::with_capacity(picture.width * picture.height);
    if let Some([r, g, b, ..]) = picture.layer(LayerKind::Beauty).map(|layer| layer.channels.as_slice()) {
        data.extend(r.iter().zip(g).zip(b).map(|((&r, &g), &b)| {
            let [r, g, b, _] = straight_srgb([r, g, b, 1.0]);
            [r, g, b].iter().fold(0, |code, c| 6 * code + quantize(*c, 5) as u8)
        }));
    }
    let palette = (0..216u8).flat_map(|code| [code / 36, code / 6 % 6, code % 6]).map(|step| 51 * step).collect();
    encode(picture, (png::ColorType::Indexed, Some(palette)), png::BitDepth::Eight, &data)
}

/// An opaque picture as 8 bits of sRGB without alpha, the smallest file.
pub(super) fn opaque_png(picture: &Picture) -> Result<Vec<u8>, png::EncodingError> {
    let mut data = Vec::with_capacity(3 * picture.width * picture.height);
    if let Some([r, g, b, ..]) = picture.layer(LayerKind::Beauty).map(|layer| layer.channels.as_slice()) {
        for ((&r, &g), &b) in r.iter().zip(g).zip(b) {
            let [r, g, b, _] = straight_srgb([r, g, b, 1.0]);
            data.extend([r, g, b].map(|c| quantize(c, 255) as u8));
        }
    }
    encode(picture, (png::ColorType::Rgb, None), png::BitDepth::Eight, &data)
}

fn encode(
    picture: &Picture,
    (color, palette): (png::ColorType, Option<Vec<u8>>),
    depth: png::BitDepth,
    data: &[u8],
) -> Result<Vec<u8>, png::EncodingError> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, picture.width as u32, picture.height as u32);
    encoder.set_color(color);
    encoder.set_depth(depth);
    if let Some(palette) = palette {
        encoder.set_palette(palette);
    }
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_compression(png::Compression::High);
    encoder.write_header()?.write_image_data(data)?;
    Ok(file)
}
