//! Faults of a scene, in the three lines of the command line's errors: what, where, what to do.

use super::place::{Place, position};
use std::fmt;
use std::path::PathBuf;

/// One fault of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Fault {
    /// The scene file, as it was named.
    pub file: PathBuf,
    /// Place in the file, or on the command line.
    pub place: Place,
    /// The key from the top, such as `transfer.nodes[2].style`; empty for a fault of the file as a whole.
    pub key: String,
    /// The kind of fault.
    pub problem: Problem,
}

/// The kinds of fault.
#[derive(Clone, Debug, PartialEq)]
pub enum Problem {
    /// The file cannot be read.
    Unreadable {
        /// Message of the system.
        reason: String,
    },
    /// Not TOML.
    Syntax {
        /// Message of the parser.
        message: String,
    },
    /// A key or table that does not exist.
    UnknownKey {
        /// The table around it, such as `[camera]`.
        table: String,
        /// The key as written.
        name: String,
        /// The known key that was probably meant.
        nearest: Option<String>,
        /// All that is known there.
        known: Vec<String>,
    },
    /// A table or key of the format that this version does not have yet.
    NotBuilt {
        /// The table or key, in words.
        what: String,
    },
    /// A value of the wrong type, unit, range or name.
    Value {
        /// The value, in words.
        found: String,
        /// The values that may stand there, in words.
        expected: String,
        /// The known name that was probably meant.
        nearest: Option<String>,
    },
    /// A list with more items, or a table with more names, than it may have.
    TooMany {
        /// The number of entries.
        count: usize,
        /// The most that may stand there.
        most: usize,
    },
    /// A name of something that does not exist.
    Reference {
        /// Kind of thing that it should name, such as `style`.
        what: String,
        /// The name as written.
        name: String,
        /// The known name that was probably meant.
        nearest: Option<String>,
        /// All that is known.
        known: Vec<String>,
    },
    /// A required key that is missing.
    Missing {
        /// The values that may stand there, in words.
        expected: String,
    },
    /// Keys that are right alone and wrong together.
    Contradiction {
        /// The contradiction, in words.
        what: String,
        /// Advice.
        remedy: String,
    },
    /// A file or folder that the scene names and that does not exist.
    NoFile {
        /// The path.
        path: PathBuf,
        /// Folders that were searched, or advice.
        remedy: String,
    },
    /// Faults that are not reported one by one.
    Further {
        /// The number of these faults.
        count: usize,
    },
    /// An override that cannot be applied.
    Override {
        /// The mistake, in words.
        what: String,
        /// Advice.
        remedy: String,
    },
}

impl Problem {
    /// The fault of an override that leads to an item which a list does not have.
    pub(crate) fn no_item(step: &str, len: usize) -> Self {
        Self::Override {
            what: format!("there is no item {step} in a list of {len}"),
            remedy: "items count from 0".into(),
        }
    }
}

impl Fault {
    /// The first line: what is wrong.
    pub fn what(&self) -> String {
        let key = &self.key;
        one_line(match &self.problem {
            Problem::Unreadable { reason } => format!("the scene cannot be read: {reason}"),
            Problem::Syntax { message } => format!("not TOML: {message}"),
            Problem::UnknownKey { table, name, .. } => format!("{table} has no key {name:?}"),
            Problem::NotBuilt { what } => format!("{what} is not built yet"),
            Problem::Value { found, .. } => format!("{key} cannot be {found}"),
            Problem::TooMany { count, most } => format!("{key} has {count} entries, and {most} are the most"),
            Problem::Reference { what, name, .. } => format!("there is no {what} {name:?}"),
            Problem::Missing { .. } => format!("{key} is missing"),
            Problem::Contradiction { what, .. } | Problem::Override { what, .. } => what.clone(),
            Problem::NoFile { path, .. } => format!("{} is not there", path.display()),
            Problem::Further { count: 1 } => "there is one more fault".into(),
            Problem::Further { count } => format!("there are {count} more faults"),
        })
    }

    /// The second line: where.
    pub fn position(&self) -> String {
        let place = Some(&self.place).filter(|_| !matches!(self.problem, Problem::Unreadable { .. }));
        one_line(position(&self.file, place, &self.key))
    }

    /// The third line: what to do.
    pub fn remedy(&self) -> String {
        let meant = |nearest: &Option<String>, rest: String| match nearest {
            Some(name) => format!("write {name:?}; {rest}"),
            None => rest,
        };
        one_line(match &self.problem {
            Problem::Unreadable { .. } => "check the file's name and that it is text in UTF-8".into(),
            Problem::Syntax { .. } => "correct this line: key = value, texts in quotes, tables as [name]".into(),
            Problem::UnknownKey { nearest, known, .. } => {
                meant(nearest, format!("the keys here are {}", known.join(", ")))
            }
            Problem::NotBuilt { .. } => "remove it: this version cannot draw it, and would not ignore it".into(),
            Problem::Value { expected, nearest, .. } => match nearest {
                Some(name) if *expected != format!("{name:?}") => format!("write {name:?}; expected is {expected}"),
                _ => format!("write {expected}"),
            },
            Problem::TooMany { most, .. } => format!("write at most {most}"),
            Problem::Further { .. } => "correct those above first".into(),
            Problem::Reference { what, nearest, known, .. } => {
                let all = if known.is_empty() {
                    format!("there is no {what} at all")
                } else {
                    format!("there is {}", known.join(", "))
                };
                meant(nearest, all)
            }
            Problem::Missing { expected } => format!("write {expected}"),
            Problem::Contradiction { remedy, .. }
            | Problem::Override { remedy, .. }
            | Problem::NoFile { remedy, .. } => remedy.clone(),
        })
    }
}

/// The text without line breaks: a path or an override may have one, and a message has three lines.
fn one_line(text: String) -> String {
    text.replace(char::is_control, " ")
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n  at {}\n  {}", self.what(), self.position(), self.remedy())
    }
}

/// All faults of a scene, in the order of the file; those of the command line last. Never empty.
#[derive(Clone, Debug, PartialEq)]
pub struct Faults(Vec<Fault>);

impl Faults {
    /// None where there is no fault.
    pub(crate) fn new(mut faults: Vec<Fault>) -> Option<Self> {
        faults.sort_by(|a, b| (&a.place, &a.key).cmp(&(&b.place, &b.key)));
        faults.dedup();
        if faults.is_empty() { None } else { Some(Self(faults)) }
    }

    /// Each fault.
    pub fn iter(&self) -> std::slice::Iter<'_, Fault> {
        self.0.iter()
    }
}

impl<'a> IntoIterator for &'a Faults {
    type Item = &'a Fault;
    type IntoIter = std::slice::Iter<'a, Fault>;

    fn into_iter(self) -> Self::IntoIter {
        self.iter()
    }
}

impl fmt::Display for Faults {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, fault) in self.0.iter().enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            write!(f, "{fault}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Faults {}
