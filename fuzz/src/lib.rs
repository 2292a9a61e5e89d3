//! Code that the fuzz targets share.

use drypoint_scene::memory;
use std::path::PathBuf;
use tempfile::TempDir;

/// The memory that the process may use, in bytes.
const BUDGET: u64 = 1 << 30;

/// Sets the memory budget, and reports a panic without ending the process: the project catches the panics of one decoder.
/// A panic that leaves a target still ends the process, and the fuzzer keeps the input.
pub fn start() {
    memory::limit(BUDGET);
    std::panic::set_hook(Box::new(|panic| eprintln!("{panic}")));
}

/// Checks that an error has its three parts, each on one line: what is wrong, where, and what to do.
pub fn check_error(parts: [String; 3]) {
    for part in &parts {
        assert!(!part.is_empty() && !part.contains('\n'), "{parts:?}");
    }
}

/// A temporary folder with the files of one input.
pub struct Folder(TempDir);

impl Folder {
    /// Creates an empty folder.
    pub fn new() -> Self {
        Self(tempfile::tempdir().expect("a temporary folder can be made"))
    }

    /// The path of a file in the folder.
    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    /// Writes a file and returns its path.
    pub fn put(&self, name: &str, bytes: &[u8]) -> PathBuf {
        let path = self.path(name);
        std::fs::write(&path, bytes).expect("a temporary file can be written");
        path
    }
}

impl Default for Folder {
    fn default() -> Self {
        Self::new()
    }
}
