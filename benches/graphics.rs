//! Frames of a graphics card: 256³ voxels, 512×512 pixels of one ray, steps of half a voxel; each effect with the shader's
//! interpolation and with the texture unit's, and by the reference. Ratios are to Phong shading: Table 1 of Bruckner and
//! Gröller 2007 has styles at 0.98 to 1.25, that of their halos has M = 4 at 2.9.
//!
//! `cargo bench --bench graphics --features gpu`

mod specimen;

use drypoint::cost::median;
use drypoint::frames::Frames;
use drypoint::gpu::{Gpu, GpuFrames, Interpolation};
use drypoint::reference::ray::Renderer;
use specimen::{COLOURS, STYLES, job};
use std::time::Instant;

/// Rounds that are counted, and those before them.
const ROUNDS: usize = 15;
const WARM: usize = 3;

const KERNEL: &str = "kernel = \"bspline\"\n";

/// The scene to whose times the others stand in ratios.
const PHONG: usize = 1;

/// Names of scenes, and their tables.
const SCENES: [(&str, &[&str]); 10] = [
    ("unshaded", &[COLOURS]),
    ("Phong", &[COLOURS, "[shading]\n"]),
    ("Phong, cubic B-spline", &[KERNEL, COLOURS, "[shading]\n"]),
    ("styles", &[STYLES]),
    ("styles, contours", &[STYLES, "[contours]\n"]),
    ("styles, contours of exact κ", &[STYLES, "[contours]\nkappa = \"exact\"\n"]),
    ("styles, contours, mip-maps", &[STYLES, "[contours]\n[style_mipmaps]\n"]),
    ("Phong, a halo, M = 1", &[COLOURS, "[shading]\n", HALO]),
    ("Phong, a halo, M = 4", &[COLOURS, "[shading]\n", HALO, "every = 4\n"]),
    (
        "Phong, four halos, M = 4",
        &[COLOURS, "[shading]\n", HALO, "every = 4\n", HALO, "every = 4\n", HALO, "every = 4\n", HALO, "every = 4\n"],
    ),
];

/// A halo around the shell.
const HALO: &str = "[[halo]]\nseed.value = [[150, 0], [180, 1]]\n";

fn main() -> Result<(), String> {
    let gpu = Gpu::new().map_err(|error| error.to_string())?;
    let fast = gpu.interpolating(Interpolation::Fast);
    let cards: Vec<&Gpu> = [Some(&gpu), fast.as_ref().ok()].into_iter().flatten().collect();
    let jobs = SCENES.iter().map(|(_, tables)| job(tables, "1")).collect::<Vec<_>>();
    let mut kinds = Vec::new();
    for job in &jobs {
        let frames = cards.iter().map(|gpu| GpuFrames::new(job, gpu)).collect::<Result<Vec<_>, _>>();
        let reference = job.renderer().map_err(|failure| failure.to_string())?;
        let mut frames = frames.map_err(|failure| failure.to_string())?;
        let before = gpu.dispatches();
        frames[0].frame(&|_| ()).map_err(|failure| failure.to_string())?;
        let dispatches = gpu.dispatches() - before;
        kinds.push(Kind { frames, reference, dispatches, rounds: Vec::new() });
    }
    // All kinds take turns. The first rounds warm up.
    for _ in 0..WARM + ROUNDS {
        kinds.iter_mut().try_for_each(Kind::take_turn)?;
    }
    println!("{}, medians of {ROUNDS} rounds\n", gpu.describe());
    println!(
        "| | dispatches | reference, ms | rays, ms | shown, ms | as a picture, ms | to Phong | fast: rays, ms | shown, ms | to Phong |"
    );
    println!("|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
    for ((name, _), kind) in SCENES.iter().zip(&kinds) {
        print!("| {name} | {} | {:.0}", kind.dispatches, 1e3 * kind.median(|round| round.reference));
        for card in 0..kind.frames.len() {
            print!(" | {:.2}", 1e3 * kind.median(|round| round.cards[card].rays));
            print!(" | {:.2}", 1e3 * kind.median(|round| round.cards[card].shown));
            if card == 0 {
                print!(" | {:.1}", 1e3 * kind.median(|round| round.cards[card].picture));
            }
            let rays = |kind: &Kind| kind.rounds[WARM..].iter().map(|round| round.cards[card].rays).collect::<Vec<_>>();
            let ratios: Vec<f64> = rays(kind).iter().zip(rays(&kinds[PHONG])).map(|(own, base)| own / base).collect();
            print!(" | {:.2}", median(&ratios));
        }
        println!(" |");
    }
    Ok(())
}

/// A scene on the card, with each interpolation, and on the reference.
struct Kind<'a> {
    frames: Vec<GpuFrames>,
    reference: Renderer<'a>,
    /// Dispatches of a frame.
    dispatches: usize,
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
