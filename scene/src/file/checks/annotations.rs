//! Checks of annotations against other tables. Names of parts are checked with those of other tables.

use super::no_label_names;
use crate::document::Problem;
use crate::document::check::Check;
use crate::tables::{AnnotatedPlace, LabelKey, Scene};

/// Reports ends of arrows and fans that nothing tells, and labels of structures without a label volume.
pub(super) fn check(scene: &Scene, check: &mut Check) {
    ends(scene, check);
    of_objects(scene, check);
    labels(scene, check);
    legend(scene, check);
}

/// A legend lists a function over the value or over labels, and has a name for each row or none at all. The rows of an
/// automatic function are known only with the data, and so are those of the preset's.
fn legend(scene: &Scene, check: &mut Check) {
    let Some(legend) = scene.annotations.legend.as_ref().filter(|_| check.sound(&["transfer", "legend"])) else {
        return;
    };
    let mut fault = |key: &str, what: String, remedy: String| {
        check.fault_in(key, Problem::Contradiction { what, remedy });
    };
    let Some(transfer) = &scene.transfer else {
        if scene.would_draw_nothing() {
            return;
        }
        let what = "a legend lists the looks of [transfer], and there is none".into();
        return fault("legend", what, "add a table [transfer], or remove [legend]".into());
    };
    match transfer.legend_rows() {
        None => {
            let second = transfer.over.second().map_or("", |axis| axis.name());
            let what =
                format!("a legend lists functions over the value or over labels, and this one is over {second:?}");
            fault("legend", what, "remove [legend], or name the looks in the caption".into());
        }
        Some(rows) => {
            if let Some((what, remedy)) = legend.wrong_names(rows.len()).filter(|_| !transfer.is_automatic()) {
                fault("legend.names", what, remedy);
            }
        }
    }
}

/// An arrow or a fan of an object begins at its ghost.
fn of_objects(scene: &Scene, check: &mut Check) {
    if !check.sound(&["object"]) {
        return;
    }
    for (i, object) in scene.objects.iter().enumerate().filter(|&(i, _)| !scene.leaves_ghost(i)) {
        for (key, _) in [("arrow", object.arrow), ("fan", object.fan)].into_iter().filter(|(_, is_asked)| *is_asked) {
            let key = format!("object[{i}].{key}");
            let what = format!("{key} begins at the ghost, and {:?} is not moved: it has no ghost", object.name);
            let remedy = format!("move {:?}, or take the key away", object.name);
            check.fault_in(&key, Problem::Contradiction { what, remedy });
        }
    }
}

/// An arrow or a fan without an end leads from the ghost to the selection of the one object that is moved.
fn ends(scene: &Scene, check: &mut Check) {
    if !check.sound(&["object", "arrow", "fan"]) {
        return;
    }
    let moved = (0..scene.objects.len()).filter(|&i| scene.leaves_ghost(i)).count();
    let annotations = &scene.annotations;
    let arrows =
        annotations.arrows.iter().enumerate().map(|(i, arrow)| (format!("arrow[{i}]"), &arrow.from, &arrow.to));
    let fans = annotations.fans.iter().enumerate().map(|(i, fan)| (format!("fan[{i}]"), &fan.from, &fan.to));
    for (table, from, to) in arrows.chain(fans) {
        let missing = [("from", from), ("to", to)].into_iter().find(|(_, end)| end.is_none());
        if let Some((key, _)) = missing.filter(|_| moved != 1) {
            let key = format!("{table}.{key}");
            let what = format!("{key} is missing, and {moved} objects are moved");
            let remedy = "name a part or a point; the default is of the only object that is moved".into();
            // A key that is not there has the place of its table.
            match check.place(&table).cloned() {
                Some(place) => check.fault_of(key, &place, Problem::Contradiction { what, remedy }),
                None => check.fault_in(&key, Problem::Contradiction { what, remedy }),
            }
        }
        let fan_point = [("from", from), ("to", to)]
            .into_iter()
            .find(|(_, end)| table.starts_with("fan") && matches!(end, Some(AnnotatedPlace::Point(_))));
        if let Some((key, _)) = fan_point {
            let what = format!("{table}.{key} is a point, and a fan joins the boxes of parts");
            let remedy = "name a part".into();
            check.fault_in(&format!("{table}.{key}"), Problem::Contradiction { what, remedy });
        }
    }
}

/// Labels of structures need a label volume, and their names a table of names.
fn labels(scene: &Scene, check: &mut Check) {
    if !check.sound(&["label", "volume"]) {
        return;
    }
    for (i, label) in scene.annotations.labels.iter().enumerate() {
        let key = if label.from.is_some() { "from" } else { "label" };
        if label.from.is_none() && label.label.is_none() {
            continue;
        }
        let key = format!("label[{i}].{key}");
        if scene.volume.labels.is_none() {
            let what = format!("{key} names structures of a label volume, and the scene has none");
            let remedy = "add the label volume: volume.labels = \"…\"".into();
            check.fault_in(&key, Problem::Contradiction { what, remedy });
        } else if let (None, Some(LabelKey::Name(name))) = (&scene.volume.label_names, &label.label) {
            check.fault_in(&key, no_label_names(name));
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::file::{Overrides, parse};
    use crate::plan::Plan;
    use std::path::Path;

    fn scene(rest: &str) -> Result<crate::tables::Scene, String> {
        let text = format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n{rest}");
        parse(&text, Path::new("scene.toml"), &Overrides::default()).map_err(|faults| faults.to_string())
    }

    #[test]
    fn faults_of_annotations_are_told() {
        for (rest, what) in [
            ("[[arrow]]\n", "arrow[0].from is missing, and 0 objects are moved\n"),
            ("[[fan]]\nfrom = [0, 0, 0]\nto = \"background\"\n", "fan[0].from is a point, and a fan joins"),
            ("[[object]]\narrow = true\n", "object[0].arrow begins at the ghost, and \"object 0\" is not moved"),
            ("[[object]]\nname = \"a\"\nfan = true\n", "object[0].fan begins at the ghost, and \"a\" is not moved"),
            ("[[box]]\nof = \"liver\"\n", "box[0].of"),
            ("[legend]\n[surface]\niso = 3\n", "a legend lists the looks of [transfer], and there is none"),
            (
                "[legend]\n[transfer]\nover = [\"value\", \"k1\"]\nrows = [{ at = 1, nodes = [{ at = 1, style = \"wax\" }] }]\n",
                "over \"k1\"",
            ),
            (
                "[legend]\nnames = [\"a\"]\n[transfer]\nnodes = [{ at = 1, style = \"wax\" }, { at = 2, style = \"metal\" }]\n",
                "legend.names has 1 name, and the legend has 2 rows",
            ),
            ("[[label]]\n", "the label names nothing\n"),
            ("[[label]]\nat = [0, 0, 0]\n", "the label has no text\n"),
            ("[[label]]\nfrom = \"labels\"\n", "label[0].from names structures of a label volume"),
            ("[[label]]\nlabel = 3\n", "label[0].label names structures of a label volume"),
            ("[[label]]\nlabel = 3\npixel = [1, 2]\n", "a label has both pixel and label\n"),
            ("[labels]\nsize = \"10 km\"\n[[label]]\nat = [0, 0, 0]\ntext = \"a\"\n", "labels.size"),
        ] {
            let faults = scene(rest).unwrap_err();
            assert!(faults.contains(what), "{rest}: {faults}");
        }
    }

    /// An end that is missing is reported at its table.
    #[test]
    fn a_missing_end_has_the_place_of_its_table() {
        for (rest, line) in
            [("[[arrow]]\n", 4), ("[[fan]]\n[[box]]\n", 4), ("[[box]]\n\n[[fan]]\nfrom = \"background\"\n", 6)]
        {
            let faults = scene(rest).unwrap_err();
            assert!(faults.contains(&format!("at scene.toml:{line}:1, key ")), "{rest}: {faults}");
        }
    }

    #[test]
    fn annotations_are_planned_where_there_are_some() {
        let has = |rest: &str| {
            let scene = scene(rest).unwrap();
            assert!(scene.transfer.is_some());
            Plan::new(&scene).passes.iter().any(|need| need.pass == crate::plan::Pass::Annotations)
        };
        let moved = "[[object]]\nmove = [1, 0, 0]\n";
        assert!(has(&format!("{moved}arrow = true\n")) && has(&format!("{moved}fan = true\n")) && !has(moved));
        assert!(has("[legend]\nnames = [\"a\"]\n"));
        assert!(has("[scale_bar]\n") && has("[orientation]\n") && has("[[box]]\n"));
        assert!(!has("") && !has("[[box]]\nshow = \"draft\"\n") && !has("[labels]\n"));
        let idle = |rest: &str| -> Vec<String> {
            Plan::new(&scene(rest).unwrap()).idle_keys.into_iter().map(|idle| idle.key).collect()
        };
        assert_eq!(idle("[labels]\nrounds = 1\n"), ["labels"]);
        let label = "[[label]]\nat = [0, 0, 0]\ntext = \"a\"\nmost = 3\n[picture]\ndpi = 100\n";
        assert_eq!(idle(label), ["label[0].most"]);
        let pen = "[[pen]]\nname = \"a\"\n[scale_bar]\npen = \"a\"\nwidth = \"1 mm\"\n";
        assert_eq!(idle(pen), ["scale_bar.width"]);
    }
}
