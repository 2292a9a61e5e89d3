//! Documents from what a user opens: a scene file, or a volume, for which a scene is made as the command does.

use crate::document::Document;
use drypoint::job::bare;
use drypoint::scene::counts::Counts;
use drypoint::scene::file::{self, Overrides};
use drypoint::scene::source::Disk;
use drypoint::scene::tables::Scene;
use drypoint::scene::volume::read;
use drypoint::{Failure, Failures};
use std::path::Path;
use toml_edit::{DocumentMut, Item};

/// Width and height of a volume's first picture.
const SIZE: [usize; 2] = [512, 512];

/// The scene of the program itself, which needs no file.
const EXAMPLE: &str = file::DEFAULT_SCENE;

/// Opens a scene file, or makes a document for a volume.
///
/// # Errors
/// A file that cannot be read, or a suffix of neither.
pub fn open(path: &Path) -> Result<Document, Failures> {
    if path.extension().is_some_and(|suffix| suffix.eq_ignore_ascii_case("toml")) {
        let document = Document::open(path)?;
        if file::is_figure(document.text()) {
            let what = "this is a figure of several scenes, and one scene is wanted";
            return Err(Failure::new(what, path.display(), "draw it with drypoint figure").into());
        }
        return Ok(document);
    }
    if !read::is_volume(path) {
        read::refuse_dicom(&Disk, path)?;
        let suffixes = read::EXTENSIONS.map(|suffix| format!(".{suffix}")).join(", ");
        let remedy = format!("scenes end in .toml, volumes in {suffixes}");
        return Err(Failure::new("this is neither a scene nor a volume", path.display(), remedy).into());
    }
    let volume = read::read(path, None)?;
    // The scene lies beside the volume and names it without a folder.
    let name = path.file_name().map_or_else(|| path.into(), Into::into);
    let scene = bare(name, &volume, SIZE, &mut Counts::default())?;
    let stem = path.file_name().and_then(|name| name.to_str()).unwrap_or("scene");
    let stem = read::EXTENSIONS.iter().find_map(|suffix| stem.strip_suffix(&format!(".{suffix}"))).unwrap_or(stem);
    Ok(Document::untitled(short_text(&scene), path.with_file_name(format!("{stem}.toml"))))
}

/// Makes a document of the example scene.
pub fn example() -> Document {
    Document::untitled(EXAMPLE.into(), "drypoint.toml".into())
}

/// Returns the text of a scene with the keys that differ from their defaults. It is the whole text if a shorter one would
/// be another scene.
fn short_text(scene: &Scene) -> String {
    let full = file::write_full(scene);
    let default = Scene::for_volume(scene.volume.source.clone());
    let differing = file::differences(scene, &default);
    let is_kept =
        |key: &str| ["drypoint", "volume.file"].contains(&key) || differing.iter().any(|differs| differs == key);
    let Ok(mut text) = full.parse::<DocumentMut>() else { return full };
    text.retain(|name, item| match item {
        Item::Table(table) => {
            table.retain(|key, _| is_kept(&format!("{name}.{key}")));
            !table.is_empty()
        }
        _ => is_kept(name),
    });
    let short = text.to_string();
    let parse = |text: &str| file::parse(text, Path::new(""), &Overrides::default());
    match (parse(&short), parse(&full)) {
        (Ok(short_scene), Ok(scene)) if file::differences(&short_scene, &scene).is_empty() => short,
        _ => full,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint::scene::file::parse;
    use drypoint::scene::volume::write::write_nrrd;

    #[test]
    fn a_volume_becomes_the_commands_scene_in_few_lines() {
        let text = "drypoint = 1\n[volume]\nphantom = { name = \"torus\", size = 24 }\n";
        let scene = parse(text, Path::new(""), &Overrides::default()).unwrap();
        let volume = drypoint::job::read_volume(&scene, &Disk).unwrap();
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("ring.nrrd");
        write_nrrd(&volume, &path).unwrap();
        let document = open(&path).unwrap();
        assert_eq!(document.path(), folder.path().join("ring.toml"));
        let expected = bare(path.clone(), &volume, SIZE, &mut Counts::default()).unwrap();
        let scene = document.scene().unwrap();
        assert_eq!(file::differences(&scene, &expected), [""; 0]);
        assert!(document.text().lines().count() < 40, "{}", document.text());
        assert!(open(&folder.path().join("ring.txt")).is_err());
    }
}
