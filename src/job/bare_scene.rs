//! Scenes for bare volumes, which no scene file describes.

use super::room::no_room_for_content;
use crate::Failure;
use drypoint_reference::suggest;
use drypoint_scene::counts::Counts;
use drypoint_scene::tables::{Scene, VolumeSource};
use drypoint_scene::volume::Volume;
use std::path::PathBuf;

/// Returns a scene for a bare volume: an automatic function, a camera that frames the content in a picture of `size`
/// pixels, a pleasant style. Voxels read for it go to `counts`.
///
/// # Errors
/// Memory that the budget does not allow.
pub fn bare(path: PathBuf, volume: &Volume, size: [usize; 2], counts: &mut Counts) -> Result<Scene, Failure> {
    let place = path.display().to_string();
    suggest::scene(VolumeSource::File { path, raw: None }, volume, size, counts)
        .map_err(|no_room| no_room_for_content(volume, place, &no_room))
}

/// Returns a scene for a bare volume with the tables of a preset: a function, an iso-surface, or the camera alone,
/// before the background of the preset.
///
/// # Errors
/// Memory that the budget does not allow.
pub fn bare_for(
    preset: &Scene,
    path: PathBuf,
    volume: &Volume,
    size: [usize; 2],
    counts: &mut Counts,
) -> Result<Scene, Failure> {
    let place = path.display().to_string();
    let source = VolumeSource::File { path, raw: None };
    let (transfer, surface, picture) = (preset.transfer.clone(), preset.surface.clone(), preset.picture.clone());
    // Stipples and their outlines lie on one surface of the volume.
    let stipples = preset.stipples.clone().filter(|stipples| stipples.iso.is_some());
    let outlines = preset.outlines.clone().filter(|_| stipples.is_some());
    let scene = Scene { transfer, surface, picture, stipples, outlines, ..Scene::for_volume(source) };
    suggest::fill(scene, volume, size, counts).map_err(|no_room| no_room_for_content(volume, place, &no_room))
}
