//! A volume of labels for scenes of phantoms.

use drypoint::scene::phantom;
use drypoint::scene::tables::PhantomSource;
use drypoint::scene::volume::VoxelType;
use drypoint::scene::volume::write::write_nrrd;
use std::path::Path;

/// Writes labels of `side`³ voxels of side 2: a ball is 1, what is around it 0.
///
/// # Errors
/// The system's failure to write the file.
pub(crate) fn write_ball(side: usize, path: &Path) -> Result<(), String> {
    let source = PhantomSource {
        name: "sphere".into(),
        size: [side; 3],
        spacing: [2.0; 3],
        voxel_type: VoxelType::U8,
        params: Vec::new(),
    };
    let labels = phantom::generate(&source).map_err(|e| e.to_string())?.present();
    write_nrrd(&labels, path).map_err(|e| e.to_string())
}
