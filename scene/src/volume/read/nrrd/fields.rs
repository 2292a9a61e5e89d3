//! The header of an NRRD file, line by line.

use super::super::error::{Fault, ReadError, quoted};
use super::super::header::{Header, Lines};
use std::path::Path;

/// Every field of the format.
const NAMES: [&str; 30] = [
    "content",
    "number",
    "type",
    "block size",
    "dimension",
    "space",
    "space dimension",
    "sizes",
    "spacings",
    "thicknesses",
    "axis mins",
    "axis maxs",
    "space directions",
    "centers",
    "kinds",
    "labels",
    "units",
    "min",
    "max",
    "old min",
    "old max",
    "endian",
    "encoding",
    "line skip",
    "byte skip",
    "sample units",
    "space units",
    "space origin",
    "measurement frame",
    "data file",
];

/// The field of that name; case and spaces do not count, as in the format's own alternatives (`data file`,
/// `datafile`).
fn name(written: &str) -> Option<&'static str> {
    let plain = |s: &str| s.chars().filter(|c| !c.is_whitespace()).collect::<String>().to_ascii_lowercase();
    let wanted = match plain(written) {
        name if name == "centerings" => "centers".to_string(),
        name => name,
    };
    NAMES.into_iter().find(|name| plain(name) == wanted)
}

/// Reads the lines up to the blank line that ends the header, to the end of the file, or to a list of data files. Data
/// can follow only a blank line, or lie in files that the header names.
pub(super) fn read(file: &Path, lines: &mut Lines<'_>) -> Result<Header, ReadError> {
    lines.magic("an NRRD file", "NRRD000")?;
    lines.read()?;
    let mut header = Header::new(file);
    let mut blank = false;
    while let Some(line) = lines.read()? {
        let at = |fault| ReadError::new(file, fault).line(lines.number);
        if line.is_empty() {
            blank = true;
            break;
        }
        if line.starts_with('#') {
            continue;
        }
        let Some((written, value)) = line.split_once(':') else {
            return Err(at(Fault::Line { found: quoted(&line) }));
        };
        if value.starts_with('=') {
            continue;
        }
        let Some(name) = name(written) else {
            return Err(at(Fault::UnknownField).field(quoted(written)));
        };
        header.add(name, value, lines.number)?;
        if name == "data file" && value.split_whitespace().next() == Some("LIST") {
            break;
        }
    }
    if !blank && header.get("data file").is_none() {
        return Err(header.missing("data file", "a blank line with the data behind it, or the name of their file"));
    }
    Ok(header)
}
