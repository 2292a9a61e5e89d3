//! A map of halo seeds of our own, after the description of Fig. 3 of Bruckner and Gröller 2007, and the figures that are
//! made of it ([HALO-10]).

use crate::files::{self, in_docs};
use drypoint::halo::{HaloFigure, IntensityMap};
use drypoint::output::encode::{quantize, straight_srgb};
use drypoint::reference::volumetric_halos::{Border, SpreadParams};
use drypoint::scene::math::{atan2, cos, hypot, sin};
use drypoint::scene::picture::{LayerKind, Picture};
use std::f64::consts::PI;

/// Pixels along a side of the map.
const SIDE: usize = 256;

/// The parameters of the figures.
const SPREAD: SpreadParams =
    SpreadParams { from_gradient: true, passes: 4, delta: 0.8, stretch: 1.0, median: false, floor: 0.0 };

/// Writes the map and the figures.
///
/// # Errors
/// What the encoder or the system says.
pub(crate) fn write() -> Result<(), String> {
    let map = in_docs("../data/pictures/halo-seeds.png");
    files::write("../data/pictures/halo-seeds.png", &grey([SIDE; 2], &seeds())?)?;
    let seeds = IntensityMap::read(&map).map_err(|e| e.to_string())?;
    for (name, figure) in [("figure_3", HaloFigure::Stages), ("figure_4", HaloFigure::Deltas)] {
        let picture = figure.draw(&seeds, SPREAD, Border::Replicate, &map).map_err(|e| e.to_string())?;
        files::write(&format!("pictures/volumetric_halos/{name}.png"), &grey_of(&picture)?)?;
    }
    Ok(())
}

/// A grey picture in 8 bits, the smallest file.
fn grey([width, height]: [usize; 2], codes: &[u8]) -> Result<Vec<u8>, String> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width as u32, height as u32);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.set_compression(png::Compression::High);
    let written = encoder.write_header().and_then(|mut writer| writer.write_image_data(codes));
    written.map_err(|e| e.to_string())?;
    Ok(file)
}

/// The file of a picture whose colours are greys.
fn grey_of(picture: &Picture) -> Result<Vec<u8>, String> {
    let layer = picture.layer(LayerKind::Beauty).ok_or("a picture without colours")?;
    let code = |c: &f64| quantize(straight_srgb([*c, *c, *c, 1.0])[1], 255) as u8;
    grey([picture.width, picture.height], &layer.channels[1].iter().map(code).collect::<Vec<u8>>())
}

/// The codes of the map.
fn seeds() -> Vec<u8> {
    (0..SIDE * SIDE).map(|t| quantize(intensity([t % SIDE, t / SIDE].map(|c| c as f64 + 0.5)), 255) as u8).collect()
}

/// The intensity of a point, in pixels: the share of a pixel around it that the brightest shape covers.
fn intensity(p: [f64; 2]) -> f64 {
    let cover = |distance: f64| (0.5 - distance).clamp(0.0, 1.0);
    let disc = |middle: [f64; 2], radius: f64| cover(distance(p, middle) - radius);
    let square = |[x, y]: [f64; 2], side: f64| {
        f64::from(u8::from((x..x + side).contains(&p[0]) && (y..y + side).contains(&p[1])))
    };
    let line = |a, b, width: f64| cover(to_segment(p, a, b) - 0.5 * width);
    let mut most: f64 = 0.0;
    let mut add = |share: f64| most = most.max(share);

    // Large: a disc with a hole off its middle, and a bud with petals.
    add(disc([58.0, 60.0], 40.0).min(1.0 - disc([68.0, 52.0], 17.0)));
    let [x, y] = [p[0] - 190.0, p[1] - 62.0];
    let (angle, rho) = (atan2(y, x), hypot(x, y));
    let (r, dr) = (27.0 + 13.0 * cos(5.0 * angle + 0.6), -65.0 * sin(5.0 * angle + 0.6));
    // The distance to r(θ) to first order: along the radius, by the slope of the outline. r is at least 14.
    add(cover((rho - r) / hypot(1.0, dr / rho.max(14.0))));
    // A square of 32 pixels, and smaller ones.
    add(square([22.0, 120.0], 32.0));
    for (x, side) in [(62.0, 16.0), (86.0, 8.0), (102.0, 4.0), (114.0, 2.0)] {
        add(square([x, 136.0 - 0.5 * side], side));
    }
    // Dots of 1, 2 and 3 pixels in rows, from sparse to close.
    for (row, side) in [1.0, 2.0, 3.0].into_iter().enumerate() {
        for i in 0..9 {
            let x = 132.0 + (1.4 * f64::from(i * (18 - i))).floor();
            add(square([x, 118.0 + 12.0 * row as f64], side));
        }
    }
    // A fan of lines of 1 to 3 pixels.
    for i in 0..6 {
        let turn = PI * (0.06 + 0.075 * f64::from(i));
        let [c, s] = [cos(turn), -sin(turn)];
        let from = [18.0 + 12.0 * c, 240.0 + 12.0 * s];
        add(line(from, [18.0 + 78.0 * c, 240.0 + 78.0 * s], 1.0 + 0.4 * f64::from(i)));
    }
    // Curves that cross: thin, and four pixels wide.
    let mut before: Option<[[f64; 2]; 3]> = None;
    for i in 0..=96 {
        let t = f64::from(i) / 96.0;
        let x = 104.0 + 142.0 * t;
        let curves = [
            [x, 205.0 + 30.0 * sin(2.0 * PI * t * 1.5)],
            [x, 205.0 - 24.0 * sin(2.0 * PI * t * 1.5 + 0.9)],
            [x, 236.0 - 70.0 * t * t],
        ];
        if let Some(before) = before {
            for (k, width) in [1.2, 4.0, 2.0].into_iter().enumerate() {
                add(line(before[k], curves[k], width));
            }
        }
        before = Some(curves);
    }
    most
}

fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    hypot(a[0] - b[0], a[1] - b[1])
}

/// Distance of a point to a segment.
fn to_segment(p: [f64; 2], a: [f64; 2], b: [f64; 2]) -> f64 {
    let [dx, dy] = [b[0] - a[0], b[1] - a[1]];
    let t = ((p[0] - a[0]) * dx + (p[1] - a[1]) * dy) / (dx * dx + dy * dy);
    let t = t.clamp(0.0, 1.0);
    distance(p, [a[0] + t * dx, a[1] + t * dy])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_map_is_the_one_that_is_drawn() {
        let kept = IntensityMap::read(&in_docs("../data/pictures/halo-seeds.png")).unwrap();
        assert_eq!(kept.size, [SIDE; 2]);
        assert_eq!(kept.values, seeds().into_iter().map(|code| f64::from(code) / 255.0).collect::<Vec<_>>());
    }
}
