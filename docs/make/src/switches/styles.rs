//! The two styles that the scenes of the switches have of their own.

use super::folder;
use drypoint::scene::math::pow;
use drypoint::scene::philox::uniform;

/// A style's file and its bytes.
type File = (&'static str, Result<Vec<u8>, png::EncodingError>);

/// All of them.
fn files() -> [File; 2] {
    [("grain.png", grain()), ("stain.png", stain())]
}

/// Writes them beside the scenes.
///
/// # Errors
/// What the system or the encoder says, with the file.
pub(super) fn write() -> Result<(), String> {
    for (name, bytes) in files() {
        let path = folder().join(name);
        let bytes = bytes.map_err(|e| format!("{}: {e}", path.display()))?;
        std::fs::write(&path, &bytes).map_err(|e| format!("{}: {e}", path.display()))?;
        println!("{name} ({} kB)", bytes.len().div_ceil(1000));
    }
    Ok(())
}

/// The normal (N_x, N_y) at the centre of each texel, row by row from the top.
fn normals(side: usize) -> impl Iterator<Item = ([usize; 2], f64, f64)> {
    let at = move |k: usize| (2 * k + 1) as f64 / side as f64 - 1.0;
    (0..side * side).map(move |t| ([t % side, t / side], at(t % side), -at(t / side)))
}

/// Dark grains on light ground, as many as the ball is dark there: a tone that is there only on the average.
fn grain() -> Result<Vec<u8>, png::EncodingError> {
    const SIDE: usize = 512;
    const PALETTE: [u8; 6] = [0xfb, 0xf4, 0xe6, 0x3a, 0x1f, 0x28];
    let mut rows = vec![0u8; SIDE * SIDE / 8];
    for ([i, j], x, y) in normals(SIDE) {
        let r2 = x * x + y * y;
        if r2 > 1.0 {
            continue;
        }
        let light = 0.6 * y - 0.45 * x + 0.66 * (1.0 - r2).sqrt();
        let shadow = 0.04 + 0.62 * pow((1.0 - light).max(0.0), 1.3);
        let rim = if r2 > 0.86 { 0.5 } else { 0.0 };
        if uniform(1, [i as u32, j as u32, 0], 0) < shadow + rim {
            rows[(j * SIDE + i) / 8] |= 0x80 >> (i % 8);
        }
    }
    encode(SIDE, png::ColorType::Indexed, png::BitDepth::One, Some(&PALETTE), &rows)
}

/// One red, opaque at the rim and all but transparent in the middle.
fn stain() -> Result<Vec<u8>, png::EncodingError> {
    const SIDE: usize = 64;
    let opacity = |x: f64, y: f64| 0.015 + 0.885 * pow((x * x + y * y).min(1.0), 2.5);
    let texel = |(_, x, y)| [0xc8, 0x1c, 0x28, (255.0 * opacity(x, y)).round() as u8];
    let texels: Vec<u8> = normals(SIDE).flat_map(texel).collect();
    encode(SIDE, png::ColorType::Rgba, png::BitDepth::Eight, None, &texels)
}

fn encode(
    side: usize,
    color: png::ColorType,
    depth: png::BitDepth,
    palette: Option<&'static [u8]>,
    texels: &[u8],
) -> Result<Vec<u8>, png::EncodingError> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, side as u32, side as u32);
    encoder.set_color(color);
    encoder.set_depth(depth);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_compression(png::Compression::High);
    if let Some(palette) = palette {
        encoder.set_palette(palette);
    }
    encoder.write_header()?.write_image_data(texels)?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checked_in_files_are_what_the_formulas_say() {
        for (name, bytes) in files() {
            let written = std::fs::read(folder().join(name)).unwrap();
            assert!(
                written == bytes.unwrap(),
                "{name} is out of date: cargo run --release -p drypoint-docs -- switches"
            );
        }
    }
}
