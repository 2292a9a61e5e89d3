//! A sheet with a sphere of each style.

use super::super::SphereMap;
use drypoint_scene::picture::{Layer, LayerKind, Picture};
use drypoint_scene::style::Style;

/// Side of a sphere's field, in pixels.
const FIELD: usize = 288;
/// Diameter of a sphere, in pixels.
const DIAMETER: usize = 256;
/// Sub-pixels along each axis of a pixel.
const PARTS: usize = 4;

/// The layer `beauty` of a sheet with a sphere of each style on white, in about as many rows as columns from the upper
/// left, antialiased by 4 × 4 samples a pixel. No style: an empty picture.
pub fn preview_sheet(styles: &[Style]) -> Picture {
    let columns = (1..).find(|n| n * n >= styles.len()).unwrap_or(1);
    let (width, height) = (columns * FIELD, styles.len().div_ceil(columns) * FIELD);
    let mut channels = vec![vec![1.0; width * height]; 4];
    for (k, style) in styles.iter().enumerate() {
        let map = SphereMap::<f64>::new(style);
        let (left, top) = (k % columns * FIELD, k / columns * FIELD);
        for y in 0..FIELD {
            for x in 0..FIELD {
                for (c, value) in pixel(&map, x, y).into_iter().enumerate() {
                    channels[c][(top + y) * width + left + x] = value;
                }
            }
        }
    }
    Picture { width, height, layers: vec![Layer { kind: LayerKind::Beauty, channels }] }
}

/// Linear premultiplied pixel (x, y) of a field: the sphere over white.
fn pixel(map: &SphereMap<f64>, x: usize, y: usize) -> [f64; 4] {
    let mut sum = [0.0; 4];
    let at = |k: usize, part: usize| {
        let place = k as f64 + (part as f64 + 0.5) / PARTS as f64 - FIELD as f64 / 2.0;
        place * 2.0 / DIAMETER as f64
    };
    for part in 0..PARTS * PARTS {
        let (nx, ny) = (at(x, part % PARTS), -at(y, part / PARTS));
        let [r, g, b, a] = if nx * nx + ny * ny <= 1.0 { map.sample(nx, ny) } else { [0.0; 4] };
        for (sum, c) in sum.iter_mut().zip([r, g, b]) {
            *sum += c + (1.0 - a);
        }
        sum[3] += 1.0;
    }
    sum.map(|c| c / (PARTS * PARTS) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn constant(texel: [f64; 4]) -> Style {
        Style::from_straight("constant", 1, &[texel], true).unwrap()
    }

    #[test]
    fn fields_stand_in_rows_on_white() {
        let styles = vec![constant([0.25, 0.5, 0.75, 1.0]); 5];
        let sheet = preview_sheet(&styles);
        assert_eq!((sheet.width, sheet.height), (3 * FIELD, 2 * FIELD));
        let Layer { kind, channels } = &sheet.layers[0];
        assert_eq!(*kind, LayerKind::Beauty);
        let pixel = |x: usize, y: usize| [0, 1, 2, 3].map(|c| channels[c][y * sheet.width + x]);
        for k in 0..6 {
            let middle = pixel(k % 3 * FIELD + FIELD / 2, k / 3 * FIELD + FIELD / 2);
            assert_eq!(middle, if k < 5 { [0.25, 0.5, 0.75, 1.0] } else { [1.0; 4] });
            assert_eq!(pixel(k % 3 * FIELD, k / 3 * FIELD), [1.0; 4]);
        }
        assert_eq!(preview_sheet(&[]).height, 0);
    }

    #[test]
    fn white_shows_through_what_is_transparent() {
        let sheet = preview_sheet(&[constant([1.0, 0.0, 0.0, 0.25])]);
        let middle = FIELD / 2 * FIELD + FIELD / 2;
        assert_eq!([0, 1, 2, 3].map(|c| sheet.layers[0].channels[c][middle]), [1.0, 0.75, 0.75, 1.0]);
    }

    #[test]
    fn the_spheres_area_is_that_of_its_disk() {
        // 4 × 4 parts a pixel count a disk of 1024 parts across to within a part along its circumference.
        let sheet = preview_sheet(&[constant([0.0, 0.0, 0.0, 1.0])]);
        let covered: f64 = sheet.layers[0].channels[0].iter().map(|c| 1.0 - c).sum();
        let area = std::f64::consts::FRAC_PI_4 * (DIAMETER * DIAMETER) as f64;
        assert!((covered - area).abs() < std::f64::consts::PI * DIAMETER as f64 / PARTS as f64);
    }
}
