//! Checks of `[[halo]]` against other tables and other halos.

use crate::document::Problem;
use crate::document::check::Check;
use crate::picture::LayerKind;
use crate::tables::{Halo, HaloKind, LabelKey, Scene, StepAlong};

/// Reports every contradiction of halos, and every name that nothing has.
pub(super) fn check(scene: &Scene, check: &mut Check) {
    // A list at fault is not in the scene.
    if !check.sound(&["halo"]) {
        return;
    }
    names(&scene.halos, check);
    tints(&scene.halos, check);
    labels(scene, check);
    layers(scene, check);
    if !scene.halos.is_empty() && scene.sampling.step_along == StepAlong::Ray && check.sound(&["sampling.step_along"]) {
        let what = "sampling.step_along = \"ray\" has no planes, and [[halo]] spreads seeds on planes".into();
        let remedy = "write step_along = \"plane\", or leave [[halo]] out".into();
        check.fault_in("sampling.step_along", Problem::Contradiction { what, remedy });
    }
}

/// A halo is called by its name, so that no two may share one.
fn names(halos: &[Halo], check: &mut Check) {
    for (i, halo) in halos.iter().enumerate() {
        if let Some(first) = halos[..i].iter().position(|other| other.name == halo.name) {
            let what = format!("halo[{first}] and halo[{i}] are both called {:?}", halo.name);
            let remedy = "give each halo a name of its own".into();
            // Of a name that the scene says and a default the first can be changed.
            let key = [i, first].map(|i| format!("halo[{i}].name")).into_iter().find(|key| check.has(key));
            let key = key.unwrap_or_else(|| format!("halo[{i}].name"));
            check.fault_in(&key, Problem::Contradiction { what, remedy });
        }
    }
}

/// What a halo tints must be an emissive one.
fn tints(halos: &[Halo], check: &mut Check) {
    let emissive = halos.iter().filter(|halo| halo.kind == HaloKind::Emissive).map(|halo| halo.name.as_str());
    let emissive: Vec<&str> = emissive.collect();
    for (i, halo) in halos.iter().enumerate() {
        for (j, name) in halo.tints.iter().enumerate().filter(|(_, name)| !emissive.contains(&name.as_str())) {
            check.unknown_in(&format!("halo[{i}].tints[{j}]"), "emissive halo", name, &emissive);
        }
    }
}

/// Seeds of labels need a label volume, and names of labels need a table of names: those beside the data that seed.
fn labels(scene: &Scene, check: &mut Check) {
    if !check.sound(&["volume", "object"]) {
        return;
    }
    for (i, halo) in scene.halos.iter().enumerate() {
        let Some(labels) = &halo.seed.labels else { continue };
        let key = format!("halo[{i}].seed.labels");
        let own = halo.object.as_ref().and_then(|part| scene.own_data_of(part));
        let (volume, names, table) = match own {
            Some(object) => {
                let table = &scene.objects[object];
                (&table.labels, &table.label_names, format!("object[{object}]"))
            }
            None => (&scene.volume.labels, &scene.volume.label_names, "volume".into()),
        };
        if volume.is_none() {
            let whose = if own.is_some() { "the object's data have" } else { "the scene has" };
            let what = format!("{key} are given, and {whose} no labels");
            let remedy = format!("add the label volume: {table}.labels = \"…\"");
            check.fault_in(&key, Problem::Contradiction { what, remedy });
        } else if names.is_none() {
            for (j, label) in labels.iter().enumerate() {
                let LabelKey::Name(name) = label else { continue };
                check.fault_in(&format!("{key}[{j}]"), super::no_label_names(name));
            }
        }
    }
}

/// A layer of a halo needs that halo.
fn layers(scene: &Scene, check: &mut Check) {
    if !check.sound(&["picture.layers"]) {
        return;
    }
    for (i, layer) in scene.picture.layers.iter().enumerate() {
        let LayerKind::Halo(n) = *layer else { continue };
        if n >= scene.halos.len() {
            let name = |i| LayerKind::Halo(i).name().into_owned();
            let known = (0..scene.halos.len()).map(name).collect();
            let problem = Problem::Reference { what: "halo".into(), name: name(n), nearest: None, known };
            check.fault_in(&format!("picture.layers[{i}]"), problem);
        }
    }
}
