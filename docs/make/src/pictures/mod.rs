//! The pictures of scenes in `docs/pictures`: which there are, how they are made, and whether they are up to date.

mod catalogue;
mod encode;
mod fingerprints;
mod of_scene;
mod window;

use crate::files;
use catalogue::{DocPicture, Source};
use drypoint::Failures;
use drypoint::figure::{DrawnPanel, FigureLayout};
use drypoint::job::Job;
use drypoint::scene::file::load;
use drypoint::scene::picture::Picture;
use drypoint::scene::tables::{Figure, Scene};
use fingerprints::Fingerprints;
use of_scene::Encode;

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
        let mut scenes = Vec::new();
        for (path, overrides) in self.source.scenes()? {
            scenes.push(load(&path, &overrides).map_err(|e| e.to_string())?);
        }
        let (picture, encode) = match &self.source {
            Source::Scene(_) => of_scene::picture(scenes.remove(0))?,
            Source::Default(_) => {
                scenes[0].picture.size = DEFAULT_SIZE;
                of_scene::picture(scenes.remove(0))?
            }
            Source::Figure(path) => {
                let page = page(&catalogue::figure(path)?, scenes).map_err(|e| e.to_string())?;
                (page, encode::opaque_png as Encode)
            }
            Source::Window(path, panel) => (window::picture(path, panel)?, encode::opaque_png as Encode),
        };
        let bytes = encode(&picture).map_err(|e| e.to_string())?;
        if bytes.len() > LARGEST {
            return Err(format!("{} bytes, more than {LARGEST}: make scene or figure smaller", bytes.len()));
        }
        Ok(bytes)
    }
}

/// Draws the scenes of a figure on its page.
fn page(figure: &Figure, scenes: Vec<Scene>) -> Result<Picture, Failures> {
    let sizes: Vec<[usize; 2]> = scenes.iter().map(|scene| scene.picture.size).collect();
    let layout = FigureLayout::new(figure, &sizes)?;
    let panel = |(mut scene, place)| {
        layout.fit(&mut scene, place);
        Ok(DrawnPanel::draw(&Job::load(scene)?, &layout, place, None, &|_| ())?)
    };
    let panels = scenes.into_iter().zip(layout.places()).map(panel).collect::<Result<Vec<_>, Failures>>()?;
    Ok(layout.paint_panels(panels)?)
}
