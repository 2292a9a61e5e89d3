//! Checks of `[[object]]` and `[[intersection]]` against other tables, and of every name of a part.

use super::no_label_names;
use crate::document::Problem;
use crate::document::check::Check;
use crate::picture::LayerKind;
use crate::tables::{LabelKey, ObjectTable, PartName, Role, Scene};
use std::collections::BTreeSet;

/// Reports every contradiction of objects, and every name of a part that nothing has.
pub(super) fn check(scene: &Scene, check: &mut Check) {
    // A list at fault is not in the scene.
    if !check.sound(&["object"]) {
        return;
    }
    names(&scene.objects, check);
    funnels(scene, check);
    labels(scene, check);
    references(scene, check);
    intersections(scene, check);
    layers(scene, check);
}

/// An object is called by its name. No two may share one, and none may have that of another part.
fn names(objects: &[ObjectTable], check: &mut Check) {
    for (i, object) in objects.iter().enumerate() {
        let problem = if let Some(first) = objects[..i].iter().position(|other| other.name == object.name) {
            let what = format!("object[{first}] and object[{i}] are both called {:?}", object.name);
            Some((what, "give each object a name of its own"))
        } else if object.name == PartName::BACKGROUND || object.name.ends_with(PartName::GHOST) {
            Some((format!("{:?} is the name of another part", object.name), "give the object another name"))
        } else {
            None
        };
        if let Some((what, remedy)) = problem {
            check.fault_in(&format!("object[{i}].name"), Problem::Contradiction { what, remedy: remedy.into() });
        }
    }
}

/// A funnel wider than the picture cuts it everywhere, and its map has no end.
fn funnels(scene: &Scene, check: &mut Check) {
    let height = scene.picture.size[1] as f64;
    for (i, object) in scene.objects.iter().enumerate() {
        let sigma = object.funnel.and_then(|funnel| scene.picture.in_pixels(funnel)).filter(|&sigma| sigma > height);
        if let Some(sigma) = sigma {
            let what = format!("a funnel of {sigma} px is wider than the picture of {height} px");
            let remedy = "give at most the height of the picture".into();
            check.fault_in(&format!("object[{i}].funnel"), Problem::Contradiction { what, remedy });
        }
    }
}

/// Labels need a label volume, and their names a table of names: those beside the object's data.
fn labels(scene: &Scene, check: &mut Check) {
    if !check.sound(&["volume"]) {
        return;
    }
    for (i, object) in scene.objects.iter().enumerate() {
        let Some(labels) = &object.label else { continue };
        let (volume, names, table) = match object.volume {
            Some(_) => (&object.labels, &object.label_names, format!("object[{i}]")),
            None => (&scene.volume.labels, &scene.volume.label_names, "volume".into()),
        };
        let key = format!("object[{i}].label");
        if volume.is_none() {
            let what = format!("{key} selects labels, and the data has none");
            let remedy = format!("add the label volume: {table}.labels = \"…\"");
            check.fault_in(&key, Problem::Contradiction { what, remedy });
        } else if let (None, Some(LabelKey::Name(name))) =
            (names, labels.iter().find(|label| matches!(label, LabelKey::Name(_))))
        {
            check.fault_in(&key, no_label_names(name));
        }
    }
}

/// Clip planes, halos and annotations may name the background, objects, and ghosts of moved objects.
fn references(scene: &Scene, check: &mut Check) {
    let of_clips = scene.clips.iter().enumerate().flat_map(|(i, clip)| {
        clip.applies.iter().enumerate().map(move |(j, part)| (format!("clip[{i}].applies[{j}]"), part))
    });
    let of_halos = scene.halos.iter().enumerate();
    let of_halos = of_halos.filter_map(|(i, halo)| Some((format!("halo[{i}].object"), halo.object.as_ref()?)));
    let known = known_parts(scene);
    let there: BTreeSet<&PartName> = known.iter().collect();
    let of_annotations = scene.annotations.parts();
    let of_annotations = of_annotations.iter().map(|(key, part)| (key.clone(), *part));
    let all: Vec<_> =
        of_clips.chain(of_halos).chain(of_annotations).filter(|(_, part)| !there.contains(part)).collect();
    let known: Vec<String> = known.iter().map(ToString::to_string).collect();
    let known: Vec<&str> = known.iter().map(String::as_str).collect();
    for (key, part) in all {
        if let PartName::Ghost(name) = part
            && scene.objects.iter().any(|object| object.name == *name)
        {
            let what = format!("{name:?} is not moved: it has no ghost");
            check.fault_in(&key, Problem::Contradiction { what, remedy: format!("move {name:?}, or name the object") });
            continue;
        }
        check.unknown_in(&key, "part", &part.to_string(), &known);
    }
}

/// All parts of a scene.
fn known_parts(scene: &Scene) -> Vec<PartName> {
    let of_object = scene.parts_of_frames().map(|(i, role)| {
        let name = scene.objects[i].name.clone();
        match role {
            Role::Selection => PartName::Selection(name),
            Role::Ghost => PartName::Ghost(name),
        }
    });
    [PartName::Background].into_iter().chain(of_object).collect()
}

/// An intersection is of an object that exists, and a pair has one table.
fn intersections(scene: &Scene, check: &mut Check) {
    if !check.sound(&["intersection"]) {
        return;
    }
    for (i, table) in scene.intersections.iter().enumerate() {
        if scene.objects.is_empty() {
            let what = format!("an intersection is of the object {:?}, and the scene has no object", table.object);
            let remedy = "add an [[object]], or remove the [[intersection]]".into();
            check.fault_in(&format!("intersection[{i}].object"), Problem::Contradiction { what, remedy });
        } else if scene.objects.iter().all(|object| object.name != table.object) {
            let known: Vec<&str> = scene.objects.iter().map(|object| object.name.as_str()).collect();
            check.unknown_in(&format!("intersection[{i}].object"), "object", &table.object, &known);
        }
        let same = |other: &&_| -> bool {
            let other: &crate::tables::IntersectionTable = other;
            (&other.object, other.with) == (&table.object, table.with)
        };
        if let Some(first) = scene.intersections[..i].iter().position(|other| same(&other)) {
            let what = format!("intersection[{first}] and intersection[{i}] are of the same pair");
            let remedy = "keep one of them".into();
            check.fault_in(&format!("intersection[{i}]"), Problem::Contradiction { what, remedy });
        }
    }
}

/// A layer of a part needs that part, in all frames.
fn layers(scene: &Scene, check: &mut Check) {
    if !check.sound(&["picture.layers"]) {
        return;
    }
    let known = known_parts(scene);
    let is_still = |&(i, object): &(usize, &ObjectTable)| !object.motion.is_moved() && scene.follows_camera(i);
    let still = scene.objects.iter().enumerate().find(is_still);
    for (i, layer) in scene.picture.layers.iter().enumerate() {
        let LayerKind::Part(n) = *layer else { continue };
        if let Some((_, object)) = still {
            let what = format!(
                "{layer} is not one part in all frames: {:?} leaves its ghost when [orbit] turns the camera",
                object.name
            );
            let remedy = "move it, or write rotate = { angle = 360 }: then it has a ghost in each frame".into();
            check.fault_in(&format!("picture.layers[{i}]"), Problem::Contradiction { what, remedy });
            continue;
        }
        if n >= known.len() {
            let parts = if known.len() == 1 { "part" } else { "parts" };
            let what = format!("there is no {layer}: the scene has {} {parts}, counted from 0", known.len());
            let named = known.iter().enumerate().map(|(i, part)| format!("{} ({part})", LayerKind::Part(i)));
            let remedy = format!("there is {}", named.collect::<Vec<_>>().join(", "));
            check.fault_in(&format!("picture.layers[{i}]"), Problem::Contradiction { what, remedy });
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::file::{Overrides, parse};
    use std::path::Path;

    /// The faults of a scene with these lines.
    fn faults(rest: &str) -> String {
        let text = format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\nlabels = \"l.nrrd\"\n{rest}");
        let faults = parse(&text, Path::new("scene.toml"), &Overrides::default()).err();
        faults.map(|faults| faults.to_string()).unwrap_or_default()
    }

    #[test]
    fn contradictions_of_objects_are_told_with_their_keys() {
        let object = |rest: &str| format!("[[object]]\nname = \"tumour\"\n{rest}\n");
        for (rest, key, what) in [
            (object("funnel = \"3000 px\""), "object[0].funnel", "wider than the picture of"),
            (
                object("") + "[[clip]]\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\napplies = [\"tumour ghost\"]\n",
                "clip[0].applies[0]",
                "is not moved: it has no ghost",
            ),
            (object("") + &object(""), "object[1].name", "both called"),
            ("[[object]]\nname = \"background\"\n".into(), "object[0].name", "the name of another part"),
            (object("label = \"liver\""), "object[0].label", "has no names of them"),
            (object("volume = \"b.nrrd\"\nlabel = 3"), "object[0].label", "object[0].labels = \"…\""),
            (object("range = [0, 1]"), "object[0].range", "has none"),
            (object("scale = [1, 1, 1e-20]"), "object[0].scale", "\"tumour\" is singular"),
            (object("scale = 0"), "object[0].scale", "none is 0"),
            (
                object("matrix = [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 2]]"),
                "object[0].matrix",
                "four rows",
            ),
            (object("label = 3\nvalue = [[0, 1]]"), "object[0].label", "has both label and value\n"),
            (object("label = 3\nvalue = [[0, 1]]"), "object[0].label", "\n  keep label or value"),
            (
                object("selection = \"s.nrrd\"\nlabel = 3\nvalue = [[0, 1]]"),
                "object[0].selection",
                "\n  keep selection or label or value",
            ),
            (
                object("strokes = [{ watershed = [1, 2, 3], brush = \"ball\" }]"),
                "object[0].strokes[0].watershed",
                "a stroke has both watershed and brush\n  at scene.toml:7:14, key object[0].strokes[0].watershed\n  keep watershed or brush",
            ),
            (
                object("strokes = [{ watershed = [1, 2, 3], radius = 2, brush = \"ball\" }]"),
                "object[0].strokes[0].watershed",
                "keep watershed, or radius and brush",
            ),
            (object("move = [0, nan, 0]"), "key object[0].move[1]", "object[0].move[1] cannot be NaN\n"),
            (object("scale = [1, 1, inf]"), "key object[0].scale[2]", "\n  write a finite number"),
            (
                object("matrix = [[1, 0, 0, 0], [0, 1, 0, -inf], [0, 0, 1, 0], [0, 0, 0, 1]]"),
                "key object[0].matrix[1][3]",
                "object[0].matrix[1][3] cannot be -inf\n",
            ),
            (
                "[[intersection]]\nobject = \"tumour\"\n".into(),
                "intersection[0].object",
                "and the scene has no object\n",
            ),
            (object("value = [[3, 1], [2, 0]]"), "object[0].value[1]", "non-decreasing"),
            (object("[object.transfer]\nnodes = [{ at = 1, style = \"waxx\", opacity = 1 }]"), "style", "wax"),
            (object("") + "[[intersection]]\nobject = \"tumor\"\n", "intersection[0].object", "tumour"),
            (object("") + &"[[intersection]]\nobject = \"tumour\"\n".repeat(2), "intersection[1]", "of the same pair"),
            (
                object("") + "[[clip]]\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\napplies = [\"tumor\"]\n",
                "clip[0].applies[0]",
                "background",
            ),
            (object("") + "[[halo]]\nobject = \"tumors\"\n", "halo[0].object", "tumour"),
            (object("") + "[[halo]]\nobject = \"tumour ghost\"\n", "halo[0].object", "tumour"),
            (
                object("move = [0, 0, 4]") + "[picture]\nlayers = [\"part2\", \"part3\"]\n",
                "picture.layers[1]",
                "there is no part3: the scene has 3 parts, counted from 0\n",
            ),
            ("[picture]\nlayers = [\"part1\"]\n".into(), "the scene has 1 part,", "\n  there is part0 (background)"),
            (
                "[picture]\nlayers = [\"part0.A\"]\n".into(),
                "picture.layers[0] cannot be \"part0.A\"",
                "\n  write \"part0\"; ",
            ),
        ] {
            let told = faults(&rest);
            assert!(told.contains(key) && told.contains(what), "{rest}\n{told}");
        }
        let dab = |keys: &str| {
            object("") + &format!("[[intersection]]\nobject = \"tumour\"\ndabs = [{{ color = \"red\", {keys} }}]\n")
        };
        let (width, widths) = ("intersection[0].dabs[0].width", "write a number above 0, or two of them");
        for (keys, key, what, remedy) in [
            ("at = [1, 2], width = 0", width, "cannot be 0", widths),
            ("at = [1, 2], width = -3", width, "cannot be -3", widths),
            ("at = [1, 2], width = nan", width, "cannot be NaN", widths),
            (
                "at = [1, 2], width = [1, nan]",
                "intersection[0].dabs[0].width[1]",
                "cannot be NaN",
                "write a finite number",
            ),
            ("at = [1, 2], width = [1, 0]", width, "cannot be [1, 0]", widths),
            ("at = [1, 2], width = [1, 2, 3]", width, "cannot be [1, 2, 3]", widths),
            ("at = [1, 2]", width, "is missing", widths),
            ("at = 1, width = 3", "intersection[0].dabs[0].at", "cannot be 1", "write two values [v, w]"),
            ("at = [1], width = 3", "intersection[0].dabs[0].at", "cannot be [1]", "write two values [v, w]"),
            ("width = 3", "intersection[0].dabs[0].at", "is missing", "at = two values [v, w]"),
        ] {
            let told = faults(&dab(keys));
            let remedy = if what == "is missing" { remedy.replace("write ", "") } else { remedy.into() };
            assert!(told.starts_with(&format!("{key} {what}\n")) && told.contains(&remedy), "{keys}\n{told}");
            assert!(told.contains(&format!("key {key}\n")) && told.lines().count() == 3, "{keys}\n{told}");
        }
        let sound = object(
            "label = [1, 2]\nmove = [0, 0, 4]\n[object.styles]\nmine = \"mine.png\"\n[object.transfer]\nnodes = [{ at = 1, style = \"mine\", opacity = 1 }]",
        ) + "[[clip]]\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\napplies = [\"tumour\", \"tumour ghost\"]\n"
            + "[[intersection]]\nobject = \"tumour\"\nwith = \"background\"\ncolor = \"#ff000080\"\n"
            + "dabs = [{ at = [80, 120], width = [10, 10], color = \"#ff8000c0\" }, { at = [-1, 0], width = 5, color = \"red\" }]\n"
            + "[[halo]]\n[[halo]]\nobject = \"background\"\n[[halo]]\nobject = \"tumour ghost\"\n";
        assert_eq!(faults(&sound), "");
    }
}
