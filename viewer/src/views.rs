//! Cameras that are kept by a name. A scene file has one camera, so further ones are part of the window's state.

use crate::document::{Document, Edit};
use crate::key::KeyPath;
use std::path::PathBuf;
use toml_edit::{InlineTable, Item, Value};

/// The keys of `[camera]` of a scene, by a name.
#[derive(Clone, Debug)]
pub struct SavedView {
    /// The scene's file.
    scene: PathBuf,
    /// The name.
    pub name: String,
    camera: InlineTable,
}

impl SavedView {
    /// The camera of a document as a view.
    pub fn of(document: &Document, name: &str) -> Self {
        let camera = keys(document).into_iter().collect();
        Self { scene: file(document), name: name.into(), camera }
    }

    /// Whether it is a view of a document's file.
    pub fn is_of(&self, document: &Document) -> bool {
        self.scene == file(document)
    }

    /// Whether it has the scene and the name of another view.
    pub fn replaces(&self, other: &Self) -> bool {
        (&self.scene, &self.name) == (&other.scene, &other.name)
    }

    /// Returns the edits that give a document this camera.
    pub fn edits(&self, document: &Document) -> Vec<Edit> {
        let key = |name: &str| KeyPath::from("camera").name(name);
        let others = keys(document).into_iter().filter(|(name, _)| !self.camera.contains_key(name));
        let removed = others.map(|(name, _)| Edit::Remove(key(&name)));
        removed.chain(self.camera.iter().map(|(name, value)| Edit::Set(key(name), bare(value)))).collect()
    }

    /// The view as the state keeps it.
    pub(crate) fn written(&self) -> InlineTable {
        let scene = self.scene.to_string_lossy().into_owned();
        let keys =
            [("scene", scene.into()), ("name", self.name.as_str().into()), ("camera", self.camera.clone().into())];
        InlineTable::from_iter::<[(&str, Value); 3]>(keys)
    }

    /// Reads a view that the state keeps.
    pub(crate) fn read(kept: &Value) -> Option<Self> {
        let kept = kept.as_inline_table()?;
        let text = |key: &str| kept.get(key)?.as_str().map(str::to_owned);
        let camera = kept.get("camera")?.as_inline_table()?.clone();
        Some(Self { scene: text("scene")?.into(), name: text("name")?, camera })
    }
}

/// The keys of a document's camera.
fn keys(document: &Document) -> Vec<(String, Value)> {
    let camera = document.get(&"camera".into()).and_then(Item::as_table_like);
    let value = |(key, item): (&str, &Item)| Some((key.to_owned(), bare(item.as_value()?)));
    camera.into_iter().flat_map(|camera| camera.iter().filter_map(value)).collect()
}

/// A value without the space and the comment around it.
fn bare(value: &Value) -> Value {
    let mut value = value.clone();
    value.decor_mut().clear();
    value
}

/// The absolute path of a document.
fn file(document: &Document) -> PathBuf {
    std::path::absolute(document.path()).unwrap_or_else(|_| document.path().into())
}
