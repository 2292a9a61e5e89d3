//! Voxels that are not finite ([PREC-2], [GPU-7]).

use crate::module::module;
use crate::shader::{Constant, Data, Shader};
use drypoint_scene::space::Grid;
use drypoint_scene::volume::Mask;

/// A bit for each cell of a grid that touches a masked voxel, x fastest.
pub(crate) fn words(mask: &Mask, [nx, ny, nz]: [usize; 3]) -> Vec<u32> {
    let mut words = vec![0u32; (nx * ny * nz).div_ceil(32)];
    for i in (0..nx * ny * nz).filter(|i| mask.touches_cell([i % nx, i / nx % ny, i / (nx * ny)])) {
        words[i / 32] |= 1 << (i % 32);
    }
    words
}

/// Adds the masked cells, in which nothing is sampled.
pub(crate) fn add(shader: &mut Shader, mask: &Mask, grid: &Grid) {
    let [nx, ny, _] = grid.dims();
    shader.add(&[module!("mask")]);
    shader.constant("MASK_X", Constant::Int(nx as i64));
    shader.constant("MASK_Y", Constant::Int(ny as i64));
    shader.bind(22, "the mask of the volume", Data::Words(words(mask, grid.dims())));
}
