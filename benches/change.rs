//! Times to prepare frames on a graphics card: frames that are made anew, and frames that take a changed scene. Then times
//! of frames from another camera, coarse and exact.
//! 256³ voxels, styles with contours, a clip plane.
//!
//! `cargo bench --bench change --features gpu`

mod specimen;

use drypoint::cost::median;
use drypoint::frames::Frames;
use drypoint::gpu::{Gpu, GpuFrames};
use specimen::{COLOURS, STYLES, job};
use std::num::NonZeroUsize;
use std::time::Instant;

/// Turns of each change.
const TURNS: usize = 5;

/// Changes of the scene: a name, and texts before and after it.
const CHANGES: [(&str, &str, &str); 6] = [
    ("a clip plane", "point = [120, 0, 0]", "point = [140, 0, 0]"),
    ("an opacity", "opacity = 0.9", "opacity = 0.7"),
    ("the thickness of contours", "[contours]", "[contours]\nthickness = \"3 voxels\""),
    ("contours off", "[contours]", ""),
    ("colours for styles", STYLES, COLOURS),
    ("the kernel", "[transfer]", "kernel = \"bspline\"\n[transfer]"),
];

fn main() -> Result<(), String> {
    let gpu = Gpu::new().map_err(|error| error.to_string())?;
    let failed = |failure: drypoint::Failure| failure.to_string();
    let tables = [STYLES, "[contours]\n", "[[clip]]\nnormal = [1, 0, 0]\npoint = [120, 0, 0]\n"].concat();
    let first = job(&[&tables], "1");
    let timed = |run: &mut dyn FnMut() -> Result<(), String>| -> Result<f64, String> {
        let start = Instant::now();
        run()?;
        gpu.wait().map_err(|error| error.to_string())?;
        Ok(1e3 * start.elapsed().as_secs_f64())
    };
    let mut frames = GpuFrames::new(&first, &gpu).map_err(failed)?;
    let (mut anew, compiled) = (Vec::new(), gpu.pipelines());
    for _ in 0..TURNS {
        anew.push(timed(&mut || GpuFrames::new(&first, &gpu).map(|made| frames = made).map_err(failed))?);
    }
    println!("{}, medians of {TURNS} turns\n", gpu.describe());
    println!("| change | ms | pipelines |\n|---|--:|--:|");
    println!("| frames made anew | {:.0} | {} |", median(&anew), (gpu.pipelines() - compiled) / TURNS);
    for (name, from, to) in CHANGES {
        let changed = job(&[&tables.replace(from, to)], "1");
        let (mut times, compiled) = (Vec::new(), gpu.pipelines());
        for _ in 0..TURNS {
            times.push(timed(&mut || frames.change(&changed).map(drop).map_err(failed))?);
            frames.change(&first).map_err(failed)?;
        }
        let pipelines = (gpu.pipelines() - compiled) as f64 / (2 * TURNS) as f64;
        println!("| {name} | {:.1} | {pipelines} |", median(&times));
    }
    println!("\n| n | frame | ms | pipelines |\n|--:|---|--:|--:|");
    for n in [16, 8, 4, 1].map(|n| NonZeroUsize::new(n).unwrap_or(NonZeroUsize::MIN)) {
        let (mut times, compiled, shot) = (Vec::new(), gpu.pipelines(), first.coarse_shot(n).map_err(failed)?);
        for _ in 0..TURNS {
            let mut shown = || frames.turn(&shot).and_then(|()| frames.show()).map(drop).map_err(failed);
            times.push(timed(&mut shown)?);
        }
        let [width, height] = shot.view.size;
        println!("| {n} | {width}×{height} | {:.1} | {} |", median(&times), gpu.pipelines() - compiled);
    }
    Ok(())
}
