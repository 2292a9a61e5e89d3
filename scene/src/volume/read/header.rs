//! Text headers: lines with numbers, fields with the line they stand on.

use super::error::{Fault, ReadError, quoted};
use crate::source::{Content, Source};
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// The longest text header that is read, in bytes: room for a list of ten thousand data files.
const LIMIT: u64 = 1 << 20;

/// Opens a regular file and says its length in bytes.
pub(super) fn open<'s>(source: &'s dyn Source, file: &Path) -> Result<(Box<dyn Content + 's>, u64), ReadError> {
    // Asked before opening: opening a pipe waits for its writer.
    let length = source.length(file).map_err(|e| ReadError::io(file, e))?;
    let length = length.ok_or_else(|| ReadError::new(file, Fault::NotAFile))?;
    Ok((source.open(file).map_err(|e| ReadError::io(file, e))?, length))
}

/// The lines of a text header.
pub(super) struct Lines<'s> {
    /// The source of the file.
    pub(super) source: &'s dyn Source,
    file: PathBuf,
    reader: BufReader<Box<dyn Content + 's>>,
    /// Number of the line read last, from 1.
    pub(super) number: usize,
    /// Bytes of the file up to the end of that line.
    pub(super) offset: u64,
}

impl<'s> Lines<'s> {
    /// The lines of a file.
    pub(super) fn open(source: &'s dyn Source, file: &Path) -> Result<Self, ReadError> {
        let (opened, _) = open(source, file)?;
        Ok(Self { source, file: file.to_path_buf(), reader: BufReader::new(opened), number: 0, offset: 0 })
    }

    /// Checks how the file begins; the bytes stay unread.
    pub(super) fn magic(&mut self, format: &'static str, magic: &'static str) -> Result<(), ReadError> {
        let start = self.reader.fill_buf().map_err(|e| ReadError::io(&self.file, e))?;
        if start.starts_with(magic.as_bytes()) {
            return Ok(());
        }
        let found = quoted(&String::from_utf8_lossy(&start[..start.len().min(8)]));
        Err(ReadError::new(&self.file, Fault::Magic { format, found, expected: magic }))
    }

    /// The next line without its end, or none at the end of the file.
    pub(super) fn read(&mut self) -> Result<Option<String>, ReadError> {
        let mut line = Vec::new();
        let room = LIMIT - self.offset;
        let n = self.reader.by_ref().take(room).read_until(b'\n', &mut line);
        let n = n.map_err(|e| ReadError::io(&self.file, e))? as u64;
        self.offset += n;
        let ended = line.pop_if(|c| *c == b'\n').is_some();
        if n == room && !ended {
            return Err(ReadError::new(&self.file, Fault::EndlessHeader { limit: LIMIT }));
        }
        if n == 0 {
            return Ok(None);
        }
        self.number += 1;
        line.pop_if(|c| *c == b'\r');
        Ok(Some(String::from_utf8_lossy(&line).into_owned()))
    }
}

/// A field of a header.
#[derive(Clone, Debug)]
pub(super) struct HeaderField {
    /// The field's name, as the format writes it.
    pub(super) name: &'static str,
    /// The value after the name, trimmed.
    pub(super) value: String,
    /// The line it stands on, from 1.
    pub(super) line: usize,
}

/// The fields of a text header.
pub(super) struct Header {
    /// The file they stand in.
    pub(super) file: PathBuf,
    fields: Vec<HeaderField>,
}

impl Header {
    /// A header without fields.
    pub(super) fn new(file: &Path) -> Self {
        Self { file: file.to_path_buf(), fields: Vec::new() }
    }

    /// Adds a field, which must be new.
    pub(super) fn add(&mut self, name: &'static str, value: &str, line: usize) -> Result<(), ReadError> {
        let field = HeaderField { name, value: value.trim().to_string(), line };
        if self.get(name).is_some() {
            return Err(self.error(&field, Fault::Repeated));
        }
        self.fields.push(field);
        Ok(())
    }

    /// A field that may be there.
    pub(super) fn get(&self, name: &str) -> Option<&HeaderField> {
        self.fields.iter().find(|f| f.name == name)
    }

    /// The first of several names for one thing.
    pub(super) fn first(&self, names: &[&str]) -> Option<&HeaderField> {
        names.iter().find_map(|name| self.get(name))
    }

    /// A field that must be there, and what it is expected to hold.
    pub(super) fn need(&self, name: &str, expected: &str) -> Result<&HeaderField, ReadError> {
        self.get(name).ok_or_else(|| self.missing(name, expected))
    }

    /// The error that a field is not there.
    pub(super) fn missing(&self, name: &str, expected: &str) -> ReadError {
        ReadError::new(&self.file, Fault::Missing { expected: expected.into() }).field(name)
    }

    /// An error at a field.
    pub(super) fn error(&self, field: &HeaderField, fault: impl Into<Fault>) -> ReadError {
        ReadError::new(&self.file, fault).field(field.name).line(field.line)
    }

    /// An error with the line of the field that it names.
    pub(super) fn with_line(&self, error: ReadError) -> ReadError {
        match error.field.as_deref().and_then(|name| self.get(name)) {
            Some(field) => error.line(field.line),
            None => error,
        }
    }

    /// The error that a field does not hold what it should.
    pub(super) fn expected(&self, field: &HeaderField, expected: &str) -> ReadError {
        self.error(field, Fault::Value { found: quoted(&field.value), expected: expected.into() })
    }

    /// The one number that a field holds.
    pub(super) fn number<T: FromStr>(&self, field: &HeaderField, expected: &str) -> Result<T, ReadError> {
        field.value.parse().map_err(|_| self.expected(field, expected))
    }

    /// The numbers that a field holds, parted by white space, `count` of them.
    pub(super) fn numbers<T: FromStr>(
        &self,
        field: &HeaderField,
        count: usize,
        what: &str,
    ) -> Result<Vec<T>, ReadError> {
        let numbers: Option<Vec<T>> = field.value.split_whitespace().map(|word| word.parse().ok()).collect();
        match numbers {
            Some(numbers) if numbers.len() == count => Ok(numbers),
            _ => Err(self.expected(field, &format!("{count} {what}"))),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Disk;

    #[test]
    fn lines_have_numbers_and_offsets() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("x");
        std::fs::write(&file, "one\r\ntwo\n\nfour").unwrap();
        let mut lines = Lines::open(&Disk, &file).unwrap();
        let mut all = Vec::new();
        while let Some(line) = lines.read().unwrap() {
            all.push((line, lines.number, lines.offset));
        }
        let want = [("one", 1, 5), ("two", 2, 9), ("", 3, 10), ("four", 4, 14)];
        assert_eq!(all, want.map(|(s, n, o)| (s.to_string(), n, o)));
    }

    #[test]
    fn a_line_without_end_is_refused() {
        let dir = tempfile::tempdir().unwrap();
        let file = dir.path().join("x");
        std::fs::write(&file, vec![b'a'; LIMIT as usize + 1]).unwrap();
        let error = Lines::open(&Disk, &file).unwrap().read().unwrap_err();
        assert!(matches!(*error.fault, Fault::EndlessHeader { .. }));
    }
}
