//! The scene whose frames are timed: the phantom of the embedded scene, 256³ voxels, in styles or in colours of the same
//! opacities.

use drypoint::job::Job;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::phantom;
use drypoint::scene::tables::VolumeSource;
use drypoint::scene::volume::Volume;
use std::path::Path;
use std::sync::{Arc, OnceLock};

const SCENE: &str = r##"
drypoint = 1
[volume]
phantom = { name = "specimen", size = 256 }
[camera]
direction = [-0.55, 1.0, -0.35]
fov = 18
[sampling]
step = "0.5 voxels"
"##;

pub(crate) const STYLES: &str = r##"
[transfer]
kind = "style"
nodes = [
  { at = 12, style = "glass", opacity = 0.0 },
  { at = 26, style = "glass", opacity = 0.05 },
  { at = 40, style = "glass", opacity = 0.0 },
  { at = 165, style = "bone", opacity = 0.0 },
  { at = 200, style = "bone", opacity = 0.9 },
]
"##;

pub(crate) const COLOURS: &str = r##"
[transfer]
kind = "regular"
nodes = [
  { at = 12, color = "#cde4ea", opacity = 0.0 },
  { at = 26, color = "#cde4ea", opacity = 0.05 },
  { at = 40, color = "#cde4ea", opacity = 0.0 },
  { at = 165, color = "#ece2cc", opacity = 0.0 },
  { at = 200, color = "#ece2cc", opacity = 0.9 },
]
"##;

/// The scene with effects, with one ray a pixel or other `samples`.
pub(crate) fn job(effects: &[&str], samples: &str) -> Job {
    let text = format!("{SCENE}{}[picture]\nsamples = {samples}\n", effects.concat());
    let scene = parse(&text, Path::new("bench.toml"), &Overrides::default()).expect("the scene above");
    // The phantom takes longer than a frame: it is made once.
    static VOLUME: OnceLock<Arc<Volume>> = OnceLock::new();
    let VolumeSource::Phantom(source) = &scene.volume.source else { unreachable!("the scene above has a phantom") };
    let volume = VOLUME.get_or_init(|| Arc::new(phantom::generate(source).expect("the phantom")));
    Job::with_volume(scene, volume.clone()).expect("the scene above")
}
