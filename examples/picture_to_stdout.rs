//! A picture as EXR on standard output. No file is read or written, so it runs wherever the library does, such as in
//! WebAssembly.
//!
//! `cargo run --release --example picture_to_stdout > torus.exr`

use drypoint::job::Job;
use drypoint::output::exr::encode_exr;
use drypoint::scene::file::{Overrides, parse};
use std::error::Error;
use std::io::Write;
use std::path::Path;

const SCENE: &str = r#"
drypoint = 1
[volume]
phantom = { name = "torus", size = 24 }
[picture]
size = [48, 32]
layers = ["beauty", "Z", "normal", "curvature.KV"]
[transfer]
nodes = [
  { at = 90, style = "wax", opacity = 0 },
  { at = 160, style = "bone", opacity = 0.7 },
]
[contours]
thickness = "1 voxel"
"#;

/// Renders the scene and returns the bytes of its file.
pub(crate) fn run() -> Result<Vec<u8>, Box<dyn Error>> {
    // The name stands in errors alone.
    let job = Job::load(parse(SCENE, Path::new("torus.toml"), &Overrides::default())?)?;
    let (picture, _) = job.renderer()?.frame(&|_share| ());
    Ok(encode_exr(&picture, &job.provenance())?)
}

fn main() -> Result<(), Box<dyn Error>> {
    Ok(std::io::stdout().write_all(&run()?)?)
}
