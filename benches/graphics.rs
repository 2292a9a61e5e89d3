//! Frames of a graphics card: 256³ voxels, 512×512 pixels of one ray, steps of half a voxel; each effect with the shader's
//! interpolation and with the texture unit's, and by the reference. Ratios are to Phong shading, as Table 1 of Bruckner and
//! Gröller 2007 has styles (0.98 to 1.25 there).
//!
//! `cargo bench --bench graphics --features gpu`

use drypoint::gpu::{Gpu, GpuFrames, Interpolation};
use drypoint::job::Job;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::phantom;
use drypoint::scene::tables::VolumeSource;
use drypoint::scene::volume::Volume;
use std::path::Path;
use std::time::Instant;

/// Frames of each kind, after one that warms up.
const ROUNDS: usize = 15;

/// The phantom of the embedded scene.
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

const KERNEL: &str = "kernel = \"bspline\"\n";

const COLOURS: &str = r##"
[picture]
samples = 1
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

const STYLES: &str = r##"
[picture]
samples = 1
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

/// Phong shading, to whose times the others stand in ratios.
const PHONG: &str = "Phong";

const SCENES: [(&str, &[&str]); 7] = [
    ("unshaded", &[COLOURS]),
    (PHONG, &[COLOURS, "[shading]\n"]),
    ("Phong, cubic B-spline", &[KERNEL, COLOURS, "[shading]\n"]),
    ("styles", &[STYLES]),
    ("styles, contours", &[STYLES, "[contours]\n"]),
    ("styles, contours of exact κ", &[STYLES, "[contours]\nkappa = \"exact\"\n"]),
    ("styles, contours, mip-maps", &[STYLES, "[contours]\n[style_mipmaps]\n"]),
];

fn main() -> Result<(), String> {
    let gpu = Gpu::new().map_err(|error| error.to_string())?;
    let fast = gpu.interpolating(Interpolation::Fast);
    println!("{}, medians of {ROUNDS} frames\n", gpu.describe());
    println!(
        "| | reference, ms | rays, ms | shown, ms | as a picture, ms | to Phong | fast: rays, ms | shown, ms | to Phong |"
    );
    println!("|---|--:|--:|--:|--:|--:|--:|--:|--:|");
    let mut volume = None;
    let mut phong = [f64::NAN; 2];
    // Phong comes first, to compare with, and its own row where it belongs.
    let of_phong = SCENES.iter().filter(|(name, _)| *name == PHONG);
    for (at, (name, parts)) in of_phong.chain(&SCENES).enumerate() {
        let job = job(parts, &mut volume)?;
        let exact = Times::of(&job, &gpu)?;
        let fast = fast.as_ref().ok().map(|gpu| Times::of(&job, gpu)).transpose()?;
        if at == 0 {
            phong = [exact.rays, fast.map_or(f64::NAN, |fast| fast.rays)];
            continue;
        }
        let reference = job.renderer().map_err(|failure| failure.to_string())?;
        let reference = median(|| Ok(timed(|| Ok(reference.frame(&|_| ())))?.1))?;
        let fast = fast.map_or("| | | |".to_owned(), |fast| {
            format!("| {:.2} | {:.2} | {:.2} |", fast.rays * 1e3, fast.shown * 1e3, fast.rays / phong[1])
        });
        println!(
            "| {name} | {:.0} | {:.2} | {:.2} | {:.1} | {:.2} {fast}",
            reference * 1e3,
            exact.rays * 1e3,
            exact.shown * 1e3,
            exact.picture * 1e3,
            exact.rays / phong[0],
        );
    }
    Ok(())
}

/// Median seconds of a frame.
#[derive(Clone, Copy)]
struct Times {
    /// Of its rays, by the card's clock; by the host's where the card has none.
    rays: f64,
    /// Until it is in a viewer's texture.
    shown: f64,
    /// Until it is a picture on the host.
    picture: f64,
}

impl Times {
    fn of(job: &Job, gpu: &Gpu) -> Result<Self, String> {
        let mut frames = GpuFrames::new(job, gpu).map_err(|failure| failure.to_string())?;
        let mut rays = Vec::new();
        let shown = median(|| {
            let (on_card, shown) = timed(|| frames.show().map_err(|failure| failure.to_string()))?;
            rays.push(on_card.unwrap_or(shown));
            Ok(shown)
        })?;
        let picture = median(|| Ok(timed(|| frames.frame(&|_| ()).map_err(|failure| failure.to_string()))?.1))?;
        let mut rest = rays.into_iter();
        Ok(Self { rays: median(|| rest.next().ok_or_else(String::new))?, shown, picture })
    }
}

fn timed<T>(run: impl FnOnce() -> Result<T, String>) -> Result<(T, f64), String> {
    let start = Instant::now();
    let made = run()?;
    Ok((made, start.elapsed().as_secs_f64()))
}

/// The median of [`ROUNDS`] times after one that warms up.
fn median(mut time: impl FnMut() -> Result<f64, String>) -> Result<f64, String> {
    time()?;
    let times = (0..ROUNDS).map(|_| time()).collect::<Result<Vec<_>, _>>()?;
    Ok(drypoint::cost::median(&times))
}

fn job(parts: &[&str], volume: &mut Option<Volume>) -> Result<Job, String> {
    let text = format!("{SCENE}{}", parts.concat());
    let scene = parse(&text, Path::new("bench.toml"), &Overrides::default()).map_err(|faults| faults.to_string())?;
    let VolumeSource::Phantom(source) = &scene.volume.source else { return Err("no phantom".into()) };
    if volume.is_none() {
        *volume = Some(phantom::generate(source).map_err(|error| error.to_string())?);
    }
    let volume = volume.clone().ok_or("no volume")?;
    Job::with_volume(scene, volume).map_err(|failures| failures.to_string())
}
