//! The list of pictures that are made from scenes.

use drypoint::output::sheet::Layout;
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
    /// Scenes side by side.
    Sheet { parts: Vec<PathBuf>, layout: Layout },
}

impl Source {
    /// The files of its scenes.
    pub(super) fn scenes(&self) -> &[PathBuf] {
        match self {
            Self::Scene(path) | Self::Default(path) => std::slice::from_ref(path),
            Self::Sheet { parts, .. } => parts,
        }
    }
}

/// A figure of several scenes: its room, its name, its parts, pixels along the side of a cell, and cells in a row.
const SHEETS: [(&str, &str, &str, usize, usize); 9] = [
    ("volumeshop", "figure_1", "ab", 440, 2),
    ("volumeshop", "figure_5", "abcd", 440, 2),
    ("volumeshop", "figure_6", "abc", 320, 3),
    ("volumetric_halos", "figure_5", "abcdef", 320, 3),
    ("volumetric_halos", "figure_6", "abcd", 330, 2),
    ("volumetric_halos", "figure_7", "abc", 400, 3),
    ("volumetric_halos", "figure_8", "ab", 440, 2),
    ("volumetric_halos", "figure_9", "ab", 440, 2),
    ("volumetric_halos", "figure_10", "abcd", 340, 2),
];

/// Parts of halos' sheets that are also shown large.
const LARGE_PARTS: [&str; 1] = ["figure_9_b"];

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
/// The system's failure to read the folder of scenes.
pub(super) fn all() -> Result<Vec<DocPicture>, String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/scenes");
    let mut pictures =
        vec![DocPicture { file: "pictures/default.png".into(), source: Source::Default(root.join("default.toml")) }];
    for folder in entries(&root)?.iter().filter(|path| path.is_dir() && !path.ends_with("cost")) {
        let room = folder.file_name().unwrap_or_default().display().to_string();
        for scene in entries(folder)?.into_iter().filter(|path| path.extension().is_some_and(|e| e == "toml")) {
            let stem = scene.file_stem().unwrap_or_default().display().to_string();
            if has_picture(&room, &stem) {
                pictures.push(DocPicture { file: format!("pictures/{room}/{stem}.png"), source: Source::Scene(scene) });
            }
        }
    }
    pictures.extend(SHEETS.map(|(room, figure, parts, cell, columns)| {
        let parts = parts.chars().map(|part| root.join(room).join(format!("{figure}_{part}.toml"))).collect();
        let layout = Layout { columns: Some(columns), cell };
        DocPicture { file: format!("pictures/{room}/{figure}.png"), source: Source::Sheet { parts, layout } }
    }));
    pictures.sort_by(|a, b| a.file.cmp(&b.file));
    Ok(pictures)
}

/// Whether a scene has a picture of its own. The parts of Fig. 1 of styles are laid out beside the painting.
fn has_picture(room: &str, stem: &str) -> bool {
    let on_a_sheet = match room {
        "volumetric_halos" => stem.starts_with("figure_") && !LARGE_PARTS.contains(&stem),
        "volumeshop" => ["figure_1_", "figure_5_", "figure_6_"].iter().any(|sheet| stem.starts_with(sheet)),
        "style_transfer_functions" => stem.starts_with("figure_1_") || stem.ends_with("_regular"),
        _ => false,
    };
    !on_a_sheet && !WITHOUT.contains(&stem)
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
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/scenes");
        let there: Vec<PathBuf> =
            entries(&root).unwrap().iter().filter(|p| p.is_dir()).flat_map(|p| entries(p).unwrap()).collect();
        for name in WITHOUT.iter().chain(&LARGE_PARTS) {
            assert!(there.iter().any(|path| path.file_stem().is_some_and(|stem| stem == *name)), "{name}");
        }
    }
}
