//! Memory checks of a job, before anything large is allocated. A failure names the key responsible.

use crate::Failure;
use drypoint_scene::memory::{self, NoRoom};
use drypoint_scene::plan::Plan;
use drypoint_scene::tables::{Role, Scene, Table, Transfer};
use drypoint_scene::volume::Volume;

/// Checks that the memory budget allows the table of the transfer function.
pub(super) fn room_for_table(scene: &Scene) -> Result<(), Failure> {
    /// Bytes of an entry while the table is made: colour and opacity, twice.
    const ENTRY: u64 = 80;
    let Some(Table::Entries(entries)) = scene.transfer.as_ref().map(|transfer| transfer.table) else { return Ok(()) };
    memory::room_for(entries as u64, ENTRY).map_err(|no_room| {
        let what = format!("a table of {entries} entries needs {no_room}");
        let remedy = format!("{} would fit", no_room.fitting(entries as u64));
        Failure::new(what, scene.given.position("transfer.table"), remedy)
    })
}

/// Returns the failure of a bare volume whose content the memory budget does not allow to find.
pub(super) fn no_room_for_content(volume: &Volume, place: String, no_room: &NoRoom) -> Failure {
    let [nx, ny, nz] = volume.dims();
    let what = format!("the search for the content of {nx} × {ny} × {nz} voxels needs {no_room}");
    Failure::new(what, place, "read less of the volume with volume.box or volume.stride, or allow more with --memory")
}

/// Checks that the memory budget allows the scenes of objects' parts, each with a copy of its function.
pub(super) fn room_for_parts(scene: &Scene) -> Result<(), Failure> {
    /// Bytes of a part without nodes.
    const PART: u64 = 1 << 14;
    /// Bytes of a node: in the part's scene, by its style's name, and in its function.
    const NODE: u64 = 200;
    let nodes = |transfer: Option<&Transfer>| transfer.map_or(0, |transfer| transfer.all_nodes().count()) as u64;
    let of_part = |(object, role): (usize, Role)| {
        let table = &scene.objects[object];
        let of_ghost = table.ghost.as_ref().filter(|_| role == Role::Ghost).and_then(|ghost| ghost.transfer.as_ref());
        PART + NODE * nodes(of_ghost.or(table.transfer.as_ref()).or(scene.transfer.as_ref()))
    };
    memory::room(scene.parts_of_frames().map(of_part).sum()).map_err(|no_room| {
        let what = format!("the functions of {} objects need {no_room}", scene.objects.len());
        Failure::new(what, scene.given.position("object"), "write fewer objects, or fewer nodes of [transfer]")
    })
}

/// Checks that the memory budget allows the rays and images of a frame with halos.
pub(super) fn room_for_halos(scene: &Scene, bytes: u64) -> Result<(), Failure> {
    memory::room(bytes).map_err(|no_room| {
        let what = format!("the rays and images of halos need {no_room}");
        let remedy =
            "make the picture narrower, picture.samples smaller, or spread.reach or spread.passes of halos shorter";
        Failure::new(what, scene.given.position("halo"), remedy)
    })
}

/// Checks that the memory budget allows the picture of a scene: its channels, as much again for encoding them, and
/// `more` bytes for each pixel.
pub(crate) fn room_for_picture(scene: &Scene, more: usize) -> Result<(), Failure> {
    let channels: usize = scene.picture.layers.iter().map(|layer| layer.channels().len()).sum();
    room(scene, 2 * size_of::<f64>() * channels + more)
}

/// Checks that the memory budget allows `bytes` bytes for each pixel.
pub(crate) fn room(scene: &Scene, bytes: usize) -> Result<(), Failure> {
    let [width, height] = scene.picture.size;
    let needed = [width, height, bytes].into_iter().fold(1u64, |product, n| product.saturating_mul(n as u64));
    memory::room(needed).map_err(|no_room| no_room_for_pixels(scene, scene.picture.size, &no_room))
}

/// Returns the failure of a picture that the memory budget does not allow, at the key responsible, with a size that
/// fits.
pub(crate) fn no_room_for_pixels(scene: &Scene, size: [usize; 2], no_room: &NoRoom) -> Failure {
    let [width, height] = size;
    let what = format!("a picture of {width} × {height} pixels needs {no_room}");
    let [w, h] = no_room.fitting_size(size);
    // A page in mm has as many pixels as its resolution gives.
    let (key, fits) = if scene.picture.extent().is_some() {
        let dpi = (scene.picture.dpi * w as f64 / width.max(1) as f64).floor();
        ("picture.dpi", format!("picture.dpi = {dpi:.0} would fit"))
    } else {
        ("picture.size", format!("make it smaller, or ask for fewer layers: {w} × {h} pixels would fit"))
    };
    Failure::new(what, scene.given.position(key), fits)
}

/// Checks that there is memory for the per-voxel passes before rays, points and lines.
pub(crate) fn room_for_passes(scene: &Scene, volume: &Volume, plan: &Plan) -> Result<(), Failure> {
    let voxels = volume.dims().into_iter().fold(1u64, |product, n| product.saturating_mul(n as u64));
    let each = plan.passes.iter().map(|need| (need, voxels.saturating_mul(need.pass.bytes_a_voxel())));
    // Passes are kept one after another, so their sum has to fit.
    let mut needed = 0u64;
    for (need, bytes) in each {
        needed = needed.saturating_add(bytes);
        memory::room(needed).map_err(|no_room| {
            let [nx, ny, nz] = volume.dims();
            let (effect, pass) = (&need.effect, need.pass.name());
            let what = format!("{effect}: {pass} of {nx} × {ny} × {nz} voxels need {no_room}");
            let remedy = "leave out what asks for it (`drypoint plan` shows what does), or make the volume smaller";
            Failure::new(what, scene.given.position(&need.key), remedy)
        })?;
    }
    Ok(())
}
