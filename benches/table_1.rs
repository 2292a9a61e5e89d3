//! Table 1 of Bruckner and Gröller 2007: frames of a style transfer function beside those of a regular one with Phong
//! shading, for the four opacity settings of Fig. 7. Same values, opacities, camera and steps; early termination at
//! 1/255, empty space skipped ([STF-11]). Values are trilinear and κ comes from the ray, as in the paper. Both as the program runs them, in lanes where the processor has them; and the
//! ratio once more with every ray cast alone.
//!
//! `cargo bench --bench table_1`

use drypoint::job::Job;
use drypoint::reference::ray::Renderer;
use drypoint::scene::file::{Overrides, load};
use std::path::Path;
use std::time::Instant;

/// Frames of each kind, in turns after one that warms up. A ratio is the median of those of neighbouring frames, so that
/// what slows the machine for longer than a round slows both.
const ROUNDS: usize = 15;

/// What the paper's table has, in frames a second: regular and style.
const PAPER: [(&str, [f64; 2]); 4] = [("a", [11.7, 11.9]), ("b", [10.5, 9.6]), ("c", [10.1, 8.1]), ("d", [12.5, 12.8])];

fn main() -> Result<(), String> {
    println!(
        "| Fig. 7 | regular, ms | style, ms | ratio | without contours | ray by ray | the paper's | samples, 1000 |"
    );
    println!("|---|--:|--:|--:|--:|--:|--:|--:|");
    for (name, [regular, style]) in PAPER {
        let jobs = [
            job(&format!("figure_7_{name}_regular"), &[])?,
            job(&format!("figure_7_{name}"), &["contours.kappa=ray"])?,
            job(&format!("figure_7_{name}"), &["contours=off"])?,
        ];
        let [(a, l), (b, m), (c, n)] = in_turns(&jobs, |renderer| renderer)?;
        let [(alone, _), (styled_alone, _), _] = in_turns(&jobs, |renderer| renderer.ray_by_ray())?;
        println!(
            "| {name} | {:.0} | {:.0} | {:.2} | {:.2} | {:.2} | {:.2} | {} : {} : {} |",
            median(a.clone()) * 1e3,
            median(b.clone()) * 1e3,
            ratio(&b, &a),
            ratio(&c, &a),
            ratio(&styled_alone, &alone),
            regular / style,
            l / 1000,
            m / 1000,
            n / 1000,
        );
    }
    Ok(())
}

fn job(name: &str, changes: &[&str]) -> Result<Job, String> {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("data/scenes/style_transfer_functions").join(name);
    let mut overrides = Overrides::default();
    let of_all = [
        "picture.size=[512, 512]",
        "picture.samples=1",
        "sampling.stop_below=0.00392156862745098",
        "sampling.kernel=trilinear",
        "sampling.hessian=auto",
    ];
    for change in of_all.iter().chain(changes) {
        overrides.push_argument(change).map_err(|e| e.to_string())?;
    }
    let scene = load(&file.with_extension("toml"), &overrides).map_err(|e| e.to_string())?;
    Job::load(scene).map_err(|e| e.to_string())
}

/// The seconds of each's frames, and its samples: the more opaque, the earlier rays end.
fn in_turns<const N: usize>(
    jobs: &[Job; N],
    set: for<'a> fn(Renderer<'a>) -> Renderer<'a>,
) -> Result<[(Vec<f64>, u64); N], String> {
    let mut seconds = [const { Vec::new() }; N];
    let mut samples = [0; N];
    let renderers =
        jobs.iter().map(|job| job.renderer().map(set)).collect::<Result<Vec<_>, _>>().map_err(|e| e.to_string())?;
    for round in 0..=ROUNDS {
        for ((renderer, seconds), samples) in renderers.iter().zip(&mut seconds).zip(&mut samples) {
            let start = Instant::now();
            let (picture, counts) = renderer.frame(&|_| ());
            std::hint::black_box(picture);
            *samples = counts.samples;
            if round > 0 {
                seconds.push(start.elapsed().as_secs_f64());
            }
        }
    }
    Ok(std::array::from_fn(|i| (std::mem::take(&mut seconds[i]), samples[i])))
}

fn median(mut numbers: Vec<f64>) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}

/// The median of the ratios of frames that were drawn one after the other.
fn ratio(a: &[f64], b: &[f64]) -> f64 {
    median(a.iter().zip(b).map(|(a, b)| a / b).collect())
}
