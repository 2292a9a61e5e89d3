//! Atomic writes: output goes to a file beside the target, and this file then replaces the target by a rename.
//!
//! A reader never sees half a file, and an error leaves the old file as it was. An interrupt handler calls
//! [`remove_unfinished`] before it ends the process, so that no partly written file stays beside the target.

use std::collections::BTreeSet;
use std::fs::{self, File, OpenOptions, Permissions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Files that are being written now.
static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Numbers the files of this process.
static COUNT: AtomicU64 = AtomicU64::new(0);

/// Writes the file `path` with the content that `fill` gives, whole or not at all. An existing file is replaced.
///
/// A symbolic link is followed. A file that is replaced keeps its permissions. A target that is no regular file (a
/// pipe, `/dev/null`) is written directly, since a file must not replace it.
///
/// # Errors
/// A file that may not be written to, any error of the operating system, and any error of `fill`. The target is then as
/// it was.
pub fn write<E: From<io::Error>>(path: &Path, fill: impl FnOnce(&mut dyn Write) -> Result<(), E>) -> Result<(), E> {
    let (target, permissions) = match Target::of(path)? {
        Target::Direct => return filled(File::create(path)?, fill),
        Target::File(target, permissions) => (target, permissions),
    };
    let (beside, file) = PartFile::create(&target)?;
    // Before the first byte, so that a private file is private while it is written.
    permissions.map_or(Ok(()), |permissions| file.set_permissions(permissions))?;
    filled(file, fill)?;
    Ok(fs::rename(&beside.path, &target)?)
}

/// Checks before long work whether [`write()`] could begin now. Leaves no trace.
///
/// # Errors
/// See [`write()`].
pub fn check(path: &Path) -> io::Result<()> {
    match Target::of(path)? {
        Target::Direct => Ok(()),
        Target::File(target, _) => PartFile::create(&target).map(drop),
    }
}

/// The remedy for an error of [`write()`] or [`check`], in one line.
pub fn remedy(error: &io::Error) -> &'static str {
    match error.kind() {
        io::ErrorKind::IsADirectory => "give the name of a file, such as one in that folder",
        io::ErrorKind::NotFound => "make the folder first, or give a path in one that is there",
        io::ErrorKind::NotADirectory => "give a path in a folder",
        io::ErrorKind::InvalidFilename => "give a shorter name",
        // With an error inside it is that of `may_be_written`, and not one of the operating system.
        io::ErrorKind::PermissionDenied if error.get_ref().is_some() => {
            "allow writing to this file first, or give another name"
        }
        io::ErrorKind::PermissionDenied | io::ErrorKind::ReadOnlyFilesystem => {
            "give a path in a folder that you may write to: a file is written beside its place, then renamed"
        }
        io::ErrorKind::FileTooLarge => "raise the limit of file sizes (ulimit -f), or write a smaller file",
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => "make room there, or give a path elsewhere",
        _ => "check that the folder exists, may be written to and has room",
    }
}

/// Removes the files that interrupted writes have left beside their targets, for the handler of an interrupt.
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

/// The kind of file at the path to be written.
enum Target {
    /// A pipe or a device.
    Direct,
    /// A file with its links followed, and its permissions; or nothing yet.
    File(PathBuf, Option<Permissions>),
}

impl Target {
    fn of(path: &Path) -> io::Result<Self> {
        match fs::metadata(path) {
            Ok(found) if found.is_dir() => Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder")),
            Ok(found) if found.is_file() => {
                may_be_written(path, &found.permissions())?;
                Ok(Self::File(fs::canonicalize(path)?, Some(found.permissions())))
            }
            Ok(_) => Ok(Self::Direct),
            // A link to a file that is not there yet makes that file.
            Err(error) if error.kind() == io::ErrorKind::NotFound => match fs::read_link(path) {
                Ok(to) => Self::of(&path.with_file_name(to)),
                Err(_) => Ok(Self::File(path.to_path_buf(), None)),
            },
            Err(error) => Err(error),
        }
    }
}

/// Whether a file may be written to. To rename another file over it, only its folder has to allow that.
fn may_be_written(path: &Path, permissions: &Permissions) -> io::Result<()> {
    // Some users may write to every file. They are refused too where the file says that nobody may.
    let denied = permissions.readonly()
        || OpenOptions::new()
            .write(true)
            .open(path)
            .is_err_and(|error| error.kind() == io::ErrorKind::PermissionDenied);
    if denied { Err(io::Error::new(io::ErrorKind::PermissionDenied, "the file is read-only")) } else { Ok(()) }
}

/// A file beside the target, which is removed or renamed however the write ends.
struct PartFile {
    path: PathBuf,
}

impl PartFile {
    fn create(target: &Path) -> io::Result<(Self, File)> {
        if target.file_name().is_none() {
            return Err(io::Error::new(io::ErrorKind::InvalidInput, "it names no file"));
        }
        loop {
            // Without the target's name: with more behind it, a long name would be too long.
            let number = COUNT.fetch_add(1, Ordering::Relaxed);
            let path = target.with_file_name(format!(".drypoint.{}-{number}.part", std::process::id()));
            // Under the lock: an interrupt finds either no file, or a file that is on the list.
            let mut unfinished = unfinished();
            match File::create_new(&path) {
                Ok(file) => {
                    unfinished.insert(path.clone());
                    return Ok((Self { path }, file));
                }
                // Another machine may write to the same folder with the same process number.
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                Err(error) => return Err(error),
            }
        }
    }
}

impl Drop for PartFile {
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

    #[cfg(unix)]
    #[test]
    fn permissions_are_kept_and_a_read_only_file_stays() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        put(&path, b"old").unwrap();
        let mode = || fs::metadata(&path).unwrap().permissions().mode() & 0o777;
        for kept in [0o600, 0o664, 0o755] {
            fs::set_permissions(&path, Permissions::from_mode(kept)).unwrap();
            put(&path, b"new").unwrap();
            assert_eq!(mode(), kept);
        }
        fs::set_permissions(&path, Permissions::from_mode(0o444)).unwrap();
        for error in [check(&path).unwrap_err(), put(&path, b"newer").unwrap_err()] {
            assert_eq!(error.kind(), io::ErrorKind::PermissionDenied);
            assert_eq!(error.to_string(), "the file is read-only");
            assert_eq!(remedy(&error), "allow writing to this file first, or give another name");
        }
        assert_eq!((fs::read(&path).unwrap(), mode(), names(folder.path()).len()), (b"new".into(), 0o444, 1));
    }

    #[cfg(unix)]
    #[test]
    fn a_name_may_be_as_long_as_the_system_allows() {
        let folder = tempfile::tempdir().unwrap();
        for length in [244, 255] {
            let path = folder.path().join(format!("{}.png", "a".repeat(length - 4)));
            check(&path).unwrap();
            put(&path, b"old").unwrap();
            put(&path, b"new").unwrap();
            assert_eq!(fs::read(&path).unwrap(), b"new");
        }
        let path = folder.path().join("a".repeat(256));
        for error in [check(&path).unwrap_err(), put(&path, b"x").unwrap_err()] {
            assert_eq!(remedy(&error), "give a shorter name");
        }
        assert_eq!(names(folder.path()).len(), 2);
    }

    #[test]
    fn a_file_of_that_name_beside_the_target_stays() {
        let folder = tempfile::tempdir().unwrap();
        // One of these files is in the way of every number that may come next.
        let next = COUNT.load(Ordering::Relaxed);
        let taken = |n| folder.path().join(format!(".drypoint.{}-{n}.part", std::process::id()));
        (next..next + 100).for_each(|n| fs::write(taken(n), b"another's").unwrap());
        let path = folder.path().join("a.png");
        put(&path, b"new").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert!((next..next + 100).all(|n| fs::read(taken(n)).unwrap() == b"another's"));
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
