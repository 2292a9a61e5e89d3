//! Gradients and normals ([REC-2], [NORM-1]).

use super::{Scales, kernel};
use crate::Interpolation;
use crate::module::{Module, module};
use crate::shader::{Constant, Data, Shader};
use drypoint_scene::glam::DMat3;
use drypoint_scene::measured::Measured;
use drypoint_scene::shot::{GradientEstimator, Kernel, NormalDirection, Outside, Reconstruction};

/// The gradients of a volume that is not moved.
pub(crate) const STILL: Module = module!("still");

/// Adds gradients and normals. `no_normal` is the share of a gradient that is rounding error ([PREC-3]). `moved` maps
/// gradients of the volume to those of a moved field ([VS-2]).
pub(crate) fn add(
    shader: &mut Shader,
    how: Reconstruction,
    normal: NormalDirection,
    measured: &Measured,
    scales: &Scales,
    no_normal: f64,
    moved: Option<DMat3>,
) {
    let kernel = how.kernel;
    match how.gradient {
        GradientEstimator::Central => {
            add_central(shader, measured);
            shader.add(&[module!("by_central")]);
        }
        GradientEstimator::Analytic if kernel == Kernel::Trilinear => shader.add(&[module!("trilinear_gradient")]),
        GradientEstimator::Analytic => shader.add(&[module!("tensor_gradient"), module!("separable")]),
        GradientEstimator::Sobel => {
            add_voxels(shader, measured);
            shader.add(&[kernel::TENSOR, module!("tensor_gradient"), module!("sobel")]);
        }
        GradientEstimator::Regression => {
            add_voxels(shader, measured);
            shader.add(&[module!("regression")]);
            let weights = measured.regression.clone().unwrap_or_default();
            shader.bind(20, "the weights of the regression", Data::Reals(weights));
        }
    }
    match moved {
        None => shader.add(&[STILL]),
        Some(moved) => {
            shader.add(&[module!("moved")]);
            for (name, column) in [("moved_x", 0), ("moved_y", 1), ("moved_z", 2)] {
                shader.block.vector(name, moved.col(column));
            }
        }
    }
    shader.add(&[module!("normal")]);
    let block = &mut shader.block;
    for (name, column) in [("to_world_x", 0), ("to_world_y", 1), ("to_world_z", 2)] {
        block.vector(name, scales.to_world.col(column));
    }
    block.number("no_normal_below", scales.gradient(measured.gradient_scale * no_normal));
    let outward = if how.outside == Outside::Low { -1.0 } else { 1.0 };
    block.number("outwards", if normal == NormalDirection::Inward { -outward } else { outward });
    block.number("facing", f64::from(u8::from(normal == NormalDirection::Facing)));
}

/// Adds central differences of the voxels.
pub(super) fn add_central(shader: &mut Shader, measured: &Measured) {
    add_voxels(shader, measured);
    match shader.interpolation {
        Interpolation::Exact => shader.add(&[module!("central")]),
        Interpolation::Fast => {
            kernel::add_filter(shader);
            shader.add(&[module!("central_filtered")]);
        }
    }
}

/// Adds the voxels, once.
pub(super) fn add_voxels(shader: &mut Shader, measured: &Measured) {
    const VOXELS: crate::module::Module = module!("voxels");
    if shader.modules.contains(&VOXELS) {
        return;
    }
    shader.add(&[VOXELS]);
    let data = if measured.voxels.is_some() { Data::Voxels(0) } else { Data::Numbers(0) };
    let pad = measured.voxels.as_ref().unwrap_or(&measured.numbers).pad;
    shader.constant("VOXELS_PAD", Constant::Int(pad as i64));
    shader.bind(1, "the voxels", data);
}
