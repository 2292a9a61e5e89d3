//! Rules of what is laid over a picture: needs, keys without effect.

use super::{Pass, Rules};
use crate::tables::ObjectTable;

/// The rules of `[[box]]`, `[[arrow]]`, `[[fan]]`, `[[label]]`, `[labels]`, `[scale_bar]`, `[orientation]` and `[legend]`.
pub(super) const RULES: Rules = Rules {
    asks: |scene, asks| {
        let annotations = &scene.annotations;
        if scene.all_annotations().is_empty() || !(asks.draws_points() && asks.draws_strokes()) {
            return;
        }
        let of_object = |asks: fn(&ObjectTable) -> bool| scene.objects.iter().position(asks);
        let arrow = of_object(|object| object.arrow).map(|i| format!("object[{i}].arrow"));
        let fan = of_object(|object| object.fan).map(|i| format!("object[{i}].fan"));
        let tables = [
            ("box[0]", !annotations.boxes.is_empty()),
            ("arrow[0]", !annotations.arrows.is_empty()),
            ("fan[0]", !annotations.fans.is_empty()),
            ("label[0]", !annotations.labels.is_empty()),
            (arrow.as_deref().unwrap_or_default(), arrow.is_some()),
            (fan.as_deref().unwrap_or_default(), fan.is_some()),
            ("scale_bar", annotations.scale_bar.is_some()),
            ("legend", annotations.legend.is_some()),
        ];
        let first = tables.into_iter().find(|(_, is_there)| *is_there).map_or("orientation", |(key, _)| key);
        asks.pass(Pass::Annotations, "annotations", first);
    },
    idle: |scene, _, idle| {
        let annotations = &scene.annotations;
        for (table, _) in annotations.lines().into_iter().filter(|(_, line)| line.pen.is_some()) {
            idle.key(&format!("{table}.color"), &format!("{table}.pen says the colour"));
            idle.key(&format!("{table}.width"), &format!("the nib of {table}.pen is the width"));
        }
        for (i, label) in annotations.labels.iter().enumerate() {
            if label.from.is_none() {
                idle.key(&format!("label[{i}].most"), "the label stands alone");
            }
            if label.from.is_none() && label.label.is_none() {
                idle.key(&format!("label[{i}].anchor"), "the label names no structure of the label volume");
            }
        }
        if annotations.labels.is_empty() {
            idle.key("labels", "there is no label");
        }
    },
    ..Rules::new("label")
};
