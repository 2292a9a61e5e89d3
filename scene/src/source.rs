//! Sources of the files that a scene names: the disk, or bytes in memory.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Cursor, ErrorKind, Read, Seek};
use std::path::{Path, PathBuf};

/// The bytes of a file, which can be read from any position on.
pub trait Content: Read + Seek {}

impl<R: Read + Seek> Content for R {}

/// A source of files by their paths. A path is the scene's folder joined with the path in the scene.
pub trait Source: Send + Sync {
    /// Opens a file at its first byte.
    ///
    /// # Errors
    /// [`ErrorKind::NotFound`] if nothing has the path, and errors of the system.
    fn open(&self, path: &Path) -> io::Result<Box<dyn Content + '_>>;

    /// Returns the length of a regular file in bytes; none for a folder, a pipe or a device.
    ///
    /// # Errors
    /// Same errors as [`Source::open`].
    fn length(&self, path: &Path) -> io::Result<Option<u64>>;

    /// Returns the paths of the entries of a folder.
    ///
    /// # Errors
    /// Same errors as [`Source::open`], and a path that is not a folder.
    fn list(&self, folder: &Path) -> io::Result<Vec<PathBuf>>;

    /// Whether a path is that of a regular file.
    fn is_file(&self, path: &Path) -> bool {
        matches!(self.length(path), Ok(Some(_)))
    }
}

/// The files of the system.
#[derive(Clone, Copy, Debug)]
pub struct Disk;

impl Source for Disk {
    fn open(&self, path: &Path) -> io::Result<Box<dyn Content + '_>> {
        Ok(Box::new(File::open(path)?))
    }

    fn length(&self, path: &Path) -> io::Result<Option<u64>> {
        let metadata = fs::metadata(path)?;
        Ok(metadata.is_file().then_some(metadata.len()))
    }

    fn list(&self, folder: &Path) -> io::Result<Vec<PathBuf>> {
        fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect()
    }
}

/// Files in memory. A folder has the paths that begin with it.
impl Source for BTreeMap<PathBuf, Vec<u8>> {
    fn open(&self, path: &Path) -> io::Result<Box<dyn Content + '_>> {
        Ok(Box::new(Cursor::new(self.get(path).ok_or(ErrorKind::NotFound)?.as_slice())))
    }

    fn length(&self, path: &Path) -> io::Result<Option<u64>> {
        match self.get(path) {
            Some(bytes) => Ok(Some(bytes.len() as u64)),
            None => self.list(path).map(|_| None),
        }
    }

    fn list(&self, folder: &Path) -> io::Result<Vec<PathBuf>> {
        let inside: Vec<PathBuf> = self.keys().filter(|path| path.parent() == Some(folder)).cloned().collect();
        if inside.is_empty() { Err(ErrorKind::NotFound.into()) } else { Ok(inside) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The disk and a map with the same files answer alike.
    #[test]
    fn sources_of_the_same_files_agree() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        let files = BTreeMap::from([(path("a"), b"one".to_vec()), (path("b"), b"three".to_vec())]);
        for (path, bytes) in &files {
            fs::write(path, bytes).unwrap();
        }
        for source in [&Disk as &dyn Source, &files] {
            let read = |name: &str| {
                let mut bytes = Vec::new();
                source.open(&path(name)).map_err(|e| e.kind())?.read_to_end(&mut bytes).map_err(|e| e.kind())?;
                Ok(bytes)
            };
            assert_eq!([read("a"), read("b")], [Ok(b"one".to_vec()), Ok(b"three".to_vec())]);
            assert_eq!(read("c"), Err(ErrorKind::NotFound));
            assert_eq!(source.length(&path("b")).unwrap(), Some(5));
            assert_eq!(source.length(folder.path()).unwrap(), None);
            assert_eq!(source.length(&path("c")).unwrap_err().kind(), ErrorKind::NotFound);
            assert_eq!(
                [path("a"), path("c"), folder.path().into()].map(|path| source.is_file(&path)),
                [true, false, false]
            );
            let mut listed = source.list(folder.path()).unwrap();
            listed.sort();
            assert_eq!(listed, [path("a"), path("b")]);
        }
    }
}
