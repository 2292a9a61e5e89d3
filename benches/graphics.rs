//! Frames of a graphics card: 256³ voxels, 512×512 pixels of one ray, steps of half a voxel; each effect with the shader's
//! interpolation and with the texture unit's, and by the reference. Ratios are to Phong shading: Table 1 of Bruckner and
//! Gröller 2007 has styles at 0.98 to 1.25, that of their halos has M = 4 at 2.9. A plain caster takes part in the turns.
//!
//! `cargo bench --bench graphics --features gpu`, and for some scenes alone parts of their names: `-- unshaded styles`.

mod plain;
mod specimen;

use drypoint::cost::median;
use drypoint::frames::Frames;
use drypoint::gpu::{Gpu, GpuFrames, Interpolation};
use drypoint::job::Job;
use drypoint::reference::ray::Renderer;
use plain::Plain;
use specimen::{COLOURS, STYLES, job};
use std::time::Instant;

/// Rounds that are counted, and those before them.
const ROUNDS: usize = 15;
const WARM: usize = 3;

/// Frames of a card in a turn, of which the last one counts. The first ones raise the clock of a card that has idled.
const BURST: usize = 8;

const KERNEL: &str = "kernel = \"bspline\"\n";

/// The scene to whose times the others stand in ratios. It always takes part.
const PHONG: &str = "Phong";

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

/// Scenes that the plain caster draws, too.
const PLAIN: [&str; 2] = ["unshaded", PHONG];

/// A halo around the shell.
const HALO: &str = "[[halo]]\nseed.value = [[150, 0], [180, 1]]\n";

fn main() -> Result<(), String> {
    let gpu = Gpu::new().map_err(|error| error.to_string())?;
    let fast = gpu.interpolating(Interpolation::Fast);
    let cards: Vec<&Gpu> = [Some(&gpu), fast.as_ref().ok()].into_iter().flatten().collect();
    let asked: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let is_asked = |name: &str| name == PHONG || asked.is_empty() || asked.iter().any(|word| name.contains(word));
    let scenes = SCENES.iter().filter(|(name, _)| is_asked(name));
    let (names, jobs): (Vec<&str>, Vec<Job>) = scenes.map(|(name, tables)| (*name, job(tables, "1"))).unzip();
    let phong = names.iter().position(|&name| name == PHONG).unwrap_or_default();
    let burst = if gpu.is_software() { 1 } else { BURST };
    let mut kinds = Vec::new();
    for job in &jobs {
        let frames = cards.iter().map(|gpu| GpuFrames::new(job, gpu)).collect::<Result<Vec<_>, _>>();
        let reference = job.renderer().map_err(|failure| failure.to_string())?;
        let mut frames = frames.map_err(|failure| failure.to_string())?;
        let before = gpu.dispatches();
        frames[0].frame(&|_| ()).map_err(|failure| failure.to_string())?;
        let dispatches = gpu.dispatches() - before;
        kinds.push(Kind { frames, reference, dispatches, burst, rounds: Vec::new() });
    }
    let interpolations = [Interpolation::Exact, Interpolation::Fast];
    let of = |(scene, kind)| Plain::new(&gpu, kind, &jobs[scene], names[scene] == PHONG);
    let cases = (0..names.len()).filter(|&scene| PLAIN.contains(&names[scene]));
    let cases = cases.flat_map(|scene| (0..cards.len()).map(move |card| (scene, card))).collect::<Vec<_>>();
    let plain = cases.iter().map(|&(scene, card)| of((scene, interpolations[card]))).collect::<Vec<_>>();
    let mut plain_seconds = vec![Vec::new(); plain.len()];
    // All kinds take turns. The first rounds warm up.
    for _ in 0..WARM + ROUNDS {
        kinds.iter_mut().try_for_each(Kind::take_turn)?;
        for (caster, seconds) in plain.iter().zip(&mut plain_seconds) {
            (1..burst).for_each(|_| caster.frame());
            let start = Instant::now();
            caster.frame();
            seconds.push(start.elapsed().as_secs_f64());
        }
    }
    println!("{}, medians of {ROUNDS} rounds\n", gpu.describe());
    println!(
        "| | dispatches | reference, ms | rays, ms | shown, ms | as a picture, ms | to Phong | fast: rays, ms | shown, ms | to Phong |"
    );
    println!("|---|--:|--:|--:|--:|--:|--:|--:|--:|--:|");
    for (name, kind) in names.iter().zip(&kinds) {
        print!("| {name} | {} | {:.0}", kind.dispatches, 1e3 * kind.median(|round| round.reference));
        for card in 0..kind.frames.len() {
            print!(" | {:.2}", 1e3 * kind.median(|round| round.cards[card].rays));
            print!(" | {:.2}", 1e3 * kind.median(|round| round.cards[card].shown));
            if card == 0 {
                print!(" | {:.1}", 1e3 * kind.median(|round| round.cards[card].picture));
            }
            let rays = |kind: &Kind| kind.rounds[WARM..].iter().map(|round| round.cards[card].rays).collect::<Vec<_>>();
            let ratios: Vec<f64> = rays(kind).iter().zip(rays(&kinds[phong])).map(|(own, base)| own / base).collect();
            print!(" | {:.2}", median(&ratios));
        }
        println!(" |");
    }
    println!("\n| | plain caster, ms | ours, shown, ms | ratio | difference of pictures |\n|---|--:|--:|--:|--:|");
    for ((&(scene, card), caster), seconds) in cases.iter().zip(&plain).zip(&plain_seconds) {
        let (picture, _) = kinds[scene].frames[card].frame(&|_| ()).map_err(|failure| failure.to_string())?;
        let apart = caster.distance(&picture);
        let plain = median(&seconds[WARM..]);
        let ours = kinds[scene].median(|round| round.cards[card].shown);
        let name = [names[scene], ["", ", fast"][card]].concat();
        println!("| {name} | {:.2} | {:.2} | {:.2} | {apart:.4} |", 1e3 * plain, 1e3 * ours, ours / plain);
    }
    Ok(())
}

/// A scene on the card, with each interpolation, and on the reference.
struct Kind<'a> {
    frames: Vec<GpuFrames>,
    reference: Renderer<'a>,
    /// Dispatches of a frame.
    dispatches: usize,
    burst: usize,
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
            let mut show = || timed(|| frames.show().map_err(|failure| failure.to_string()));
            for _ in 1..self.burst {
                show()?;
            }
            let (on_card, shown) = show()?;
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
