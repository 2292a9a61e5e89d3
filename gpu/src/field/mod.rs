//! The field between voxels ([REC-1] … [REC-3]).

pub(crate) mod gradient;
pub(crate) mod hessian;
pub(crate) mod kernel;
pub(crate) mod mask;

use crate::volume::scale_exponent;
use drypoint_scene::glam::{DMat3, DVec3};
use drypoint_scene::math::{exponent, scale_by_power_of_two};
use drypoint_scene::measured::Measured;
use drypoint_scene::space::Grid;

/// The powers of two by which a shader's numbers are divided.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Scales {
    /// e: values minus the base are divided by 2^e.
    pub(crate) value: i32,
    /// Gradients are divided by 2 to this power.
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

    /// Converts a value to the shader's scale.
    pub(crate) fn value(&self, value: f64) -> f64 {
        scale_by_power_of_two(value - self.base, -self.value)
    }

    /// Converts a difference of values to the shader's scale.
    pub(crate) fn difference(&self, difference: f64) -> f64 {
        scale_by_power_of_two(difference, -self.value)
    }

    /// Converts a number of the shader to a value.
    pub(crate) fn to_value(self, number: f64) -> f64 {
        scale_by_power_of_two(number, self.value) + self.base
    }

    /// Converts a gradient's magnitude, in values per world unit, to the shader's scale.
    pub(crate) fn gradient(&self, g: f64) -> f64 {
        scale_by_power_of_two(g, -self.gradient)
    }

    /// The ratio of 1/length in the world to the shader's unit of curvature, which is a Hessian over a gradient.
    pub(crate) fn curvature_unit(&self) -> f64 {
        scale_by_power_of_two(1.0, self.gradient - self.value)
    }
}
