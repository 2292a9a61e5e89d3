//! The table of names beside a label volume: `id,name` on each line ([STF-13]).

use crate::memory;
use crate::nearest::nearest;
use crate::source::Source;
use crate::volume::read::quoted;
use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};

/// Names of labels.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LabelNames {
    by_id: BTreeMap<u32, String>,
    by_name: BTreeMap<String, u32>,
}

/// A table of names that cannot be read.
#[derive(Debug)]
pub struct NamesError {
    /// The table's file.
    pub file: PathBuf,
    /// The line at fault, counted from 1.
    pub line: Option<u64>,
    /// The fault.
    pub fault: NamesFault,
}

/// A fault of a table of names.
#[derive(Debug, thiserror::Error)]
pub enum NamesFault {
    /// The file cannot be read.
    #[error("the file cannot be read: {0}")]
    Io(std::io::Error),
    /// Bytes that are no text.
    #[error("the line is not UTF-8")]
    NotText,
    /// A first column that holds no id.
    #[error("{} is not a label: an id is a whole number from 0 to 4294967295", quoted(.0))]
    NotAnId(String),
    /// A line without a second column, or with an empty one.
    #[error("label {0} has no name")]
    NoName(u32),
    /// A name for a label that has one.
    #[error("label {id} has a name already, on line {before}: {}", quoted(name))]
    IdTwice {
        /// The label.
        id: u32,
        /// The label's name.
        name: String,
        /// The line that gave it.
        before: u64,
    },
    /// A name that another label has.
    #[error("{} is the name of label {id} already, on line {before}", quoted(name))]
    NameTwice {
        /// The name.
        name: String,
        /// The label that has it.
        id: u32,
        /// The line that gave it.
        before: u64,
    },
}

impl LabelNames {
    /// Reads a CSV file: the first column holds an id, the second its name. Further columns are ignored, and so is a
    /// first line whose first column is no number. A field may be quoted.
    ///
    /// # Errors
    /// A file that cannot be read, and the first line that has no id, no name, or an id or a name that an earlier line
    /// has.
    pub fn read(source: &dyn Source, path: &Path) -> Result<Self, NamesError> {
        let error = |fault| NamesError { file: path.to_owned(), line: None, fault };
        let text = memory::read(source, path).map_err(|e| error(NamesFault::Io(e)))?;
        Self::parse(&text).map_err(|(line, fault)| NamesError { line, ..error(fault) })
    }

    fn parse(text: &[u8]) -> Result<Self, (Option<u64>, NamesFault)> {
        let text = text.strip_prefix(b"\xef\xbb\xbf").unwrap_or(text);
        let mut reader =
            csv::ReaderBuilder::new().has_headers(false).flexible(true).trim(csv::Trim::All).from_reader(text);
        let mut names = Self::default();
        let mut lines = BTreeMap::new();
        for (i, record) in reader.records().enumerate() {
            let record = record.map_err(|error| (line(text, error.position()), fault(error)))?;
            let line = line(text, record.position());
            let first = record.get(0).unwrap_or_default();
            if i == 0 && first.parse::<f64>().is_err() {
                continue;
            }
            let add = || {
                let id = first.parse().map_err(|_| NamesFault::NotAnId(first.into()))?;
                let name = record.get(1).filter(|name| !name.is_empty()).ok_or(NamesFault::NoName(id))?;
                let line_of = |id| lines.get(&id).copied().unwrap_or_default();
                if let Some(name) = names.by_id.get(&id) {
                    return Err(NamesFault::IdTwice { id, name: name.clone(), before: line_of(id) });
                }
                if let Some(&id) = names.by_name.get(name) {
                    return Err(NamesFault::NameTwice { name: name.into(), id, before: line_of(id) });
                }
                Ok((id, name.to_owned()))
            };
            let (id, name) = add().map_err(|fault| (line, fault))?;
            lines.insert(id, line.unwrap_or_default());
            names.by_name.insert(name.clone(), id);
            names.by_id.insert(id, name);
        }
        Ok(names)
    }

    /// The label of that name.
    pub fn id(&self, name: &str) -> Option<u32> {
        self.by_name.get(name).copied()
    }

    /// The name of a label.
    pub fn name(&self, id: u32) -> Option<&str> {
        self.by_id.get(&id).map(String::as_str)
    }

    /// Labels and their names, by ascending id.
    pub fn iter(&self) -> impl Iterator<Item = (u32, &str)> {
        self.by_id.iter().map(|(&id, name)| (id, name.as_str()))
    }

    /// The known name that a misspelt one probably meant ([SCN-4]).
    pub fn nearest(&self, wanted: &str) -> Option<&str> {
        nearest(wanted, self.iter().map(|(_, name)| name))
    }
}

/// The line on which a record begins: a reader's position still lies before the empty lines that it skips.
fn line(text: &[u8], position: Option<&csv::Position>) -> Option<u64> {
    let position = position?;
    let rest = text.get(usize::try_from(position.byte()).ok()?..)?;
    let skipped = rest.iter().take_while(|byte| b"\r\n".contains(byte));
    Some(position.line() + skipped.filter(|&&byte| byte == b'\n').count() as u64)
}

/// The fault of a malformed record. The text is in memory and lines may have any length, so only its bytes can be
/// wrong.
fn fault(error: csv::Error) -> NamesFault {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => NamesFault::Io(error),
        _ => NamesFault::NotText,
    }
}

impl NamesError {
    /// The fault, in one line.
    pub fn what(&self) -> String {
        self.fault.to_string()
    }

    /// The file, and the line if it is known.
    pub fn place(&self) -> String {
        let file = self.file.display();
        self.line.map_or_else(|| file.to_string(), |line| format!("{file}, line {line}"))
    }

    /// The remedy, in one line.
    pub fn remedy(&self) -> &'static str {
        match self.fault {
            NamesFault::Io(_) => "give a file that may be read",
            NamesFault::NotText => "save the table as UTF-8",
            NamesFault::NotAnId(_) | NamesFault::NoName(_) => "write an id and a name on each line, as in `5,liver`",
            NamesFault::IdTwice { .. } | NamesFault::NameTwice { .. } => "give each label one name, and each its own",
        }
    }
}

impl fmt::Display for NamesError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n{}\n{}", self.what(), self.place(), self.remedy())
    }
}

impl std::error::Error for NamesError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Disk;

    fn parse(text: &str) -> Vec<(u32, String)> {
        let names = LabelNames::parse(text.as_bytes()).unwrap();
        names.iter().map(|(id, name)| (id, name.to_owned())).collect()
    }

    #[test]
    fn with_and_without_header_quotes_and_further_columns() {
        let want = [(1, "spleen".to_owned()), (1200, "left, \"upper\" lobe".to_owned())];
        assert_eq!(parse("1,spleen\n1200,\"left, \"\"upper\"\" lobe\"\n"), want);
        assert_eq!(parse("label,name,voxels\n1200,\"left, \"\"upper\"\" lobe\"\n\n1,spleen,9668,33\n"), want);
        assert_eq!(parse("\u{feff}id,name\r\n 1 , spleen \r\n1200,\"left, \"\"upper\"\" lobe\""), want);
        assert_eq!(parse(""), []);
    }

    #[test]
    fn names_and_ids_are_found_from_each_other() {
        let names = LabelNames::parse("5,liver\n0,background\n".as_bytes()).unwrap();
        assert_eq!((names.id("liver"), names.id("Liver"), names.id("5")), (Some(5), None, None));
        assert_eq!((names.name(0), names.name(4)), (Some("background"), None));
        assert_eq!((names.nearest("livre"), names.nearest("kidney")), (Some("liver"), None));
    }

    /// A field in quotes may hold line breaks, and a fault is told on one line.
    #[test]
    fn a_fault_is_told_on_one_line() {
        let (line, fault) =
            LabelNames::parse(include_bytes!("../../../../fuzz/findings/labels/line-break.csv")).unwrap_err();
        let what = r"`\0\n\u{1}` is not a label: an id is a whole number from 0 to 4294967295";
        // A carriage return ends a record, and no line.
        assert_eq!((line, fault.to_string()), (Some(1), what.to_owned()));
        let (_, fault) = LabelNames::parse(b"1,\"a\nb\"\n1,c\n").unwrap_err();
        assert_eq!(fault.to_string(), r"label 1 has a name already, on line 1: `a\nb`");
    }

    #[test]
    fn faults_have_their_line() {
        for (text, line, what) in [
            ("id,name\n1,a\nliver,5\n", 3, "`liver` is not a label: an id is a whole number from 0 to 4294967295"),
            ("-1,a\n", 1, "`-1` is not a label: an id is a whole number from 0 to 4294967295"),
            ("4294967296,a\n", 1, "`4294967296` is not a label: an id is a whole number from 0 to 4294967295"),
            ("1,a\n2\n", 2, "label 2 has no name"),
            ("1,a\n2, ,x\n", 2, "label 2 has no name"),
            ("1,a\n2,b\n\n1,c\n", 4, "label 1 has a name already, on line 1: `a`"),
            ("1,\"a\nb\"\n2,b\n3,b\n", 4, "`b` is the name of label 2 already, on line 3"),
        ] {
            let (at, fault) = LabelNames::parse(text.as_bytes()).unwrap_err();
            assert_eq!((at, fault.to_string()), (Some(line), what.to_owned()), "{text:?}");
        }
        let (at, fault) = LabelNames::parse(b"1,a\n\n2,\xff\n").unwrap_err();
        assert!(at == Some(3) && matches!(fault, NamesFault::NotText));
    }

    #[test]
    fn a_fault_says_what_where_and_what_to_do() {
        let fault = NamesFault::NoName(2);
        let error = NamesError { file: "parts.csv".into(), line: Some(2), fault };
        let text = "label 2 has no name\nparts.csv, line 2\nwrite an id and a name on each line, as in `5,liver`";
        assert_eq!(error.to_string(), text);
        let gone = LabelNames::read(&Disk, Path::new("no/such/parts.csv")).unwrap_err();
        assert_eq!(gone.place(), "no/such/parts.csv");
    }
}
