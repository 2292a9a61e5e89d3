//! A scene as the text of a scene file.

use super::describe::Field;
use super::out::{self, Out};
use crate::tables::Scene;
use crate::tables::scene::ROOT;

/// The scene with every default filled in, as the text of a scene file ([SCN-3]). Reading it gives the scene again; a
/// scene that was not read from a file may have colours between those that a file can say, which are rounded. Relative
/// paths are those of the scene, from the working directory.
pub fn write_full(scene: &Scene) -> String {
    write(scene, |out| out)
}

/// The text of [`write_full`] with every path cut to its last name, so that the same scene gives the same text in
/// every folder and on every machine: what a picture's metadata holds a hash of ([IO-2]).
pub fn identity(scene: &Scene) -> String {
    write(scene, without_folders)
}

/// The keys, such as `contours.kappa`, whose values are not those of another scene, and the tables that have them.
pub fn differences(scene: &Scene, other: &Scene) -> Vec<String> {
    let mut keys = Vec::new();
    for key in ROOT.keys {
        let field: &dyn Field<Scene> = key.field;
        let (Some(value), others) = (field.write(scene), field.write(other)) else { continue };
        match (&value, &others) {
            (_, Some(same)) if value == *same => continue,
            (Out::Table(entries), others) => {
                let known = match others {
                    Some(Out::Table(known)) => known.as_slice(),
                    _ => &[],
                };
                let new = entries.iter().filter(|entry| !known.contains(entry));
                keys.extend(new.map(|(name, _)| format!("{}.{name}", key.name)));
            }
            _ => {}
        }
        keys.push(key.name.into());
    }
    keys
}

fn write(scene: &Scene, change: fn(Out) -> Out) -> String {
    let mut top = String::new();
    let mut tables = String::new();
    for key in ROOT.keys {
        let field: &dyn Field<Scene> = key.field;
        let is_table = field.shape().section().is_some();
        match field.write(scene).map(change) {
            Some(Out::Table(entries)) if is_table => {
                tables.push_str(&format!("\n[{}]\n", key.name));
                for (name, value) in entries {
                    tables.push_str(&line(&name, &value));
                }
            }
            Some(value) => top.push_str(&line(key.name, &value)),
            None => {}
        }
    }
    top + &tables
}

fn line(name: &str, value: &Out) -> String {
    format!("{} = {}\n", out::key(name), value.toml_block())
}

fn without_folders(out: Out) -> Out {
    match out {
        Out::Path(path) => Out::Text(path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()),
        Out::List(items) => Out::List(items.into_iter().map(without_folders).collect()),
        Out::Table(entries) => {
            Out::Table(entries.into_iter().map(|(name, value)| (name, without_folders(value))).collect())
        }
        other => other,
    }
}
