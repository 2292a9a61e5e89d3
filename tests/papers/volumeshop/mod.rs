//! VolumeShop (Bruckner and Gröller 2005).

mod by_hand;
mod conventions;
mod counts;
mod coverage;
mod cutaways;
mod halos;
mod identity;
mod meetings;
mod motions;
mod painting;
mod states;

use drypoint::job::Job;
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::picture::{LayerKind, Picture};
use std::path::Path;

/// A scene as text: a volume, a small picture with one ray a pixel, and more.
pub(super) fn scene_of(volume: &str, rest: &str) -> String {
    format!("drypoint = 1\n[volume]\n{volume}\n[picture]\nsize = [24, 20]\nsamples = 1\nbackground = \"none\"\n{rest}")
}

/// A scene that can be drawn.
pub(super) fn job_of(text: &str) -> Job {
    let scene = parse(text, Path::new("scene.toml"), &Overrides::default());
    let scene = scene.unwrap_or_else(|faults| panic!("{faults}\n{text}"));
    Job::load(scene).unwrap_or_else(|failures| panic!("{failures}\n{text}"))
}

/// The picture of a scene, and its counts.
pub(super) fn drawn(text: &str) -> (Picture, Counts) {
    let job = job_of(text);
    let renderer = job.renderer().unwrap_or_else(|failure| panic!("{failure}\n{text}"));
    renderer.again(&|_| ())
}

/// The channels of a layer of a picture.
pub(super) fn layer(picture: &Picture, kind: LayerKind) -> &[Vec<f64>] {
    let layer = picture.layers.iter().find(|layer| layer.kind == kind);
    &layer.unwrap_or_else(|| panic!("no layer {kind:?}")).channels
}

/// The colour and opacity of each pixel.
pub(super) fn pixels(picture: &Picture) -> Vec<[f64; 4]> {
    let beauty = layer(picture, LayerKind::Beauty);
    (0..picture.width * picture.height).map(|i| std::array::from_fn(|c| beauty[c][i])).collect()
}

/// The largest difference of two pictures.
pub(super) fn difference(a: &Picture, b: &Picture) -> f64 {
    let largest =
        |most: f64, (a, b): (&[f64; 4], &[f64; 4])| a.iter().zip(b).fold(most, |most, (a, b)| most.max((a - b).abs()));
    pixels(a).iter().zip(&pixels(b)).fold(0.0, largest)
}

/// The sum of all opacities: a picture of nothing shows nothing of a fault.
pub(super) fn seen(picture: &Picture) -> f64 {
    pixels(picture).iter().map(|pixel| pixel[3]).sum()
}

/// A head of shells under Blinn–Phong.
pub(super) const SHELLS: &str = "phantom = { name = \"shells\", size = 32 }";

/// A translucent lit function over most values.
pub(super) const LIT: &str = "[transfer]\nkind = \"regular\"\n\
    nodes = [{ at = 20, color = \"#c08040\", opacity = 0 }, { at = 255, color = \"#4080c0\", opacity = 0.4 }]\n[shading]\n";
