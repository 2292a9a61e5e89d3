//! Whole files or none, for the writers of pictures.

use crate::OutputError;
use drypoint_scene::atomic;
use std::io;
use std::path::Path;

/// Writes `bytes` to `path`, replacing what is there, at once or not at all.
///
/// # Errors
/// [`OutputError::Io`]; the target is then as it was.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    atomic::write(path, |out| out.write_all(bytes)).map_err(|source| refused(path, source))
}

/// Whether [`write()`] could begin now: asked before long work, so that it is not done in vain. Leaves no trace.
///
/// # Errors
/// As [`write()`].
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
