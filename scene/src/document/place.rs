//! Places in a scene file or on the command line.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::Arc;

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
    /// On the command line: what follows `--set`. All values of an override share it.
    Set(Arc<str>),
    /// Chosen for the volume that the scene is for, and written nowhere.
    Chosen,
}

impl Place {
    /// The line of the scene file; none for a key of the command line.
    pub fn line(&self) -> Option<usize> {
        self.in_file().map(|[line, _]| line)
    }

    /// The line and the column in the scene file; none for a key of the command line.
    pub(crate) fn in_file(&self) -> Option<[usize; 2]> {
        match self {
            Self::File { line, column } => Some([*line, *column]),
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

/// Turns byte offsets of a text into places. A place takes equally long in lines of any length.
#[derive(Debug)]
pub(crate) struct Lines<'a> {
    text: &'a str,
    starts: Vec<usize>,
    /// The characters before each block of bytes.
    before: Vec<usize>,
}

/// Bytes of a block.
const BLOCK: usize = 256;

impl<'a> Lines<'a> {
    pub(crate) fn new(text: &'a str) -> Self {
        let starts = std::iter::once(0).chain(text.match_indices('\n').map(|(i, _)| i + 1)).collect();
        let mut before = vec![0];
        for block in text.as_bytes().chunks(BLOCK) {
            before.push(before[before.len() - 1] + characters(block));
        }
        Self { text, starts, before }
    }

    /// The characters that begin before a byte of the text.
    fn characters_before(&self, byte: usize) -> usize {
        let block = byte / BLOCK;
        self.before[block] + characters(&self.text.as_bytes()[block * BLOCK..byte])
    }

    /// The place of a byte. Bytes inside a character have its place, and bytes past the end the place of the end.
    pub(crate) fn place(&self, byte: usize) -> Place {
        let byte = (0..=byte.min(self.text.len())).rev().find(|&b| self.text.is_char_boundary(b)).unwrap_or(0);
        let line = self.starts.partition_point(|&start| start <= byte);
        // Never 0: the first line starts at byte 0, which is at most `byte`.
        let start = self.starts[line - 1];
        Place::File { line, column: self.characters_before(byte) - self.characters_before(start) + 1 }
    }
}

/// The characters that begin in a part of a text: bytes that do not continue one.
fn characters(bytes: &[u8]) -> usize {
    bytes.iter().filter(|&&byte| byte & 0b1100_0000 != 0b1000_0000).count()
}

/// The keys that a scene gives itself, with their places. Scenes that differ only in these keys and places are equal.
#[derive(Clone, Debug, Default)]
pub struct Given {
    file: PathBuf,
    /// All keys, shared by the scenes of parts.
    keys: Arc<BTreeMap<String, Place>>,
    /// Tables and the places that their keys take.
    moved: Vec<(String, &'static str)>,
    chosen: BTreeSet<String>,
}

impl PartialEq for Given {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl Given {
    pub(crate) fn new(file: &Path) -> Self {
        Self { file: file.to_owned(), ..Self::default() }
    }

    /// Whether the scene said a key, such as `camera.fov` or `transfer.nodes[2].style`, or has a table, such as
    /// `contours`.
    pub fn contains(&self, key: &str) -> bool {
        self.place(key).is_some()
    }

    /// The place at which the scene gives a key.
    pub fn place(&self, key: &str) -> Option<&Place> {
        let moved = self.moved.iter().find_map(|(table, place)| Some((table, inside(key, place)?)));
        match moved {
            Some((table, rest)) => self.keys.get(&format!("{table}{rest}")),
            None => self.keys.get(key),
        }
    }

    /// The line of the scene file that gives a key; none for a default, and for a key of the command line.
    pub fn line(&self, key: &str) -> Option<usize> {
        self.place(key).and_then(Place::line)
    }

    /// Returns the keys after some tables have replaced others. Each pair is a table and the key that the table moves
    /// to. Keys that stood there before are left out.
    pub(crate) fn with_tables(&self, moved: Vec<(String, &'static str)>) -> Self {
        Self { moved, ..self.clone() }
    }

    /// Place of a key as messages write it: file, line and column as far as they are known, and the key.
    pub fn position(&self, key: &str) -> String {
        position(&self.file, self.place(key), key)
    }

    /// Forgets the keys of the file, for a scene that the program composed; keys of the command line stay. `chosen` are
    /// the keys and tables that differ from their defaults, for [`Given::is_chosen`].
    pub fn keep_overrides(&mut self, chosen: impl IntoIterator<Item = String>) {
        Arc::make_mut(&mut self.keys).retain(|_, place| matches!(place, Place::Set(_)));
        self.chosen.extend(chosen);
    }

    /// Whether a key or table of a composed scene was chosen for its volume.
    pub fn is_chosen(&self, key: &str) -> bool {
        self.chosen.contains(key)
    }

    pub(crate) fn insert(&mut self, key: String, place: Place) {
        Arc::make_mut(&mut self.keys).insert(key, place);
    }

    pub(crate) fn remove(&mut self, key: &str) {
        Arc::make_mut(&mut self.keys).remove(key);
    }
}

/// The rest of a key behind a table's key; none for a key outside the table.
fn inside<'a>(key: &'a str, table: &str) -> Option<&'a str> {
    key.strip_prefix(table).filter(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
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

    /// Columns of one line of 10⁷ characters, which takes hours if each is counted from the line's start.
    #[test]
    fn a_long_line_is_counted_once() {
        let text = "µ=\u{1F58B}, ".repeat(2_000_000);
        let lines = Lines::new(&text);
        let each = text.len() / 2_000_000;
        for i in (0..2_000_000).step_by(7) {
            assert_eq!(lines.place(i * each), Place::File { line: 1, column: 5 * i + 1 });
        }
        let short = &text[..20 * each];
        for (i, (byte, _)) in short.char_indices().enumerate() {
            assert_eq!(lines.place(byte), Place::File { line: 1, column: i + 1 });
        }
    }

    #[test]
    fn tables_of_a_part_take_the_places_of_others() {
        let mut given = Given::default();
        let at = |line| Place::File { line, column: 1 };
        for (line, key) in ["a", "a.x", "a.y", "b[0].a", "b[0].a.x", "ab"].into_iter().enumerate() {
            given.insert(key.into(), at(line));
        }
        let part = given.with_tables(vec![("b[0].a".into(), "a")]);
        let line = |key| part.line(key);
        assert_eq!(["a", "a.x", "a.y", "ab", "b[0].a.x"].map(line), [Some(3), Some(4), None, Some(5), Some(4)]);
        assert_eq!((given.line("a.y"), part.contains("a.y")), (Some(2), false));
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
