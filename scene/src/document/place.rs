//! Places in a scene file or on the command line.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::{Path, PathBuf};

/// Place of a key or a value.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Place {
    /// In the scene file. Both numbers count from 1; columns are characters, not bytes.
    File {
        /// Line.
        line: usize,
        /// Column.
        column: usize,
    },
    /// On the command line: what follows `--set`.
    Set(String),
    /// Nowhere: it was found in the volume that the scene is for.
    Chosen,
}

impl Place {
    /// The line of the scene file; none for what the command line said.
    pub fn line(&self) -> Option<usize> {
        match self {
            Self::File { line, .. } => Some(*line),
            Self::Set(_) | Self::Chosen => None,
        }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::File { line, column } => write!(f, "line {line}, column {column}"),
            Self::Set(text) => write!(f, "--set {text}"),
            Self::Chosen => f.write_str("chosen for this volume"),
        }
    }
}

/// Turns byte offsets of a text into places.
#[derive(Debug)]
pub(crate) struct Lines<'a> {
    text: &'a str,
    starts: Vec<usize>,
}

impl<'a> Lines<'a> {
    pub(crate) fn new(text: &'a str) -> Self {
        let starts = std::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
        Self { text, starts }
    }

    /// The place of a byte; what lies past the end or inside a character counts as just before it.
    pub(crate) fn place(&self, byte: usize) -> Place {
        let byte = (0..=byte.min(self.text.len())).rev().find(|&b| self.text.is_char_boundary(b)).unwrap_or(0);
        let line = self.starts.partition_point(|&start| start <= byte);
        // Never 0: the first line starts at byte 0, which is at most `byte`.
        let start = self.starts[line - 1];
        Place::File { line, column: self.text[start..byte].chars().count() + 1 }
    }
}

/// The keys that a scene said itself, with their places. It is not part of what the scene means: two scenes that
/// differ only here are equal.
#[derive(Clone, Debug, Default)]
pub struct Given {
    file: PathBuf,
    keys: BTreeMap<String, Place>,
    chosen: BTreeSet<String>,
}

impl PartialEq for Given {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Given {
    pub(crate) fn new(file: &Path) -> Self {
        Self { file: file.to_owned(), keys: BTreeMap::new(), chosen: BTreeSet::new() }
    }

    /// Whether the scene said a key, such as `camera.fov` or `transfer.nodes[2].style`, or has a table, such as
    /// `contours`.
    pub fn contains(&self, key: &str) -> bool {
        self.keys.contains_key(key)
    }

    /// Place at which the scene said a key.
    pub fn place(&self, key: &str) -> Option<&Place> {
        self.keys.get(key)
    }

    /// The line of the scene file that said it; none for a default and for what the command line said.
    pub fn line(&self, key: &str) -> Option<usize> {
        self.place(key).and_then(Place::line)
    }

    /// Every key and table, in alphabetical order.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Place)> {
        self.keys.iter().map(|(key, place)| (key.as_str(), place))
    }

    /// Returns the keys with those of some tables in the place of others: each pair is a table and the place that its keys take.
    /// Keys that stood there are left out.
    pub(crate) fn with_tables(&self, tables: &[(String, &str)]) -> Self {
        let is_in = |key: &str, table: &str| {
            key.strip_prefix(table).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
        };
        let mut keys = self.keys.clone();
        keys.retain(|key, _| tables.iter().all(|(_, place)| !is_in(key, place)));
        for (table, place) in tables {
            let inner = self.keys.iter().filter(|(key, _)| is_in(key, table));
            keys.extend(inner.map(|(key, at)| (format!("{place}{}", &key[table.len()..]), at.clone())));
        }
        Self { keys, ..self.clone() }
    }

    /// Place of a key as messages write it: file, line and column as far as they are known, and the key.
    pub fn position(&self, key: &str) -> String {
        position(&self.file, self.place(key), key)
    }

    /// Forgets what the file said, for a scene that nobody wrote. What the command line said stays. Of `chosen`, keys
    /// and tables that are not as by default, [`Given::is_chosen`] knows.
    pub fn keep_overrides(&mut self, chosen: impl IntoIterator<Item = String>) {
        self.keys.retain(|_, place| matches!(place, Place::Set(_)));
        self.chosen.extend(chosen);
    }

    /// Whether a key or table of a scene that nobody wrote was chosen for its volume.
    pub fn is_chosen(&self, key: &str) -> bool {
        self.chosen.contains(key)
    }

    pub(crate) fn insert(&mut self, key: String, place: Place) {
        self.keys.insert(key, place);
    }

    pub(crate) fn remove(&mut self, key: &str) {
        self.keys.remove(key);
    }
}

/// A place and a key in one line: the second of an error.
pub(crate) fn position(file: &Path, place: Option<&Place>, key: &str) -> String {
    let place = match place {
        Some(Place::File { line, column }) => format!("{}:{line}:{column}", file.display()),
        Some(Place::Set(text)) => format!("--set {text}"),
        Some(Place::Chosen) | None => file.display().to_string(),
    };
    match (place.as_str(), key) {
        (_, "") => place,
        ("", _) => format!("key {key}"),
        _ => format!("{place}, key {key}"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_columns_count_characters_from_one() {
        let lines = Lines::new("a = 1\nµ = \"é\" x\n");
        let at = |byte| match lines.place(byte) {
            Place::File { line, column } => (line, column),
            Place::Set(_) | Place::Chosen => unreachable!(),
        };
        assert_eq!(at(0), (1, 1));
        assert_eq!(at(5), (1, 6), "the end of a line belongs to it");
        assert_eq!(at(6), (2, 1));
        // µ and é are two bytes each.
        assert_eq!(at(8), (2, 2));
        assert_eq!(at(7), (2, 1), "inside µ");
        assert_eq!(at(16), (2, 9));
        assert_eq!(at(18), (3, 1));
        assert_eq!(at(1000), (3, 1));
        assert_eq!(Lines::new("").place(0), Place::File { line: 1, column: 1 });
    }

    #[test]
    fn a_position_says_what_is_known() {
        let mut given = Given::new(Path::new("a/scene.toml"));
        given.insert("camera.fov".into(), Place::File { line: 3, column: 7 });
        given.insert("picture.bits".into(), Place::Set("picture.bits=16".into()));
        assert_eq!(given.position("camera.fov"), "a/scene.toml:3:7, key camera.fov");
        assert_eq!(given.position("picture.bits"), "--set picture.bits=16, key picture.bits");
        assert_eq!(given.position("camera.up"), "a/scene.toml, key camera.up");
        assert_eq!(Given::default().position("camera.up"), "key camera.up");
        given.keep_overrides(["camera.fov".into()]);
        assert!(!given.contains("camera.fov") && given.contains("picture.bits"));
        assert!(given.is_chosen("camera.fov") && !given.is_chosen("picture.bits"));
    }
}
