//! The list of pictures that are made from scenes and figures.

use crate::files::in_docs;
use drypoint::scene::file::{Overrides, load_figure};
use drypoint::scene::tables::{Figure, PanelCameras, PanelSource};
use std::ffi::OsStr;
use std::path::{Path, PathBuf};

/// A picture of a page.
pub(super) struct DocPicture {
    /// Its path in `docs`.
    pub(super) file: String,
    pub(super) source: Source,
}

/// The scenes of a picture.
pub(super) enum Source {
    /// One scene.
    Scene(PathBuf),
    /// The embedded scene, larger than it is drawn by itself.
    Default(PathBuf),
    /// A figure file.
    Figure(PathBuf),
    /// A scene as the window shows it, with a panel beside it.
    Window(PathBuf, &'static str),
}

impl Source {
    /// The files of its scenes, with the keys that replace theirs.
    ///
    /// # Errors
    /// The faults of a figure file, and a panel that is no scene, or one with another volume or camera.
    pub(super) fn scenes(&self) -> Result<Vec<(PathBuf, Overrides)>, String> {
        match self {
            Self::Scene(path) | Self::Default(path) | Self::Window(path, _) => {
                Ok(vec![(path.clone(), Overrides::default())])
            }
            Self::Figure(path) => panels(&figure(path)?).map_err(|e| format!("{}: {e}", path.display())),
        }
    }
}

/// Reads a figure file.
pub(super) fn figure(path: &Path) -> Result<Figure, String> {
    load_figure(path, &Overrides::default()).map_err(|e| e.to_string())
}

/// The scenes of panels and insets.
fn panels(figure: &Figure) -> Result<Vec<(PathBuf, Overrides)>, String> {
    let scene = |(table, source): (String, &PanelSource)| {
        let plain = source.volume.is_none() && figure.figure.camera == PanelCameras::Own;
        let path = source.scene.clone().filter(|_| plain).ok_or(format!("{table} is not a scene as it is"))?;
        let mut overrides = Overrides::default();
        source.set.iter().try_for_each(|key| overrides.push_argument(key)).map_err(|e| e.to_string())?;
        Ok((path, overrides))
    };
    figure.sources().into_iter().map(scene).collect()
}

/// Panels of halos' figures that are also shown large.
const LARGE_PARTS: [&str; 1] = ["figure_9_b"];

/// The scenes in `docs/pictures/window`, and the panel that the window has open.
const WINDOWS: [(&str, &str); 5] =
    [("cut", "Cuts"), ("function", "Function"), ("looks", "Looks"), ("move", "Objects"), ("paint", "Objects")];

/// Scenes without a picture of their own: they are timed, measured, or drawn as a page to plot.
const WITHOUT: [&str; 8] = [
    "engine-regular",
    "engine-unshaded",
    "outlines-lobster",
    "outlines-skull",
    "skull-outlines-plotter",
    "three_tones",
    "engine-opaque",
    "skull",
];

/// Lists every picture, sorted by its path.
///
/// # Errors
/// The system's failure to read the folders of scenes and figures, and a figure file that is none.
pub(super) fn all() -> Result<Vec<DocPicture>, String> {
    let data = in_docs("../data").canonicalize().map_err(|e| format!("data: {e}"))?;
    let default = Source::Default(data.join("scenes/default.toml"));
    let mut pictures = vec![DocPicture { file: "pictures/default.png".into(), source: default }];
    let mut panels = Vec::new();
    for (room, stem, path) in in_rooms(&data.join("figures"))? {
        let source = Source::Figure(path);
        for (scene, _) in source.scenes()? {
            panels.push(scene.canonicalize().map_err(|e| format!("{}: {e}", scene.display()))?);
        }
        pictures.push(DocPicture { file: format!("pictures/{room}/{stem}.png"), source });
    }
    for (room, stem, scene) in in_rooms(&data.join("scenes"))? {
        let is_panel = panels.contains(&scene) && !LARGE_PARTS.contains(&&*stem);
        if !is_panel && has_picture(&room, &stem) {
            pictures.push(DocPicture { file: format!("pictures/{room}/{stem}.png"), source: Source::Scene(scene) });
        }
    }
    pictures.extend(WINDOWS.map(|(stem, panel)| {
        let file = format!("pictures/window/{stem}");
        DocPicture { source: Source::Window(in_docs(&format!("{file}.toml")), panel), file: format!("{file}.png") }
    }));
    pictures.sort_by(|a, b| a.file.cmp(&b.file));
    Ok(pictures)
}

/// Whether a scene that is no panel has a picture of its own. The parts of Fig. 1 of styles are laid out beside the
/// painting.
fn has_picture(room: &str, stem: &str) -> bool {
    let is_laid_out =
        room == "style_transfer_functions" && (stem.starts_with("figure_1_") || stem.ends_with("_regular"));
    room != "cost" && !is_laid_out && !WITHOUT.contains(&stem)
}

/// Room, name and path of the files in the folders of a folder.
fn in_rooms(folder: &Path) -> Result<Vec<(String, String, PathBuf)>, String> {
    let name = |name: Option<&OsStr>| name.unwrap_or_default().display().to_string();
    let mut found = Vec::new();
    for room in entries(folder)?.iter().filter(|path| path.is_dir()) {
        let files = entries(room)?.into_iter().filter(|path| path.extension().is_some_and(|e| e == "toml"));
        found.extend(files.map(|path| (name(room.file_name()), name(path.file_stem()), path)));
    }
    Ok(found)
}

/// The paths in a folder.
fn entries(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let read = std::fs::read_dir(folder).and_then(Iterator::collect::<Result<Vec<_>, _>>);
    Ok(read.map_err(|e| format!("{}: {e}", folder.display()))?.iter().map(std::fs::DirEntry::path).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_exception_is_a_scene() {
        let there = in_rooms(&in_docs("../data/scenes")).unwrap();
        for name in WITHOUT.iter().chain(&LARGE_PARTS) {
            assert!(there.iter().any(|(_, stem, _)| stem == *name), "{name}");
        }
    }
}
