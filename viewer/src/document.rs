//! The scene file as a document: its text, its file, and changes that can be undone.

use crate::edit::{self, EditError};
use crate::history::History;
use crate::key::KeyPath;
use crate::paths::absolute_paths;
use drypoint::scene::atomic;
use drypoint::scene::file::{self, Overrides};
use drypoint::scene::tables::Scene;
use drypoint::{Failure, Failures};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::SystemTime;
use toml_edit::{DocumentMut, InlineTable, Item, Value};

/// A scene's text while it is edited. Every change is a change of keys, and keeps the comments and the layout of
/// everything else.
///
/// ```
/// use drypoint_viewer::document::Document;
/// let text = "drypoint = 1\n[volume]\nphantom.name = \"torus\" # a ring\n";
/// let mut document = Document::untitled(text.into(), "torus.toml".into());
/// document.set(&"volume.phantom.name".into(), "sphere")?;
/// document.set(&"camera.fov".into(), 40)?;
/// assert_eq!(document.text(), "drypoint = 1\n[volume]\nphantom.name = \"sphere\" # a ring\n\n[camera]\nfov = 40\n");
/// assert!(document.scene().is_ok());
/// document.undo();
/// document.undo();
/// assert_eq!(document.text(), text);
/// # Ok::<(), drypoint_viewer::edit::EditError>(())
/// ```
#[derive(Debug)]
pub struct Document {
    /// The file, or the suggested one of an untitled document.
    path: PathBuf,
    is_untitled: bool,
    text: String,
    /// The text as TOML; none while another editor left a text that is none.
    toml: Option<DocumentMut>,
    /// The text of the file.
    saved: String,
    /// The file's time of modification when it was last read or written.
    stamp: Option<SystemTime>,
    history: History,
    revision: u64,
}

/// One edit of a list of edits.
#[derive(Clone, Debug)]
pub enum Edit {
    /// Gives a key a value.
    Set(KeyPath, Value),
    /// Removes a key, if it is there.
    Remove(KeyPath),
    /// Inserts a table into a list before an index, or at the end of the list.
    Insert(KeyPath, usize, InlineTable),
}

impl Edit {
    /// An edit that gives a key a value.
    pub fn set(key: impl Into<KeyPath>, value: impl Into<Value>) -> Self {
        Self::Set(key.into(), value.into())
    }

    /// An edit that removes a key.
    pub fn remove(key: impl Into<KeyPath>) -> Self {
        Self::Remove(key.into())
    }
}

impl Document {
    /// Makes a document that is no file yet. `path` is suggested for it, and relative paths in it start at that folder.
    pub fn untitled(text: String, path: PathBuf) -> Self {
        let toml = text.parse().ok();
        let (saved, history) = (text.clone(), History::default());
        Self { path, is_untitled: true, text, toml, saved, stamp: None, history, revision: 0 }
    }

    /// Opens a scene file. A text with faults is opened, too.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn open(path: &Path) -> Result<Self, Failure> {
        let stamp = modified(path);
        let text = std::fs::read_to_string(path).map_err(|error| unreadable(path, &error))?;
        Ok(Self { is_untitled: false, stamp, ..Self::untitled(text, path.into()) })
    }

    /// Returns the file, or the suggested one of an untitled document.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Whether the document is no file yet.
    pub fn is_untitled(&self) -> bool {
        self.is_untitled
    }

    /// Returns the text as it would be saved.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Whether the text differs from that of the file.
    pub fn is_changed(&self) -> bool {
        self.text != self.saved
    }

    /// Returns a number that grows with every change of the text.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Returns the changes that were made and undone.
    pub fn history(&self) -> &History {
        &self.history
    }

    /// Reads the scene, as the command does.
    ///
    /// # Errors
    /// Every fault, in the command's words.
    pub fn scene(&self) -> Result<Scene, Failures> {
        Ok(file::load_text(&self.text, &self.path, &Overrides::default())?)
    }

    /// Returns the item at a key, if the text has it.
    pub fn get(&self, key: &KeyPath) -> Option<&Item> {
        edit::get(self.toml.as_ref()?, key)
    }

    /// Gives a key a value.
    ///
    /// # Errors
    /// The key leads into a value, or into a list without such an item.
    pub fn set(&mut self, key: &KeyPath, value: impl Into<Value>) -> Result<(), EditError> {
        self.apply(&key.to_string(), vec![Edit::Set(key.clone(), value.into())])
    }

    /// Removes a key, if it is there.
    ///
    /// # Errors
    /// Same errors as [`Document::set`].
    pub fn remove(&mut self, key: &KeyPath) -> Result<(), EditError> {
        self.apply(&key.to_string(), vec![Edit::Remove(key.clone())])
    }

    /// Makes all of some edits, or none of them. They are undone together, and with the changes before them that have
    /// the same label and are not sealed ([`Document::seal`]).
    ///
    /// # Errors
    /// Same errors as [`Document::set`].
    pub fn apply(&mut self, label: &str, edits: Vec<Edit>) -> Result<(), EditError> {
        let mut toml = self.toml.clone().ok_or(EditError::Unreadable)?;
        for one in edits {
            match one {
                Edit::Set(key, value) => edit::set(&mut toml, &key, value),
                Edit::Remove(key) => edit::remove(&mut toml, &key),
                Edit::Insert(list, index, table) => edit::insert(&mut toml, &list, index, table),
            }?;
        }
        self.take(label, toml.to_string());
        Ok(())
    }

    /// Replaces the whole text, which may have faults.
    pub fn replace(&mut self, label: &str, text: String) {
        self.take(label, text);
    }

    /// Ends the group of changes that are undone together. It is called when a drag or the typing of a value ends.
    pub fn seal(&mut self) {
        self.history.seal();
    }

    /// Undoes the last group of changes. Returns whether there was one.
    pub fn undo(&mut self) -> bool {
        self.history.undo(&mut self.text) && self.renew()
    }

    /// Repeats the last group of changes that was undone. Returns whether there was one.
    pub fn redo(&mut self) -> bool {
        self.history.redo(&mut self.text) && self.renew()
    }

    /// Writes the text to its file.
    ///
    /// # Errors
    /// Errors of the operating system.
    pub fn save(&mut self) -> Result<(), Failure> {
        self.write(self.path.clone(), self.text.clone())
    }

    /// Writes the text to another file, which is the document's from then on. If its folder is another one, relative paths
    /// in the scene become absolute, so that the files are still found.
    ///
    /// # Errors
    /// Errors of the operating system; if the folder is another one, also a scene with faults, whose paths are not known.
    /// The document then keeps its file and its text.
    pub fn save_as(&mut self, path: &Path) -> Result<(), Failure> {
        let is_moved = self.path.parent() != path.parent();
        let text = if is_moved { self.text_elsewhere()? } else { self.text.clone() };
        self.write(path.into(), text)
    }

    /// Returns the text for another folder.
    fn text_elsewhere(&self) -> Result<String, Failure> {
        let fault = |reason: String| {
            let what = format!("the paths in the scene cannot be moved to another folder: {reason}");
            Failure::new(what, self.path.display(), "correct the scene first, or save it in the same folder")
        };
        let toml = self.toml.as_ref().ok_or_else(|| fault(EditError::Unreadable.to_string()))?;
        absolute_paths(toml, &self.path)
            .map_err(|failures| fault(failures.iter().next().map_or_else(String::new, |failure| failure.what.clone())))
    }

    /// Writes a text to a file. Both are the document's once they are written.
    fn write(&mut self, path: PathBuf, text: String) -> Result<(), Failure> {
        let written = atomic::write(&path, |out: &mut dyn Write| out.write_all(text.as_bytes()));
        written.map_err(|error: io::Error| {
            let what = format!("the scene cannot be written: {error}");
            Failure::new(what, path.display(), atomic::remedy(&error))
        })?;
        self.take("save in another folder", text);
        self.history.seal();
        (self.is_untitled, self.stamp) = (false, modified(&path));
        self.path = path;
        self.saved.clone_from(&self.text);
        Ok(())
    }

    /// Reads the file anew if another program has written it. The text before is one change that can be undone. Returns
    /// whether the text has changed.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn follow_file(&mut self) -> Result<bool, Failure> {
        let stamp = if self.is_untitled { None } else { modified(&self.path) };
        if stamp.is_none() || stamp == self.stamp {
            return Ok(false);
        }
        self.stamp = stamp;
        let text = std::fs::read_to_string(&self.path).map_err(|error| unreadable(&self.path, &error))?;
        if text == self.saved {
            return Ok(false);
        }
        self.saved.clone_from(&text);
        self.take("change by another program", text);
        self.history.seal();
        Ok(true)
    }

    /// Takes another text as a change, if it is one.
    fn take(&mut self, label: &str, text: String) {
        if text != self.text {
            self.history.push(label, &self.text, &text);
            self.text = text;
            self.renew();
        }
    }

    /// Parses the text after a change.
    fn renew(&mut self) -> bool {
        self.toml = self.text.parse().ok();
        self.revision += 1;
        true
    }
}

/// The time of a file's last modification, if the file is there.
fn modified(path: &Path) -> Option<SystemTime> {
    std::fs::metadata(path).and_then(|data| data.modified()).ok()
}

fn unreadable(path: &Path, error: &io::Error) -> Failure {
    Failure::new(format!("the file cannot be read: {error}"), path.display(), "check the path")
}
