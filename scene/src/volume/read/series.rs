//! Voxels in several files: lists and numbered names, as NRRD and MetaImage have them.

use super::error::{Fault, ReadError};
use super::header::{Header, HeaderField, Lines};
use crate::source::Source;
use std::path::{Path, PathBuf};

/// The most digits that a number in a name is padded to.
const PADDING: usize = 32;

/// A path in a header, which is relative to the header's folder.
pub(super) fn beside(header: &Path, name: &str) -> PathBuf {
    header.parent().unwrap_or(Path::new("")).join(name)
}

/// The file names on the remaining lines of a header, blank lines left out.
pub(super) fn list(header: &Path, lines: &mut Lines<'_>) -> Result<Vec<PathBuf>, ReadError> {
    let mut files = Vec::new();
    while let Some(line) = lines.read()? {
        let name = line.trim();
        if !name.is_empty() {
            files.push(beside(header, name));
        }
    }
    Ok(files)
}

/// The files of a name with a number in it, such as `slice%03d.raw`, the number going from `first` to `last` in steps
/// of `step`. A field may ask for any number of files. The first missing file therefore ends the series, and is an
/// error.
pub(super) fn numbered(
    source: &dyn Source,
    header: &Header,
    field: &HeaderField,
    name: &str,
    [first, last, step]: [i64; 3],
) -> Result<Vec<PathBuf>, ReadError> {
    let name = NumberedName::parse(name).ok_or_else(|| header.expected(field, "a name with one %d in it"))?;
    if step == 0 || (last < first) != (step < 0) && last != first {
        return Err(header.expected(field, "a step that leads from the first number to the last"));
    }
    let mut files = Vec::new();
    let mut number = Some(first);
    while let Some(n) = number.filter(|&n| if step > 0 { n <= last } else { n >= last }) {
        let file = beside(&header.file, &name.with(n));
        if let Err(e) = source.length(&file) {
            return Err(ReadError::new(&file, Fault::Io(e)));
        }
        files.push(file);
        number = n.checked_add(step);
    }
    Ok(files)
}

/// A name with one printf-like number in it.
struct NumberedName {
    before: String,
    after: String,
    zeros: bool,
    width: usize,
}

impl NumberedName {
    /// Takes `%d`, `%i` or `%u` with an optional width, and `%%` for a percent sign.
    fn parse(name: &str) -> Option<Self> {
        let mut found: Option<Self> = None;
        let mut text = String::new();
        let mut chars = name.chars();
        while let Some(c) = chars.next() {
            if c != '%' {
                text.push(c);
                continue;
            }
            let spec: String = chars.clone().take_while(char::is_ascii_digit).collect();
            match chars.nth(spec.len())? {
                '%' if spec.is_empty() => text.push('%'),
                'd' | 'i' | 'u' if found.is_none() => {
                    let width = if spec.is_empty() { 0 } else { spec.parse().ok().filter(|w| *w <= PADDING)? };
                    let before = std::mem::take(&mut text);
                    found = Some(Self { before, after: String::new(), zeros: spec.starts_with('0'), width });
                }
                _ => return None,
            }
        }
        found.map(|name| Self { after: text, ..name })
    }

    fn with(&self, n: i64) -> String {
        let Self { before, after, zeros, width } = self;
        if *zeros { format!("{before}{n:0width$}{after}") } else { format!("{before}{n:width$}{after}") }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::source::Disk;

    #[test]
    fn names_as_printf_writes_them() {
        let write = |name: &str, n| NumberedName::parse(name).map(|p| p.with(n));
        assert_eq!(write("a%d.raw", 7).as_deref(), Some("a7.raw"));
        assert_eq!(write("a%03d.raw", 7).as_deref(), Some("a007.raw"));
        assert_eq!(write("a%3u.raw", 7).as_deref(), Some("a  7.raw"));
        assert_eq!(write("100%%-%02i", -1).as_deref(), Some("100%--1"));
        for bad in ["a.raw", "%d%d", "%s", "%", "%5", "%99999999999d", "%-3d", "%é"] {
            assert_eq!(write(bad, 1), None, "{bad}");
        }
    }

    #[test]
    fn numbers_go_from_first_to_last_while_there_are_files() {
        let dir = tempfile::tempdir().unwrap();
        for n in [1, 3, 5] {
            std::fs::write(dir.path().join(format!("s{n}")), "").unwrap();
        }
        let mut header = Header::new(&dir.path().join("h.nhdr"));
        header.add("data file", "s%d", 2).unwrap();
        let field = header.get("data file").unwrap();
        let names = |range| {
            let name = |file: PathBuf| file.file_name().unwrap().to_string_lossy().into_owned();
            numbered(&Disk, &header, field, "s%d", range).map(|files| files.into_iter().map(name).collect::<Vec<_>>())
        };
        assert_eq!(names([1, 5, 2]).unwrap(), ["s1", "s3", "s5"]);
        assert_eq!(names([5, 1, -4]).unwrap(), ["s5", "s1"]);
        assert_eq!(names([3, 3, 1]).unwrap(), ["s3"]);
        assert!(matches!(*names([1, i64::MAX, 2]).unwrap_err().fault, Fault::Io(_)));
        assert!(matches!(*names([1, 5, 0]).unwrap_err().fault, Fault::Value { .. }));
        assert!(matches!(*names([1, 5, -1]).unwrap_err().fault, Fault::Value { .. }));
    }
}
