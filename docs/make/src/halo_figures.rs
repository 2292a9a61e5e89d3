//! Figures 5 to 10 of Bruckner and Gröller 2007 with our own data, each a sheet of its parts, and large pictures beside them.

use crate::figures::{opaque_png, picture};
use crate::files;
use drypoint::output::read::Image;
use drypoint::output::sheet::{Layout, sheet};
use drypoint::scene::picture::Picture;
use std::path::Path;

/// The most bytes of a sheet or of a large picture.
const LARGEST: usize = 600_000;

/// A figure, its parts, pixels along the side of a cell, and cells in a row.
const SHEETS: [(&str, &str, usize, usize); 6] = [
    ("figure_5", "abcdef", 320, 3),
    ("figure_6", "abcd", 330, 2),
    ("figure_7", "abc", 400, 3),
    ("figure_8", "ab", 440, 2),
    ("figure_9", "ab", 440, 2),
    ("figure_10", "abcd", 340, 2),
];

/// Scenes that are shown large.
const LARGE: [&str; 4] = ["vessels", "figure_9_b", "figure_10_d", "nested_shells"];

/// Writes the sheets and the large pictures.
///
/// # Errors
/// What the renderer or the system says, and a file that is too large for a page.
pub(crate) fn write() -> Result<(), String> {
    for name in LARGE {
        put(name, &of_scene(name)?)?;
    }
    for (figure, parts, cell, columns) in SHEETS {
        let part = |letter: char| {
            let name = format!("{figure}_{letter}");
            Ok((name.clone(), Image::from(&of_scene(&name)?)))
        };
        let pictures: Vec<(String, Image)> = parts.chars().map(part).collect::<Result<_, String>>()?;
        let layout = Layout { columns: Some(columns), cell };
        put(figure, &sheet(&pictures, layout).map_err(|e| e.to_string())?)?;
    }
    Ok(())
}

/// The picture of a scene.
fn of_scene(name: &str) -> Result<Picture, String> {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data/scenes/volumetric_halos");
    Ok(picture(&scenes.join(name).with_extension("toml"))?.0)
}

/// Writes a picture beside the others.
fn put(name: &str, picture: &Picture) -> Result<(), String> {
    let bytes = opaque_png(picture).map_err(|e| e.to_string())?;
    if bytes.len() > LARGEST {
        return Err(format!("{name} has {} bytes, more than {LARGEST}: make the picture smaller", bytes.len()));
    }
    files::write(&format!("pictures/volumetric_halos/{name}.png"), &bytes)
}
