//! NRRD with attached or detached header ([IO-1], [SPACE-2]); the format is that of Teem 1.9 (NRRD0005).
//!
//! D's columns are `space directions`, voxel (0, 0, 0) lies at `space origin`. Without directions, `spacings` stand on
//! the diagonal, NaN counting as 1, and the origin is 0.

mod axes;
mod fields;

use super::data::{Payload, volume_of};
use super::error::{Fault, ReadError, quoted};
use super::header::{Header, HeaderField, Lines};
use super::limits::Encoding;
use super::{Choose, series};
use crate::source::Source;
use crate::volume::{Volume, VoxelType};
use std::path::{Path, PathBuf};

/// Reads an `.nrrd` or `.nhdr` file.
pub(super) fn read(source: &dyn Source, file: &Path, choose: &Choose<'_>) -> Result<Volume, ReadError> {
    let mut lines = Lines::open(source, file)?;
    let header = fields::read(file, &mut lines)?;
    let (voxel_type, big_endian) = number(&header)?;
    let encoding = encoding(&header)?;
    let axes = axes::read(&header)?;
    let (files, start, lines_before) = match header.get("data file") {
        Some(field) => (data_files(&header, field, &axes.sizes, &mut lines)?, 0, 0),
        None => (vec![file.to_path_buf()], lines.offset, lines.number),
    };
    let skips = skips(&header, encoding)?;
    let grid = axes.grid(&header)?;
    let payload = Payload {
        source,
        header: file,
        sizes: "sizes",
        count: grid.len(),
        voxel_type,
        big_endian,
        files,
        start,
        from_end: skips.from_end,
        lines: skips.lines,
        lines_before,
        encoding,
        inside: skips.bytes,
    };
    volume_of(file, &grid, &payload, [1.0, 0.0], axes.anatomy, choose)
}

/// Type and byte order of a voxel.
fn number(header: &Header) -> Result<(VoxelType, bool), ReadError> {
    let field = header.need("type", "a numeric type such as uint8, short or float")?;
    let name = field.value.to_ascii_lowercase();
    let words: Vec<&str> = name.split_whitespace().collect();
    let voxel_type = match words.join(" ").as_str() {
        "signed char" | "int8" | "int8_t" => VoxelType::I8,
        "uchar" | "unsigned char" | "uint8" | "uint8_t" => VoxelType::U8,
        "short" | "short int" | "signed short" | "signed short int" | "int16" | "int16_t" => VoxelType::I16,
        "ushort" | "unsigned short" | "unsigned short int" | "uint16" | "uint16_t" => VoxelType::U16,
        "int" | "signed int" | "int32" | "int32_t" => VoxelType::I32,
        "uint" | "unsigned int" | "uint32" | "uint32_t" => VoxelType::U32,
        "longlong"
        | "long long"
        | "long long int"
        | "signed long long"
        | "signed long long int"
        | "int64"
        | "int64_t" => VoxelType::I64,
        "ulonglong" | "unsigned long long" | "unsigned long long int" | "uint64" | "uint64_t" => VoxelType::U64,
        "float" => VoxelType::F32,
        "double" => VoxelType::F64,
        "block" => {
            let found = "voxels of type block".to_string();
            return Err(header.error(field, Fault::Unsupported { found, supported: "one number a voxel" }));
        }
        _ => return Err(header.expected(field, "a numeric type such as uint8, short or float")),
    };
    let big_endian = match header.get("endian") {
        Some(field) => match field.value.to_ascii_lowercase().as_str() {
            "little" => false,
            "big" => true,
            _ => return Err(header.expected(field, "little or big")),
        },
        None if voxel_type.bytes() == 1 || encoding(header)? == Encoding::Text => false,
        None => return Err(header.missing("endian", "little or big")),
    };
    Ok((voxel_type, big_endian))
}

fn encoding(header: &Header) -> Result<Encoding, ReadError> {
    let field = header.need("encoding", "raw, gzip, bzip2 or ascii")?;
    Ok(match field.value.to_ascii_lowercase().as_str() {
        "raw" => Encoding::Raw,
        "gzip" | "gz" => Encoding::Gzip,
        "ascii" | "text" | "txt" => Encoding::Text,
        "bzip2" | "bz2" => Encoding::Bzip2,
        "hex" | "zrl" => {
            let found = format!("data in encoding {}", quoted(&field.value));
            return Err(header.error(field, Fault::Unsupported { found, supported: "raw, gzip, bzip2 and ascii" }));
        }
        _ => return Err(header.expected(field, "raw, gzip, bzip2 or ascii")),
    })
}

/// The files that `data file` names: one, a numbered name, or a list that ends the header.
fn data_files(
    header: &Header,
    field: &HeaderField,
    sizes: &[usize],
    lines: &mut Lines<'_>,
) -> Result<Vec<PathBuf>, ReadError> {
    let words: Vec<&str> = field.value.split_whitespace().collect();
    let (files, axes_a_file) = match words.as_slice() {
        ["LIST", rest @ ..] if rest.len() < 2 => (series::list(&header.file, lines)?, rest.first()),
        [name, first, last, step, rest @ ..] if name.contains('%') && rest.len() < 2 => {
            let number = |word: &str| word.parse().map_err(|_| header.expected(field, "a name, first, last and step"));
            let range = [number(first)?, number(last)?, number(step)?];
            (series::numbered(lines.source, header, field, name, range)?, rest.first())
        }
        [] => return Err(header.expected(field, "a file name")),
        _ => return Ok(vec![series::beside(&header.file, &field.value)]),
    };
    // Each file has so many of the fastest axes; as many as there are: a slab along the slowest.
    let axes_a_file = match axes_a_file {
        None => sizes.len() - 1,
        Some(word) => {
            let axes = word.parse().ok().filter(|n| (1..=sizes.len()).contains(n));
            axes.ok_or_else(|| header.expected(field, "a number of axes at the end"))?
        }
    };
    let expected = sizes[axes_a_file..].iter().try_fold(1usize, |n, &size| n.checked_mul(size));
    if axes_a_file < sizes.len() && expected != Some(files.len()) {
        let found = format!("{} data files", files.len());
        let expected = format!("one for each of the {:?} slices", &sizes[axes_a_file..]);
        return Err(header.error(field, Fault::Value { found, expected }));
    }
    Ok(files)
}

/// The parts of a file to skip before the data. Lines are skipped in the file itself, bytes in the decoded data.
#[derive(Default)]
struct Skips {
    lines: u64,
    bytes: u64,
    /// A byte skip of −1: everything up to the data, which end with the file.
    from_end: bool,
}

fn skips(header: &Header, encoding: Encoding) -> Result<Skips, ReadError> {
    let lines = match header.get("line skip") {
        Some(field) => header.number(field, "a number of lines")?,
        None => 0,
    };
    let Some(field) = header.get("byte skip") else { return Ok(Skips { lines, ..Skips::default() }) };
    match header.number::<i64>(field, "a number of bytes, or −1")? {
        -1 if encoding == Encoding::Raw => Ok(Skips { from_end: true, ..Skips::default() }),
        -1 => {
            let found = "data at the end of a file that is not raw".to_string();
            Err(header.error(field, Fault::Unsupported { found, supported: "a byte skip of −1 with raw data" }))
        }
        n => match u64::try_from(n) {
            Ok(bytes) => Ok(Skips { lines, bytes, from_end: false }),
            Err(_) => Err(header.expected(field, "a number of bytes, or −1")),
        },
    }
}
