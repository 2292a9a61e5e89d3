//! What the command says when it cannot do what it was asked: what, where, and what to do.

use std::fmt;

/// One fault in three lines. Several faults of one scene are one failure with more lines.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// What is wrong.
    pub what: String,
    /// File, line, key.
    pub place: String,
    /// What to do.
    pub remedy: String,
}

impl Failure {
    /// From its three lines.
    pub fn new(what: impl fmt::Display, place: impl fmt::Display, remedy: impl fmt::Display) -> Self {
        Self { what: what.to_string(), place: place.to_string(), remedy: remedy.to_string() }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "error: {}", self.what)?;
        if !self.place.is_empty() {
            write!(f, "\n  at: {}", self.place)?;
        }
        if !self.remedy.is_empty() {
            write!(f, "\n  try: {}", self.remedy)?;
        }
        Ok(())
    }
}

impl std::error::Error for Failure {}
