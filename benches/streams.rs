//! Strokes a second on one core: along a field of directions in a file, and along the lines of curvature of a volume.
//!
//! `DRYPOINT_SEEDS=seeds.txt DRYPOINT_FIELD=field.nrrd DRYPOINT_VOLUME=torus.nrrd cargo bench --bench streams`; seeds are
//! `x y z` in index space, one a line, the field is a NRRD of three floats a voxel, without gaps. Strokes are 20 voxels long,
//! half of it each way. With `DRYPOINT_OUT` a folder gets a file for each row of the table: the seed and both ends of each
//! stroke, nine little-endian doubles.

use drypoint::reference::field::normal::outward;
use drypoint::reference::field::{Field, GradientEstimator, Kernel, Reconstruction, Rung, Sampler};
use drypoint::reference::interactive_volume_illustration::integrator::{Control, LineField, trace};
use drypoint::reference::interactive_volume_illustration::{
    CurvatureFamily, DirectionCounts, DirectionEstimator, DirectionInterpolation, DirectionStorage, HatchCounts,
    HatchParams, Seed, StrokeGrower,
};
use drypoint::reference::number::Vec3;
use drypoint::reference::with_sampler;
use drypoint::scene::glam::DVec3;
use drypoint::scene::volume::read::read;
use std::env::var;
use std::path::Path;
use std::time::Instant;

/// Of a stroke, both ways together, in voxels.
const LENGTH: f64 = 20.0;

/// Of a step, in voxels.
const TOLERANCE: f64 = 1e-3;

/// Times of each; the median counts.
const ROUNDS: usize = 5;

/// A stroke's seed and its ends.
type Ends = [DVec3; 3];

fn main() -> Result<(), String> {
    let Ok(seeds) = var("DRYPOINT_SEEDS") else {
        println!("skipped: no DRYPOINT_SEEDS");
        return Ok(());
    };
    let seeds = places(&std::fs::read_to_string(seeds).map_err(|e| e.to_string())?)?;
    println!(
        "| {} seeds | strokes a second | directions a stroke | vertices a stroke |\n|---|--:|--:|--:|",
        seeds.len()
    );
    if let Ok(path) = var("DRYPOINT_FIELD") {
        let field = Vectors::read(Path::new(&path))?;
        row("field", || along_vectors(&field, &seeds))?;
    }
    if let Ok(path) = var("DRYPOINT_VOLUME") {
        let volume = read(Path::new(&path), None).map_err(|e| e.to_string())?;
        let kernels = [("trilinear", Kernel::Trilinear), ("bspline", Kernel::Bspline), ("bspline5", Kernel::Bspline5)];
        for (name, kernel) in kernels {
            let gradient = match kernel {
                Kernel::Trilinear => GradientEstimator::Central,
                _ => GradientEstimator::Analytic,
            };
            let how = Reconstruction { kernel, gradient, ..Reconstruction::default() };
            let field = Field::<f64>::new(&volume, how, Rung::Hessian).map_err(|e| e.to_string())?;
            for (from, stored) in [
                ("stored", Some(DirectionStorage { between: DirectionInterpolation::Tensor, all: false })),
                ("hessian", None),
            ] {
                let how = HatchParams {
                    length: LENGTH * volume.grid().voxel(),
                    tolerance: TOLERANCE * volume.grid().voxel(),
                    max_angle: 180.0,
                    rule: DirectionEstimator::Raw,
                    stored,
                    ..HatchParams::new(volume.grid())
                };
                let strokes = StrokeGrower::new(&field, None, how);
                row(&format!("{name}-{from}"), || along_curvature(&strokes, &field, &seeds))?;
            }
        }
    }
    Ok(())
}

/// The median of some rounds, after one in which what is stored is made.
fn row(name: &str, run: impl Fn() -> (Vec<Ends>, [u64; 2])) -> Result<(), String> {
    let (ends, [asked, vertices]) = run();
    let mut seconds: Vec<f64> = (0..ROUNDS)
        .map(|_| {
            let start = Instant::now();
            run();
            start.elapsed().as_secs_f64()
        })
        .collect();
    seconds.sort_by(f64::total_cmp);
    let n = ends.len() as f64;
    let [asked, vertices] = [asked, vertices].map(|count| count as f64 / n);
    println!("| {name}, {} strokes | {:.0} | {asked:.1} | {vertices:.1} |", ends.len(), n / seconds[ROUNDS / 2]);
    if let Ok(folder) = var("DRYPOINT_OUT") {
        let bytes: Vec<u8> = ends.iter().flatten().flat_map(DVec3::to_array).flat_map(f64::to_le_bytes).collect();
        std::fs::write(Path::new(&folder).join(format!("{name}.f64")), bytes).map_err(|e| e.to_string())?;
    }
    Ok(())
}

/// Vectors at voxels, interpolated as they are.
struct Vectors {
    dims: [usize; 3],
    numbers: Vec<f32>,
}

impl Vectors {
    fn read(path: &Path) -> Result<Self, String> {
        let bytes = std::fs::read(path).map_err(|e| e.to_string())?;
        let end = bytes.windows(2).position(|pair| pair == b"\n\n").ok_or("the field has no header")?;
        let header = String::from_utf8_lossy(&bytes[..end]);
        let sizes = header.lines().find_map(|line| line.strip_prefix("sizes:")).ok_or("the field has no sizes")?;
        let sizes: Vec<usize> = sizes.split_whitespace().filter_map(|n| n.parse().ok()).collect();
        let numbers: Vec<f32> =
            bytes[end + 2..].chunks_exact(4).map(|b| f32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
        match sizes[..] {
            [3, nx, ny, nz] if numbers.len() == 3 * nx * ny * nz && nx.min(ny).min(nz) > 1 => {
                Ok(Self { dims: [nx, ny, nz], numbers })
            }
            _ => Err(format!("{sizes:?} with {} numbers is no field of three floats a voxel", numbers.len())),
        }
    }

    /// A direction of length 1.
    fn at(&self, x: DVec3) -> Option<DVec3> {
        let [nx, ny, nz] = self.dims;
        let last = DVec3::new((nx - 1) as f64, (ny - 1) as f64, (nz - 1) as f64);
        if !(x.cmpge(DVec3::ZERO).all() && x.cmplt(last).all()) {
            return None;
        }
        let [i, j, k] = x.to_array().map(|x| x as usize);
        let w = x - DVec3::new(i as f64, j as f64, k as f64);
        let pair = |j: usize, k: usize| {
            let from = 3 * ((k * ny + j) * nx + i);
            let n: [f32; 6] = self.numbers[from..from + 6].try_into().unwrap_or_default();
            let [a, b, c, d, e, f] = n.map(f64::from);
            let low = DVec3::new(a, b, c);
            low + (DVec3::new(d, e, f) - low) * w.x
        };
        let [low, high] = [k, k + 1].map(|k| pair(j, k).lerp(pair(j + 1, k), w.y));
        low.lerp(high, w.z).try_normalize()
    }
}

impl LineField for &Vectors {
    type Cause = ();
    fn at(&mut self, x: DVec3) -> Result<DVec3, ()> {
        Vectors::at(self, x).ok_or(())
    }
}

fn along_vectors(mut field: &Vectors, seeds: &[DVec3]) -> (Vec<Ends>, [u64; 2]) {
    let control = Control {
        tolerance: TOLERANCE,
        first: 0.5,
        min_step: 0.01,
        max_step: 2.0,
        length: 0.5 * LENGTH,
        cos_max_angle: -1.0,
        goal: None,
    };
    let (mut asked, mut vertices) = (0, 0);
    let strokes = seeds.iter().filter_map(|&seed| {
        let along = field.at(seed)?;
        let halves = [along, -along].map(|along| trace(&mut field, seed, along, &control));
        asked += 1 + halves.iter().map(|half| u64::from(half.evaluations)).sum::<u64>();
        vertices += 1 + halves.iter().map(|half| half.segments.len() as u64).sum::<u64>();
        let [a, b] = halves.map(|half| half.segments.last().map_or(seed, |segment| segment.ends[1]));
        Some([seed, a, b])
    });
    (strokes.collect(), [asked, vertices])
}

fn along_curvature(strokes: &StrokeGrower<'_, '_>, field: &Field<'_, f64>, seeds: &[DVec3]) -> (Vec<Ends>, [u64; 2]) {
    let grid = field.volume().grid();
    let mut counts = HatchCounts::default();
    let mut vertices = 0;
    let ends = seeds.iter().filter_map(|&place| {
        let index = Vec3::from_glam(place);
        let (target, gradient, cell) = with_sampler!(field, |s| (s.value(index), s.gradient(index), s.cell(index)));
        let normal = outward(gradient, field.reconstruction().outside, field.no_normal_below())?.to_glam();
        let curvature = strokes.directions().at(field, index, &mut DirectionCounts::default()).ok()?;
        let family = CurvatureFamily::Larger.of(&curvature);
        let seed = Seed { cell, world: grid.to_world(place), normal, target, curvature, family };
        let stroke = strokes.grow(&seed, &mut counts).ok()?;
        vertices += stroke.vertices.len() as u64;
        let [first, last] = [stroke.vertices.first()?, stroke.vertices.last()?];
        Some([place, grid.to_index(first.world), grid.to_index(last.world)])
    });
    let ends = ends.collect();
    (ends, [counts.scales.directions(), vertices])
}

fn places(text: &str) -> Result<Vec<DVec3>, String> {
    let of = |line: &str| {
        let numbers: Result<Vec<f64>, _> = line.split_whitespace().map(str::parse).collect();
        match numbers.as_deref() {
            Ok([x, y, z]) => Ok(DVec3::new(*x, *y, *z)),
            _ => Err(format!("{line:?} is no place")),
        }
    };
    text.lines().map(of).collect()
}
