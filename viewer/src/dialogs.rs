//! Dialogs of the system for files. They run beside the window, and hand over a path when the user has chosen.

use drypoint::scene::volume::read;
use rfd::AsyncFileDialog;
use std::path::{Path, PathBuf};
use std::sync::mpsc::{Receiver, Sender, channel};

/// The purpose of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wish {
    /// A scene or a volume is opened.
    Open,
    /// The scene is saved.
    SaveAs,
    /// The picture is rendered.
    Export,
}

/// The dialogs and their answers.
#[derive(Debug)]
pub(crate) struct Dialogs {
    sender: Sender<(Wish, PathBuf)>,
    answers: Receiver<(Wish, PathBuf)>,
}

impl Default for Dialogs {
    fn default() -> Self {
        let (sender, answers) = channel();
        Self { sender, answers }
    }
}

impl Dialogs {
    /// Returns the next path that was chosen.
    pub(crate) fn answer(&self) -> Option<(Wish, PathBuf)> {
        self.answers.try_recv().ok()
    }

    /// Answers a wish without a dialog.
    pub(crate) fn put(&self, wish: Wish, path: PathBuf) {
        // The receiver lives as long as the sender.
        let _ = self.sender.send((wish, path));
    }

    /// Asks for a scene or a volume.
    pub(crate) fn open(&self) {
        let suffixes: Vec<&str> = std::iter::once("toml").chain(read::EXTENSIONS).collect();
        let dialog = AsyncFileDialog::new().add_filter("Scenes and volumes", &suffixes).add_filter("All files", &["*"]);
        self.wait(Wish::Open, dialog.pick_file());
    }

    /// Asks for the file of a scene.
    pub(crate) fn save_as(&self, suggested: &Path) {
        let dialog = suggest(suggested, "toml").add_filter("Scenes", &["toml"]);
        self.wait(Wish::SaveAs, dialog.save_file());
    }

    /// Asks for the file of a picture.
    pub(crate) fn export(&self, document: &Path) {
        let dialog = suggest(document, "png").add_filter("Pictures", &["png", "exr", "svg", "pdf", "gif", "apng"]);
        self.wait(Wish::Export, dialog.save_file());
    }

    /// Waits for the user on a thread.
    fn wait(&self, wish: Wish, chosen: impl Future<Output = Option<rfd::FileHandle>> + Send + 'static) {
        let sender = self.sender.clone();
        std::thread::spawn(move || {
            if let Some(file) = pollster::block_on(chosen) {
                let _ = sender.send((wish, file.path().into()));
            }
        });
    }
}

/// A dialog that suggests a document's folder and its name with another suffix.
fn suggest(document: &Path, suffix: &str) -> AsyncFileDialog {
    let name = document.with_extension(suffix);
    let name = name.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let dialog = AsyncFileDialog::new().set_file_name(name);
    match document.parent().filter(|folder| folder.is_dir()) {
        Some(folder) => dialog.set_directory(folder),
        None => dialog,
    }
}
