//! Checks that need several tables of a scene.

mod annotations;
mod halos;
mod objects;
mod page;

use crate::document::Problem;
use crate::document::check::Check;
use crate::source::Disk;
use crate::style::Theme;
use crate::tables::{Axis, DotColor, LabelKey, Over, PenSettings, Scene, Stand, Styles};
use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};

/// Reports every contradiction between tables, and every name that nothing has.
pub(super) fn check(scene: &Scene, check: &mut Check) {
    styles(scene, check);
    pens(&scene.pens, check);
    labels(scene, check);
    colors(scene, check);
    annotations::check(scene, check);
    halos::check(scene, check);
    objects::check(scene, check);
    page::check(scene, check);
}

/// Every style that a node names must be one that the theme or a file provides. A folder of pictures that cannot be
/// listed is left to whoever opens it.
fn styles(scene: &Scene, check: &mut Check) {
    if !check.sound(&["styles", "object"]) {
        return;
    }
    let mut known_at = BTreeMap::new();
    for (name, key, place) in check.take_styles() {
        let part = part_of(scene, &key);
        let known = known_at.entry(part).or_insert_with(|| known_styles(&styles_at(scene, part, check)));
        let Some(known) = known else { continue };
        if !known.contains(&name) {
            let known: Vec<&str> = known.iter().map(String::as_str).collect();
            check.unknown_of(key, &place, "style", &name, &known);
        }
    }
}

/// The object that a key is about, and whether it is about the object's ghost; none: it is about the picture.
fn part_of(scene: &Scene, key: &str) -> Option<(usize, bool)> {
    let (i, key) = key.strip_prefix("object[")?.split_once("].")?;
    let i = i.parse().ok().filter(|&i| i < scene.objects.len())?;
    Some((i, key.starts_with("ghost")))
}

/// The styles that a part or the picture can name.
fn styles_at<'a>(scene: &'a Scene, part: Option<(usize, bool)>, check: &Check) -> Cow<'a, Styles> {
    part.map_or(Cow::Borrowed(&scene.styles), |(i, is_ghost)| {
        Cow::Owned(scene.styles_of(i, is_ghost, &|key| check.place(key).is_some()))
    })
}

/// The names of all styles; none if the theme cannot be listed.
fn known_styles(styles: &Styles) -> Option<BTreeSet<String>> {
    let theme = Theme::open(&Disk, &styles.theme).ok()?;
    let mut known: BTreeSet<String> = theme.names().map(Into::into).collect();
    known.extend(styles.files.iter().map(|(name, _)| name.clone()));
    Some(known)
}

/// A pen is called by its name, so that no two may share one.
fn pens(pens: &[PenSettings], check: &mut Check) {
    for (i, pen) in pens.iter().enumerate() {
        if let Some(first) = pens[..i].iter().position(|other| other.name == pen.name) {
            let what = format!("pen[{first}] and pen[{i}] are both called {:?}", pen.name);
            let remedy = "give each pen a name of its own".into();
            check.fault_in(&format!("pen[{i}].name"), Problem::Contradiction { what, remedy });
        }
    }
}

/// A function over labels needs a label volume, and names of labels need a table of names.
fn labels(scene: &Scene, check: &mut Check) {
    let Some(transfer) = &scene.transfer else { return };
    if !check.sound(&["transfer.over", "volume"]) {
        return;
    }
    if scene.volume.labels.is_none() {
        if let Some(axis) = transfer.over.axes().iter().find(|axis| axis.reads_labels()) {
            let what = format!("the function is over {:?}, and the scene has no labels", axis.name());
            let remedy = "add the label volume: volume.labels = \"…\"".into();
            check.fault_in("transfer.over", Problem::Contradiction { what, remedy });
        }
        return;
    }
    if scene.volume.label_names.is_some() {
        return;
    }
    for axis in transfer.over.axes() {
        if let Axis::DistanceToLabel(LabelKey::Name(name)) = axis {
            check.fault_in("transfer.over", no_label_names(name));
        }
    }
    for (i, row) in transfer.rows.iter().flatten().enumerate() {
        for at in row.at.each() {
            if let Stand::Name(name) = at {
                check.fault_in(&format!("transfer.rows[{i}].at"), no_label_names(name));
            }
        }
    }
}

/// The fault of a label's name in a scene without a table of names.
fn no_label_names(name: &str) -> Problem {
    let what = format!("{name:?} is the name of a label, and the scene has no names of them");
    let remedy = "write an id, or add the table of names: volume.label_names = \"…\"".into();
    Problem::Contradiction { what, remedy }
}

/// Colours are borrowed from `[transfer]`, and a dot has its value and its label, no other quantity.
fn colors(scene: &Scene, check: &mut Check) {
    let Some(stipples) = &scene.stipples else { return };
    if matches!(stipples.color, DotColor::Fixed(_)) || !check.sound(&["transfer", "stipples.color"]) {
        return;
    }
    let (what, remedy) = match (&scene.transfer, stipples.color) {
        (None, _) => {
            ("dots take their colours from [transfer], and there is none", "add a table [transfer], or give a colour")
        }
        (Some(transfer), DotColor::Label) if !transfer.over.is_over_labels() => (
            "dots take the colours of their labels, and the function is not over [\"value\", \"label\"]",
            "give it a row for each label, or write \"transfer\"",
        ),
        (Some(transfer), _) if transfer.over != Over::Value && !transfer.over.is_over_labels() => (
            "dots have a value and a label, and the function is over another quantity",
            "make it one over the value, or over [\"value\", \"label\"], or give a colour",
        ),
        _ => return,
    };
    check.fault_in("stipples.color", Problem::Contradiction { what: what.into(), remedy: remedy.into() });
}

#[cfg(test)]
mod tests {
    use crate::file::{Overrides, parse};
    use std::path::Path;

    fn faults(rest: &str) -> Option<String> {
        let text = format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\nlabels = \"l.nrrd\"\n{rest}");
        parse(&text, Path::new("scene.toml"), &Overrides::default()).err().map(|faults| faults.to_string())
    }

    #[test]
    fn colours_are_borrowed_from_a_function_that_dots_can_read() {
        let rows = |over: &str| {
            format!(
                "[transfer]\nkind = \"regular\"\nover = {over}\nrows = [{{ at = 1, nodes = [{{ at = 1, color = \"red\" }}] }}]\n"
            )
        };
        let labels = rows("[\"value\", \"label\"]");
        for (color, transfer, wrong) in [
            ("red", String::new(), None),
            ("transfer", String::new(), Some("and there is none")),
            ("label", String::new(), Some("and there is none")),
            ("transfer", "[transfer]\n".into(), None),
            ("label", "[transfer]\n".into(), Some("is not over [\"value\", \"label\"]")),
            ("transfer", labels.clone(), None),
            ("label", labels, None),
            ("transfer", rows("[\"value\", \"k1\"]"), Some("over another quantity")),
        ] {
            let told = faults(&format!("[stipples]\ncolor = \"{color}\"\n{transfer}"));
            assert_eq!(told.is_some(), wrong.is_some(), "{color} {transfer}: {told:?}");
            if let (Some(told), Some(wrong)) = (told, wrong) {
                assert!(told.contains(wrong) && told.contains("stipples.color"), "{told}");
            }
        }
    }
}
