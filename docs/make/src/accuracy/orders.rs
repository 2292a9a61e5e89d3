//! Kernel × estimator × grid: measured orders and error constants ([REC-4]).

use super::places::{around, curvature_error, probed, scattered};
use super::statistics::{Errors, two_digits};
use super::waves::Waves;
use drypoint::reference::field::probe::Probe;
use drypoint::reference::field::{GradientEstimator, HessianEstimator, Kernel, Reconstruction};
use drypoint::scene::glam::{DMat3, DVec3};
use drypoint::scene::math::{log2, pow};
use drypoint::scene::phantom::{Jet, Phantom, curvatures};
use rayon::prelude::*;

/// Blocks of the field that are sampled, and positions in the middle cell of each.
const BLOCKS: usize = 24;
const POINTS: usize = 40;

/// Voxels along the side of a block: the border is 31 voxels away, where what a quintic prefilter makes of its end has
/// fallen by 0.43³¹.
const SIDE: usize = 64;

/// The steps h that orders are measured between, in radians of the shortest wave.
const COARSE: f64 = 0.125;
const FINE: f64 = 0.0625;

/// Curvature is measured where ‖g‖ is at least this: about half of its largest values.
const LEAST_GRADIENT: f64 = 0.5;

/// The grids, with voxels of volume 1.
fn frames() -> [(&'static str, DMat3); 3] {
    let sheared = [[1.0, 0.25, 0.0], [-0.5, 1.5, 0.5], [0.25, 0.0, 2.0]];
    let unit = |axes: DMat3| axes * pow(axes.determinant(), -1.0 / 3.0);
    [
        ("isotropic", DMat3::IDENTITY),
        ("1:1:4", unit(DMat3::from_diagonal(DVec3::new(1.0, 1.0, 4.0)))),
        ("sheared", unit(DMat3::from_cols_array_2d(&sheared))),
    ]
}

const KERNELS: [(&str, Kernel); 5] = [
    ("trilinear", Kernel::Trilinear),
    ("catmull-rom", Kernel::CatmullRom),
    ("bspline", Kernel::Bspline),
    ("bspline5", Kernel::Bspline5),
    ("bspline-smooth", Kernel::BsplineSmooth),
];

/// What is measured. Estimators that read voxels give the same with every kernel, which [`kernels_do_not_matter`]
/// checks, so they are measured once.
fn reconstructions() -> Vec<Reconstruction> {
    let with = |kernel, gradient, hessian| Reconstruction { kernel, gradient, hessian, ..Default::default() };
    let mut all: Vec<_> =
        KERNELS.iter().map(|&(_, k)| with(k, GradientEstimator::Analytic, HessianEstimator::Auto)).collect();
    all.push(with(Kernel::Trilinear, GradientEstimator::Central, HessianEstimator::Central));
    all.push(with(Kernel::Trilinear, GradientEstimator::Sobel, HessianEstimator::Gaussian));
    all.push(with(Kernel::Trilinear, GradientEstimator::Regression, HessianEstimator::Central));
    all
}

/// An error of a probe against the truth; none where it is not measured.
type Measure = fn(&Probe, &Jet) -> Option<f64>;

/// A line of the table: what is measured, and on which of [`reconstructions`].
struct Line {
    quantity: &'static str,
    kernel: &'static str,
    estimator: &'static str,
    reconstruction: usize,
    measure: Measure,
}

fn lines() -> Vec<Line> {
    let value: Measure = |probe, truth| Some((probe.value - truth.value).abs());
    let gradient: Measure = |probe, truth| Some((probe.gradient - truth.gradient).length());
    let hessian: Measure = |probe, truth| {
        let off = (probe.hessian - truth.hessian).to_cols_array();
        Some(off.iter().map(|x| x * x).sum::<f64>().sqrt())
    };
    let curvature: Measure = |probe, truth| {
        let kappa = curvatures(truth.gradient, truth.hessian)?;
        (truth.gradient.length() >= LEAST_GRADIENT).then(|| curvature_error(probe, kappa))
    };
    let mut lines = Vec::new();
    let mut add = |quantity, measure, estimator, kernel, reconstruction| {
        lines.push(Line { quantity, kernel, estimator, reconstruction, measure });
    };
    for (i, (kernel, _)) in KERNELS.into_iter().enumerate() {
        add("value", value, "", kernel, i);
    }
    for (i, (kernel, _)) in KERNELS.into_iter().enumerate() {
        add("gradient", gradient, "analytic", kernel, i);
    }
    for (i, estimator) in ["central", "sobel", "regression"].into_iter().enumerate() {
        add("gradient", gradient, estimator, "any", 5 + i);
    }
    for (quantity, measure) in [("Hessian", hessian), ("curvature", curvature)] {
        for (i, (kernel, _)) in KERNELS.into_iter().enumerate().skip(2) {
            add(quantity, measure, "analytic", kernel, i);
        }
        add(quantity, measure, "central", "any", 5);
        add(quantity, measure, "gaussian", "any", 6);
    }
    lines
}

/// Probes of every reconstruction at the points of one block, and the truth there.
struct Block {
    probes: Vec<Vec<Probe>>,
    truth: Vec<Jet>,
}

fn block(number: usize, axes: DMat3) -> Result<Block, String> {
    let waves = Waves::new();
    let volume = around(&waves, 20.0 * scattered(number), axes, SIDE)?;
    let middle = DVec3::splat((SIDE / 2 - 1) as f64);
    let at: Vec<_> = (0..POINTS).map(|i| middle + scattered(i)).collect();
    let scale = volume.grid().voxel();
    let probes = reconstructions().into_iter().map(|how| probed(&volume, Reconstruction { scale, ..how }, &at));
    let truth = at.iter().map(|&p| waves.jet(volume.grid().to_world(p))).collect();
    Ok(Block { probes: probes.collect::<Result<_, _>>()?, truth })
}

/// Errors of every line on one grid with one step.
fn errors(lines: &[Line], axes: DMat3) -> Result<Vec<Errors>, String> {
    let blocks: Vec<Block> = (0..BLOCKS).into_par_iter().map(|n| block(n, axes)).collect::<Result<_, _>>()?;
    let of = |line: &Line| {
        let pairs = blocks.iter().flat_map(|b| b.probes[line.reconstruction].iter().zip(&b.truth));
        Errors::new(pairs.filter_map(|(probe, truth)| (line.measure)(probe, truth)).collect())
    };
    Ok(lines.iter().map(of).collect())
}

/// Order and constants of one line on one grid.
struct Cell {
    order: f64,
    /// The same from the largest errors.
    order_of_max: f64,
    median: f64,
    max: f64,
}

fn cell(coarse: &Errors, fine: &Errors) -> Cell {
    let order = log2(coarse.median() / fine.median());
    let power = pow(FINE, order.round());
    Cell {
        order,
        order_of_max: log2(coarse.max() / fine.max()),
        median: fine.median() / power,
        max: fine.max() / power,
    }
}

/// That gradients and Hessians from voxels are the same numbers whatever the kernel.
fn kernels_do_not_matter() -> Result<(), String> {
    let waves = Waves::new();
    for (name, axes) in frames() {
        let volume = around(&waves, DVec3::ONE, axes * 0.5, 16)?;
        let at: Vec<_> = (0..POINTS).map(|i| 15.0 * scattered(i)).collect();
        for (gradient, hessian) in [
            (GradientEstimator::Central, HessianEstimator::Central),
            (GradientEstimator::Sobel, HessianEstimator::Gaussian),
            (GradientEstimator::Regression, HessianEstimator::Central),
        ] {
            let of = |kernel| {
                let probes = probed(&volume, Reconstruction { kernel, gradient, hessian, ..Default::default() }, &at)?;
                Ok::<_, String>(probes.iter().map(|p| (p.gradient, p.hessian, p.k1, p.k2)).collect::<Vec<_>>())
            };
            let first = of(Kernel::Trilinear)?;
            for (kernel, k) in KERNELS {
                if of(k)? != first {
                    return Err(format!("{gradient:?} or {hessian:?} depends on {kernel} on the {name} grid"));
                }
            }
        }
    }
    Ok(())
}

/// The table as Markdown, and the largest difference between the order of the medians and that of the maxima.
pub(super) fn table() -> Result<(String, f64), String> {
    kernels_do_not_matter()?;
    let lines = lines();
    let mut columns = Vec::new();
    for (_, axes) in frames() {
        let (coarse, fine) = (errors(&lines, axes * COARSE)?, errors(&lines, axes * FINE)?);
        columns.push(coarse.iter().zip(&fine).map(|(c, f)| cell(c, f)).collect::<Vec<_>>());
    }
    let mut text = String::from("| quantity | kernel | estimator |");
    for (name, _) in frames() {
        text += &format!(" {name}: order | C median | C max |");
    }
    text += &format!("\n|---|---|---|{}\n", "--:|".repeat(9));
    let mut apart = 0.0f64;
    for (i, line) in lines.iter().enumerate() {
        text += &format!("| {} | {} | {} |", line.quantity, line.kernel, line.estimator);
        for column in &columns {
            let Cell { order, order_of_max, median, max } = column[i];
            apart = apart.max((order - order_of_max).abs());
            text += &format!(" {order:.2} | {} | {} |", two_digits(median), two_digits(max));
        }
        text += "\n";
    }
    Ok((text, apart))
}
