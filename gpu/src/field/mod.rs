//! The field between voxels ([REC-1] … [REC-3]).

use crate::GpuError;
use crate::number::NUMBER;
use crate::shader::{Constant, Data, Shader, module};
use crate::volume::scale_exponent;
use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::math::{exponent, scale_by_power_of_two};
use drypoint_scene::measured::Measured;
use drypoint_scene::shot::{GradientEstimator, Kernel, NormalDirection, Object, Outside};
use drypoint_scene::space::Grid;

/// The powers of two that a shader's numbers are divided by.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scales {
    /// e: values minus the base are divided by 2^e.
    pub(crate) value: i32,
    /// Gradients are divided by 2 to this.
    pub(crate) gradient: i32,
    /// D⁻ᵀ with 0 for axes of length 1, divided by 2^(gradient − value).
    pub(crate) to_world: DMat3,
    base: f64,
}

impl Scales {
    pub(crate) fn new(measured: &Measured, grid: &Grid) -> Self {
        let value = scale_exponent(measured);
        let long = DVec3::from_array(grid.dims().map(|n| if n == 1 { 0.0 } else { 1.0 }));
        let to_world = grid.inverse_axes().transpose() * DMat3::from_diagonal(long);
        let largest = to_world.to_cols_array().into_iter().fold(0.0, |largest: f64, c| largest.max(c.abs()));
        let e = exponent(largest);
        let to_world = DMat3::from_cols_array(&to_world.to_cols_array().map(|c| scale_by_power_of_two(c, -e)));
        Self { value, gradient: value + e, to_world, base: measured.base }
    }

    /// A value as the shader has it.
    pub(crate) fn value(&self, value: f64) -> f64 {
        scale_by_power_of_two(value - self.base, -self.value)
    }

    /// The value that the shader has as `number`.
    pub(crate) fn to_value(self, number: f64) -> f64 {
        scale_by_power_of_two(number, self.value) + self.base
    }

    /// A gradient's magnitude, in values per world unit, as the shader has it.
    pub(crate) fn gradient(&self, g: f64) -> f64 {
        scale_by_power_of_two(g, -self.gradient)
    }
}

/// Adds the kernel.
pub(crate) fn add_kernel(
    shader: &mut Shader,
    object: &Object,
    measured: &Measured,
    grid: &Grid,
) -> Result<(), GpuError> {
    shader.add(&[NUMBER, module!("place"), module!("numbers")]);
    shader.constant("NUMBERS_PAD", Constant::Int(measured.numbers.pad as i64));
    shader.bind(0, "the volume", Data::Numbers);
    let dims = grid.dims();
    shader.block.vector("last_cell", DVec3::from_array(dims.map(|n| (n.max(2) - 2) as f64)));
    shader.block.vector("long_axes", DVec3::from_array(dims.map(|n| if n == 1 { 0.0 } else { 1.0 })));
    match object.reconstruction.kernel {
        Kernel::Trilinear => shader.add(&[module!("trilinear")]),
        _ => return Err(GpuError::Missing { what: "kernels other than trilinear", key: "sampling.kernel" }),
    }
    Ok(())
}

/// Adds gradients and normals. `no_normal` is the share of a gradient that is rounding ([PREC-3]).
pub(crate) fn add_gradient(
    shader: &mut Shader,
    object: &Object,
    measured: &Measured,
    scales: &Scales,
    no_normal: f64,
) -> Result<(), GpuError> {
    let estimator = object.reconstruction.gradient;
    if estimator != GradientEstimator::Analytic {
        shader.add(&[module!("voxels")]);
        let data = if measured.voxels.is_some() { Data::Voxels } else { Data::Numbers };
        let pad = measured.voxels.as_ref().unwrap_or(&measured.numbers).pad;
        shader.constant("VOXELS_PAD", Constant::Int(pad as i64));
        shader.bind(1, "the voxels", data);
    }
    match estimator {
        GradientEstimator::Central => shader.add(&[module!("central")]),
        _ => return Err(GpuError::Missing { what: "gradients other than central ones", key: "sampling.gradient" }),
    }
    shader.add(&[module!("gradient")]);
    let block = &mut shader.block;
    for (name, column) in [("to_world_x", 0), ("to_world_y", 1), ("to_world_z", 2)] {
        block.vector(name, scales.to_world.col(column));
    }
    block.number("no_normal_below", scales.gradient(measured.gradient_scale * no_normal));
    let outward = if object.reconstruction.outside == Outside::Low { -1.0 } else { 1.0 };
    block.number("outwards", if object.normal == NormalDirection::Inward { -outward } else { outward });
    block.number("facing", f64::from(u8::from(object.normal == NormalDirection::Facing)));
    Ok(())
}
