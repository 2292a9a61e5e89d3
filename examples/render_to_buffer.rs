//! A scene in a text, rendered into a buffer of RGBA bytes, as a window or a web page takes them.
//!
//! `cargo run --release --example render_to_buffer -- torus.png`

use drypoint::job::Job;
use drypoint::output::png::rgba_codes;
use drypoint::scene::file::{Overrides, parse};
use std::error::Error;
use std::path::Path;

const SCENE: &str = r#"
drypoint = 1
[volume]
phantom = { name = "torus", size = 48 }
[picture]
size = [160, 120]
background = "none"
[transfer]
nodes = [
  { at = 100, style = "wax", opacity = 0 },
  { at = 150, style = "wax", opacity = 1 },
]
[contours]
"#;

/// Renders the scene and returns its bytes: red, green, blue and alpha of each pixel, row by row from the top.
pub(crate) fn run(file: &Path) -> Result<Vec<u8>, Box<dyn Error>> {
    // The name stands in errors, and relative paths in the scene begin in its folder.
    let scene = parse(SCENE, Path::new("torus.toml"), &Overrides::default())?;
    // Everything that the scene names: here a phantom and a style of the embedded theme.
    let job = Job::load(scene)?;
    // Numbers are linear, premultiplied and f64; the counts say what it took.
    let (picture, counts) = job.renderer()?.frame(&|_share| ());
    println!("{} samples, {} gradients", counts.samples, counts.gradients);
    // As bytes in straight sRGB, and as a file.
    let bytes = rgba_codes(&picture, 8)?;
    job.write(&picture, file)?;
    Ok(bytes)
}

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).unwrap_or("torus.png".into());
    println!("{} bytes of pixels, and {file}", run(file.as_ref())?.len());
    Ok(())
}
