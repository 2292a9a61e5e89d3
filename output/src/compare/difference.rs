//! Pictures of the difference of two pictures.

use super::flip::FlipMap;
use drypoint_scene::color::srgb_to_linear;
use drypoint_scene::picture::{Layer, LayerKind, Picture};

/// Sixteen evenly spaced colours (sRGB) of the map Magma by N. Smith and S. van der Walt (CC0). FLIP's authors use this
/// colour map. Linear interpolation is within 2.2/255 of the published table of 256.
const MAGMA: [[u8; 3]; 16] = [
    [0, 0, 4],
    [11, 9, 36],
    [32, 17, 75],
    [59, 15, 112],
    [87, 21, 126],
    [114, 31, 129],
    [140, 41, 129],
    [168, 50, 125],
    [196, 60, 117],
    [222, 73, 104],
    [241, 96, 93],
    [250, 127, 94],
    [254, 159, 109],
    [254, 191, 132],
    [253, 222, 160],
    [252, 253, 191],
];

/// The colour of a difference in [0, 1], as sRGB codes in [0, 1]: black for none, pale yellow for the largest.
pub fn magma(value: f64) -> [f64; 3] {
    let at = value.clamp(0.0, 1.0) * (MAGMA.len() - 1) as f64;
    let first = (at as usize).min(MAGMA.len() - 2);
    let w = at - first as f64;
    [0, 1, 2].map(|c| {
        let [a, b] = [MAGMA[first][c], MAGMA[first + 1][c]].map(f64::from);
        (a + w * (b - a)) / 255.0
    })
}

/// Returns the map as an opaque picture in the colours of [`magma`]. A PNG of it has Magma's sRGB codes.
pub fn difference_picture(map: &FlipMap) -> Picture {
    let colours: Vec<_> = map.values.iter().map(|&value| magma(value).map(srgb_to_linear)).collect();
    let mut channels: Vec<Vec<f64>> = (0..3).map(|c| colours.iter().map(|colour| colour[c]).collect()).collect();
    channels.push(vec![1.0; colours.len()]);
    Picture { width: map.width, height: map.height, layers: vec![Layer { kind: LayerKind::Beauty, channels }] }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::color::linear_to_srgb;

    #[test]
    fn close_to_the_published_table() {
        for (index, published) in [
            (0, [0.001462, 0.000466, 0.013866]),
            (8, [0.013708, 0.011771, 0.068667]),
            (60, [0.291366, 0.064553, 0.475462]),
            (128, [0.716387, 0.214982, 0.475290]),
            (200, [0.992785, 0.594891, 0.410283]),
            (255, [0.987053, 0.991438, 0.749504]),
        ] {
            for (found, expected) in magma(f64::from(index) / 255.0).into_iter().zip(published) {
                assert!((found - expected).abs() < 2.2 / 255.0, "{index}: {found} for {expected}");
            }
        }
    }

    #[test]
    fn larger_differences_are_lighter() {
        let lightness = |i: u32| {
            let [r, g, b] = magma(f64::from(i) / 255.0).map(srgb_to_linear);
            0.2126 * r + 0.7152 * g + 0.0722 * b
        };
        assert!((1..=255).all(|i| lightness(i) > lightness(i - 1)));
    }

    #[test]
    fn a_picture_of_a_map() {
        let picture = difference_picture(&FlipMap { width: 2, height: 1, values: vec![0.0, 1.0] });
        let channels = &picture.layers[0].channels;
        let codes = |i: usize| [0, 1, 2].map(|c| (linear_to_srgb(channels[c][i]) * 255.0).round() as u8);
        assert_eq!((codes(0), codes(1)), (MAGMA[0], MAGMA[15]));
        assert_eq!(channels[3], [1.0, 1.0]);
    }
}
