//! Fingerprints of the scenes from which the pictures of `docs` were made: a picture is up to date if that of its scene is
//! beside it.

use super::catalogue::{DocPicture, Source, figure};
use crate::files::{self, in_docs};
use drypoint::scene::file::{figure_identity, identity, parse};
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;

/// The list, a line a picture: fingerprint and path.
const LIST: &str = "pictures/made-from.txt";

/// Fingerprints by the paths of pictures.
pub(super) struct Fingerprints(BTreeMap<String, String>);

impl Fingerprints {
    /// Reads the list. Without a file no picture is up to date.
    pub(super) fn read() -> Result<Self, String> {
        let path = in_docs(LIST);
        let text = if path.exists() {
            std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?
        } else {
            String::new()
        };
        let lines = text.lines().filter_map(|line| line.split_once("  "));
        Ok(Self(lines.map(|(fingerprint, file)| (file.into(), fingerprint.into())).collect()))
    }

    /// The fingerprint beside a picture.
    pub(super) fn of(&self, file: &str) -> Option<&String> {
        self.0.get(file)
    }

    /// Notes the fingerprint of a new picture.
    pub(super) fn set(&mut self, file: &str, fingerprint: String) {
        self.0.insert(file.into(), fingerprint);
    }

    /// Writes the list.
    pub(super) fn write(&self) -> Result<(), String> {
        let lines: String = self.0.iter().map(|(file, fingerprint)| format!("{fingerprint}  {file}\n")).collect();
        files::write(LIST, lines.as_bytes())
    }
}

impl DocPicture {
    /// The first 16 hexadecimal digits of SHA-256 over the figure and its scenes, with every default filled in. Comments,
    /// the order of keys and the place of data do not count.
    pub(super) fn fingerprint(&self) -> Result<String, String> {
        let mut hash = Sha256::new();
        if let Source::Figure(path) = &self.source {
            hash.update(figure_identity(&figure(path)?));
        }
        for (path, overrides) in self.source.scenes()? {
            // Without a look at the disk: the place of data does not count, and they need not be there.
            let text = std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
            let scene = parse(&text, &path, &overrides).map_err(|e| e.to_string())?;
            hash.update(identity(&scene));
        }
        Ok(hash.finalize().iter().take(8).map(|byte| format!("{byte:02x}")).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::super::catalogue;
    use super::*;

    #[test]
    fn no_picture_is_older_than_its_scene() {
        let made = Fingerprints::read().unwrap();
        let listed = catalogue::all().unwrap();
        let stale: Vec<&str> = listed
            .iter()
            .filter(|entry| {
                made.of(&entry.file) != Some(&entry.fingerprint().unwrap()) || !in_docs(&entry.file).is_file()
            })
            .map(|entry| entry.file.as_str())
            .collect();
        assert!(stale.is_empty(), "`drypoint-docs pictures` renders them anew: {stale:?}");
        let gone: Vec<&String> = made.0.keys().filter(|file| listed.iter().all(|entry| entry.file != **file)).collect();
        assert!(gone.is_empty(), "no scene has these pictures: {gone:?}");
    }
}
