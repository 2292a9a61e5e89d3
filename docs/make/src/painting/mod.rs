//! A painting of three spheres, of which the scenes of Fig. 1 take their styles and their background: our own, after
//! the idea of the lithograph in the paper.

pub(crate) mod figure;
mod room;
mod stone;

use crate::files;
use drypoint::output::png::encode_png;
use drypoint::reference::style_transfer_functions::extract::{Region, extract};
use drypoint::scene::picture::Provenance;
use drypoint::scene::style::SourcePicture;
use rayon::prelude::*;
use room::{Finish, Room, Sphere, smooth};

/// Pixels of the painting.
const SIZE: [usize; 2] = [1024, 640];

/// Parts of a pixel along a side that are painted and averaged.
const PARTS: usize = 3;

/// Pixels of bare paper around it, and how rough its edge is.
const MARGIN: f64 = 22.0;
const ROUGH: f64 = 6.0;

/// Texels along the side of a style.
const SIDE: usize = 256;

const SPHERES: [Sphere; 3] = [
    Sphere { name: "plaster", finish: Finish::Plaster, middle: [222.0, 366.0], radius: 122.0 },
    Sphere { name: "polished", finish: Finish::Polished, middle: [520.0, 322.0], radius: 118.0 },
    Sphere { name: "hatched", finish: Finish::Hatched, middle: [806.0, 380.0], radius: 124.0 },
];

/// Writes the painting, and the styles of its spheres.
///
/// # Errors
/// What the encoder, the extraction or the system says.
pub(crate) fn write() -> Result<(), String> {
    let painting = painted()?;
    files::write("../data/pictures/three-spheres.png", &painting)?;
    for sphere in &SPHERES {
        files::write(&format!("../data/themes/three-spheres/{}.png", sphere.name), &style(&painting, sphere)?)?;
    }
    Ok(())
}

/// The file of the painting.
fn painted() -> Result<Vec<u8>, String> {
    let [width, height] = SIZE;
    let room = Room { spheres: &SPHERES };
    let steps: Vec<u8> = (0..width * height).into_par_iter().map(|t| pixel(&room, t % width, t / width)).collect();
    indexed(SIZE, &steps)
}

/// The file of a picture whose pixels are steps from paper to ink. The width is even.
fn indexed([width, height]: [usize; 2], steps: &[u8]) -> Result<Vec<u8>, String> {
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, width as u32, height as u32);
    encoder.set_color(png::ColorType::Indexed);
    encoder.set_depth(png::BitDepth::Four);
    encoder.set_palette(stone::palette());
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_compression(png::Compression::High);
    encoder.set_filter(png::Filter::NoFilter);
    let pairs: Vec<u8> = steps.chunks_exact(2).map(|pair| pair[0] << 4 | pair[1]).collect();
    encoder
        .write_header()
        .and_then(|mut writer| writer.write_image_data(&pairs).and_then(|()| writer.finish()))
        .map_err(|e| e.to_string())?;
    Ok(file)
}

/// The step of pixel (i, j).
fn pixel(room: &Room, i: usize, j: usize) -> u8 {
    let [x, y] = [i, j].map(|k| k as f64 + 0.5);
    let (mut value, mut grain) = (0.0, 0.0);
    for part in 0..PARTS * PARTS {
        let [u, v] = [(i, part % PARTS), (j, part / PARTS)].map(|(k, p)| k as f64 + (p as f64 + 0.5) / PARTS as f64);
        let tone = room.at(u, v, part as f64 / (PARTS * PARTS) as f64);
        value += tone.value;
        grain += tone.grain;
    }
    let count = (PARTS * PARTS) as f64;
    let stroke = room.at(x, y, 0.0).stroke;
    // Bare paper from the edge of the drawing on, which is as rough as crayon leaves it.
    let [width, height] = SIZE.map(|n| n as f64);
    let edge = x.min(y).min(width - x).min(height - y) - MARGIN;
    let rough = ROUGH * (stone::noise(x / 14.0, y / 14.0, 3) - 0.5) + 3.0 * (stone::noise(x / 1.7, y / 1.7, 4) - 0.5);
    let drawn = smooth(-1.5, 1.5, edge + rough);
    stone::printed(x, y, 1.0 + drawn * (value / count - 1.0), grain / count, stroke)
}

/// The file of a sphere's style, from the file of the painting: one pixel inside its edge, which is antialiased.
fn style(painting: &[u8], sphere: &Sphere) -> Result<Vec<u8>, String> {
    let source = SourcePicture::decode(painting, false).map_err(|e| e.to_string())?;
    let [x, y] = sphere.middle;
    let region = Region::Circle { x, y, r: sphere.radius - 1.0 };
    let found = extract(&source, &region, SIDE).map_err(|e| e.to_string())?;
    encode_png(&found.picture, 8, &Provenance::default()).map_err(|e| e.to_string())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::in_docs;

    /// The pixels of two files, where one of them is on disk.
    fn same(bytes: &[u8], name: &str) {
        let file = std::fs::read(in_docs(name)).unwrap();
        let [made, kept] = [bytes, &file].map(|bytes| SourcePicture::decode(bytes, false).unwrap());
        assert_eq!((made.width(), made.height()), (kept.width(), kept.height()), "{name}");
        for t in 0..made.width() * made.height() {
            let (i, j) = (t % made.width(), t / made.width());
            assert_eq!(made.pixel(i, j), kept.pixel(i, j), "{name} ({i}, {j})");
        }
    }

    #[test]
    fn the_files_are_what_is_painted_and_extracted() {
        let painting = painted().unwrap();
        same(&painting, "../data/pictures/three-spheres.png");
        for sphere in &SPHERES {
            same(&style(&painting, sphere).unwrap(), &format!("../data/themes/three-spheres/{}.png", sphere.name));
        }
    }
}
