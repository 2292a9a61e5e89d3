//! Volume stippling (Lu, Morris, Ebert, Rheingans, Hansen 2002).

mod order;
mod slab;

/// Prototype entry.
pub fn try_points(cells: &[[u32; 3]], normals: &[drypoint_scene::glam::DVec3], slab: f64, each: usize, neighbours: bool) -> Vec<[f32; 3]> {
    let sites = order::Sites { cells, normals, axes: drypoint_scene::glam::DMat3::IDENTITY, voxel: 1.0, slab, seed: 1, neighbours };
    order::points(&sites, each, &|_| {})
}
