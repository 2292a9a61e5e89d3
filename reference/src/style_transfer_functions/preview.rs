//! Picture of a style on a sphere.

use super::SphereMap;
use crate::accumulator::Accumulator;
use drypoint_scene::picture::{Layer, LayerKind, Picture};
use drypoint_scene::style::Style;

/// Sub-pixels along each axis of a pixel.
const PARTS: usize = 4;

/// The layer `beauty` of a square picture on white. A sphere of the style touches the picture's sides, antialiased by 4
/// × 4 samples for each pixel.
pub fn preview(style: &Style, side: usize) -> Picture {
    let map = SphereMap::new(style);
    let mut channels = vec![vec![1.0; side * side]; 4];
    for (i, pixel) in (0..side * side).map(|i| (i, pixel(&map, side, i % side, i / side))) {
        for (channel, value) in channels.iter_mut().zip(pixel) {
            channel[i] = value;
        }
    }
    Picture { width: side, height: side, layers: vec![Layer { kind: LayerKind::Beauty, channels }] }
}

/// Linear premultiplied pixel (x, y): the sphere over white.
fn pixel(map: &SphereMap, side: usize, x: usize, y: usize) -> [f64; 4] {
    let mut sum = [0.0; 4];
    let at = |k: usize, part: usize| (k as f64 + (part as f64 + 0.5) / PARTS as f64) * 2.0 / side as f64 - 1.0;
    for part in 0..PARTS * PARTS {
        let (nx, ny) = (at(x, part % PARTS), -at(y, part / PARTS));
        let [r, g, b, a] = if nx * nx + ny * ny <= 1.0 { map.sample(nx, ny) } else { [0.0; 4] };
        let mut front = Accumulator { rgb: [r, g, b], opacity: a };
        front.over_premultiplied([1.0; 4]);
        for (sum, c) in sum.iter_mut().zip(front.rgb) {
            *sum += c;
        }
        sum[3] += 1.0;
    }
    sum.map(|c| c / (PARTS * PARTS) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_constant(texel: [f64; 4], side: usize) -> Picture {
        preview(&Style::from_straight("constant", 1, &[texel], true).unwrap(), side)
    }

    #[test]
    fn a_sphere_on_white_shows_it_through() {
        let picture = of_constant([1.0, 0.0, 0.0, 0.25], 64);
        assert_eq!((picture.width, picture.height, picture.layers[0].kind), (64, 64, LayerKind::Beauty));
        let pixel = |i: usize| [0, 1, 2, 3].map(|c| picture.layers[0].channels[c][i]);
        assert_eq!(pixel(32 * 64 + 32), [1.0, 0.75, 0.75, 1.0]);
        assert_eq!(pixel(0), [1.0; 4]);
    }

    #[test]
    fn the_spheres_area_is_that_of_its_disk() {
        // 4 × 4 parts a pixel count a disk of 1024 parts across to within a part along its circumference.
        let side = 256;
        let picture = of_constant([0.0, 0.0, 0.0, 1.0], side);
        let covered: f64 = picture.layers[0].channels[0].iter().map(|c| 1.0 - c).sum();
        let area = std::f64::consts::FRAC_PI_4 * (side * side) as f64;
        assert!((covered - area).abs() < std::f64::consts::PI * side as f64 / PARTS as f64);
    }
}
