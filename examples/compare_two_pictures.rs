//! The change that a setting makes in a picture: one scene rendered with two kernels, and their difference.
//!
//! `cargo run --release --example compare_two_pictures -- smooth.png`

use drypoint::job::Job;
use drypoint::output::compare::{CompareOptions, Comparison, compare};
use drypoint::output::read::Image;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::picture::Picture;
use std::error::Error;
use std::path::Path;

const SCENE: &str = r#"
drypoint = 1
[volume]
phantom = { name = "marschner-lobb", size = 40 }
[picture]
size = [120, 120]
[transfer]
nodes = [
  { at = 110, style = "porcelain", opacity = 0 },
  { at = 140, style = "porcelain", opacity = 1 },
]
"#;

/// Renders the scene with a kernel. Overrides are keys and values as after `--set`.
fn picture(kernel: &str) -> Result<(Job, Picture), Box<dyn Error>> {
    let overrides: Overrides = [("sampling.kernel", kernel)].into_iter().collect();
    let job = Job::load(parse(SCENE, Path::new("signal.toml"), &overrides)?)?;
    let (picture, _) = job.renderer()?.frame(&|_share| ());
    Ok((job, picture))
}

/// Compares trilinear interpolation with a cubic B-spline, and writes the second picture.
pub(crate) fn run(file: &Path) -> Result<Comparison, Box<dyn Error>> {
    let (_, linear) = picture("trilinear")?;
    let (job, cubic) = picture("bspline")?;
    job.write(&cubic, file)?;
    // Pictures in memory, without rounding to 8 bits. `read_image` reads files.
    Ok(compare(&Image::from(&linear), &Image::from(&cubic), &CompareOptions::default())?)
}

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).unwrap_or("smooth.png".into());
    // Displayed as the table of `drypoint compare`.
    println!("{}", run(file.as_ref())?);
    Ok(())
}
