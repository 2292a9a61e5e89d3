//! Tests of the walk, the descriptions and what is made from them.

mod clips;
mod drift;
mod faults;
mod figure;
mod found;
mod limits;
mod over;
mod overrides;
mod random;
mod round_trip;
mod samples;
mod schema;

use super::*;
use crate::document::describe::{Section, SectionKey};
use crate::document::reference::is_of_the_top;

/// A scene file's first lines.
const HEAD: &str = "drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n";

/// A scene of [`HEAD`] and more.
fn scene(rest: &str) -> Scene {
    match parse(&format!("{HEAD}{rest}"), Path::new("scene.toml"), &Overrides::default()) {
        Ok(scene) => scene,
        Err(faults) => panic!("{rest}\n{faults}"),
    }
}

/// The faults of a scene of [`HEAD`] and more, as text.
fn faults(rest: &str) -> String {
    match parse(&format!("{HEAD}{rest}"), Path::new("scene.toml"), &Overrides::default()) {
        Ok(_) => panic!("no fault in\n{rest}"),
        Err(faults) => faults.to_string(),
    }
}

/// Every key of every table with its path from the top, of tables inside others that are described at the top only there; `[0]` stands for any item of a list of tables.
fn every_key() -> Vec<(String, SectionKey)> {
    fn walk(path: &str, section: Section, all: &mut Vec<(String, SectionKey)>) {
        for key in section.keys {
            let inner = if path.is_empty() { key.name.to_owned() } else { format!("{path}.{}", key.name) };
            if let Some(table) = key.shape.section().filter(|table| !is_of_the_top(path, table)) {
                walk(&inner, table, all);
            }
            if let Some(table) = key.shape.item_section() {
                walk(&format!("{inner}[0]"), table, all);
            }
            all.push((inner, key));
        }
    }
    let mut all = Vec::new();
    walk("", ROOT.section(), &mut all);
    all
}
