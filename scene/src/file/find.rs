//! Finding the files that a scene names ([SCN-2]).

use crate::document::check::Check;
use crate::document::out;
use crate::document::{Place, Problem};
use crate::nearest::nearest;
use crate::tables::styles::THEMES;
use crate::tables::{Axis, Background, Over, Scene, StyleSource, VolumeSource};
use std::path::{Path, PathBuf};

/// The variable that lists folders of volumes.
const VARIABLE: &str = "DRYPOINT_DATA";

/// The folder of volumes beside a source tree, from its root. Only programs that run there find it.
const BESIDE_THE_SOURCE: &str = "../shared/data";

/// The folders in which a volume is looked for that is not where the scene says: those of the environment variable
/// `DRYPOINT_DATA`, separated as in `PATH`; without the variable `../shared/data`, if it is there.
pub fn data_folders() -> Vec<PathBuf> {
    match std::env::var_os(VARIABLE) {
        Some(list) => std::env::split_paths(&list).filter(|folder| !folder.as_os_str().is_empty()).collect(),
        None => Some(PathBuf::from(BESIDE_THE_SOURCE)).filter(|folder| folder.is_dir()).into_iter().collect(),
    }
}

/// Looks for every file and folder that the scene names, and says which are not there.
pub(super) fn files(scene: &mut Scene, check: &mut Check, folders: &[PathBuf]) {
    let volume = &mut scene.volume;
    if let VolumeSource::File { path, .. } = &mut volume.source {
        must_be_found(path, "volume.file", check, folders);
    }
    for (path, key) in [(&mut volume.labels, "volume.labels"), (&mut volume.label_names, "volume.label_names")] {
        if let Some(path) = path {
            must_be_found(path, key, check, folders);
        }
    }
    if let Some(Over::Two(axes)) = scene.transfer.as_mut().map(|transfer| &mut transfer.over) {
        for (i, axis) in axes.iter_mut().enumerate() {
            if let Axis::Volume(path) = axis {
                must_be_found(path, &format!("transfer.over[{i}].volume"), check, folders);
            }
        }
    }
    for (i, mesh) in scene.meshes.iter_mut().enumerate() {
        must_be_found(&mut mesh.file, &format!("mesh[{i}].file"), check, folders);
    }
    if let Background::Picture(path) = &scene.picture.background {
        must_exist(path, "picture.background", check);
    }
    for (name, file) in &scene.styles.files {
        let key = format!("styles.{}", out::key(name));
        must_exist(&file.path, &key, check);
    }
    if let StyleSource::Folder(path) = &scene.styles.theme
        && !path.is_dir()
        && let Some(place) = sound(check, "styles.theme")
    {
        let known: Vec<String> = THEMES.map(Into::into).to_vec();
        let name = check.unresolved(path, &place).to_string_lossy().into_owned();
        let nearest = nearest(&name, known.iter().map(String::as_str)).map(Into::into);
        let problem = Problem::Reference { what: "theme or folder".into(), name, nearest, known };
        check.fault_of("styles.theme".into(), &place, problem);
    }
}

/// The place of a key that the scene says and that nothing is wrong with so far.
fn sound(check: &Check, key: &str) -> Option<Place> {
    check.place(key).filter(|_| check.sound(&[key])).cloned()
}

/// Puts the place where a file of the data was found for its path.
fn must_be_found(path: &mut PathBuf, key: &str, check: &mut Check, folders: &[PathBuf]) {
    let Some(place) = sound(check, key) else { return };
    match find(path, check.unresolved(path, &place), folders) {
        Some(found) => *path = found,
        None => {
            let listed: Vec<String> = folders.iter().map(|folder| folder.display().to_string()).collect();
            let also = if listed.is_empty() {
                format!("{VARIABLE} lists no folder with it")
            } else {
                format!("nor is it in {}", listed.join(" or "))
            };
            let problem = Problem::NoFile { path: path.clone(), remedy: format!("write another path; {also}") };
            check.fault_of(key.into(), &place, problem);
        }
    }
}

fn must_exist(path: &Path, key: &str, check: &mut Check) {
    if !path.is_file()
        && let Some(place) = sound(check, key)
    {
        let remedy = "write the path of a picture that is there".into();
        check.fault_of(key.into(), &place, Problem::NoFile { path: path.to_owned(), remedy });
    }
}

/// The path, or else what the scene wrote in the first folder that has it.
fn find(path: &Path, written: &Path, folders: &[PathBuf]) -> Option<PathBuf> {
    let in_folders = folders.iter().map(|folder| folder.join(written));
    std::iter::once(path.to_owned()).chain(in_folders).find(|path| path.exists())
}
