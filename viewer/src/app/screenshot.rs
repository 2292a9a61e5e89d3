//! Pictures of the window itself.

use drypoint::Failure;
use drypoint::output::png::write_png;
use drypoint::scene::color::srgb_to_linear;
use drypoint::scene::picture::{Layer, LayerKind, Picture, Provenance};
use eframe::egui;
use std::path::Path;

/// Writes pixels of the window as a PNG file.
pub(super) fn write_image(image: &egui::ColorImage, path: &Path) -> Result<(), Failure> {
    let [width, height] = image.size;
    let channel = |c: usize| image.pixels.iter().map(move |pixel| pixel.to_array()[c]);
    let linear = |c: usize| channel(c).map(|code| srgb_to_linear(f64::from(code) / 255.0)).collect();
    let channels = vec![linear(0), linear(1), linear(2), vec![1.0; width * height]];
    let picture = Picture { width, height, layers: vec![Layer { kind: LayerKind::Beauty, channels }] };
    write_png(&picture, 8, &Provenance::default(), path).map_err(|error| Failure::picture(&error, path.display()))
}
