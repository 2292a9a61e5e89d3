//! The connected parts of a job's volume that are kept ([VOL-2]).

use crate::Failure;
use drypoint_reference::suggest;
use drypoint_scene::counts::Counts;
use drypoint_scene::tables::{HatchIso, Iso, Keep, Outside, PartsTable, Scene};
use drypoint_scene::transfer::Function;
use drypoint_scene::volume::Volume;
use drypoint_scene::volume::parts::Parts;

/// The largest number of parts whose sizes are counted.
const COUNTED: usize = 100;

/// Whether a scene's parts are those that its transfer function shows.
pub(super) fn reads_function(scene: &Scene) -> bool {
    scene.transfer.is_some() && scene.volume.parts.as_ref().is_some_and(|table| table.at_least.is_none())
}

/// Removes the parts that a scene does not keep from its volume. Number and sizes of all parts go to `counts`.
///
/// A voxel is shown if its value reaches `at_least`. Without `at_least`, it is shown if the function can show it, with
/// any second quantity. Without a function, the value to reach is the first iso-value of the scene.
pub(super) fn isolate(
    scene: &Scene,
    function: Option<&Function>,
    mut volume: Volume,
    counts: &mut Counts,
) -> Result<Volume, Failure> {
    let Some(table) = &scene.volume.parts else { return Ok(volume) };
    let fails = |key: &str, what: &str, remedy: &str| Failure::new(what, scene.given.position(key), remedy);
    let outside_is_high = scene.volume.outside == Outside::High;
    let no_room = |no_room| {
        let what = format!("the parts of the volume need {no_room}");
        fails("volume.parts", &what, "leave volume.parts out, or read less with volume.box or volume.stride")
    };
    let parts = match least(scene, table, &volume, counts) {
        Some(least) if outside_is_high => Parts::find(&volume, &|value| value <= least),
        Some(least) => Parts::find(&volume, &|value| value >= least),
        None => match function.filter(|_| scene.transfer.is_some()) {
            Some(function) => Parts::find(&volume, &|value| function.can_be_visible([value; 2], None, |at| at)),
            None => {
                let what = "nothing in the scene says which voxels are parts";
                return Err(fails("volume.parts", what, "give the least value of a part as volume.parts.at_least"));
            }
        },
    };
    let parts = parts.map_err(no_room)?;
    let kept = parts.kept(table.keep, &volume).ok_or_else(|| {
        let Keep::At(point) = table.keep else { return fails("volume.parts.keep", "no part is kept", "") };
        let what = format!("there is no part at {point}");
        fails("volume.parts.keep", &what, "give a point on what is shown: `drypoint pick` tells some")
    })?;
    parts.isolate(&kept, &mut volume, outside_is_high).map_err(no_room)?;
    counts.parts = parts.all().len() as u64;
    counts.parts_kept = kept.iter().filter(|&&kept| kept).count() as u64;
    counts.part_sizes = parts.all().iter().take(COUNTED).map(|part| part.size as u64).collect();
    Ok(volume)
}

/// The value that voxels of parts must reach. Returns none if the function decides.
fn least(scene: &Scene, table: &PartsTable, volume: &Volume, counts: &mut Counts) -> Option<f64> {
    if table.at_least.is_some() || scene.transfer.is_some() {
        return table.at_least;
    }
    let hatching = scene.hatching.as_ref().and_then(|hatching| match hatching.iso {
        HatchIso::Surface(iso) => Some(iso),
        HatchIso::Transfer => None,
    });
    let surface = scene.surface.as_ref().map(|surface| surface.iso);
    let outlines = scene.outlines.as_ref().map(|outlines| outlines.iso);
    let hides = scene.stipples.as_ref().and_then(|stipples| stipples.hide_behind);
    match surface.or(outlines).or(hatching).or(hides)? {
        Iso::Value(value) => Some(value),
        Iso::Auto => Some(suggest::iso(volume, &scene.volume, counts)),
    }
}
