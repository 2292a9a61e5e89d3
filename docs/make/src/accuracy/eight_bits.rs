//! Curvature of 8-bit data: why it needs a smoothing scale ([REC-3]).

use super::places::{curvature_error, probed, scattered};
use super::statistics::{Errors, percent};
use drypoint::reference::field::{GradientEstimator, HessianEstimator, Kernel, Reconstruction};
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::math::{cos, sin};
use drypoint::scene::phantom::{self, Phantom};
use drypoint::scene::space::Grid;
use drypoint::scene::volume::VoxelType;
use rayon::prelude::*;

/// Radii of the torus in voxels: of its ring and of its tube.
const RING: f64 = 70.0;
const TUBE: f64 = 25.0;

/// Places on the torus.
const POINTS: usize = 2000;

/// Widths of the edge in voxels.
pub(super) const WIDTHS: [f64; 3] = [1.0, 2.0, 4.0];

/// What is compared: a name, the kernel, and the Hessian with its σ in voxels.
const ESTIMATORS: [(&str, Kernel, HessianEstimator, f64); 7] = [
    ("`bspline5`, analytic", Kernel::Bspline5, HessianEstimator::Analytic, 1.0),
    ("`bspline`, analytic", Kernel::Bspline, HessianEstimator::Analytic, 1.0),
    ("`trilinear`, central", Kernel::Trilinear, HessianEstimator::Central, 1.0),
    ("`bspline-smooth`, analytic", Kernel::BsplineSmooth, HessianEstimator::Analytic, 1.0),
    ("gaussian, σ = 1 voxel", Kernel::Trilinear, HessianEstimator::Gaussian, 1.0),
    ("gaussian, σ = 2 voxels", Kernel::Trilinear, HessianEstimator::Gaussian, 2.0),
    ("gaussian, σ = 3 voxels", Kernel::Trilinear, HessianEstimator::Gaussian, 3.0),
];

/// A part of a torus about the z axis, and places on and near its surface there.
struct Part {
    torus: Box<dyn Phantom>,
    grid: Grid,
    at: Vec<DVec3>,
}

impl Part {
    fn new(w: f64) -> Result<Self, String> {
        let origin = Grid::new([2; 3], DMat3::IDENTITY, DVec3::splat(-0.5)).map_err(|e| e.to_string())?;
        let params =
            [("R", RING), ("r", TUBE), ("w", w), ("high", 255.0)].map(|(name, value)| (name.to_owned(), value));
        let torus = phantom::by_name("torus", &origin, &params).map_err(|e| e.to_string())?;
        // All around the tube, 32 voxels along the ring, and 15 voxels of margin.
        let grid =
            Grid::new([82, 68, 82], DMat3::IDENTITY, DVec3::new(29.7, -33.6, -40.4)).map_err(|e| e.to_string())?;
        let at = (0..POINTS).map(|i| {
            let s = scattered(i);
            let (theta, phi, rho) = (std::f64::consts::TAU * s.x, 0.3 * (s.y - 0.5), TUBE + s.z - 0.5);
            let out = RING + rho * cos(theta);
            grid.to_index(DVec3::new(out * cos(phi), out * sin(phi), rho * sin(theta)))
        });
        let at = at.collect();
        Ok(Self { torus, grid, at })
    }

    /// Errors of both curvatures, the worse of the two, over the larger |κ|.
    fn errors(
        &self,
        voxels: VoxelType,
        kernel: Kernel,
        hessian: HessianEstimator,
        scale: f64,
    ) -> Result<Errors, String> {
        let volume = phantom::sample(self.torus.as_ref(), self.grid.clone(), voxels).map_err(|e| e.to_string())?;
        let how = Reconstruction { kernel, gradient: GradientEstimator::Central, hessian, scale, ..Default::default() };
        let probes = probed(&volume, how, &self.at)?;
        let errors = probes.iter().zip(&self.at).filter_map(|(probe, &p)| {
            let kappa = self.torus.curvatures(self.grid.to_world(p))?;
            Some(curvature_error(probe, kappa) / kappa[0].abs().max(kappa[1].abs()))
        });
        Ok(Errors::new(errors.collect()))
    }
}

/// The table as Markdown: for each width of the edge the median in u8, its 95th percentile, and the median in f64.
pub(super) fn table() -> Result<String, String> {
    let parts = WIDTHS.iter().map(|&w| Part::new(w)).collect::<Result<Vec<_>, _>>()?;
    let mut text = String::from("| estimator |");
    WIDTHS.iter().for_each(|w| text += &format!(" w = {w}: u8 median | u8 95 % | f64 median |"));
    text += &format!("\n|---|{}\n", "--:|".repeat(3 * WIDTHS.len()));
    let rows = ESTIMATORS.par_iter().map(|&(name, kernel, hessian, scale)| {
        let mut row = format!("| {name} |");
        for part in &parts {
            let [u8s, f64s] = [VoxelType::U8, VoxelType::F64].map(|t| part.errors(t, kernel, hessian, scale));
            let (u8s, f64s) = (u8s?, f64s?);
            let numbers = [u8s.median(), u8s.quantile(0.95), f64s.median()].map(percent);
            row += &format!(" {} |", numbers.join(" | "));
        }
        Ok(row + "\n")
    });
    Ok(text + &rows.collect::<Result<Vec<_>, String>>()?.concat())
}
