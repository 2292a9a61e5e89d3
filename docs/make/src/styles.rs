//! The pictures of `data/themes/textbook`, from the formulas in `reference`.

use drypoint_reference::style_transfer_functions::gallery::gallery;
use std::path::Path;

/// Side of a style's picture, in texels.
const SIDE: usize = 256;

/// Writes every style of the gallery as an 8-bit RGBA PNG in sRGB.
///
/// # Errors
/// What the system or the encoder says, with the file.
pub(crate) fn write() -> Result<(), String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/themes/textbook");
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    for (name, style) in gallery() {
        let file = folder.join(format!("{name}.png"));
        let bytes = encode(&style.rgba8(SIDE)).map_err(|e| format!("{}: {e}", file.display()))?;
        std::fs::write(&file, &bytes).map_err(|e| format!("{}: {e}", file.display()))?;
        println!("{name}.png ({} kB)", bytes.len().div_ceil(1000));
    }
    Ok(())
}

/// The file of SIDE × SIDE RGBA bytes.
fn encode(rgba: &[u8]) -> Result<Vec<u8>, png::EncodingError> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, SIDE as u32, SIDE as u32);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_compression(png::Compression::High);
    encoder.write_header()?.write_image_data(rgba)?;
    Ok(file)
}
