//! Whole files or none: bytes are written beside the target and renamed over it.
//!
//! A reader never sees half a file, and an error leaves the old file as it was. An interrupt handler calls
//! [`remove_unfinished`] before it ends the process, so that nothing is left beside the target either.

use crate::OutputError;
use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Files that are being written just now.
static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Tells apart two writes of one process to one target.
static COUNT: AtomicU64 = AtomicU64::new(0);

/// Writes `bytes` to `path`, replacing what is there, at once or not at all.
///
/// A symbolic link is followed. A target that is no regular file (a pipe, `/dev/null`) is written directly, since it
/// must not be replaced by a file.
///
/// # Errors
/// [`OutputError::Io`]; the target is then as it was.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), OutputError> {
    replace(path, bytes).map_err(|source| OutputError::Io { path: path.into(), action: "written", source })
}

/// Removes what interrupted writes have left beside their targets. For the handler of an interrupt.
pub fn remove_unfinished() {
    for path in std::mem::take(&mut *unfinished()) {
        // The process is about to end: there is nobody to tell that a file could not be removed.
        let _ = fs::remove_file(path);
    }
}

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let target = match fs::metadata(path) {
        Ok(found) if found.is_file() => fs::canonicalize(path)?,
        Ok(found) if found.is_dir() => return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder")),
        Ok(_) => return fs::write(path, bytes),
        Err(_) => path.to_path_buf(),
    };
    let beside = Beside::of(&target)?;
    let mut file = File::create_new(&beside.path)?;
    file.write_all(bytes)?;
    drop(file);
    fs::rename(&beside.path, &target)
}

/// A name beside the target, under which nothing is left when the write ends in any way.
struct Beside {
    path: PathBuf,
}

impl Beside {
    fn of(target: &Path) -> io::Result<Self> {
        let name = target.file_name().ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "it names no file"))?;
        let mut hidden = std::ffi::OsString::from(".");
        hidden.push(name);
        hidden.push(format!(".{}-{}.part", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed)));
        let path = target.with_file_name(hidden);
        unfinished().insert(path.clone());
        Ok(Self { path })
    }
}

impl Drop for Beside {
    fn drop(&mut self) {
        // After the rename there is nothing of that name, and this does nothing.
        let _ = fs::remove_file(&self.path);
        unfinished().remove(&self.path);
    }
}

/// The list, even if a thread died while it held it: a set of paths cannot be left half changed.
fn unfinished() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> =
            fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn replaces_and_leaves_nothing_beside() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        write(&path, b"old").unwrap();
        write(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(names(folder.path()), ["a.png"]);
    }

    #[test]
    fn a_failure_names_the_file_and_changes_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let error = write(&folder.path().join("absent/a.png"), b"x").unwrap_err();
        assert!(error.to_string().contains("a.png: cannot be written"), "{error}");
        // The target is a folder.
        assert!(write(folder.path(), b"x").is_err());
        assert!(names(folder.path()).is_empty());
    }

    #[test]
    fn an_interrupt_removes_what_is_beside() {
        let folder = tempfile::tempdir().unwrap();
        let beside = Beside::of(&folder.path().join("a.png")).unwrap();
        fs::write(&beside.path, b"half").unwrap();
        remove_unfinished();
        assert!(names(folder.path()).is_empty());
    }

    #[cfg(unix)]
    #[test]
    fn links_are_followed_and_devices_stay_devices() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        fs::write(&file, b"old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write(&link, b"new").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&file).unwrap(), b"new");
        write(Path::new("/dev/null"), b"x").unwrap();
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
    }
}
