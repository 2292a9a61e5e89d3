//! The shaders against the reference ([GPU-1] … [GPU-4]). Without an adapter the tests say 'skipped: no adapter'; with
//! DRYPOINT_REQUIRE_GPU=1 they fail.

mod annotations;
mod cost;
mod double;
mod field;
mod formulas;
#[path = "../common/halos.rs"]
mod halo_scenes;
mod halos;
mod lines;
mod machines;
#[path = "../common/meshes.rs"]
mod mesh_scenes;
mod meshes;
#[path = "../common/objects.rs"]
mod object_scenes;
mod objects;
mod points;
#[path = "sabotage/bounds.rs"]
mod sabotage_of_bounds;
#[path = "sabotage/halos.rs"]
mod sabotage_of_halos;
#[path = "sabotage/lines.rs"]
mod sabotage_of_lines;
#[path = "sabotage/meshes.rs"]
mod sabotage_of_meshes;
#[path = "sabotage/objects.rs"]
mod sabotage_of_objects;
#[path = "sabotage/points.rs"]
mod sabotage_of_points;
#[path = "sabotage/rays.rs"]
mod sabotage_of_rays;
#[path = "sabotage/styles.rs"]
mod sabotage_of_styles;
#[path = "sabotage/surfaces.rs"]
mod sabotage_of_surfaces;
#[path = "sabotage/field.rs"]
mod sabotage_of_the_field;
mod styles;
mod two_quantities;
mod validation;
mod viewer;

use drypoint::gpu::{Gpu, GpuError};

/// The adapter, opened for one test; none if there is none.
fn gpu() -> Option<Gpu> {
    match Gpu::new() {
        Ok(gpu) => Some(gpu),
        Err(GpuError::NoAdapter) if std::env::var("DRYPOINT_REQUIRE_GPU").is_ok_and(|v| v == "1") => {
            panic!("DRYPOINT_REQUIRE_GPU is 1, and there is no adapter")
        }
        Err(GpuError::NoAdapter) => {
            println!("skipped: no adapter");
            None
        }
        Err(error) => panic!("{error}"),
    }
}
