//! Table 1 of Bruckner and Gröller 2005: frames of the UNC head with a cubic selection of 16³, 32³ and 64³ voxels in its middle
//! beside frames without one. The paper's function and picture: opaque above 1228, 512×512 pixels, about 444 planes, turned
//! about each axis. Empty space is skipped, and a ray ends where less than 1/255 shines through.
//!
//! `cargo bench --bench volumeshop_table_1`, with `--features gpu` on a graphics card, too.

#[cfg(feature = "gpu")]
use drypoint::frames::Frames;
#[cfg(feature = "gpu")]
use drypoint::gpu::{Gpu, GpuFrames};
use drypoint::job::Job;
use drypoint::reference::ray::Renderer;
use drypoint::scene::file::{Overrides, load};
use drypoint::scene::shot::Shot;
use drypoint::scene::space::Grid;
use drypoint::scene::view::View;
use drypoint::scene::volume::write::write_nrrd;
use drypoint::scene::volume::{Volume, Voxels};
use std::path::Path;
use std::time::Instant;

/// Views about each axis.
const VIEWS: usize = 4;

/// Rounds over all views, after one that warms up.
const ROUNDS: usize = 3;

/// Frames a second in the paper, by the side of the selection.
const PAPER: [(usize, f64); 4] = [(0, 8.28), (16, 8.04), (32, 6.81), (64, 4.86)];

fn main() -> Result<(), String> {
    let folder = std::env::temp_dir().join(format!("drypoint-table-1-{}", std::process::id()));
    std::fs::create_dir_all(&folder).map_err(|e| e.to_string())?;
    let result = table(&folder);
    std::fs::remove_dir_all(&folder).map_err(|e| e.to_string())?;
    result
}

fn table(folder: &Path) -> Result<(), String> {
    let plain = job(folder, 0, &Grid::with_spacing([1; 3], [1.0; 3]).map_err(|e| e.to_string())?)?;
    let grid = plain.volume.grid().clone();
    let mut jobs = vec![plain];
    for (side, _) in &PAPER[1..] {
        jobs.push(job(folder, *side, &grid)?);
    }
    let views = views(&jobs[0])?;
    println!("By the reference:\n");
    let mut renderers: Vec<Renderer<'_>> =
        jobs.iter().map(Job::renderer).collect::<Result<_, _>>().map_err(|e| e.to_string())?;
    let mut samples = vec![0u64; PAPER.len()];
    let shots: Vec<Shot> = jobs.iter().map(Job::shot).collect::<Result<_, _>>().map_err(|e| e.to_string())?;
    measure(&views, |i, view| {
        let shot = shots[i].seen_from(view.clone());
        renderers[i].turn(&shot).map_err(|e| e.to_string())?;
        let start = Instant::now();
        let (picture, counts) = renderers[i].again(&|_| ());
        std::hint::black_box(picture);
        samples[i] += counts.samples;
        Ok(start.elapsed().as_secs_f64())
    })?;
    let more: Vec<String> = samples.iter().map(|&n| format!("{:.3}", n as f64 / samples[0] as f64)).collect();
    println!("\nSamples to none: {}", more.join(", "));
    #[cfg(feature = "gpu")]
    on_card(&jobs, &views)?;
    Ok(())
}

/// The table on a graphics card, by its own clock where it has one.
#[cfg(feature = "gpu")]
fn on_card(jobs: &[Job], views: &[View]) -> Result<(), String> {
    let gpu = Gpu::new().map_err(|e| e.to_string())?;
    println!("\nOn {}:\n", gpu.describe());
    let mut frames: Vec<GpuFrames> =
        jobs.iter().map(|job| GpuFrames::new(job, &gpu)).collect::<Result<_, _>>().map_err(|e| e.to_string())?;
    let shots: Vec<Shot> = jobs.iter().map(Job::shot).collect::<Result<_, _>>().map_err(|e| e.to_string())?;
    measure(views, |i, view| {
        let shot = shots[i].seen_from(view.clone());
        frames[i].turn(&shot).map_err(|e| e.to_string())?;
        let start = Instant::now();
        let on_card = frames[i].show().map_err(|e| e.to_string())?;
        Ok(on_card.unwrap_or(start.elapsed().as_secs_f64()))
    })
}

/// Prints the seconds of frames, and their ratios to those without a selection. Frames of all selections take turns, view by
/// view, so that what slows the machine slows all of them. `frame` draws one for a selection and returns its seconds.
fn measure(views: &[View], mut frame: impl FnMut(usize, &View) -> Result<f64, String>) -> Result<(), String> {
    let mut ratios = vec![Vec::new(); PAPER.len()];
    let mut seconds = vec![Vec::new(); PAPER.len()];
    for round in 0..=ROUNDS {
        for view in views {
            let mut without = 0.0;
            for i in 0..PAPER.len() {
                let taken = frame(i, view)?;
                if i == 0 {
                    without = taken;
                }
                if round > 0 {
                    seconds[i].push(taken);
                    ratios[i].push(taken / without);
                }
            }
        }
    }
    println!("| selection | ms a frame | ratio to none | the paper's |");
    println!("|---|--:|--:|--:|");
    for (i, (side, frames)) in PAPER.into_iter().enumerate() {
        let name = if side == 0 { "none".into() } else { format!("{side}³") };
        let (time, ratio) = (median(&mut seconds[i]) * 1e3, median(&mut ratios[i]));
        println!("| {name} | {time:.2} | {ratio:.3} | {:.3} |", PAPER[0].1 / frames);
    }
    Ok(())
}

/// The head with a selection of a side in its middle, drawn as the rest of it.
fn job(folder: &Path, side: usize, grid: &Grid) -> Result<Job, String> {
    let mut text = String::from(
        "drypoint = 1\n[volume]\nfile = \"cthead.nhdr\"\n[picture]\nsize = [512, 512]\nsamples = 1\n\
         [sampling]\nstep = \"1 voxel\"\nstop_below = 0.00392156862745098\n\
         [transfer]\nkind = \"regular\"\n\
         nodes = [{ at = 1228, color = \"#e8dcc0\", opacity = 0 }, { at = 1228, color = \"#e8dcc0\", opacity = 1 }]\n[shading]\n",
    );
    if side > 0 {
        let file = folder.join(format!("cube-{side}.nrrd"));
        let [nx, ny, nz] = grid.dims();
        let inside = |i: usize, n: usize| (n / 2 - side / 2..n / 2 + side / 2).contains(&i);
        let member = |i: usize| inside(i % nx, nx) && inside(i / nx % ny, ny) && inside(i / (nx * ny), nz);
        let voxels = Voxels::U8((0..grid.len()).map(|i| u8::from(member(i))).collect());
        let cube = Volume::new(grid.clone(), voxels, 1.0, 0.0).map_err(|e| e.to_string())?;
        write_nrrd(&cube, &file).map_err(|e| e.to_string())?;
        text += &format!("[[object]]\nselection = \"{}\"\n", file.display());
    }
    // Volumes are found for scenes that are files.
    let file = folder.join(format!("{side}.toml"));
    std::fs::write(&file, text).map_err(|e| e.to_string())?;
    let scene = load(&file, &Overrides::default()).map_err(|e| e.to_string())?;
    Job::load(scene).map_err(|e| e.to_string())
}

/// Views about the three axes.
fn views(job: &Job) -> Result<Vec<View>, String> {
    let mut views = Vec::new();
    for axis in 0..3 {
        for i in 0..VIEWS {
            let turn = std::f64::consts::TAU * (i as f64 + 0.25) / VIEWS as f64;
            let mut camera = job.scene.camera.clone();
            let (mut direction, mut up) = ([0.0; 3], [0.0; 3]);
            (direction[(axis + 1) % 3], direction[(axis + 2) % 3]) = (turn.cos(), turn.sin());
            up[axis] = 1.0;
            (camera.direction, camera.direction_given, camera.up) = (direction.into(), true, up.into());
            views.push(View::new(&camera, job.volume.grid(), job.scene.picture.size).map_err(|e| e.to_string())?);
        }
    }
    Ok(views)
}

fn median(numbers: &mut [f64]) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[numbers.len() / 2]
}
