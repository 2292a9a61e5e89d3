//! The kernels of values ([REC-1]).

use crate::Interpolation;
use crate::module::{Module, module};
use crate::number::NUMBER;
use crate::shader::{Constant, Data, Shader};
use drypoint_scene::glam::DVec3;
use drypoint_scene::measured::Measured;
use drypoint_scene::shot::Kernel;
use drypoint_scene::space::Grid;

/// Sums of separable kernels.
pub(super) const TENSOR: Module = module!("tensor");
/// The taps of the cubic B-spline.
pub(super) const BSPLINE: Module = module!("bspline");

/// Adds a kernel, its numbers and their cells.
pub(crate) fn add(shader: &mut Shader, kernel: Kernel, measured: &Measured, grid: &Grid) {
    shader.add(&[NUMBER, module!("../place"), module!("../numbers")]);
    shader.constant("NUMBERS_PAD", Constant::Int(measured.numbers.pad as i64));
    shader.bind(0, "the volume", Data::Numbers(0));
    let dims = grid.dims();
    shader.block.vector("last_cell", DVec3::from_array(dims.map(|n| (n.max(2) - 2) as f64)));
    shader.block.vector("long_axes", DVec3::from_array(dims.map(|n| if n == 1 { 0.0 } else { 1.0 })));
    let separable = match kernel {
        Kernel::Trilinear if shader.interpolation == Interpolation::Fast => {
            add_filter(shader);
            return shader.add(&[module!("trilinear_filtered")]);
        }
        Kernel::Trilinear => return shader.add(&[module!("trilinear")]),
        Kernel::Bspline | Kernel::BsplineSmooth => [TENSOR, BSPLINE, module!("bspline_kernel")].as_slice(),
        Kernel::Bspline5 => &[TENSOR, module!("bspline5")],
        Kernel::CatmullRom => &[TENSOR, module!("catmull_rom")],
    };
    shader.add(separable);
    shader.add(&[module!("separable")]);
}

/// Adds the texture unit's interpolation, once.
pub(super) fn add_filter(shader: &mut Shader) {
    const FILTERED: Module = module!("filtered");
    if !shader.modules.contains(&FILTERED) {
        shader.add(&[FILTERED]);
        shader.bind(8, "the interpolation", Data::Sampler);
    }
}
