//! A style's lit sphere as a disc of a picture's pixels.

use super::SphereMap;
use drypoint_scene::picture::Overlay;
use drypoint_scene::style::Style;
use std::ops::Range;

/// Sub-pixels along each axis of a pixel.
const PARTS: usize = 4;

/// The visible half of a style's sphere in a picture of `size` pixels, antialiased by 4 × 4 samples for each pixel.
/// `centre` and `radius` are in pixels, the first pixel's centre at (½, ½). At the centre the normal is (0, 0, 1). What lies outside the picture is left out.
pub fn lit_disc(style: &Style, centre: [f64; 2], radius: f64, size: [usize; 2]) -> Overlay {
    let map = SphereMap::new(style);
    let [columns, rows] = [0, 1].map(|axis| touched(centre[axis], radius, size[axis]));
    let in_row = |y: usize| columns.clone().map(move |x| [x, y]);
    let pixels = rows.clone().flat_map(in_row).map(|at| pixel(&map, centre, radius, at)).collect();
    Overlay { corner: [columns.start, rows.start], width: columns.len(), pixels }
}

/// The pixels along an axis that [c − r, c + r] touches.
fn touched(centre: f64, radius: f64, size: usize) -> Range<usize> {
    // Casts end at 0 and at the largest number.
    let end = ((centre + radius).ceil() as usize).min(size);
    ((centre - radius).floor() as usize).min(end)..end
}

/// Linear premultiplied pixel (x, y): the mean over its parts, of which those outside the disc are transparent.
fn pixel(map: &SphereMap, centre: [f64; 2], radius: f64, [x, y]: [usize; 2]) -> [f64; 4] {
    let at = |k: usize, part: usize, centre: f64| (k as f64 + (part as f64 + 0.5) / PARTS as f64 - centre) / radius;
    let mut sum = [0.0; 4];
    for part in 0..PARTS * PARTS {
        let (nx, ny) = (at(x, part % PARTS, centre[0]), -at(y, part / PARTS, centre[1]));
        if nx * nx + ny * ny <= 1.0 {
            sum.iter_mut().zip(map.sample(nx, ny)).for_each(|(sum, c)| *sum += c);
        }
    }
    sum.map(|c| c / (PARTS * PARTS) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    /// A style whose red and green are linear in the normal: (1 + N_x)/2 and (1 + N_y)/2.
    fn normals(side: usize) -> Style {
        let n = |k: usize| (2 * k + 1) as f64 / side as f64 - 1.0;
        let texel = |t: usize| [(1.0 + n(t % side)) / 2.0, (1.0 - n(t / side)) / 2.0, 0.25, 1.0];
        Style::from_straight("normals", side, &(0..side * side).map(texel).collect::<Vec<_>>(), true).unwrap()
    }

    #[test]
    fn a_pixel_has_the_style_at_its_normal() {
        let disc = lit_disc(&normals(64), [20.5, 12.5], 10.0, [100, 100]);
        assert_eq!((disc.corner, disc.width, disc.pixels.len()), ([10, 2], 21, 21 * 21));
        for (dx, dy) in [(0, 0), (5, 0), (0, -6), (-4, 3)] {
            let at = (10 + dy) * 21 + 10 + dx;
            // Rows go down, N_y goes up; texels have the precision of f32.
            let expected = [(1.0 + f64::from(dx) / 10.0) / 2.0, (1.0 - f64::from(dy) / 10.0) / 2.0, 0.25, 1.0];
            let found = disc.pixels[at as usize];
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-6), "{found:?} {expected:?}");
        }
    }

    #[test]
    fn the_discs_area_is_covered() {
        for radius in [0.4, 3.7, 20.0] {
            let disc = lit_disc(&normals(16), [40.2, 50.9], radius, [100, 100]);
            let covered: f64 = disc.pixels.iter().map(|pixel| pixel[3]).sum();
            let area = PI * radius * radius;
            assert!((covered - area).abs() < 2.0 * PI * radius / PARTS as f64, "{covered} {area}");
        }
    }

    #[test]
    fn what_lies_outside_the_picture_is_left_out() {
        let disc = lit_disc(&normals(16), [0.0, 10.0], 3.0, [10, 10]);
        assert_eq!((disc.corner, disc.width, disc.pixels.len()), ([0, 7], 3, 9));
        for centre in [[-20.0, 5.0], [5.0, 200.0], [1e300, 0.0]] {
            assert!(lit_disc(&normals(16), centre, 3.0, [10, 10]).pixels.is_empty());
        }
    }
}
