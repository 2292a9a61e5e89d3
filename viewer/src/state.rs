//! State that is kept between sessions: recent files, the look of the window, saved views, and texts that were not saved.

use crate::views::SavedView;
use std::collections::hash_map::DefaultHasher;
use std::fs;
use std::hash::{Hash, Hasher};
use std::path::{Path, PathBuf};
use toml_edit::{Array, DocumentMut, value};

/// The most recent files that are kept.
const RECENT: usize = 12;

/// The kept state. Without a folder nothing is kept.
#[derive(Clone, Debug)]
pub struct State {
    folder: Option<PathBuf>,
    /// Recent files, the newest first.
    pub recent: Vec<PathBuf>,
    /// Whether the window is dark.
    pub is_dark: bool,
    /// The scale of text and controls.
    pub scale: f32,
    /// Cameras that are kept by a name.
    pub views: Vec<SavedView>,
}

impl State {
    /// Reads the state of a folder.
    pub fn read(folder: Option<PathBuf>) -> Self {
        let text = folder.as_ref().and_then(|folder| fs::read_to_string(folder.join("window.toml")).ok());
        let kept = text.and_then(|text| text.parse::<DocumentMut>().ok()).unwrap_or_default();
        let recent = kept.get("recent").and_then(|recent| recent.as_array()).into_iter().flatten();
        let views = kept.get("views").and_then(|views| views.as_array()).into_iter().flatten();
        Self {
            folder,
            views: views.filter_map(SavedView::read).collect(),
            recent: recent.filter_map(|path| path.as_str().map(PathBuf::from)).take(RECENT).collect(),
            is_dark: kept.get("dark").and_then(|dark| dark.as_bool()).unwrap_or(true),
            scale: kept.get("scale").and_then(|scale| scale.as_float()).map_or(1.0, |x| (x as f32).clamp(0.5, 3.0)),
        }
    }

    /// The folder for programs' state: `XDG_STATE_HOME`, `LOCALAPPDATA`, or `.local/state` in the home folder.
    pub fn folder() -> Option<PathBuf> {
        let named = ["XDG_STATE_HOME", "LOCALAPPDATA"].into_iter().find_map(std::env::var_os).map(PathBuf::from);
        named.or_else(|| Some(std::env::home_dir()?.join(".local/state"))).map(|folder| folder.join("drypoint-viewer"))
    }

    /// The folder of the user's own looks.
    pub fn looks(&self) -> Option<PathBuf> {
        Some(self.folder.as_ref()?.join("looks"))
    }

    /// Writes the state. What cannot be written is forgotten.
    pub fn write(&self) {
        let mut kept = DocumentMut::new();
        kept["recent"] = value(self.recent.iter().filter_map(|path| path.to_str()).collect::<Array>());
        kept["dark"] = value(self.is_dark);
        kept["scale"] = value(f64::from(self.scale));
        kept["views"] = value(self.views.iter().map(SavedView::written).collect::<Array>());
        self.put("window.toml", &kept.to_string());
    }

    /// Puts a file at the top of the recent ones.
    pub fn opened(&mut self, path: &Path) {
        let path = std::path::absolute(path).unwrap_or_else(|_| path.into());
        self.recent.retain(|recent| *recent != path);
        self.recent.insert(0, path);
        self.recent.truncate(RECENT);
        self.write();
    }

    /// Keeps the text of a document that is not saved, for the case that the window does not end well.
    pub fn keep_unsaved(&self, document: &Path, text: &str) {
        self.put(&unsaved(document), text);
    }

    /// Forgets the text of a document that is saved or given up.
    pub fn forget_unsaved(&self, document: &Path) {
        if let Some(folder) = &self.folder {
            // Mostly there is none.
            let _ = fs::remove_file(folder.join(unsaved(document)));
        }
    }

    /// Returns the text of a document that was not saved when its window ended, if it differs from `text`.
    pub fn unsaved(&self, document: &Path, text: &str) -> Option<String> {
        let kept = fs::read_to_string(self.folder.as_ref()?.join(unsaved(document))).ok()?;
        (kept != text).then_some(kept)
    }

    fn put(&self, name: &str, text: &str) {
        if let Some(folder) = &self.folder {
            let _ = fs::create_dir_all(folder).and_then(|()| fs::write(folder.join(name), text));
        }
    }
}

/// The name of the file that keeps a document's text.
fn unsaved(document: &Path) -> String {
    let mut hasher = DefaultHasher::new();
    std::path::absolute(document).unwrap_or_else(|_| document.into()).hash(&mut hasher);
    format!("unsaved-{:016x}.toml", hasher.finish())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_state_is_read_as_it_was_written() {
        let folder = tempfile::tempdir().unwrap();
        let mut state = State::read(Some(folder.path().join("deep")));
        assert!(state.recent.is_empty() && state.is_dark);
        (state.is_dark, state.scale) = (false, 1.5);
        for i in 0..RECENT + 3 {
            state.opened(Path::new(&format!("/a/{}.toml", i % (RECENT + 1))));
        }
        let read = State::read(Some(folder.path().join("deep")));
        assert_eq!((&read.recent, read.is_dark, read.scale), (&state.recent, false, 1.5));
        assert!(read.recent.len() == RECENT && read.recent[0] == Path::new("/a/1.toml"));
        let document = Path::new("/a/b.toml");
        state.keep_unsaved(document, "x");
        assert_eq!(read.unsaved(document, "y").as_deref(), Some("x"));
        assert_eq!((read.unsaved(document, "x"), read.unsaved(Path::new("/a/c.toml"), "y")), (None, None));
        state.forget_unsaved(document);
        assert_eq!(read.unsaved(document, "y"), None);
        // Without a folder nothing happens.
        State::read(None).opened(document);
    }
}
