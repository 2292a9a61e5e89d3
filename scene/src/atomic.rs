//! Whole files or none: what is written goes beside the target and is renamed over it.
//!
//! A reader never sees half a file, and an error leaves the old file as it was. An interrupt handler calls
//! [`remove_unfinished`] before it ends the process, so that nothing is left beside the target either.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Files that are being written just now.
static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Tells apart two writes of one process to one target.
static COUNT: AtomicU64 = AtomicU64::new(0);

/// Makes `path` hold what `fill` writes, replacing what is there, at once or not at all.
///
/// A symbolic link is followed. A target that is no regular file (a pipe, `/dev/null`) is written directly, since it
/// must not be replaced by a file.
///
/// # Errors
/// Whatever the operating system refuses or `fill` returns; the target is then as it was.
pub fn write<E: From<io::Error>>(path: &Path, fill: impl FnOnce(&mut dyn Write) -> Result<(), E>) -> Result<(), E> {
    let target = match Target::of(path)? {
        Target::Direct => return filled(File::create(path)?, fill),
        Target::File(target) => target,
    };
    let (beside, file) = Beside::create(&target)?;
    filled(file, fill)?;
    Ok(fs::rename(&beside.path, &target)?)
}

/// Whether [`write()`] could begin now: asked before long work, so that it is not done in vain. Leaves no trace.
///
/// # Errors
/// As [`write()`].
pub fn check(path: &Path) -> io::Result<()> {
    match Target::of(path)? {
        Target::Direct => Ok(()),
        Target::File(target) => Beside::create(&target).map(drop),
    }
}

/// What to do where [`write()`] or [`check`] was refused, in one line.
pub fn remedy(error: &io::Error) -> &'static str {
    match error.kind() {
        io::ErrorKind::IsADirectory => "give the name of a file, such as one in that folder",
        io::ErrorKind::NotFound => "make the folder first, or give a path in one that is there",
        io::ErrorKind::NotADirectory => "give a path in a folder",
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            "give a path in a folder that you may write to: a file is written beside its place, then renamed"
        }
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => "make room there, or give a path elsewhere",
        _ => "check that the folder exists, may be written to and has room",
    }
}

/// Removes what interrupted writes have left beside their targets. For the handler of an interrupt.
pub fn remove_unfinished() {
    for path in std::mem::take(&mut *unfinished()) {
        // The process is about to end: there is nobody to tell that a file could not be removed.
        let _ = fs::remove_file(path);
    }
}

fn filled<E: From<io::Error>>(file: File, fill: impl FnOnce(&mut dyn Write) -> Result<(), E>) -> Result<(), E> {
    let mut out = BufWriter::new(file);
    fill(&mut out)?;
    Ok(out.flush()?)
}

/// What stands under the name that is to be written.
enum Target {
    /// A pipe or a device.
    Direct,
    /// A file with its links followed, or nothing yet.
    File(PathBuf),
}

impl Target {
    fn of(path: &Path) -> io::Result<Self> {
        match fs::metadata(path) {
            Ok(found) if found.is_file() => Ok(Self::File(fs::canonicalize(path)?)),
            Ok(found) if found.is_dir() => Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder")),
            Ok(_) => Ok(Self::Direct),
            Err(_) => Ok(Self::File(path.to_path_buf())),
        }
    }
}

/// A file beside the target, of which nothing is left when the write ends in any way.
struct Beside {
    path: PathBuf,
}

impl Beside {
    fn create(target: &Path) -> io::Result<(Self, File)> {
        let name = target.file_name().ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "it names no file"))?;
        let mut hidden = std::ffi::OsString::from(".");
        hidden.push(name);
        hidden.push(format!(".{}-{}.part", std::process::id(), COUNT.fetch_add(1, Ordering::Relaxed)));
        let path = target.with_file_name(hidden);
        // Under the lock: an interrupt finds either no file, or a file that is on the list.
        let mut unfinished = unfinished();
        let file = File::create_new(&path)?;
        unfinished.insert(path.clone());
        Ok((Self { path }, file))
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

    fn put(path: &Path, bytes: &[u8]) -> io::Result<()> {
        write(path, |out| out.write_all(bytes))
    }

    #[test]
    fn replaces_and_leaves_nothing_beside() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        check(&path).unwrap();
        assert!(names(folder.path()).is_empty(), "a check leaves no trace");
        put(&path, b"old").unwrap();
        put(&path, b"new").unwrap();
        check(&path).unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert_eq!(names(folder.path()), ["a.png"]);
    }

    #[test]
    fn a_failure_changes_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        put(&path, b"old").unwrap();
        let half = |out: &mut dyn Write| {
            out.write_all(b"half")?;
            Err(io::Error::other("no more"))
        };
        assert_eq!(write(&path, half).unwrap_err().to_string(), "no more");
        assert_eq!(fs::read(&path).unwrap(), b"old");
        for refused in [folder.path().join("absent/a.png"), folder.path().to_path_buf(), path.join("b"), "/".into()] {
            assert!(put(&refused, b"x").is_err() && check(&refused).is_err(), "{}", refused.display());
        }
        assert_eq!(names(folder.path()), ["a.png"]);
    }

    #[cfg(unix)]
    #[test]
    fn a_folder_that_may_not_be_written_to_is_told_as_that() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        put(&path, b"old").unwrap();
        fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o555)).unwrap();
        // Some users may write anywhere.
        if File::create(folder.path().join("b")).is_ok() {
            println!("skipped: this user may write to every folder");
            return;
        }
        for error in [put(&path, b"new").unwrap_err(), check(&path).unwrap_err()] {
            assert_eq!(error.kind(), io::ErrorKind::PermissionDenied);
            assert!(remedy(&error).contains("a folder that you may write to"));
        }
        assert_eq!((fs::read(&path).unwrap(), names(folder.path())), (b"old".into(), vec!["a.png".into()]));
        fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o755)).unwrap();
    }

    #[test]
    fn an_interrupt_removes_what_is_beside() {
        let folder = tempfile::tempdir().unwrap();
        let (_beside, mut file) = Beside::create(&folder.path().join("a.png")).unwrap();
        file.write_all(b"half").unwrap();
        assert_eq!(names(folder.path()).len(), 1);
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
        put(&link, b"new").unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&file).unwrap(), b"new");
        put(Path::new("/dev/null"), b"x").unwrap();
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
    }
}
