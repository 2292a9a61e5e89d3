//! Dots on the faces of a machined part, as a page for a plotter.
//!
//! `cargo run --release --example stipple_to_svg -- part.svg`

use drypoint::drawing::Drawing;
use drypoint::job::{Job, RenderTarget};
use drypoint::marking::Marking;
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::source::Disk;
use std::error::Error;
use std::path::Path;
use std::sync::Arc;

const SCENE: &str = r#"
drypoint = 1
[volume]
phantom = { name = "machined-part", size = 64 }
[picture]
width = "80 mm"
height = "80 mm"
[page]
plotter = true
[[pen]]
name = "black"
width = "0.3 mm"
[stipples]
pen = "black"
size = "0.3 mm"
thin = true
snap = "edge"
[stipples.silhouette]
"#;

/// Draws the page and returns the number of dots on it.
pub(crate) fn run(file: &Path) -> Result<usize, Box<dyn Error>> {
    let scene = parse(SCENE, Path::new("part.toml"), &Overrides::default())?;
    // Only what dots need is loaded.
    let job = Job::load_for(scene, RenderTarget::Points, Arc::new(Disk))?;
    // Dots are placed once, for any number of frames.
    let mut counts = Counts::default();
    let marking = Marking::new(&job, &mut counts, &|_progress| ())?;
    // The frame of the scene's own camera; with `[orbit]` there are more.
    let (frame, _) = Drawing::new(&job, &marking, &mut counts)?.frame(0, &|_share| ())?;
    // The suffix chooses SVG, PDF, PNG, EXR, CSV or JSON lines.
    let report = frame.write(&job, file)?;
    report.notes.iter().for_each(|note| println!("{note}"));
    Ok(report.marks[0])
}

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).unwrap_or("part.svg".into());
    println!("{} dots in {file}", run(file.as_ref())?);
    Ok(())
}
