//! A scene over another volume than its own, and templates, which have none ([VS-11]).

use crate::document::Place;
use crate::document::check::Check;
use crate::document::item::{Entry, Item, Value};
use crate::tables::{Scene, VolumeSource};
use std::path::{Path, PathBuf};

/// Keys of `[volume]` that name the data.
const SOURCE: [&str; 2] = ["file", "phantom"];

/// Keys of `[volume]` that describe the file that a scene names, and that mean nothing for another.
const OF_THE_FILE: [&str; 3] = ["raw", "box", "labels"];

/// A volume in the place of the one that a document names.
pub(super) struct Replaced {
    volume: PathBuf,
    /// The keys that went with the document's own volume, and their places.
    left_out: Vec<(&'static str, Place)>,
}

impl Replaced {
    /// Puts the file of a volume into a document. Keys of a template describe any volume, and stay.
    pub(super) fn new(document: &mut Item, volume: &Path) -> Self {
        let mut replaced = Self { volume: volume.to_path_buf(), left_out: Vec::new() };
        let chosen = |value| Item { value, place: Place::Chosen, is_way: false };
        let Value::Table(root) = &mut document.value else { return replaced };
        let empty = || Entry { name: Place::Chosen, item: chosen(Value::Table(Default::default())) };
        // A `volume` that is no table stays, and is a fault of the scene.
        let Value::Table(table) = &mut root.entry("volume".into()).or_insert_with(empty).item.value else {
            return replaced;
        };
        let is_template = SOURCE.iter().all(|key| !table.contains_key(*key));
        if !is_template {
            SOURCE.iter().for_each(|key| _ = table.remove(*key));
            let left_out = OF_THE_FILE.iter().filter_map(|key| Some((*key, table.remove(*key)?.name)));
            replaced.left_out = left_out.collect();
        }
        let file = chosen(Value::Text(volume.to_string_lossy().into_owned()));
        table.insert("file".into(), Entry { name: Place::Chosen, item: file });
        replaced
    }

    /// Completes the scene that was read from the document: a path that is not Unicode, and the places of keys that are
    /// left out, which the plan lists.
    pub(super) fn finish(self, scene: &mut Scene, check: &mut Check) {
        if let VolumeSource::File { path, .. } = &mut scene.volume.source
            && check.place("volume.file") == Some(&Place::Chosen)
        {
            *path = self.volume;
        }
        // Keys that nobody wrote have their defaults, although the table came with the volume.
        check.forget_chosen("volume");
        for (key, place) in self.left_out {
            if check.place(&format!("volume.{key}")).is_none() {
                check.within("volume", |check| check.within(key, |check| check.note(&place)));
            }
        }
    }
}
