//! Scene files: parsing with places, checking, overrides, schema ([IO-3], [SCN-1] … [SCN-4]).
//!
//! A document is walked with its places against the description of the tables (`describe`), which stands with the
//! tables themselves. All faults are collected, and a [`Scene`] is built only from what passed. The same description
//! makes the scene with every default filled in, the JSON Schema and the reference page.
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

pub(crate) mod check;
mod css;
pub(crate) mod describe;
mod embedded;
pub(crate) mod fault;
mod find;
mod full;
pub(crate) mod item;
pub(crate) mod kind;
pub(crate) mod names;
pub(crate) mod out;
mod place;
mod reference;
mod schema;
pub(crate) mod set;
#[cfg(test)]
mod tests;

pub use embedded::DEFAULT_SCENE;
pub use fault::{Fault, Faults, Problem};
pub use find::data_folders;
pub use full::{differences, identity, write_full};
pub use place::{Given, Place};
pub use reference::reference_markdown;
pub use schema::schema;
pub use set::Overrides;

use crate::memory;
use crate::tables::scene::ROOT;
use crate::tables::{Scene, Transfer, TransferKind};
use check::Check;
use item::Item;
use std::path::Path;

/// Reads a scene from the text of a file. Relative paths are resolved against the folder of `file_name`, those of
/// overrides against the working directory. Of the files that the scene names only the folder of a theme is looked at, for
/// the names of its styles.
///
/// # Errors
/// Every fault of the text and of the overrides, with its place ([SCN-4]).
pub fn parse(text: &str, file_name: &Path, overrides: &Overrides) -> Result<Scene, Faults> {
    let mut check = Check::new(file_name);
    let scene = read(text, overrides, &mut check);
    finish(scene, check)
}

/// Reads a scene file. A volume that is not beside the scene is looked for in [`data_folders`].
///
/// # Errors
/// A file that cannot be read, every fault of its text and of the overrides, and every file or folder that the scene
/// names and that is not there.
pub fn load(path: &Path, overrides: &Overrides) -> Result<Scene, Faults> {
    let mut check = Check::new(path);
    let scene = match memory::read_to_string(path) {
        Ok(text) => {
            let mut scene = read(&text, overrides, &mut check);
            if let Some(scene) = &mut scene {
                find::files(scene, &mut check, &data_folders());
            }
            scene
        }
        Err(e) => {
            check.fault(&Place::File { line: 1, column: 1 }, Problem::Unreadable { reason: e.to_string() });
            None
        }
    };
    finish(scene, check)
}

/// Walks a text. The scene is whole only if the walk found no fault; until then it holds what passed.
fn read(text: &str, overrides: &Overrides, check: &mut Check) -> Option<Scene> {
    let mut document = match Item::document(text) {
        Ok(document) => document,
        Err(faults) => {
            for (place, problem) in faults {
                check.fault(&place, problem);
            }
            return None;
        }
    };
    overrides.apply(&mut document, check);
    let mut scene = check.table(&ROOT, &document)?;
    if scene.transfer.is_none() && scene.surface.is_none() && !scene.has_marks() {
        // The preset `style`, for a scene that would draw nothing ([SCN-3]).
        scene.transfer = Some(Transfer::automatic(TransferKind::Style));
    }
    Some(scene)
}

fn finish(scene: Option<Scene>, check: Check) -> Result<Scene, Faults> {
    let (given, faults) = check.done();
    match (scene, Faults::new(faults)) {
        (Some(scene), None) => Ok(Scene { given, ..scene }),
        (_, Some(faults)) => Err(faults),
        // `read` gives no scene only after it has reported a fault.
        (None, None) => unreachable!("no scene and no fault"),
    }
}
