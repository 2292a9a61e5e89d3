//! Relative paths of a scene that is saved in another folder.

use crate::edit;
use crate::key::KeyPath;
use drypoint::scene::file::{self, Overrides, data_folders};
use drypoint::{Failure, Failures};
use std::ffi::OsString;
use std::path::{Path, absolute};
use toml_edit::{DocumentMut, Item, Value};

/// Returns the text of a scene file in which relative paths are absolute, so that it names the same files from every
/// folder. A path that is found in a folder of data alone ([`data_folders`]) stays: it is found from everywhere.
///
/// The format tells which texts are paths. A candidate is a text that is the path of a file of the scene. It is a path
/// itself, and not a name like it, if the scene names `./text` once the text says so.
///
/// # Errors
/// A scene with faults, whose paths are not known, or a folder whose name is not Unicode.
pub(crate) fn absolute_paths(toml: &DocumentMut, path: &Path) -> Result<String, Failures> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let files = files(toml, path)?;
    let mut candidates = Vec::new();
    texts(toml.as_item(), &KeyPath::default(), &mut |key, text| {
        let named = folder.join(text).into_os_string();
        if Path::new(text).is_relative() && files.contains(&named) {
            candidates.push((key, text.to_owned()));
        }
    });
    let mut moved = toml.clone();
    for (key, text) in candidates {
        let mut probed = toml.clone();
        let is_set = edit::set(&mut probed, &key, Path::new(".").join(&text).to_string_lossy().as_ref().into()).is_ok();
        let is_path = is_set && self::files(&probed, path).is_ok_and(|probed| probed != files);
        let is_here = folder.join(&text).exists();
        let is_elsewhere = || data_folders().iter().any(|folder| folder.join(&text).exists());
        if is_path && (is_here || !is_elsewhere()) {
            let whole = absolute(folder.join(&text)).ok();
            let Some(whole) = whole.as_deref().and_then(Path::to_str) else {
                let what = format!("the path of {text} cannot be written: its folder is not known, or is not Unicode");
                return Err(Failure::new(what, path.display(), "save the scene in the folder that it is in").into());
            };
            // A key that was found can be set.
            let _ = edit::set(&mut moved, &key, whole.into());
        }
    }
    Ok(moved.to_string())
}

/// Returns the files that a scene names, as they are written behind its folder.
fn files(toml: &DocumentMut, path: &Path) -> Result<Vec<OsString>, Failures> {
    let scene = file::parse(&toml.to_string(), path, &Overrides::default())?;
    Ok(scene.files().into_iter().map(|file| file.as_os_str().to_owned()).collect())
}

/// Calls a function for each text under an item, with its key.
fn texts(item: &Item, key: &KeyPath, found: &mut dyn FnMut(KeyPath, &str)) {
    match item {
        Item::None => {}
        Item::Value(value) => texts_of_value(value, key, found),
        Item::Table(table) => table.iter().for_each(|(name, item)| texts(item, &key.name(name), found)),
        Item::ArrayOfTables(tables) => {
            for (i, table) in tables.iter().enumerate() {
                table.iter().for_each(|(name, item)| texts(item, &key.item(i).name(name), found));
            }
        }
    }
}

fn texts_of_value(value: &Value, key: &KeyPath, found: &mut dyn FnMut(KeyPath, &str)) {
    match value {
        Value::String(text) => found(key.clone(), text.value()),
        Value::Array(array) => {
            array.iter().enumerate().for_each(|(i, value)| texts_of_value(value, &key.item(i), found));
        }
        Value::InlineTable(table) => {
            table.iter().for_each(|(name, value)| texts_of_value(value, &key.name(name), found));
        }
        _ => {}
    }
}
