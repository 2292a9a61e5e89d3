//! A volume from a formula of one's own, and what Drypoint makes of a volume about which nothing is said.
//!
//! `cargo run --release --example own_phantom -- tanglecube.png`

use drypoint::job::{Job, bare};
use drypoint::scene::counts::Counts;
use drypoint::scene::glam::DVec3;
use drypoint::scene::phantom::from_fn;
use drypoint::scene::space::Grid;
use drypoint::scene::volume::Volume;
use std::error::Error;
use std::path::Path;

/// Voxels along each axis.
const SIZE: usize = 64;

/// Samples the tanglecube x⁴ − 5x² + y⁴ − 5y² + z⁴ − 5z² + 11.8 = 0 on [−3, 3]³, with high values inside.
///
/// Voxels that are there already go into a volume by [`Volume::new`].
fn tanglecube() -> Result<Volume, Box<dyn Error>> {
    let grid = Grid::with_spacing([SIZE; 3], [1.0; 3])?;
    let (centre, unit) = (grid.centre(), 6.0 / SIZE as f64);
    let value = |p: DVec3| {
        let quartic = |x: f64| x.powi(4) - 5.0 * x.powi(2);
        let p = (p - centre) * unit;
        (-11.8 - quartic(p.x) - quartic(p.y) - quartic(p.z)).max(-20.0)
    };
    Ok(from_fn(grid, value)?)
}

/// Renders the volume by an automatic scene and returns the range of its values.
pub(crate) fn run(file: &Path) -> Result<[f64; 2], Box<dyn Error>> {
    let volume = tanglecube()?;
    let range = volume.range();
    // A transfer function, a camera and a style are found in the data. The name stands in errors alone.
    let scene = bare("tanglecube".into(), &volume, [240, 240], &mut Counts::default())?;
    let job = Job::with_volume(scene, volume)?;
    let (picture, _) = job.renderer()?.frame(&|_share| ());
    job.write(&picture, file)?;
    Ok(range)
}

fn main() -> Result<(), Box<dyn Error>> {
    let file = std::env::args().nth(1).unwrap_or("tanglecube.png".into());
    let [lo, hi] = run(file.as_ref())?;
    println!("values from {lo} to {hi}, drawn in {file}");
    Ok(())
}
