//! What the gallery promises of every theme.

use super::light::{BOUNCE, KEY};
use super::*;
use drypoint::scene::color::srgb_to_linear;
use drypoint::scene::source::Disk;
use drypoint::scene::style::{Style, Theme, load};
use drypoint::scene::tables::{StyleSource, Styles};
use rayon::prelude::*;

/// Every theme and style.
fn all() -> Vec<(&'static str, GalleryStyle)> {
    THEMES.iter().flat_map(|theme| theme.styles().map(|style| (theme.name, style))).collect()
}

/// The style of that name in each theme.
fn named(name: &str) -> Vec<(&'static str, GalleryStyle)> {
    all().into_iter().filter(|(_, style)| style.name == name).collect()
}

/// Linear light at (x, y) over white paper.
fn on_paper(style: &GalleryStyle, x: f64, y: f64) -> [f64; 3] {
    let [r, g, b, a] = style.shade(x, y);
    [r, g, b].map(|c| a * srgb_to_linear(c) + (1.0 - a))
}

/// Relative luminance (IEC 61966-2-1) at (x, y) over white paper.
fn luminance(style: &GalleryStyle, x: f64, y: f64) -> f64 {
    let [r, g, b] = on_paper(style, x, y);
    0.2126 * r + 0.7152 * g + 0.0722 * b
}

/// Directions all round the circumference.
fn directions() -> impl Iterator<Item = (f64, f64)> {
    (0..72).map(|k| f64::from(5 * k).to_radians()).map(|angle| (angle.cos(), angle.sin()))
}

/// Places all over the disk of radius 0.9, about even.
fn places() -> impl Iterator<Item = (f64, f64)> {
    // Vogel's spiral: the golden angle, radii as roots.
    (0..800).map(|k| {
        let (r, angle) = (0.9 * (f64::from(k) / 800.0).sqrt(), f64::from(k) * 2.399_963);
        (r * angle.cos(), r * angle.sin())
    })
}

#[test]
fn every_theme_has_every_name_and_says_how() {
    let names: Vec<&str> = ROLES.iter().map(|role| role.name).collect();
    assert!(names.is_sorted() && names.len() >= 16);
    for theme in THEMES {
        assert_eq!(theme.styles().map(|style| style.name).collect::<Vec<_>>(), names, "{}", theme.name);
        assert!(theme.styles().all(|style| !style.how.is_empty()));
    }
    assert_eq!(THEMES.map(|theme| theme.name).to_vec(), Theme::embedded_names().collect::<Vec<_>>());
    assert_eq!(Styles::default().theme, StyleSource::Embedded(THEMES[0].name.into()));
}

#[test]
fn the_files_of_the_themes_are_what_these_formulas_paint() {
    for theme in THEMES {
        let table = Styles { theme: StyleSource::Embedded(theme.name.into()), files: Vec::new() };
        let names: Vec<String> = Theme::open(&Disk, &table.theme).unwrap().names().map(Into::into).collect();
        let files = load(&Disk, &table, names.iter().map(String::as_str)).unwrap();
        assert_eq!(files.len(), theme.styles().count(), "{}", theme.name);
        let styles: Vec<GalleryStyle> = theme.styles().collect();
        files.par_iter().zip(styles).for_each(|(file, style)| {
            let bytes = style.rgba8(SIDE);
            let straight: Vec<Rgba> =
                bytes.chunks_exact(4).map(|c| [c[0], c[1], c[2], c[3]].map(|byte| f64::from(byte) / 255.0)).collect();
            let painted = Style::from_straight(style.name, SIDE, &straight, false).unwrap();
            assert!(*file == painted, "{}/{}: drypoint-docs styles writes it", theme.name, style.name);
        });
    }
}

#[test]
fn all_are_opaque_but_what_is_to_be_seen_through() {
    for (theme, style) in all() {
        let alpha = |r: f64, (x, y): (f64, f64)| style.shade(r * x, r * y)[3];
        let clear = ["glass", "xray"].contains(&style.name);
        for direction in directions() {
            let alphas: Vec<f64> = (0..=100).map(|k| alpha(f64::from(k) / 100.0, direction)).collect();
            if clear {
                assert!(
                    alphas.iter().all(|a| (0.01..=1.0).contains(a)) && alphas[100] == 1.0,
                    "{theme}/{}",
                    style.name
                );
                // A highlight may stand in the way, but none lies at the lower left.
                if style.name == "xray" || direction.0 * -0.8 + direction.1 * -0.6 > 0.95 {
                    assert!(alphas.windows(2).all(|a| a[0] < a[1] + 1e-12), "{theme}/{}: {direction:?}", style.name);
                }
            } else {
                assert!(alphas.iter().all(|&a| a == 1.0), "{theme}/{}", style.name);
            }
        }
        assert!(!clear || style.shade(0.0, 0.0)[3] < 0.1, "{theme}/{}", style.name);
    }
}

#[test]
fn the_circumference_draws_a_dark_line_that_is_darkest_in_the_shade() {
    for (theme, style) in all().into_iter().filter(|(_, style)| style.name != "constant") {
        let mean = places().map(|(x, y)| luminance(&style, x, y)).sum::<f64>() / 800.0;
        for (x, y) in directions() {
            let line = luminance(&style, x, y);
            // The contrast of WCAG 2: at least 6 to the paper and 1.8 to the style itself.
            assert!(1.05 / (line + 0.05) > 6.0, "{theme}/{} at ({x:.2}, {y:.2}): {line}", style.name);
            assert!((mean + 0.05) / (line + 0.05) > 1.8, "{theme}/{} at ({x:.2}, {y:.2}): {line}, {mean}", style.name);
        }
        let towards = |light: Vec3<f64>| {
            let r = light.x.hypot(light.y);
            luminance(&style, light.x / r, light.y / r)
        };
        // The two are equal where the line has one colour, but for rounding.
        assert!(towards(KEY) >= towards(BOUNCE) - 1e-12, "{theme}/{}", style.name);
    }
}

#[test]
fn all_are_lit_from_the_upper_left() {
    for (theme, style) in all().into_iter().filter(|(_, style)| !["constant", "glass", "xray"].contains(&style.name)) {
        // The mean of the half towards the light, and of the other.
        let half = |sign: f64| -> f64 {
            let here: Vec<f64> = places()
                .filter(|(x, y)| sign * (x * KEY.x + y * KEY.y) > 0.0)
                .map(|(x, y)| luminance(&style, x, y))
                .collect();
            here.iter().sum::<f64>() / here.len() as f64
        };
        assert!(half(1.0) > 1.1 * half(-1.0), "{theme}/{}: {} and {}", style.name, half(1.0), half(-1.0));
    }
    // Glass gathers light on its far side, so only its highlight tells where it comes from.
    for (theme, style) in named("glass") {
        assert!(style.shade(-0.33, 0.44)[3] > 2.0 * style.shade(0.33, -0.44)[3], "{theme}");
    }
}

#[test]
fn constant_is_constant() {
    for (theme, style) in named("constant") {
        let first = style.shade(0.0, 0.0);
        assert!(places().chain(directions()).all(|(x, y)| style.shade(x, y) == first), "{theme}");
    }
}

#[test]
fn cartoons_have_their_tones_and_nothing_else() {
    for (name, tones) in [("cartoon", 4), ("cartoon-2", 2)] {
        for (theme, style) in named(name) {
            let side = 256;
            let bytes = style.rgba8(side);
            let centre = |k: usize| (2 * k + 1) as f64 / side as f64 - 1.0;
            let mut counts = std::collections::BTreeMap::<&[u8], usize>::new();
            let mut all = 0;
            for (t, texel) in bytes.chunks_exact(4).enumerate() {
                if centre(t % side).hypot(centre(t / side)) < 0.91 {
                    *counts.entry(texel).or_default() += 1;
                    all += 1;
                }
            }
            let flat: Vec<usize> = counts.into_values().filter(|&count| count * 100 > all).collect();
            assert_eq!(flat.len(), tones, "{theme}/{name}");
            // The rest is what lies within a border: 0.044 of N·L, two or three of them across the disk.
            assert!(flat.iter().sum::<usize>() * 100 > 90 * all, "{theme}/{name}");
        }
    }
}

#[test]
fn tissues_are_told_apart() {
    let tissues =
        ["bone", "brain", "gall", "gut", "kidney", "liver", "lung", "muscle", "nerve", "spleen", "vein", "vessel"];
    for theme in THEMES {
        let means: Vec<(&str, Paint)> = theme
            .styles()
            .filter(|style| tissues.contains(&style.name))
            .map(|style| {
                let sum = places().fold([0.0; 3], |sum: [f64; 3], (x, y)| {
                    let light = on_paper(&style, x, y);
                    std::array::from_fn(|c| sum[c] + light[c] / 800.0)
                });
                (style.name, Paint::linear(sum))
            })
            .collect();
        assert_eq!(means.len(), tissues.len());
        // Twice the difference that one can just see between large fields, 0.02 in OKLab.
        let alike: Vec<_> = means
            .iter()
            .flat_map(|one| means.iter().map(move |other| (one.0, other.0, one.1.difference(other.1))))
            .filter(|(one, other, difference)| one < other && *difference < 0.04)
            .collect();
        assert!(alike.is_empty(), "{}: {alike:?}", theme.name);
    }
}

#[test]
fn nothing_outside_the_disk_is_painted_and_a_file_loses_at_most_half_a_step() {
    let side = 48;
    let centre = |k: usize| (2 * k + 1) as f64 / side as f64 - 1.0;
    for (theme, style) in all() {
        for (t, texel) in style.rgba8(side).chunks_exact(4).enumerate() {
            let (i, j) = (t % side, t / side);
            if is_inside(side, i, j) {
                let exact = style.shade(centre(i), -centre(j));
                assert!(
                    (0..4).all(|c| (f64::from(texel[c]) - 255.0 * exact[c]).abs() <= 0.5),
                    "{theme}/{}",
                    style.name
                );
            } else {
                assert_eq!(texel, [0; 4]);
            }
        }
    }
}

#[test]
fn colours_of_the_page_are_what_the_page_says() {
    // docs/styles.md names the constants' bytes.
    for (theme, style) in named("constant") {
        let [r, g, b, _] = style.shade(0.0, 0.0).map(|c| (255.0 * c).round() as u8);
        assert!(style.how.contains(&format!("RGB ({r}, {g}, {b})")), "{theme}: {}", style.how);
    }
}
