//! The styles of the theme `textbook`, painted by formulas of light ([STF-12]).
//!
//! Each style is a function of the unit normal towards the eye; its file says what it looks like and why. All are lit
//! from the upper left, as plates of medical textbooks are, and end in a thin ring of a dark, warm colour of their
//! own, which style contours ([STF-8]) are drawn with. The files in `data/themes` are these functions on 256 × 256
//! texels, and a test holds them to it.

mod bone;
mod cartoon;
mod glass;
mod ink;
mod light;
mod metal;
mod paint;
mod sheet;
mod skin;
mod tone;
mod vessel;
mod wax;

pub use sheet::preview_sheet;

use crate::number::Vec3;
use drypoint_scene::color::Rgba;
use drypoint_scene::style::is_inside;
use paint::Paint;

/// A style as a formula: straight sRGB and opacity, all in [0, 1], of the unit normal (N_z ≥ 0).
#[derive(Clone, Copy, Debug)]
pub struct GalleryStyle {
    shade: fn(Vec3<f64>) -> (Paint, f64),
}

/// The styles by name, in alphabetical order.
pub fn gallery() -> Vec<(&'static str, GalleryStyle)> {
    let style = |shade| GalleryStyle { shade };
    vec![
        ("bone", style(bone::shade)),
        ("cartoon", style(cartoon::shade)),
        ("glass", style(glass::shade)),
        ("ink", style(ink::shade)),
        ("metal", style(metal::shade)),
        ("skin", style(skin::shade)),
        ("tone", style(tone::shade)),
        ("vessel", style(vessel::shade)),
        ("wax", style(wax::shade)),
    ]
}

impl GalleryStyle {
    /// Straight sRGB and opacity of the normal whose first components are x and y; N_z follows, 0 beyond the disk.
    pub fn shade(&self, x: f64, y: f64) -> Rgba {
        let z = (1.0 - x * x - y * y).max(0.0).sqrt();
        let (paint, alpha) = (self.shade)(Vec3::new(x, y, z));
        let [r, g, b] = paint.srgb();
        [r, g, b, alpha]
    }

    /// The picture as S × S straight RGBA bytes, row by row from the top: what a style's file holds ([STF-1]). Texels
    /// whose centres lie outside the inscribed disk are transparent black.
    pub fn rgba8(&self, side: usize) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(4 * side * side);
        let centre = |k: usize| (2 * k + 1) as f64 / side as f64 - 1.0;
        for j in 0..side {
            for i in 0..side {
                if is_inside(side, i, j) {
                    let rgba = self.shade(centre(i), -centre(j));
                    bytes.extend((0..4).map(|c| quantize(rgba[c], i, j, c)));
                } else {
                    bytes.extend([0; 4]);
                }
            }
        }
        bytes
    }
}

/// A channel in [0, 1] as a byte. The rounding threshold is spread by the two-dimensional golden-ratio sequence
/// (multiples of 1/ρ and 1/ρ², ρ³ = ρ + 1), so that slow gradients show no steps and neighbours round differently.
/// 0 and 1 stay exact.
fn quantize(x: f64, i: usize, j: usize, channel: usize) -> u8 {
    let spread = i as f64 * 0.754_877_666_246_692_8 + j as f64 * 0.569_840_290_998_053_3 + channel as f64 * 0.25;
    let threshold = spread - spread.floor();
    (x.clamp(0.0, 1.0) * 255.0 + threshold).floor().min(255.0) as u8
}

#[cfg(test)]
mod tests {
    use super::light::{BOUNCE, KEY};
    use super::*;
    use drypoint_scene::color::srgb_to_linear;
    use drypoint_scene::style::{Style, Theme, load};
    use drypoint_scene::tables::Styles;

    /// Relative luminance (IEC 61966-2-1) of the style at (x, y).
    fn luminance(style: &GalleryStyle, x: f64, y: f64) -> f64 {
        let [r, g, b, _] = style.shade(x, y).map(srgb_to_linear);
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    /// Directions all round the circumference.
    fn directions() -> impl Iterator<Item = (f64, f64)> {
        (0..72).map(|k| f64::from(5 * k).to_radians()).map(|angle| (angle.cos(), angle.sin()))
    }

    #[test]
    fn the_files_of_the_theme_are_what_these_formulas_paint() {
        let table = Styles::default();
        let theme = Theme::open(&table.theme).unwrap();
        let names: Vec<&str> = gallery().iter().map(|(name, _)| *name).collect();
        assert_eq!(theme.names().collect::<Vec<_>>(), names);
        for (file, (name, style)) in load(&table, names).unwrap().iter().zip(gallery()) {
            let straight: Vec<Rgba> = style
                .rgba8(file.side)
                .chunks_exact(4)
                .map(|c| [c[0], c[1], c[2], c[3]].map(|byte| f64::from(byte) / 255.0))
                .collect();
            assert_eq!(*file, Style::from_straight(name, file.side, &straight, false).unwrap(), "{name}");
        }
    }

    #[test]
    fn every_style_but_glass_is_opaque_and_glass_clears_towards_the_middle() {
        for (name, style) in gallery() {
            let alpha = |r: f64, (x, y): (f64, f64)| style.shade(r * x, r * y)[3];
            for direction in directions() {
                let radii = (0..=100).map(|k| f64::from(k) / 100.0);
                if name == "glass" {
                    assert!(radii.map(|r| alpha(r, direction)).all(|a| a > 0.0 && a <= 1.0));
                    assert_eq!(alpha(1.0, direction), 1.0);
                    // Away from the highlight it clears steadily.
                    if direction.0 * KEY.x + direction.1 * KEY.y < 0.0 {
                        assert!((0..100).all(|k| alpha(f64::from(k) / 100.0, direction)
                            < alpha(f64::from(k + 1) / 100.0, direction) + 1e-12));
                    }
                } else {
                    assert!(radii.map(|r| alpha(r, direction)).all(|a| a == 1.0), "{name}");
                }
            }
        }
        let (_, glass) = gallery().into_iter().find(|(name, _)| *name == "glass").unwrap();
        assert!(glass.shade(0.0, 0.0)[3] < 0.1);
    }

    #[test]
    fn the_circumference_draws_a_dark_line_that_is_darkest_in_the_shade() {
        for (name, style) in gallery() {
            let middle = luminance(&style, 0.0, 0.0);
            for (x, y) in directions() {
                let line = luminance(&style, x, y);
                assert!(line < 0.12 && line < 0.3 * middle, "{name} at ({x:.2}, {y:.2}): {line}");
            }
            let towards = |light: Vec3<f64>| {
                let r = light.x.hypot(light.y);
                luminance(&style, light.x / r, light.y / r)
            };
            assert!(towards(KEY) >= towards(BOUNCE), "{name}");
        }
    }

    #[test]
    fn all_are_lit_from_the_upper_left() {
        for (name, style) in gallery() {
            // Where the light falls, and the mirror image of that place.
            assert!(luminance(&style, KEY.x, KEY.y) > 1.1 * luminance(&style, -KEY.x, -KEY.y), "{name}");
        }
    }

    #[test]
    fn nothing_outside_the_disk_is_painted() {
        let side = 64;
        let bytes = gallery()[0].1.rgba8(side);
        for (t, texel) in bytes.chunks_exact(4).enumerate() {
            assert_eq!(texel[3] == 255, is_inside(side, t % side, t / side));
            assert!(texel[3] == 255 || texel == [0; 4]);
        }
    }

    #[test]
    fn bytes_keep_the_ends_and_the_mean() {
        for k in 0..50 {
            assert_eq!((quantize(0.0, k, 3 * k, 1), quantize(1.0, k, 3 * k, 1)), (0, 255));
        }
        // The sequence's discrepancy over 64 × 64 texels is far below 1/64 of a step.
        for x in [0.1234, 0.5, 0.777] {
            let sum: u64 = (0..64 * 64).map(|t| u64::from(quantize(x, t % 64, t / 64, 2))).sum();
            assert!((sum as f64 / 4096.0 - 255.0 * x).abs() < 1.0 / 64.0, "{x}");
        }
    }

    #[test]
    fn a_file_loses_less_than_a_step() {
        let (_, wax) = gallery().into_iter().find(|(name, _)| *name == "wax").unwrap();
        let side = 32;
        let bytes = wax.rgba8(side);
        for (t, texel) in bytes.chunks_exact(4).enumerate().filter(|(_, texel)| texel[3] == 255) {
            let centre = |k: usize| (2 * k + 1) as f64 / side as f64 - 1.0;
            let exact = wax.shade(centre(t % side), -centre(t / side));
            for c in 0..3 {
                // The spread threshold rounds up or down: less than one step.
                assert!((f64::from(texel[c]) - 255.0 * exact[c]).abs() < 1.0);
            }
        }
    }
}
