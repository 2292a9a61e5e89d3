//! The elementary functions of the shaders in f64 beside those of the standard library. A picture would not show the last
//! terms of their series.

use super::planting::Multiplication;
use drypoint::gpu::{Gpu, GpuError, Precision, ShaderKernel};

/// The name of the table.
pub(super) const NAME: &str = "the table of elementary functions";

/// The largest relative error without a fault, in last places of f64.
const LAST_PLACES: f64 = 8.0;

const MODULE: &str = include_str!("../../../../gpu/src/number/math.wgsl");

const FUNCTIONS: [&str; 7] = [
    "ln_one_minus(0.9 * x[0])",
    "one_minus_exp(-x[0])",
    "exp_of(-x[0])",
    "ln(2.0 + 40.0 * x[0])",
    "log2_of(2.0 + 40.0 * x[0])",
    "power(0.5 + x[0], 0.3 + x[0])",
    "angle(x[0], 1.0 - 2.0 * x[0])",
];

fn truths(x: f64) -> [f64; 7] {
    let (y, wide) = (-x, 2.0 + 40.0 * x);
    [(-0.9 * x).ln_1p(), -y.exp_m1(), y.exp(), wide.ln(), wide.log2(), (0.5 + x).powf(0.3 + x), x.atan2(1.0 - 2.0 * x)]
}

/// Whether a fault of an elementary function shows. Returns none for other functions.
///
/// # Errors
/// The text is refused, or the adapter fails.
pub(super) fn notices(fault: &Multiplication, gpu: &Gpu) -> Result<Option<bool>, GpuError> {
    let Some(modules) = fault.planted(MODULE) else { return Ok(None) };
    let rows: Vec<f64> = (1..1000).map(|i| f64::from(i) / 1000.0).collect();
    let kernel = ShaderKernel { modules, results: &FUNCTIONS, ..ShaderKernel::default() };
    let found = kernel.run(gpu, Precision::Double, 1, &rows)?;
    let truths = rows.iter().flat_map(|&x| truths(x));
    let is_right = |(found, truth): (&f64, f64)| (found - truth).abs() <= LAST_PLACES * f64::EPSILON * truth.abs();
    Ok(Some(!found.iter().zip(truths).all(is_right)))
}
