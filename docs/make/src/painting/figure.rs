//! `docs/pictures/style_transfer_functions/figure-1.png`: the painting, and the three scenes that take from it.

use super::{SIZE, indexed, stone};
use crate::files::{self, in_docs};
use drypoint::job::Job;
use drypoint::output::encode::straight_srgb;
use drypoint::output::read::{Image, read_image};
use drypoint::scene::file::{Overrides, load};
use std::path::Path;

/// Pixels of a picture along which the mean is taken, and between pictures.
const SHRINK: usize = 2;
const GAP: usize = 8;

const SCENES: [&str; 3] = ["figure_1_a", "figure_1_b", "figure_1_c"];

/// Renders the scenes, which need the head's volume, and lays them out.
///
/// # Errors
/// What cannot be read, rendered or written.
pub(crate) fn write() -> Result<(), String> {
    let painting = in_docs("../data/pictures/three-spheres.png");
    let mut pictures = vec![read_image(&painting).map_err(|e| e.to_string())?];
    for name in SCENES {
        pictures.push(rendered(&in_docs(&format!("../data/scenes/style_transfer_functions/{name}.toml")))?);
    }
    let cell = SIZE.map(|n| n / SHRINK);
    let size = cell.map(|n| 2 * n + GAP);
    let mut steps = vec![0; size[0] * size[1]];
    for (k, picture) in pictures.iter().enumerate() {
        let [left, top] = [k % 2 * (cell[0] + GAP), k / 2 * (cell[1] + GAP)];
        for (x, y) in (0..cell[0] * cell[1]).map(|t| (t % cell[0], t / cell[0])) {
            steps[(top + y) * size[0] + left + x] = stone::nearest(mean(picture, x, y)?);
        }
    }
    files::write("pictures/style_transfer_functions/figure-1.png", &indexed(size, &steps)?)
}

fn rendered(scene: &Path) -> Result<Image, String> {
    let scene = load(scene, &Overrides::default()).map_err(|e| e.to_string())?;
    let job = Job::load(scene).map_err(|e| e.to_string())?;
    let (picture, _) = job.renderer().map_err(|e| e.to_string())?.frame(&|_| ());
    Ok(Image::from(&picture))
}

/// The mean over the pixels that become pixel (x, y), as sRGB codes.
fn mean(image: &Image, x: usize, y: usize) -> Result<[f64; 3], String> {
    let colors = image.colors().ok_or("a picture without colours")?;
    let light = colors.rgb.map(|channel| {
        let parts = (0..SHRINK * SHRINK).map(|p| (y * SHRINK + p / SHRINK) * image.width + x * SHRINK + p % SHRINK);
        parts.map(|t| channel[t]).sum::<f64>() / (SHRINK * SHRINK) as f64
    });
    let [r, g, b, _] = straight_srgb([light[0], light[1], light[2], 1.0]);
    Ok([r, g, b].map(|c| c * 255.0))
}
