//! `docs/pictures/rings.png`: spheres of four sizes with a constant threshold, with exact κ and with κ along the ray.

use super::measure::{Ball, Drawn, Seen, Stored};
use drypoint::output::encode::{quantize, straight_srgb};
use drypoint::output::{raster, text};
use drypoint::scene::tables::Kappa;
use rayon::prelude::*;

const RADII: [f64; 4] = [4.0, 10.0, 20.0, 40.0];

/// Rows: a name, and which κ.
const ROWS: [(&str, Kappa); 3] =
    [("none", Kappa::None { threshold: 0.3 }), ("exact", Kappa::Exact), ("ray", Kappa::Ray)];

/// Δ in voxels: small, so that the lattice of samples does not show.
const STEP: f64 = 0.25;

/// Pixels a voxel, and parts of a pixel along a side that are drawn and averaged.
const SCALE: f64 = 2.5;
const PARTS: usize = 3;

/// Pixels between spheres, for the names on the left, for the radii at the bottom, and of a capital letter.
const GAP: usize = 14;
const MARGIN: usize = 56;
const FOOT: usize = 26;
const CAPITAL: f64 = 11.0;

/// The picture, one linear grey a pixel.
pub(super) struct Grey {
    pub(super) width: usize,
    pub(super) height: usize,
    values: Vec<f64>,
}

impl Grey {
    /// Draws all spheres.
    pub(super) fn spheres() -> Result<Self, String> {
        let balls: Vec<Ball> = ROWS
            .iter()
            .flat_map(|&(_, kappa)| RADII.map(|radius| (radius, kappa)))
            .map(|(radius, kappa)| Ball {
                radius,
                kappa,
                stored: Stored::Distance,
                step: STEP,
                pixels: SCALE * PARTS as f64,
            })
            .collect();
        let drawn = balls.par_iter().map(Ball::draw).collect::<Result<Vec<Drawn>, _>>()?;
        let side = |d: &Drawn| d.side / PARTS;
        let row_height = drawn.iter().map(side).max().unwrap_or(0) + GAP;
        let width = MARGIN + drawn[..RADII.len()].iter().map(|d| side(d) + GAP).sum::<usize>();
        let height = ROWS.len() * row_height + FOOT;
        let mut grey = Self { width, height, values: vec![1.0; width * height] };
        for (row, (name, _)) in ROWS.iter().enumerate() {
            let middle = row * row_height + row_height / 2;
            grey.write(name, 8.0, middle as f64 + CAPITAL / 2.0);
            let mut left = MARGIN;
            for (column, radius) in RADII.iter().enumerate() {
                let d = &drawn[row * RADII.len() + column];
                grey.lay(d, left, middle - side(d) / 2);
                if row + 1 == ROWS.len() {
                    let label = format!("R = {radius}");
                    let half = text::width(&label) * CAPITAL / text::CAP_HEIGHT / 2.0;
                    grey.write(&label, (left + side(d) / 2) as f64 - half, (height - 8) as f64);
                }
                left += side(d) + GAP;
            }
        }
        Ok(grey)
    }

    /// Lays a sphere with its upper left corner at a pixel.
    fn lay(&mut self, drawn: &Drawn, left: usize, top: usize) {
        let grey = |seen: Seen| match seen {
            Seen::Nothing => 1.0,
            Seen::Sphere(d) => 0.45 + 0.4 * d,
            Seen::Contour => 0.0,
        };
        let side = drawn.side / PARTS;
        for (y, x) in (0..side).flat_map(|y| (0..side).map(move |x| (y, x))) {
            let parts = (0..PARTS * PARTS).map(|k| (y * PARTS + k / PARTS) * drawn.side + x * PARTS + k % PARTS);
            let sum: f64 = parts.map(|i| grey(drawn.pixels[i])).sum();
            self.values[(top + y) * self.width + left + x] = sum / (PARTS * PARTS) as f64;
        }
    }

    /// Writes a line of text from a point of its baseline on.
    fn write(&mut self, line: &str, x: f64, y: f64) {
        let unit = CAPITAL / text::CAP_HEIGHT;
        let place = |p: [f64; 2]| [x + p[0] * unit, y - p[1] * unit];
        let strokes: Vec<_> = text::strokes(line).into_iter().map(|s| s.into_iter().map(place).collect()).collect();
        let cover = raster::coverage(self.width, self.height, &strokes, text::WEIGHT * unit);
        self.values.iter_mut().zip(cover).for_each(|(value, c)| *value *= 1.0 - c);
    }

    /// The file: 8 bits, sRGB.
    pub(super) fn png(&self) -> Result<Vec<u8>, png::EncodingError> {
        let mut file = Vec::new();
        let mut encoder = png::Encoder::new(&mut file, self.width as u32, self.height as u32);
        encoder.set_color(png::ColorType::Grayscale);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
        encoder.set_compression(png::Compression::High);
        let code = |&v: &f64| quantize(straight_srgb([v, v, v, 1.0])[0], 255) as u8;
        encoder.write_header()?.write_image_data(&self.values.iter().map(code).collect::<Vec<_>>())?;
        Ok(file)
    }
}
