//! Finding the files that a scene names ([SCN-2]).

use crate::document::check::Check;
use crate::document::out;
use crate::document::{Place, Problem};
use crate::nearest::nearest;
use crate::tables::styles::THEMES;
use crate::tables::{Axis, Background, Figure, Over, PanelSource, Scene, StyleSource, Transfer, VolumeSource};
use std::path::{Path, PathBuf};

/// The variable that lists folders of volumes.
const VARIABLE: &str = "DRYPOINT_DATA";

/// The folder of volumes beside a source tree, from its root. Only programs that run there find it.
const BESIDE_THE_SOURCE: &str = "../shared/data";

/// The folders to search for a volume that is not at the scene's path: those of the environment variable
/// `DRYPOINT_DATA`, separated as in `PATH`. The default is `../shared/data`, if it exists.
pub fn data_folders() -> Vec<PathBuf> {
    match std::env::var_os(VARIABLE) {
        Some(list) => std::env::split_paths(&list).filter(|folder| !folder.as_os_str().is_empty()).collect(),
        None => Some(PathBuf::from(BESIDE_THE_SOURCE)).filter(|folder| folder.is_dir()).into_iter().collect(),
    }
}

/// Looks for every file and folder that the scene names, and says which are not there.
pub(super) fn files(scene: &mut Scene, check: &mut Check, folders: &[PathBuf]) {
    for (path, key) in data(scene) {
        must_be_found(path, &key, check, folders);
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

/// Looks for every file that a figure names, and says which are not there.
pub(super) fn panels(figure: &mut Figure, check: &mut Check, folders: &[PathBuf]) {
    for (i, panel) in figure.panels.iter_mut().enumerate() {
        let insets = panel.insets.iter_mut().enumerate();
        let insets = insets.map(|(j, inset)| (format!("panel[{i}].inset[{j}]"), &mut inset.source));
        for (table, source) in std::iter::once((format!("panel[{i}]"), &mut panel.source)).chain(insets) {
            let PanelSource { scene, volume, picture, .. } = source;
            for (key, path) in [("scene", scene), ("volume", volume), ("picture", picture)] {
                if let Some(path) = path {
                    must_be_found(path, &format!("{table}.{key}"), check, folders);
                }
            }
        }
    }
}

/// Every file of data that the scene names, with its key.
fn data(scene: &mut Scene) -> Vec<(&mut PathBuf, String)> {
    let mut all = Vec::new();
    let volume = &mut scene.volume;
    if let VolumeSource::File { path, .. } = &mut volume.source {
        all.push((path, "volume.file".into()));
    }
    all.extend(volume.labels.as_mut().map(|path| (path, "volume.labels".into())));
    all.extend(volume.label_names.as_mut().map(|path| (path, "volume.label_names".into())));
    all.extend(of_function(scene.transfer.as_mut(), "transfer".into()));
    for (i, object) in scene.objects.iter_mut().enumerate() {
        let key = |name: &str| format!("object[{i}].{name}");
        all.extend(object.volume.as_mut().map(|path| (path, key("volume"))));
        all.extend(object.labels.as_mut().map(|path| (path, key("labels"))));
        all.extend(object.label_names.as_mut().map(|path| (path, key("label_names"))));
        all.extend(object.selection.as_mut().map(|path| (path, key("selection"))));
        all.extend(of_function(object.transfer.as_mut(), key("transfer")));
        let ghost = object.ghost.as_mut().and_then(|ghost| ghost.transfer.as_mut());
        all.extend(of_function(ghost, key("ghost.transfer")));
    }
    let meshes = scene.meshes.iter_mut().enumerate();
    all.extend(meshes.map(|(i, mesh)| (&mut mesh.file, format!("mesh[{i}].file"))));
    all
}

/// The volumes whose values a transfer function is over, with their keys. `table` is the function's own.
fn of_function(transfer: Option<&mut Transfer>, table: String) -> impl Iterator<Item = (&mut PathBuf, String)> {
    let axes = match transfer.map(|transfer| &mut transfer.over) {
        Some(Over::Two(axes)) => axes.as_mut_slice(),
        Some(Over::Value) | None => &mut [],
    };
    axes.iter_mut().enumerate().filter_map(move |(i, axis)| match axis {
        Axis::Volume(path) => Some((path, format!("{table}.over[{i}].volume"))),
        _ => None,
    })
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
