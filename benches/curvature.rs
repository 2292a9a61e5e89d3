//! Nanoseconds for the principal curvatures and directions of a place, one after the other on one core, and what they are.
//!
//! `DRYPOINT_VOLUME=torus.nrrd DRYPOINT_POINTS=points.txt DRYPOINT_KERNEL=bspline cargo bench --bench curvature`; points are
//! `x y z` in index space, one a line; kernels are `trilinear`, `bspline`, `bspline-smooth`, `bspline5` and `catmull-rom`.
//! Hessians are what `auto` takes, with `DRYPOINT_HESSIAN=analytic` the kernel's own; `DRYPOINT_SCALE` is the Gaussian's σ, 1
//! by itself.
//! With `DRYPOINT_OUT` it writes κ₁, κ₂ and e₁ of each, little-endian doubles. Curvatures are those of surfaces with the
//! higher values inside: positive where these bulge.

use drypoint::reference::field::curvature::{Curvature, principal};
use drypoint::reference::field::{
    Field, GradientEstimator, HessianEstimator, Kernel, Outside, Reconstruction, Rung, Sampler,
};
use drypoint::reference::number::Vec3;
use drypoint::reference::with_sampler;
use drypoint::scene::volume::read::read;
use std::env::var;
use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

/// Seconds that rounds take at least, all together.
const SECONDS: f64 = 0.3;

fn main() -> Result<(), String> {
    let (Ok(volume), Ok(points)) = (var("DRYPOINT_VOLUME"), var("DRYPOINT_POINTS")) else {
        println!("skipped: no DRYPOINT_VOLUME and DRYPOINT_POINTS");
        return Ok(());
    };
    let named = var("DRYPOINT_KERNEL").unwrap_or_else(|_| "bspline".into());
    let kernel = kernel(&named)?;
    let hessian = match var("DRYPOINT_HESSIAN").as_deref() {
        Ok("analytic") => HessianEstimator::Analytic,
        _ => HessianEstimator::Auto,
    };
    let scale = var("DRYPOINT_SCALE").map_or(Ok(1.0), |s| s.parse().map_err(|_| format!("{s:?} is no scale")))?;
    let volume = read(Path::new(&volume), None).map_err(|e| e.to_string())?;
    let how = Reconstruction { kernel, hessian, scale, gradient: GradientEstimator::Analytic, outside: Outside::Low };
    let start = Instant::now();
    let field = Field::<f64>::new(&volume, how, Rung::Hessian).map_err(|e| e.to_string())?;
    let prepared = start.elapsed().as_secs_f64();
    let points = places(&std::fs::read_to_string(points).map_err(|e| e.to_string())?)?;
    let mut found: Vec<Curvature<f64>> = Vec::with_capacity(points.len());
    let (mut rounds, start) = (0, Instant::now());
    while start.elapsed().as_secs_f64() < SECONDS {
        rounds += 1;
        found.clear();
        with_sampler!(field, |s| for &p in &points {
            let (gradient, hessian) = s.hessian(black_box(p));
            found.push(principal(gradient, hessian, Outside::Low));
        });
    }
    let ns = start.elapsed().as_secs_f64() * 1e9 / (rounds as f64 * points.len() as f64);
    if let Ok(path) = var("DRYPOINT_OUT") {
        let numbers = found.iter().flat_map(|c| [c.k1, c.k2, c.e1.x, c.e1.y, c.e1.z]);
        let bytes: Vec<u8> = numbers.flat_map(f64::to_le_bytes).collect();
        std::fs::write(path, bytes).map_err(|e| e.to_string())?;
    }
    let places = points.len();
    println!(
        "{{\"kernel\": \"{named}\", \"places\": {places}, \"prepared_s\": {prepared:.3}, \"ns_per_probe\": {ns:.1}}}"
    );
    Ok(())
}

fn kernel(name: &str) -> Result<Kernel, String> {
    match name {
        "trilinear" => Ok(Kernel::Trilinear),
        "bspline" => Ok(Kernel::Bspline),
        "bspline-smooth" => Ok(Kernel::BsplineSmooth),
        "bspline5" => Ok(Kernel::Bspline5),
        "catmull-rom" => Ok(Kernel::CatmullRom),
        _ => Err(format!("there is no kernel {name:?}")),
    }
}

fn places(text: &str) -> Result<Vec<Vec3<f64>>, String> {
    let of = |line: &str| {
        let numbers: Result<Vec<f64>, _> = line.split_whitespace().map(str::parse).collect();
        match numbers.as_deref() {
            Ok([x, y, z]) => Ok(Vec3::new(*x, *y, *z)),
            _ => Err(format!("{line:?} is no place")),
        }
    };
    text.lines().map(of).collect()
}
