//! Table 1 of Lu et al. 2002: frames a second with stipples, with silhouette curves, and with both, of eight volumes, beside the
//! paper's. A frame is what changes with the camera: factors, projection, dots, curves, and painting them on 500 × 500 pixels;
//! what is made once stands beside it. The paper does not print its parameters: ours are those of its Fig. 1.
//!
//! `cargo bench --bench stippling_table_1`

use drypoint::drawing::Drawing;
use drypoint::job::{Job, RenderTarget};
use drypoint::marking::Marking;
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{Overrides, data_folders, parse};
use drypoint::scene::source::Disk;
use drypoint::scene::tables::Orbit;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

/// Frames, after one that warms up: the camera turns from one to the next.
const FRAMES: usize = 9;

/// The paper's row, our volume, and the paper's frames a second with stipples, with curves, and with both.
const ROWS: [(&str, &str, [f64; 3]); 8] = [
    ("iron", "iron_protein.nhdr", [30.0, 60.4, 29.9]),
    ("head", "cthead.nhdr", [4.0, 26.1, 3.5]),
    ("engine", "engine.nhdr", [4.0, 20.3, 3.6]),
    ("leg", "statue_leg.nhdr", [5.0, 30.5, 4.6]),
    ("lobster", "lobster.nhdr", [8.7, 30.5, 7.5]),
    // Of the foot there is no copy with us.
    ("foot", "tooth.nhdr", [5.9, 30.5, 5.0]),
    ("aneurysm", "aneurism.nhdr", [15.1, 30.5, 12.1]),
    ("bonsai", "bonsai.nhdr", [4.3, 20.6, 3.9]),
];

const STIPPLES: &str = "size = \"1.5 px\"\nk_max = 0.5\nthreshold = 0.15\n";
const FACTORS: &str = "[stipples.boundary]\n[stipples.silhouette]\n";
const CURVES: &str = "[stipples.curves]\n";

fn main() -> Result<(), String> {
    println!(
        "| | volume | made once, s | points, 1000 | drawn, 1000 | curves | stipples | curves | both | the paper's |"
    );
    println!("|---|---|--:|--:|--:|--:|--:|--:|--:|--:|");
    for (name, volume, paper) in ROWS {
        let stipples = frames(volume, &format!("{STIPPLES}{FACTORS}"))?;
        // No voxel is above a threshold of 1: no points.
        let curves = frames(volume, &format!("size = \"1.5 px\"\nthreshold = 1.0\n{CURVES}"))?;
        let both = frames(volume, &format!("{STIPPLES}{FACTORS}{CURVES}"))?;
        println!(
            "| {name} | {volume} | {:.2} | {} | {} | {} | {:.0} | {:.0} | {:.0} | {}, {}, {} |",
            both.once,
            both.points / 1000,
            stipples.dots / 1000,
            curves.lines,
            stipples.rate,
            curves.rate,
            both.rate,
            paper[0],
            paper[1],
            paper[2],
        );
    }
    Ok(())
}

struct Measured {
    /// Seconds.
    once: f64,
    points: u64,
    dots: usize,
    lines: usize,
    /// Frames a second: by the median.
    rate: f64,
}

fn frames(volume: &str, stipples: &str) -> Result<Measured, String> {
    let folders = data_folders();
    let found = folders.iter().map(|folder| folder.join(volume)).find(|path| path.is_file());
    let volume = found.ok_or_else(|| format!("{volume} is in no folder of DRYPOINT_DATA"))?;
    let volume = volume.display();
    let file =
        format!("drypoint = 1\n[volume]\nfile = \"{volume}\"\n[picture]\nsize = [500, 500]\n[stipples]\n{stipples}");
    let mut scene = parse(&file, Path::new("table_1.toml"), &Overrides::default()).map_err(|e| e.to_string())?;
    scene.orbit = Some(Orbit { frames: 36, degrees: 360.0, ..Orbit::default() });
    let job = Job::load_for(scene, RenderTarget::Marks, Arc::new(Disk)).map_err(|e| e.to_string())?;
    let mut counts = Counts::default();
    let start = Instant::now();
    let marking = Marking::new(&job, &mut counts, &|_| ()).map_err(|e| e.to_string())?;
    let mut drawing = Drawing::new(&job, &marking, &mut counts).map_err(|e| e.to_string())?;
    let once = start.elapsed().as_secs_f64();
    let (mut seconds, mut marks) = (Vec::new(), [0; 2]);
    for i in 0..=FRAMES {
        let start = Instant::now();
        let (frame, _) = drawing.frame(i, &|_| ()).map_err(|e| e.to_string())?;
        let drawn = frame.marks();
        std::hint::black_box(frame.painted(&job).map_err(|e| e.to_string())?);
        if i > 0 {
            seconds.push(start.elapsed().as_secs_f64());
        } else {
            marks = drawn;
        }
    }
    seconds.sort_by(f64::total_cmp);
    let points = counts.preprocess.get("stipple points").copied().unwrap_or_default();
    Ok(Measured { once, points, dots: marks[0], lines: marks[1], rate: 1.0 / seconds[FRAMES / 2] })
}
