//! A value as the text of a document.

use super::describe::Table;
use super::out::{self, Out};

/// The keys, such as `contours.kappa`, whose values differ from another document's, and the tables with such keys.
pub(crate) fn differences<S>(root: &Table<S>, from: &S, other: &S) -> Vec<String> {
    let mut keys = Vec::new();
    for key in root.keys {
        let (Some(value), others) = (key.field.write(from), key.field.write(other)) else { continue };
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

/// The text of a document with every key. `change` is applied to each value.
pub(crate) fn write<S>(root: &Table<S>, from: &S, change: fn(Out) -> Out) -> String {
    let mut top = String::new();
    let mut tables = String::new();
    for key in root.keys {
        let is_table = key.field.shape().section().is_some();
        match key.field.write(from).map(change) {
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

/// The value with every path cut to its last name.
pub(crate) fn without_folders(out: Out) -> Out {
    match out {
        Out::Path(path) => Out::Text(path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()),
        Out::List(items) => Out::List(items.into_iter().map(without_folders).collect()),
        Out::Table(entries) => {
            Out::Table(entries.into_iter().map(|(name, value)| (name, without_folders(value))).collect())
        }
        other => other,
    }
}
