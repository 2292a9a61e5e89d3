//! κ on spheres: the error falls with the square of R in voxels ([CUR-1]).

use super::places::{around, curvature_error, directions, probed, scattered};
use super::statistics::{Errors, order, two_digits};
use drypoint::reference::field::{GradientEstimator, HessianEstimator, Kernel, Reconstruction};
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::phantom::{self, Phantom};
use drypoint::scene::space::Grid;
use rayon::prelude::*;

/// Radii in voxels.
const RADII: [f64; 4] = [8.0, 16.0, 32.0, 64.0];

/// Places on each sphere.
const POINTS: usize = 48;

/// Voxels along the side of the block around each place.
const SIDE: usize = 40;

/// A sphere about the world's origin: the distance field for w = 0, else a logistic edge of that width from 0 to 1.
fn sphere(radius: f64, w: f64) -> Result<Box<dyn Phantom>, String> {
    let grid = Grid::new([2; 3], DMat3::IDENTITY, DVec3::splat(-0.5)).map_err(|e| e.to_string())?;
    let params = [("R", radius), ("w", w), ("high", 1.0)].map(|(name, value)| (name.to_owned(), value));
    phantom::by_name("sphere", &grid, &params).map_err(|e| e.to_string())
}

/// |κr − 1|, the worse of both curvatures, between voxels at places all over a sphere.
fn between_voxels(radius: f64, w: f64, kernel: Kernel) -> Result<Errors, String> {
    let field = sphere(radius, w)?;
    let how = Reconstruction {
        kernel,
        gradient: GradientEstimator::Analytic,
        hessian: HessianEstimator::Analytic,
        ..Default::default()
    };
    let errors = directions(POINTS).enumerate().par_bridge().map(|(i, u)| {
        let (p, shift) = (u * radius, scattered(i) - 0.5);
        let volume = around(field.as_ref(), p + shift, DMat3::IDENTITY, SIDE)?;
        let probes = probed(&volume, how, &[volume.grid().to_index(p)])?;
        Ok(radius * curvature_error(&probes[0], [1.0 / radius; 2]))
    });
    Ok(Errors::new(errors.collect::<Result<_, String>>()?))
}

/// |κr − 1| r²/h², the worse of both curvatures, by central differences of the distance field at the voxels next to each
/// place.
fn at_voxels(radius: f64) -> Result<Errors, String> {
    let field = sphere(radius, 0.0)?;
    let how = Reconstruction { hessian: HessianEstimator::Central, ..Default::default() };
    let errors = directions(POINTS).enumerate().par_bridge().map(|(i, u)| {
        let volume = around(field.as_ref(), u * radius + scattered(i), DMat3::IDENTITY, SIDE)?;
        let middle = (SIDE / 2) as f64;
        let at = [-1.0, 0.0].map(|d| DVec3::splat(middle + d));
        let probes = probed(&volume, how, &at)?;
        let off = probes.iter().zip(at).map(|(probe, p)| {
            let r = volume.grid().to_world(p).length();
            r * r * r * curvature_error(probe, [1.0 / r; 2])
        });
        Ok(off.fold(0.0, f64::max))
    });
    Ok(Errors::new(errors.collect::<Result<_, String>>()?))
}

/// The table as Markdown.
pub(super) fn table() -> Result<String, String> {
    let all = |of: &dyn Fn(f64) -> Result<Errors, String>| RADII.iter().map(|&r| of(r)).collect::<Result<Vec<_>, _>>();
    let columns = [
        all(&|r| between_voxels(r, 0.0, Kernel::Bspline))?,
        all(&|r| between_voxels(r, r / 8.0, Kernel::Bspline))?,
        all(&|r| between_voxels(r, r / 4.0, Kernel::Bspline5))?,
    ];
    let central = all(&at_voxels)?;
    let mut text = String::from(
        "| R in voxels | distance, `bspline` | edge w = R/8, `bspline` | edge w = R/4, `bspline5` | distance, \
         `central` at voxels: largest \\|κr − 1\\| r²/h² |\n|--:|--:|--:|--:|--:|\n",
    );
    for (i, r) in RADII.iter().enumerate() {
        text += &format!("| {r} |");
        columns.iter().for_each(|column| text += &format!(" {} |", two_digits(column[i].rms())));
        text += &format!(" {:.2} |\n", central[i].max());
    }
    text += "| slope over all R |";
    for column in &columns {
        text += &format!(" {:.2} |", order(&RADII, &column.iter().map(Errors::rms).collect::<Vec<_>>()));
    }
    text += " |\n| slope of the last doubling |";
    for column in &columns {
        text += &format!(" {:.2} |", order(&RADII[2..], &column[2..].iter().map(Errors::rms).collect::<Vec<_>>()));
    }
    Ok(text + " |\n")
}
