//! Hessians and curvatures ([REC-3], [CUR-1] … [CUR-3]).

use super::{Scales, gradient, kernel};
use crate::module::{Module, module};
use crate::shader::{Constant, Data, Shader};
use crate::{GpuError, Precision};
use drypoint_scene::measured::Measured;
use drypoint_scene::shot::{HessianEstimator, Object, Outside};

/// Hessians of separable kernels.
const TENSOR: Module = module!("tensor_hessian");

/// The ‖Pv‖ up to which the direction Pv is lost to rounding ([CUR-2]).
fn no_direction(precision: Precision) -> f64 {
    match precision {
        Precision::Single => 1.0 / (1u64 << 12) as f64,
        Precision::Double => 1.0 / (1u64 << 26) as f64,
    }
}

/// Adds Hessians and the formulas of curvature, after gradients. `is_integer` tells whether voxels are integers.
pub(crate) fn add(
    shader: &mut Shader,
    object: &Object,
    is_integer: bool,
    measured: &Measured,
    scales: &Scales,
    precision: Precision,
) -> Result<(), GpuError> {
    let how = object.reconstruction;
    shader.add(&[kernel::TENSOR, module!("second"), TENSOR]);
    match how.hessian.resolved(how.kernel, is_integer).map_err(|_| GpuError::Material)? {
        HessianEstimator::Analytic => shader.add(&[module!("analytic")]),
        HessianEstimator::Gaussian => {
            let pad = measured.smoothed.as_ref().map_or(0, |smoothed| smoothed.pad);
            shader.add(&[kernel::BSPLINE, module!("gaussian")]);
            shader.constant("SMOOTHED_PAD", Constant::Int(pad as i64));
            shader.bind(21, "the smoothed volume", Data::Smoothed(0));
        }
        HessianEstimator::Auto | HessianEstimator::Central => {
            gradient::add_central(shader, measured);
            shader.add(&[module!("central")]);
        }
    }
    shader.add(&[module!("curvature")]);
    let block = &mut shader.block;
    block.number("outside_sign", if how.outside == Outside::Low { -1.0 } else { 1.0 });
    block.number("curvature_unit", scales.curvature_unit());
    block.number("no_direction", no_direction(precision));
    Ok(())
}
