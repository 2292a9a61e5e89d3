//! Atomic writes of picture files.

use crate::OutputError;
use drypoint_scene::atomic;
use std::io;
use std::path::Path;

/// Writes `bytes` to `path`. The file appears whole or not at all, and replaces what is there.
///
/// # Errors
/// [`OutputError::Io`]. The old file then stays unchanged.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    atomic::write(path, |out| out.write_all(bytes)).map_err(|source| refused(path, source))
}

/// Checks before long work whether [`write()`] could begin now. Leaves no trace.
///
/// # Errors
/// Same errors as [`write()`].
pub fn check(path: &Path) -> Result<(), OutputError> {
    atomic::check(path).map_err(|source| refused(path, source))
}

fn refused(path: &Path, source: io::Error) -> OutputError {
    OutputError::Io { path: path.into(), action: "written", source }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_names_the_file() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("absent/a.png");
        for error in [write(&path, b"x").unwrap_err(), check(&path).unwrap_err()] {
            assert!(error.to_string().contains("a.png: cannot be written"), "{error}");
        }
    }
}
