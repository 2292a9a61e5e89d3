//! Hatching in one run ([HATCH-5], [HATCH-8], [HATCH-10]): directions of a whole volume and of what is visible of it; strokes a
//! second with stored directions and with computed ones; what packed strokes take; how far strokes of stored directions are
//! from those of computed ones.
//!
//! `cargo bench --bench stroke`, with the scans in `DRYPOINT_DATA` or `../shared/data`; `-- engine` measures strokes of that
//! scan alone, `-- directions` the directions of a whole volume alone, `-- visible` those that its surface needs, `-- packed`
//! what packed strokes of whole volumes take

use drypoint::job::Job;
use drypoint::output::compare::line_distance::{WorldLine, angles, line_distance};
use drypoint::reference::field::{Field, HessianEstimator, Reconstruction, Rung};
use drypoint::reference::interactive_volume_illustration::{
    DirectionEstimator, DirectionInterpolation, DirectionStorage, GrownStrokes, HatchCounts, HatchParams,
    PackedStrokes, Pyramid, Seed, SeedRule, StrokeGrower, gradient_range,
};
use drypoint::scene::file::{Overrides, parse};
use drypoint::scene::space::Grid;
use drypoint::scene::strokes::Measure;
use drypoint::scene::tables::GradientRange;
use drypoint::scene::volume::{Volume, Voxels};
use rayon::prelude::*;
use std::hint::black_box;
use std::path::Path;
use std::sync::Arc;
use std::time::Instant;

/// The scans, and a value of each.
const SCANS: [(&str, f64); 2] = [("engine.nhdr", 80.0), ("hydrogen_atom.nhdr", 30.0)];

/// Scans of 256³ voxels, and a value of each.
const WHOLE: [(&str, f64); 2] = [("bonsai.nhdr", 40.0), ("aneurism.nhdr", 70.0)];

/// Strokes of a scan.
const STROKES: usize = 50_000;

/// Pairs of strokes that are compared.
const PAIRS: usize = 2000;

/// Times of each; the median counts.
const ROUNDS: usize = 3;

fn main() -> Result<(), String> {
    let folder = std::env::var("DRYPOINT_DATA").unwrap_or_else(|_| "../shared/data".into());
    if !Path::new(&folder).join(SCANS[0].0).exists() {
        println!("skipped: no data");
        return Ok(());
    }
    let wanted: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    let is_wanted = |part: &str| wanted.is_empty() || wanted.iter().any(|word| part.starts_with(word.as_str()));
    println!("{} threads\n", rayon::current_num_threads());
    let (whole, iso) = (|| doubled(&load(&folder, SCANS[0].0)?), SCANS[0].1);
    if is_wanted("directions") {
        preprocessing("all", ALL, &whole()?, iso)?;
    }
    if is_wanted("visible") {
        preprocessing("visible, with pyramid and seeds", VISITED, &whole()?, iso)?;
    }
    for (name, iso) in SCANS.into_iter().filter(|(name, _)| is_wanted(name)) {
        strokes(name, &load(&folder, name)?, iso)?;
    }
    for (name, iso) in WHOLE.into_iter().filter(|_| is_wanted("packed")) {
        let volume = load(&folder, name)?;
        let field = field(&volume, HessianEstimator::Gaussian)?;
        let strokes = StrokeGrower::new(
            &field,
            Some(iso),
            hatching(volume.grid(), DirectionEstimator::Scaled(Default::default()), None),
        );
        packed(name, &strokes.grow_all(&cells(&field, iso), |_| false), volume.grid());
    }
    Ok(())
}

fn load(folder: &str, name: &str) -> Result<Volume, String> {
    let text = format!("drypoint = 1\n[volume]\nfile = \"{name}\"\n");
    let place = Path::new(folder).join("bench.toml");
    let scene = parse(&text, &place, &Overrides::default()).map_err(|e| e.to_string())?;
    Ok(Arc::unwrap_or_clone(Job::load(scene).map_err(|e| e.to_string())?.volume))
}

/// A volume and its mirror image behind it: the engine's 128 slices make 256³ voxels.
fn doubled(volume: &Volume) -> Result<Volume, String> {
    let [nx, ny, nz] = volume.dims();
    let Voxels::U8(voxels) = volume.voxels() else { return Err("the volume is not of bytes".into()) };
    let slices = (0..nz).chain((0..nz).rev());
    let both = slices.flat_map(|z| voxels[z * ny * nx..(z + 1) * ny * nx].iter().copied()).collect();
    let grid = Grid::with_spacing([nx, ny, 2 * nz], volume.grid().spacing()).map_err(|e| e.to_string())?;
    Volume::new(grid, Voxels::U8(both), 1.0, 0.0).map_err(|e| e.to_string())
}

fn field(volume: &Volume, hessian: HessianEstimator) -> Result<Field<'_, f64>, String> {
    let rung = if hessian == HessianEstimator::Auto { Rung::Gradient } else { Rung::Hessian };
    Field::new(volume, Reconstruction { hessian, ..Default::default() }, rung).map_err(|e| e.to_string())
}

fn hatching(grid: &Grid, rule: DirectionEstimator, stored: Option<DirectionStorage>) -> HatchParams {
    HatchParams { rule, stored, ..HatchParams::new(grid) }
}

const ALL: Option<DirectionStorage> = Some(DirectionStorage { between: DirectionInterpolation::Tensor, all: true });
const VISITED: Option<DirectionStorage> =
    Some(DirectionStorage { between: DirectionInterpolation::Tensor, all: false });
const FLIPPED: Option<DirectionStorage> =
    Some(DirectionStorage { between: DirectionInterpolation::Flipped, all: false });

fn preprocessing(which: &str, storing: Option<DirectionStorage>, volume: &Volume, iso: f64) -> Result<(), String> {
    let dims = volume.dims();
    println!("| directions of {dims:?}: {which} | seconds | directions | bytes |\n|---|--:|--:|--:|");
    let scaled = DirectionEstimator::Scaled(Default::default());
    let cases = [
        ("raw, central differences", DirectionEstimator::Raw, HessianEstimator::Central),
        ("raw, Gaussian", DirectionEstimator::Raw, HessianEstimator::Gaussian),
        ("scaled, the default", scaled, HessianEstimator::Auto),
    ];
    for (name, rule, hessian) in cases {
        let mut seconds = Vec::new();
        let mut kept = [0; 2];
        for _ in 0..ROUNDS {
            let start = Instant::now();
            let field = field(volume, hessian)?;
            let strokes = StrokeGrower::new(&field, Some(iso), hatching(volume.grid(), rule, storing));
            strokes.prepare();
            if storing == VISITED {
                black_box(seeds(&strokes, &field, iso));
            }
            seconds.push(start.elapsed().as_secs_f64());
            kept = strokes.stored();
        }
        let [made, bytes] = kept;
        println!("| {name} | {:.2} | {made} | {bytes} |", median(&mut seconds, 0.5));
    }
    println!();
    Ok(())
}

/// The cells of the surface that have a seed.
fn seeds(strokes: &StrokeGrower<'_, '_>, field: &Field<'_, f64>, iso: f64) -> Vec<[usize; 3]> {
    let rule = SeedRule::Curvature { min_curvature: 0.02, min_gradient: 0.05 };
    let (range, _) = gradient_range(field, GradientRange::Fixed([0.0, 60.0]));
    let pyramid = Pyramid::new(field.volume());
    strokes.seeds(&pyramid, field, iso, rule, (Measure::Mean, range)).draw(1).collect()
}

/// The number below which a share of others lies.
fn median(numbers: &mut [f64], share: f64) -> f64 {
    numbers.sort_by(f64::total_cmp);
    numbers[((numbers.len() - 1) as f64 * share).round() as usize]
}

fn strokes(name: &str, volume: &Volume, iso: f64) -> Result<(), String> {
    let field = field(volume, HessianEstimator::Gaussian)?;
    let cells = cells(&field, iso);
    println!(
        "| {name}, {} seeds | seconds | the second time | of it placing | strokes a second | directions | stored |",
        cells.len()
    );
    println!("|---|--:|--:|--:|--:|--:|--:|");
    let mut grown: Vec<(&str, GrownStrokes)> = Vec::new();
    for (how, rule) in [("scaled", DirectionEstimator::Scaled(Default::default())), ("raw", DirectionEstimator::Raw)] {
        for (from, storing) in [("hessian", None), ("stored", VISITED), ("stored, flipped", FLIPPED)] {
            let strokes = StrokeGrower::new(&field, Some(iso), hatching(volume.grid(), rule, storing));
            let once = || {
                let start = Instant::now();
                let grown = strokes.grow_all(&cells, |_| false);
                (start.elapsed().as_secs_f64(), grown)
            };
            let ((first, made), (again, _)) = (once(), once());
            let start = Instant::now();
            cells.par_iter().for_each(|&cell| {
                black_box(strokes.place(cell, &mut HatchCounts::default())).ok();
            });
            let placing = start.elapsed().as_secs_f64();
            println!(
                "| {how}, {from} | {first:.2} | {again:.2} | {placing:.2} | {:.0} | {} | {} |",
                made.strokes.len() as f64 / again,
                made.counts.scales.directions(),
                strokes.stored()[0],
            );
            if how == "scaled" {
                grown.push((from, made));
            }
        }
    }
    println!();
    if let Some((_, direct)) = grown.first() {
        packed(name, direct, volume.grid());
        println!(
            "| {name}: distance to computed directions | strokes of one alone | Hausdorff, voxels: median | 95 % | angle: median \
             | 95 % |\n|---|--:|--:|--:|--:|--:|"
        );
        for (from, other) in &grown[1..] {
            compared(from, direct, other, volume.grid());
        }
        println!();
    }
    Ok(())
}

/// Of the cells that the surface crosses so many as there shall be strokes, all over it.
fn cells(field: &Field<'_, f64>, iso: f64) -> Vec<[usize; 3]> {
    let volume = field.volume();
    let strokes = StrokeGrower::new(field, Some(iso), hatching(volume.grid(), DirectionEstimator::Raw, None));
    let pyramid = Pyramid::new(volume);
    let seeds = strokes.seeds(&pyramid, field, iso, SeedRule::Dense, (Measure::Mean, [0.0; 2]));
    let all: Vec<[usize; 3]> = seeds.cells.into_iter().map(|(cell, _)| cell).collect();
    let share = (STROKES as f64 / all.len() as f64).min(1.0);
    let kept = |i: &usize| (*i as f64 * share).floor() != ((i + 1) as f64 * share).floor();
    (0..all.len()).filter(kept).map(|i| all[i]).collect()
}

/// What strokes take beside the volume.
fn packed(name: &str, grown: &GrownStrokes, grid: &Grid) {
    let packed = PackedStrokes::new(grown.strokes.iter().map(|(_, stroke)| stroke), grid);
    let (bytes, normals, strokes) = (packed.bytes() as f64, 4.0 * grid.len() as f64, grown.strokes.len() as f64);
    println!(
        "{name}: {strokes} strokes, {} vertices: {bytes} bytes packed, 1/{:.1} of value and normal, 4 B a voxel; {:.1} segments \
         a stroke, an eighth takes {:.0} strokes\n",
        packed.vertices(),
        normals / bytes,
        packed.vertices() as f64 / strokes - 1.0,
        strokes * normals / (8.0 * bytes),
    );
}

/// Strokes of the same seeds: how far they are apart, and the angle between them at equal arc lengths from the seed's end.
fn compared(from: &str, direct: &GrownStrokes, other: &GrownStrokes, grid: &Grid) {
    let voxel = grid.voxel();
    let find = |seed: &Seed| other.strokes.iter().position(|(s, _)| s.cell == seed.cell);
    let step = direct.strokes.len().div_ceil(PAIRS);
    let (mut far, mut turned, mut alone) = (Vec::new(), Vec::new(), 0);
    for (seed, a) in direct.strokes.iter().step_by(step) {
        let Some(at) = find(seed) else {
            alone += 1;
            continue;
        };
        let (_, b) = &other.strokes[at];
        if let Some(found) = line_distance([a].into_iter(), [b].into_iter(), 0.1 * voxel) {
            far.push(found.max / voxel);
        }
        if !a.closed && !b.closed && seed.family == other.strokes[at].0.family {
            turned.extend(angles(&WorldLine::from(a), &WorldLine::from(b), voxel).into_iter().map(f64::to_degrees));
        }
    }
    println!(
        "| {from} | {:.1} % | {:.3} | {:.2} | {:.2}° | {:.1}° |",
        100.0 * f64::from(alone) / (far.len() as f64 + f64::from(alone)),
        median(&mut far, 0.5),
        median(&mut far, 0.95),
        median(&mut turned, 0.5),
        median(&mut turned, 0.95),
    );
}
