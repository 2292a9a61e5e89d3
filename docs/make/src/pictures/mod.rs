//! The pictures of scenes in `docs/pictures`: which there are, how they are made, and whether they are up to date.

mod catalogue;
mod encode;
mod fingerprints;
mod of_scene;

use crate::files;
use catalogue::{DocPicture, Source};
use drypoint::output::read::Image;
use drypoint::output::sheet::{Layout, sheet};
use drypoint::scene::file::{Overrides, load};
use drypoint::scene::picture::Picture;
use drypoint::scene::tables::Scene;
use fingerprints::Fingerprints;
use of_scene::Encode;
use std::path::{Path, PathBuf};

/// The most bytes of a picture in `docs`.
const LARGEST: usize = 600_000;

/// Width and height of the picture of the embedded scene.
const DEFAULT_SIZE: [usize; 2] = [880, 880];

/// Renders every picture that is older than its scene. Words after the command select pictures by a part of their path;
/// those are rendered in any case.
///
/// # Errors
/// The failure of the renderer or the system, and a file that is too large for a page.
pub(crate) fn write() -> Result<(), String> {
    let asked: Vec<String> = std::env::args().skip(2).collect();
    let mut made = Fingerprints::read()?;
    for entry in catalogue::all()? {
        let fingerprint = entry.fingerprint()?;
        let due = if asked.is_empty() {
            made.of(&entry.file) != Some(&fingerprint)
        } else {
            asked.iter().any(|part| entry.file.contains(part))
        };
        if due {
            let bytes = entry.png().map_err(|e| format!("{}: {e}", entry.file))?;
            files::write(&entry.file, &bytes)?;
            made.set(&entry.file, fingerprint);
            made.write()?;
        }
    }
    Ok(())
}

impl DocPicture {
    /// Renders the picture and encodes it.
    fn png(&self) -> Result<Vec<u8>, String> {
        let (picture, encode) = match &self.source {
            Source::Scene(path) => of_scene::picture(scene(path)?)?,
            Source::Default(path) => {
                let mut scene = scene(path)?;
                scene.picture.size = DEFAULT_SIZE;
                of_scene::picture(scene)?
            }
            Source::Sheet { parts, layout } => (contact_sheet(parts, *layout)?, encode::opaque_png as Encode),
        };
        let bytes = encode(&picture).map_err(|e| e.to_string())?;
        if bytes.len() > LARGEST {
            return Err(format!("{} bytes, more than {LARGEST}: make the scene's picture smaller", bytes.len()));
        }
        Ok(bytes)
    }
}

/// Reads a scene of a picture.
fn scene(path: &Path) -> Result<Scene, String> {
    load(path, &Overrides::default()).map_err(|e| e.to_string())
}

/// Renders scenes side by side, each with its name.
fn contact_sheet(parts: &[PathBuf], layout: Layout) -> Result<Picture, String> {
    let part = |path: &PathBuf| {
        let name = path.file_stem().unwrap_or_default().display().to_string();
        Ok((name, Image::from(&of_scene::picture(scene(path)?)?.0)))
    };
    let pictures: Vec<(String, Image)> = parts.iter().map(part).collect::<Result<_, String>>()?;
    sheet(&pictures, layout).map_err(|e| e.to_string())
}
