//! Failures of the command: the fault, its place, and the remedy.

use drypoint_output::OutputError;
use drypoint_scene::file::{Fault, Faults};
use drypoint_scene::volume::read::ReadError;
use drypoint_scene::volume::write::WriteError;
use std::fmt;

/// One fault in three lines.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// The fault.
    pub what: String,
    /// The place: file, line, key.
    pub place: String,
    /// The remedy.
    pub remedy: String,
}

impl Failure {
    /// Makes a failure of its three lines. Line breaks, which a path may have, become spaces.
    pub fn new(what: impl fmt::Display, place: impl fmt::Display, remedy: impl fmt::Display) -> Self {
        let line = |text: &dyn fmt::Display| text.to_string().replace(char::is_control, " ");
        Self { what: line(&what), place: line(&place), remedy: line(&remedy) }
    }

    /// Returns the failure of a volume's file, with the position of the key that names it.
    pub fn of_file(error: &ReadError, key: impl fmt::Display) -> Self {
        Self::new(error.what(), format!("{}, {key}", error.place()), error.remedy())
    }

    /// Returns the failure of a picture's file. `place` is used if the error names no file.
    pub fn picture(error: &OutputError, place: impl fmt::Display) -> Self {
        let text = error.to_string();
        let file = match error {
            OutputError::Io { path, .. }
            | OutputError::UnknownFormat { path, .. }
            | OutputError::Malformed { path, .. }
            | OutputError::TooLarge { path, .. }
            | OutputError::Side { path, .. }
            | OutputError::NoRoom { path: Some(path), .. } => path.display().to_string(),
            OutputError::List { path, line, column, fault } => {
                return Self::new(fault, format!("{}, line {line}, column {column}", path.display()), error.help());
            }
            _ => return Self::new(text, place, error.help()),
        };
        let fault = text.strip_prefix(&format!("{file}: ")).unwrap_or(&text);
        let what = match error {
            OutputError::Io { .. } => format!("the picture {fault}"),
            _ => fault.into(),
        };
        Self::new(what, file, error.help())
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

impl From<&Fault> for Failure {
    fn from(fault: &Fault) -> Self {
        Self::new(fault.what(), fault.position(), fault.remedy())
    }
}

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Self {
        Self::new(error.what(), error.place(), error.remedy())
    }
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        Self::new(error.what(), error.place(), error.remedy())
    }
}

/// One or more failures, three lines each.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failures(Vec<Failure>);

impl Failures {
    /// Makes a list of the first and the others, without repetitions.
    pub fn new(first: Failure, others: impl IntoIterator<Item = Failure>) -> Self {
        let mut each = vec![first];
        for failure in others {
            if !each.contains(&failure) {
                each.push(failure);
            }
        }
        Self(each)
    }

    /// Succeeds if there is no failure.
    ///
    /// # Errors
    /// All failures, if there is one.
    pub fn check(failures: impl IntoIterator<Item = Failure>) -> Result<(), Self> {
        let mut failures = failures.into_iter();
        failures.next().map_or(Ok(()), |first| Err(Self::new(first, failures)))
    }

    /// Changes each failure.
    #[cfg(feature = "command")]
    pub(crate) fn map(self, change: impl Fn(Failure) -> Failure) -> Self {
        Self(self.0.into_iter().map(change).collect())
    }

    /// Iterates over the failures, at least one.
    pub fn iter(&self) -> std::slice::Iter<'_, Failure> {
        self.0.iter()
    }
}

impl From<Failure> for Failures {
    fn from(failure: Failure) -> Self {
        Self(vec![failure])
    }
}

impl From<ReadError> for Failures {
    fn from(error: ReadError) -> Self {
        Failure::from(error).into()
    }
}

impl From<Faults> for Failures {
    fn from(faults: Faults) -> Self {
        Self(faults.iter().map(Failure::from).collect())
    }
}

impl fmt::Display for Failures {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, failure) in self.0.iter().enumerate() {
            if i > 0 {
                writeln!(f)?;
            }
            write!(f, "{failure}")?;
        }
        Ok(())
    }
}

impl std::error::Error for Failures {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_failure_has_three_lines_whatever_a_path_has() {
        let failure = Failure::new("no such\nfile", "a\r\nb.toml", "look");
        assert_eq!(failure.to_string(), "error: no such file\n  at: a  b.toml\n  try: look");
        assert_eq!(Failure::new("x", "", "").to_string(), "error: x");
    }

    #[test]
    fn what_is_said_twice_is_said_once() {
        let [a, b] = ["a", "b"].map(|what| Failure::new(what, "here", "do"));
        assert_eq!(Failures::check([]), Ok(()));
        let all = Failures::check([a.clone(), b.clone(), a.clone()]).unwrap_err();
        assert_eq!(all.iter().collect::<Vec<_>>(), [&a, &b]);
        assert_eq!(all.to_string(), format!("{a}\n{b}"));
    }

    #[test]
    fn the_file_of_a_picture_is_the_place() {
        let path = "a/b.png".into();
        let source = std::io::Error::new(std::io::ErrorKind::NotFound, "gone");
        let failure = Failure::picture(&OutputError::Io { path, action: "read", source }, "elsewhere");
        assert_eq!((&*failure.what, &*failure.place), ("the picture cannot be read: gone", "a/b.png"));
        let failure = Failure::picture(&OutputError::Bits { bits: 12 }, "elsewhere");
        assert_eq!((&*failure.what, &*failure.place), ("picture.bits: 12 bits per channel", "elsewhere"));
    }
}
