//! Looks: the tables of a scene that say how a volume is drawn, whatever the volume and the camera. The presets of the
//! format are looks, and users keep their own.

use crate::background::{Background, Desk};
use crate::document::Document;
use crate::frames::{Frame, picks};
use crate::page::draw;
use crate::paths::absolute_paths;
use crate::schema::{Kind, Node, ValueKind};
use drypoint::Failures;
use drypoint::scene::atomic;
use drypoint::scene::file::{self, Overrides};
use drypoint::scene::tables::RaysPerPixel;
use drypoint::scene::volume::Volume;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use toml_edit::DocumentMut;

/// The keys and tables that make a look. All others belong to the volume, the camera, the page, or places in the volume.
const TABLES: [&str; 12] = [
    "preset",
    "light",
    "transfer",
    "styles",
    "shading",
    "contours",
    "style_mipmaps",
    "halo",
    "stipples",
    "hatching",
    "outlines",
    "surface",
];

/// The pens, which a look brings if it has some. Those of the scene stay otherwise: annotations may draw with them.
const PENS: &str = "pen";

/// Pixels of the longer side of a picture.
const SIDE: usize = 336;

/// A look.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Look {
    /// The name: of a preset, or of the file that keeps an own look.
    pub name: String,
    /// A sentence about it.
    pub doc: String,
    /// Its tables, as a scene file has them.
    pub text: String,
    /// The file of an own look.
    pub file: Option<PathBuf>,
}

/// Returns the presets of the format, and the looks that are kept in a folder.
pub fn all(folder: Option<&Path>) -> Vec<Look> {
    let of_format = presets().into_iter().map(|(name, doc)| {
        let text = format!("preset = \"{name}\"\n");
        Look { name, doc, text, file: None }
    });
    let files = folder.and_then(|folder| fs::read_dir(folder).ok()).into_iter().flatten().flatten();
    let mut own: Vec<Look> = files.filter_map(|file| read(&file.path())).collect();
    own.sort_by(|a, b| a.name.cmp(&b.name));
    own.into_iter().chain(of_format).collect()
}

/// The names and meanings of the presets.
fn presets() -> Vec<(String, String)> {
    let preset = Node::scene().children().iter().find(|node| node.name == "preset").cloned();
    match preset.map(|preset| preset.kind) {
        Some(Kind::Value(ValueKind::Choice(choices))) => choices,
        _ => Vec::new(),
    }
}

fn read(path: &Path) -> Option<Look> {
    let name = path.file_name()?.to_str()?.strip_suffix(".toml")?.to_owned();
    let text = fs::read_to_string(path).ok()?;
    text.parse::<DocumentMut>().ok()?;
    Some(Look { name, doc: "A look of your own.".into(), text, file: Some(path.into()) })
}

/// Keeps the look of a document in a folder by a name, in place of one with that name. Characters that a file's name cannot
/// have become underscores.
///
/// # Errors
/// A scene with faults, or errors of the operating system.
pub fn keep(document: &Document, folder: &Path, name: &str) -> Result<(), String> {
    let toml: DocumentMut = document.text().parse().map_err(|_| "the text of the scene cannot be read".to_owned())?;
    // The look is used with scenes in other folders.
    let text = absolute_paths(&toml, document.path()).map_err(|failures| failures.to_string())?;
    let mut look: DocumentMut = text.parse().map_err(|_| "the text of the scene cannot be read".to_owned())?;
    look.retain(|key, _| is_of_look(key));
    let is_plain = |c: char| c.is_alphanumeric() || " -_".contains(c);
    let name: String = name.trim().chars().map(|c| if is_plain(c) { c } else { '_' }).collect();
    let file = folder.join(format!("{name}.toml"));
    let written = fs::create_dir_all(folder)
        .and_then(|()| atomic::write(&file, |out: &mut dyn Write| out.write_all(look.to_string().as_bytes())));
    written.map_err(|error: io::Error| format!("{}: {error}", file.display()))
}

fn is_of_look(key: &str) -> bool {
    TABLES.contains(&key) || key == PENS
}

/// Returns the text of a scene with another look; none if one of the two is no TOML.
pub fn applied(scene: &str, look: &str) -> Option<String> {
    let (mut scene, look) = (scene.parse::<DocumentMut>().ok()?, look.parse::<DocumentMut>().ok()?);
    TABLES.iter().for_each(|key| drop(scene.remove(key)));
    for (key, item) in look.iter().filter(|(key, _)| is_of_look(key)) {
        scene.insert(key, item.clone());
    }
    Some(scene.to_string())
}

/// A question: how does a volume look with some looks?
pub(crate) struct LooksQuery {
    /// A number of the question, which the answers name.
    pub(crate) number: u64,
    /// The text and the file of the scene.
    pub(crate) scene: (String, PathBuf),
    pub(crate) volume: Arc<Volume>,
    pub(crate) looks: Vec<Look>,
}

/// An answer: the number of the question, the index of the look, and its picture, or the reason why there is none.
pub(crate) type LookPicture = (u64, usize, Result<Frame, Failures>);

/// Starts the thread that draws looks, one after the other. `wake` is called after each answer, on the thread.
pub(crate) fn painter(wake: Box<dyn Fn() + Send>) -> Background<LooksQuery, LookPicture> {
    Background::new("looks", wake, |desk: Desk<LooksQuery, LookPicture>| {
        while let Some(query) = desk.wait() {
            for (i, look) in query.looks.iter().enumerate() {
                let stop = desk.mailbox.stop();
                match picture(&query, look, stop).transpose() {
                    Some(drawn) => desk.answer((query.number, i, drawn)),
                    None => break,
                }
                if stop.load(Ordering::Relaxed) {
                    break;
                }
            }
        }
    })
}

/// Draws a scene with a look, small and with a ray a pixel. Returns none if it is stopped.
fn picture(query: &LooksQuery, look: &Look, stop: &AtomicBool) -> Result<Option<Frame>, Failures> {
    let (text, path) = &query.scene;
    let text = applied(text, &look.text).unwrap_or_default();
    let mut scene = file::load_text(&text, path, &Overrides::default())?;
    // Places at pixels would be others.
    if !picks(&scene) {
        let [width, height] = scene.picture.size;
        let longest = width.max(height).max(1);
        scene.picture.size = [width, height].map(|n| (n * SIDE).div_ceil(longest).max(1));
        // The page keeps its size.
        scene.picture.dpi *= SIDE as f64 / longest as f64;
    }
    scene.picture.samples = RaysPerPixel::Across(1);
    draw(query.number, scene, Arc::clone(&query.volume), None, stop)
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCENE: &str = "# A ring.\ndrypoint = 1\nlight = [0, 0, 1] # above\n\n[volume]\nphantom = { name = \"torus\", size = 16 }\n\n[transfer]\nkind = \"style\"\n\n[camera]\nfov = 20\n";

    #[test]
    fn a_look_takes_the_place_of_the_one_before() {
        let hatched = applied(SCENE, "preset = \"hatch\"\n").unwrap();
        let expected = "# A ring.\ndrypoint = 1\npreset = \"hatch\"\n\n[volume]\nphantom = { name = \"torus\", size = 16 }\n\n[camera]\nfov = 20\n";
        assert_eq!(hatched, expected);
        let scene = |text: &str| Document::untitled(text.into(), "a.toml".into()).scene().unwrap();
        assert!(scene(&hatched).hatching.is_some() && scene(&hatched).transfer.is_none());
        assert_eq!(
            scene(&applied(&hatched, "light = [0, 0, 1]\n[transfer]\nkind = \"style\"\n").unwrap()),
            scene(SCENE)
        );
        assert_eq!(applied("[", ""), None);
    }

    #[test]
    fn a_look_is_kept_without_volume_and_camera() {
        let folder = tempfile::tempdir().unwrap();
        let document = Document::untitled(SCENE.into(), folder.path().join("a.toml"));
        let looks = folder.path().join("looks");
        assert!(all(Some(&looks)).iter().all(|look| look.file.is_none()));
        keep(&document, &looks, " my/own ").unwrap();
        let kept = all(Some(&looks)).remove(0);
        assert_eq!((kept.name.as_str(), &kept.file), ("my_own", &Some(looks.join("my_own.toml"))));
        // Named pens come along, and what is no look does not.
        let drawn = format!("{SCENE}[[pen]]\nname = \"fine\"\n[stipples]\npen = \"fine\"\n");
        let document = Document::untitled(drawn, folder.path().join("a.toml"));
        keep(&document, &looks, "pens").unwrap();
        let pens = all(Some(&looks)).into_iter().find(|look| look.name == "pens").unwrap();
        let text = applied(SCENE, &format!("{}\n[picture]\nsize = [8, 8]\n", pens.text)).unwrap();
        let scene_of_pens = Document::untitled(text.clone(), "a.toml".into()).scene().unwrap();
        assert!(scene_of_pens.pens.len() == 1 && !text.contains("[picture]"), "{text}");
        assert!(!kept.text.contains("camera") && !kept.text.contains("volume"), "{}", kept.text);
        let scene = |text: &str| Document::untitled(text.into(), "a.toml".into()).scene().unwrap();
        assert_eq!(scene(&applied(SCENE, &kept.text).unwrap()), scene(SCENE));
    }

    #[test]
    fn presets_are_looks_of_scenes_without_faults() {
        let looks = all(None);
        assert!(looks.len() > 15 && looks.iter().any(|look| look.name == "halo"));
        for look in looks {
            let document = Document::untitled(applied(SCENE, &look.text).unwrap(), "a.toml".into());
            assert!(document.scene().is_ok(), "{}", look.name);
        }
    }
}
