//! Automatic iso-values, which come from the volume.

use drypoint_reference::suggest;
use drypoint_scene::counts::Counts;
use drypoint_scene::plan::{Pass, Plan, Quantity};
use drypoint_scene::tables::{HatchIso, Iso, Scene};
use drypoint_scene::volume::Volume;

/// Sets automatic iso-values to the one suggested by the volume, if something uses them.
pub(super) fn find_iso_values(scene: &mut Scene, plan: &Plan, volume: &Volume, counts: &mut Counts) {
    let (drawn, hides) = (plan.needs(Quantity::Surface), plan.has_pass(Pass::HiddenStrokes));
    let strokes = hides || plan.has_pass(Pass::Strokes);
    let surface = scene.surface.as_mut().filter(|_| drawn || hides).map(|surface| &mut surface.iso);
    let outlines = scene.outlines.as_mut().filter(|_| strokes).map(|outlines| &mut outlines.iso);
    let hatching = scene.hatching.as_mut().filter(|_| strokes).and_then(|hatching| match &mut hatching.iso {
        HatchIso::Surface(iso) => Some(iso),
        HatchIso::Transfer => None,
    });
    let stipples = scene.stipples.as_mut().filter(|_| plan.has_pass(Pass::StipplePoints));
    let stipples = stipples.into_iter().flat_map(|stipples| [&mut stipples.iso, &mut stipples.hide_behind]).flatten();
    let strokes = surface.into_iter().chain(outlines).chain(hatching);
    let asked: Vec<&mut Iso> = strokes.chain(stipples).filter(|iso| **iso == Iso::Auto).collect();
    if !asked.is_empty() {
        let found = suggest::iso(volume, &scene.volume, counts);
        asked.into_iter().for_each(|iso| *iso = Iso::Value(found));
    }
}
