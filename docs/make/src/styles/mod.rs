//! The pictures of `data/themes`, painted by the formulas of [`gallery`]; `docs/styles.md` and its sheets of spheres.

mod gallery;

use crate::files;
use drypoint::output::encode::{quantize, straight_srgb};
use drypoint::output::read::Image;
use drypoint::output::sheet::{Layout, sheet};
use drypoint::scene::color::Rgba;
use drypoint::scene::picture::Picture;
use drypoint::scene::style::Style;
use drypoint_reference::style_transfer_functions::preview;
use gallery::{GalleryStyle, GalleryTheme, ROLES, SIDE, THEMES};
use rayon::prelude::*;
use std::path::Path;

/// How the sheets are laid out: small enough that a page of three loads at once.
const LAYOUT: Layout = Layout { columns: Some(7), cell: 96 };

/// The page around its table and its sections, which stand where their names are.
const PAGE: &str = include_str!("page.template");

/// Writes every theme, its sheet, and the page.
///
/// # Errors
/// What the system or the encoder says, with the file.
pub(crate) fn write() -> Result<(), String> {
    for theme in THEMES {
        let styles: Vec<GalleryStyle> = theme.styles().collect();
        let painted: Vec<Vec<u8>> = styles.par_iter().map(|style| style.rgba8(SIDE)).collect();
        theme_files(&theme, &styles, &painted)?;
        let picture = spheres(&styles, &painted)?;
        let file = encode_opaque(&picture).map_err(|e| format!("{}: {e}", sheet_name(&theme)))?;
        files::write(&sheet_name(&theme), &file)?;
    }
    files::write("styles.md", page().as_bytes())
}

/// Writes every style of a theme as an 8-bit RGBA PNG in sRGB.
fn theme_files(theme: &GalleryTheme, styles: &[GalleryStyle], painted: &[Vec<u8>]) -> Result<(), String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/themes").join(theme.name);
    std::fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut sum = 0;
    for (style, bytes) in styles.iter().zip(painted) {
        let file = folder.join(format!("{}.png", style.name));
        let png = encode(SIDE, SIDE, png::ColorType::Rgba, bytes).map_err(|e| format!("{}: {e}", file.display()))?;
        std::fs::write(&file, &png).map_err(|e| format!("{}: {e}", file.display()))?;
        sum += png.len();
    }
    println!("data/themes/{} ({} files, {} kB)", theme.name, styles.len(), sum.div_ceil(1000));
    Ok(())
}

/// The sheet of a theme, as `drypoint styles -o` draws it.
fn spheres(styles: &[GalleryStyle], painted: &[Vec<u8>]) -> Result<Picture, String> {
    let spheres = styles.iter().zip(painted).map(|(style, bytes)| {
        let straight: Vec<Rgba> =
            bytes.chunks_exact(4).map(|c| [c[0], c[1], c[2], c[3]].map(|byte| f64::from(byte) / 255.0)).collect();
        let style = Style::from_straight(style.name, SIDE, &straight, false).map_err(|e| e.to_string())?;
        Ok((style.name.clone(), Image::from(&preview(&style, LAYOUT.cell))))
    });
    sheet(&spheres.collect::<Result<Vec<_>, String>>()?, LAYOUT).map_err(|e| e.to_string())
}

/// The file of an opaque picture: 8 bits, sRGB.
fn encode_opaque(picture: &Picture) -> Result<Vec<u8>, png::EncodingError> {
    let channels = &picture.layers[0].channels;
    let codes: Vec<u8> = (0..channels[0].len())
        .flat_map(|i| {
            let [r, g, b, _] = straight_srgb([channels[0][i], channels[1][i], channels[2][i], 1.0]);
            [r, g, b].map(|c| quantize(c, 255) as u8)
        })
        .collect();
    encode(picture.width, picture.height, png::ColorType::Rgb, &codes)
}

fn encode(width: usize, height: usize, color: png::ColorType, bytes: &[u8]) -> Result<Vec<u8>, png::EncodingError> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width as u32, height as u32);
    encoder.set_color(color);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_compression(png::Compression::High);
    encoder.set_filter(png::Filter::MinEntropy);
    encoder.write_header()?.write_image_data(bytes)?;
    Ok(file)
}

/// A theme's sheet, in `docs/`.
fn sheet_name(theme: &GalleryTheme) -> String {
    format!("pictures/theme-{}.png", theme.name)
}

/// The page with its table of names and a section for each theme.
fn page() -> String {
    let names: String = ROLES.iter().map(|role| format!("| `{}` | {} |\n", role.name, role.purpose)).collect();
    let sections: String = THEMES.iter().map(section).collect();
    PAGE.replace("{names}\n", &names).replace("{themes}\n", &sections)
}

fn section(theme: &GalleryTheme) -> String {
    let rows: String = theme.styles().map(|style| format!("| `{}` | {} |\n", style.name, style.how)).collect();
    let GalleryTheme { name, spirit, .. } = theme;
    let sheet = sheet_name(theme);
    format!(
        "## {name}\n\n{spirit}\n\n![The styles of {name} on spheres]({sheet})\n\n| style | how it is painted |\n|---|---|\n{rows}\n"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checked_in_page_is_what_the_gallery_says() {
        let written = std::fs::read_to_string(files::in_docs("styles.md")).unwrap();
        assert!(written == page(), "docs/styles.md is out of date: cargo run --release -p drypoint-docs -- styles");
    }

    #[test]
    fn pictures_are_small() {
        let size = |file: std::path::PathBuf| std::fs::metadata(file).unwrap().len();
        let mut sum = 0;
        for theme in THEMES {
            assert!(size(files::in_docs(&sheet_name(&theme))) < 300_000, "{}", theme.name);
            for style in theme.styles() {
                let bytes = size(files::in_docs(&format!("../data/themes/{}/{}.png", theme.name, style.name)));
                assert!(bytes < 60_000, "{}/{}: {bytes}", theme.name, style.name);
                sum += bytes;
            }
        }
        // They are part of the program.
        assert!(sum < 2_500_000, "{sum}");
    }
}
