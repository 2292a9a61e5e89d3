//! Picture of a style on a sphere.

use super::lit_disc;
use crate::accumulator::Accumulator;
use drypoint_scene::picture::{Layer, LayerKind, Picture};
use drypoint_scene::style::Style;

/// The layer `beauty` of a square picture on white. A sphere of the style touches the picture's sides.
pub fn preview(style: &Style, side: usize) -> Picture {
    let radius = side as f64 / 2.0;
    let disc = lit_disc(style, [radius; 2], radius, [side; 2]);
    let mut channels = vec![Vec::new(); 4];
    for [r, g, b, a] in disc.pixels {
        let mut front = Accumulator { rgb: [r, g, b], opacity: a };
        front.over_premultiplied([1.0; 4]);
        for (channel, value) in channels.iter_mut().zip(front.rgb.into_iter().chain([1.0])) {
            channel.push(value);
        }
    }
    Picture { width: side, height: side, layers: vec![Layer { kind: LayerKind::Beauty, channels }] }
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
        // Parts of a pixel, four each way, count a disk of 1024 parts across to within a part along its circumference.
        let side = 256;
        let picture = of_constant([0.0, 0.0, 0.0, 1.0], side);
        let covered: f64 = picture.layers[0].channels[0].iter().map(|c| 1.0 - c).sum();
        let area = std::f64::consts::FRAC_PI_4 * (side * side) as f64;
        assert!((covered - area).abs() < std::f64::consts::PI * side as f64 / 4.0);
    }
}
