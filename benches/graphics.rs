//! Frames of a graphics card: 256³ voxels, 512×512 pixels of one ray, steps of half a voxel; each effect with the shader's
//! interpolation and with the texture unit's, and by the reference. Ratios are to Phong shading: Table 1 of Bruckner and
//! Gröller 2007 has styles at 0.98 to 1.25, that of their halos has M = 4 at 2.9.
//!
//! `cargo bench --bench graphics --features gpu`

use drypoint::cost::median;
use drypoint::gpu::{Gpu, GpuFrames, Interpolation};
use drypoint::job::Job;
use drypoint::reference::ray::Renderer;
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::phantom;
use drypoint::scene::tables::VolumeSource;
use drypoint::scene::volume::Volume;
use std::path::Path;
use std::time::Instant;

/// Rounds that are counted, and those before them.
const ROUNDS: usize = 15;
const WARM: usize = 3;

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

/// Name of a scene, that of the scene to whose time its own stands in a ratio, and its tables.
type Row = (&'static str, &'static str, &'static [&'static str]);

const SCENES: [Row; 10] = [
    ("unshaded", "Phong", &[COLOURS]),
    ("Phong", "Phong", &[COLOURS, "[shading]\n"]),
    ("Phong, cubic B-spline", "Phong", &[KERNEL, COLOURS, "[shading]\n"]),
    ("styles", "Phong", &[STYLES]),
    ("styles, contours", "Phong", &[STYLES, "[contours]\n"]),
    ("styles, contours of exact κ", "Phong", &[STYLES, "[contours]\nkappa = \"exact\"\n"]),
    ("styles, contours, mip-maps", "Phong", &[STYLES, "[contours]\n[style_mipmaps]\n"]),
    ("Phong, a halo, M = 1", "Phong", &[COLOURS, "[shading]\n", HALO]),
    ("Phong, a halo, M = 4", "Phong", &[COLOURS, "[shading]\n", HALO, "every = 4\n"]),
    (
        "Phong, four halos, M = 4",
        "Phong",
        &[COLOURS, "[shading]\n", HALO, "every = 4\n", HALO, "every = 4\n", HALO, "every = 4\n", HALO, "every = 4\n"],
    ),
];

/// A halo around the shell.
const HALO: &str = "[[halo]]\nseed.value = [[150, 0], [180, 1]]\n";

fn main() -> Result<(), String> {
    let gpu = Gpu::new().map_err(|error| error.to_string())?;
    let fast = gpu.interpolating(Interpolation::Fast);
    let cards: Vec<&Gpu> = [Some(&gpu), fast.as_ref().ok()].into_iter().flatten().collect();
    let mut volume = None;
    let jobs = SCENES.iter().map(|(_, _, parts)| job(parts, &mut volume)).collect::<Result<Vec<_>, _>>()?;
    let mut kinds = Vec::new();
    for job in &jobs {
        let frames = cards.iter().map(|gpu| GpuFrames::new(job, gpu)).collect::<Result<Vec<_>, _>>();
        let reference = job.renderer().map_err(|failure| failure.to_string())?;
        kinds.push(Kind { frames: frames.map_err(|failure| failure.to_string())?, reference, rounds: Vec::new() });
    }
    // All kinds take turns. The first rounds warm up.
    for _ in 0..WARM + ROUNDS {
        kinds.iter_mut().try_for_each(Kind::take_turn)?;
    }
    println!("{}, medians of {ROUNDS} rounds\n", gpu.describe());
    println!(
        "| | reference, ms | rays, ms | shown, ms | as a picture, ms | to Phong | fast: rays, ms | shown, ms | to Phong |"
    );
    println!("|---|--:|--:|--:|--:|--:|--:|--:|--:|");
    for ((name, base, _), kind) in SCENES.iter().zip(&kinds) {
        print!("| {name} | {:.0}", 1e3 * kind.median(|round| round.reference));
        for card in 0..kind.frames.len() {
            print!(" | {:.2}", 1e3 * kind.median(|round| round.cards[card].rays));
            print!(" | {:.2}", 1e3 * kind.median(|round| round.cards[card].shown));
            if card == 0 {
                print!(" | {:.1}", 1e3 * kind.median(|round| round.cards[card].picture));
            }
            let rays = |kind: &Kind| kind.rounds[WARM..].iter().map(|round| round.cards[card].rays).collect::<Vec<_>>();
            let base = SCENES.iter().position(|(name, ..)| name == base).ok_or("no such scene")?;
            let ratios: Vec<f64> = rays(kind).iter().zip(rays(&kinds[base])).map(|(own, base)| own / base).collect();
            print!(" | {:.2}", median(&ratios));
        }
        println!(" |");
    }
    Ok(())
}

/// A scene on the card, with each interpolation, and on the reference.
struct Kind<'a> {
    frames: Vec<GpuFrames<'a>>,
    reference: Renderer<'a>,
    rounds: Vec<Round>,
}

/// Seconds of a round.
struct Round {
    reference: f64,
    cards: Vec<Times>,
}

/// Seconds of a frame on the card.
struct Times {
    /// Seconds of its rays, by the card's clock; by the host's where the card has none.
    rays: f64,
    /// Until it is in a viewer's texture.
    shown: f64,
    /// Until it is a picture on the host.
    picture: f64,
}

impl Kind<'_> {
    fn take_turn(&mut self) -> Result<(), String> {
        let reference = timed(|| Ok(self.reference.frame(&|_| ())))?.1;
        let mut cards = Vec::new();
        for frames in &mut self.frames {
            let (on_card, shown) = timed(|| frames.show().map_err(|failure| failure.to_string()))?;
            let picture = timed(|| frames.frame(&|_| ()).map_err(|failure| failure.to_string()))?.1;
            cards.push(Times { rays: on_card.unwrap_or(shown), shown, picture });
        }
        self.rounds.push(Round { reference, cards });
        Ok(())
    }

    fn median(&self, seconds: impl Fn(&Round) -> f64) -> f64 {
        median(&self.rounds[WARM..].iter().map(seconds).collect::<Vec<_>>())
    }
}

fn timed<T>(run: impl FnOnce() -> Result<T, String>) -> Result<(T, f64), String> {
    let start = Instant::now();
    let made = run()?;
    Ok((made, start.elapsed().as_secs_f64()))
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
