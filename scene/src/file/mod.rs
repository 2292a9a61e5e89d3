//! Scene files: parsing with places, checking, overrides, schema ([IO-3], [SCN-1] … [SCN-4]).
//!
//! A document is walked with its places against the description of the tables, which stands with the tables
//! themselves. All faults are collected, and a [`Scene`] is built only from what passed.
//!
//! ```
//! use drypoint_scene::file::{Overrides, parse};
//! let text = "drypoint = 1\n[volume]\nphantom = { name = \"torus\" }\n[contours]\nthickness = \"3 voxels\"\n";
//! let scene = parse(text, "torus.toml".as_ref(), &Overrides::default())?;
//! assert!(scene.contours.is_some());
//!
//! let faults = parse("drypoint = 1\n[volum]\n", "torus.toml".as_ref(), &Overrides::default()).unwrap_err();
//! assert_eq!(faults.iter().count(), 2, "an unknown table and no volume");
//! # Ok::<(), drypoint_scene::file::Faults>(())
//! ```

mod checks;
mod embedded;
mod figure;
mod find;
mod template;
#[cfg(test)]
mod tests;

pub use crate::document::{Fault, Faults, Given, Overrides, Place, Problem};
pub use embedded::DEFAULT_SCENE;
pub use figure::{
    figure_identity, figure_reference_markdown, figure_schema, is_figure, load_figure, parse_figure, write_full_figure,
};
pub use find::data_folders;

use crate::document::check::Check;
use crate::document::item::Item;
use crate::document::{full, reference, schema};
use crate::memory;
use crate::source::Disk;
use crate::tables::root::ROOT;
use crate::tables::{Scene, Transfer, TransferKind};
use std::io;
use std::path::Path;

/// Returns the scene with every default filled in, as the text of a scene file ([SCN-3]). Reading the text gives the
/// scene again. Only colours of a scene that was not read from a file may be rounded. Relative paths start at the
/// working directory.
pub fn write_full(scene: &Scene) -> String {
    full::write(&ROOT, scene, |out| out)
}

/// Returns the text of [`write_full`] with every path cut to its last name. The same scene gives the same text in every
/// folder and on every machine. A picture's metadata holds the text's hash ([IO-2]).
pub fn identity(scene: &Scene) -> String {
    full::write(&ROOT, scene, full::without_folders)
}

/// Returns the keys, such as `contours.kappa`, whose values differ from another scene's, and the tables with such keys.
pub fn differences(scene: &Scene, other: &Scene) -> Vec<String> {
    full::differences(&ROOT, scene, other)
}

/// The JSON Schema (2020-12) of a scene file, with the documentation and the default of every key. Keys that are not
/// built yet are left out.
pub fn schema() -> serde_json::Value {
    schema::document("Drypoint scene", &ROOT.section())
}

/// A page of Markdown with every table and key: what may stand there, the default, what it does, what it can make a
/// picture compute ([PLAN-1]), and the rule, which `rules.md` explains.
pub fn reference_markdown() -> String {
    reference::page("Scene file reference", &ROOT.section())
}

/// Reads a scene from the text of a file. Relative paths are resolved against the folder of `file_name`, those of
/// overrides against the working directory. No file that the scene names is opened; only a theme's folder is listed,
/// for the names of styles.
///
/// # Errors
/// Every fault of the text and of the overrides, with its place ([SCN-4]).
pub fn parse(text: &str, file_name: &Path, overrides: &Overrides) -> Result<Scene, Faults> {
    let mut check = Check::new(file_name);
    let scene = read(text, None, overrides, &mut check);
    finish(scene, |scene| &mut scene.given, check)
}

/// Reads a scene file. A volume that is not beside the scene is looked for in [`data_folders`].
///
/// # Errors
/// A file that cannot be read, every fault of its text and of the overrides, and every file or folder that the scene
/// names and that is not there.
pub fn load(path: &Path, overrides: &Overrides) -> Result<Scene, Faults> {
    load_over(path, None, overrides)
}

/// Reads a scene from a text that stands in place of the text of a file, such as one that is being edited. Otherwise like
/// [`load`].
///
/// # Errors
/// Every fault of the text, and every file or folder that the scene names and that is not there.
pub fn load_text(text: &str, path: &Path, overrides: &Overrides) -> Result<Scene, Faults> {
    let mut check = Check::new(path);
    let scene = read(text, None, overrides, &mut check);
    found(scene, check)
}

/// Reads a scene file for another volume than its own, or a template, which has none ([VS-11]). The volume's file takes
/// the place of `volume.file` or `volume.phantom`. If the scene has one of them, its `raw`, `box` and `labels` go too;
/// every other key stays.
///
/// # Errors
/// Same errors as [`load`].
pub fn load_for(path: &Path, volume: &Path, overrides: &Overrides) -> Result<Scene, Faults> {
    load_over(path, Some(volume), overrides)
}

fn load_over(path: &Path, volume: Option<&Path>, overrides: &Overrides) -> Result<Scene, Faults> {
    let mut check = Check::new(path);
    let scene = text(path, &mut check).and_then(|text| read(&text, volume, overrides, &mut check));
    found(scene, check)
}

/// Looks for the files of a scene that was read, and returns it, or the faults.
fn found(mut scene: Option<Scene>, mut check: Check) -> Result<Scene, Faults> {
    if let Some(scene) = &mut scene {
        find::files(scene, &mut check, &data_folders());
    }
    finish(scene, |scene| &mut scene.given, check)
}

/// The most bytes of a scene's text. A list of 100000 nodes has about 6 MiB.
const LONGEST_TEXT: usize = 1 << 24;

/// Walks a text. The scene is whole only if the walk found no fault; until then it holds what passed.
fn read(text: &str, volume: Option<&Path>, overrides: &Overrides, check: &mut Check) -> Option<Scene> {
    let mut document = document(text, check)?;
    let replaced = volume.map(|volume| template::Replaced::new(&mut document, volume));
    overrides.apply(&ROOT, &mut document, check);
    let mut scene = check.table(&ROOT, &document)?;
    if let Some(replaced) = replaced {
        replaced.finish(&mut scene, check);
    }
    checks::check(&scene, check);
    if scene.would_draw_nothing() {
        scene.transfer = Some(Transfer::automatic(TransferKind::Style));
    }
    Some(scene)
}

/// Parses a text.
fn document(text: &str, check: &mut Check) -> Option<Item> {
    if text.len() > LONGEST_TEXT {
        let reason = format!("it has {} bytes, and at most {LONGEST_TEXT} are read", text.len());
        check.fault(&Place::File { line: 1, column: 1 }, Problem::Unreadable { reason });
        return None;
    }
    let document = Item::document(text);
    let faults =
        document.map_err(|faults| faults.into_iter().for_each(|(place, problem)| check.fault(&place, problem)));
    faults.ok()
}

/// Reads the text of a file.
fn text(path: &Path, check: &mut Check) -> Option<String> {
    let text = memory::read_to_string(&Disk, path);
    let unreadable = |e: io::Error| {
        check.fault(&Place::File { line: 1, column: 1 }, Problem::Unreadable { reason: e.to_string() });
    };
    text.map_err(unreadable).ok()
}

/// Returns what was read, with the places of its keys, or the faults.
fn finish<T>(read: Option<T>, given: fn(&mut T) -> &mut Given, check: Check) -> Result<T, Faults> {
    let (places, faults) = check.done();
    match (read, Faults::new(faults)) {
        (Some(mut read), None) => {
            *given(&mut read) = places;
            Ok(read)
        }
        (_, Some(faults)) => Err(faults),
        // Nothing is read only after a fault was reported.
        (None, None) => unreachable!("nothing read and no fault"),
    }
}
