//! MetaImage: `.mhd` with the voxels beside it, `.mha` with them behind the header ([IO-1], [SPACE-2]).
//!
//! D is `TransformMatrix` × `ElementSpacing`. The first NDims numbers of the matrix are the direction of the first axis
//! of the voxels, and so on; voxel (0, 0, 0) lies at `Offset`. The world is LPS, as in MetaImage's own library.
//! `AnatomicalOrientation` names the voxels' axes, not the world's. It repeats the matrix and is not read.

use super::data::{Payload, volume_of};
use super::error::{Fault, ReadError, quoted};
use super::header::{Header, HeaderField, Lines};
use super::limits::Encoding;
use super::{Choose, grid_of, header, series};
use crate::source::Source;
use crate::volume::{Anatomy, Volume, VoxelType};
use glam::{DMat3, DVec3};
use std::path::{Path, PathBuf};

/// The keys that are read. Others are notes of the program that wrote the file.
const KEYS: [&str; 22] = [
    "ObjectType",
    "NDims",
    "BinaryData",
    "BinaryDataByteOrderMSB",
    "ElementByteOrderMSB",
    "CompressedData",
    "CompressedDataSize",
    "TransformMatrix",
    "Rotation",
    "Orientation",
    "Offset",
    "Position",
    "Origin",
    "ElementSpacing",
    "ElementSize",
    "DimSize",
    "HeaderSize",
    "ElementNumberOfChannels",
    "ElementToIntensityFunctionSlope",
    "ElementToIntensityFunctionOffset",
    "ElementType",
    "ElementDataFile",
];

/// The most axes that a header may have.
const MOST_AXES: usize = 10;

/// Reads an `.mhd` or `.mha` file.
pub(super) fn read(source: &dyn Source, file: &Path, choose: &Choose<'_>) -> Result<Volume, ReadError> {
    let mut lines = Lines::open(source, file)?;
    let header = fields(file, &mut lines)?;
    let sizes = sizes(&header)?;
    let dims = [sizes[0], sizes[1], sizes[2]];
    let field = header.need("ElementDataFile", "LOCAL, LIST or a file name")?;
    let local = field.value.eq_ignore_ascii_case("LOCAL");
    // A HeaderSize is that of data files of their own.
    let (files, (start, from_end), lines_before) = if local {
        (vec![file.to_path_buf()], (lines.offset, false), lines.number)
    } else {
        (data_files(&header, field, &sizes, &mut lines)?, header_size(&header)?, 0)
    };
    // How the data are encoded.
    let compressed = flag_or(&header, &["CompressedData"], false)?;
    let encoding = match (flag_or(&header, &["BinaryData"], true)?, compressed) {
        (true, false) => Encoding::Raw,
        (true, true) => Encoding::Zlib,
        (false, false) => Encoding::Text,
        (false, true) => {
            let field = header.need("CompressedData", "False")?;
            let found = "compressed text".to_string();
            return Err(header.error(field, Fault::Unsupported { found, supported: "text or compressed numbers" }));
        }
    };
    if from_end && encoding != Encoding::Raw {
        let field = header.need("HeaderSize", "a number of bytes")?;
        let found = "data at the end of a file that is not raw".to_string();
        return Err(header.error(field, Fault::Unsupported { found, supported: "a HeaderSize of −1 with raw data" }));
    }
    // Where the voxels lie in the world.
    let (axes, origin, names) = space(&header, sizes.len())?;
    let grid = grid_of(file, dims, axes, origin, names).map_err(|e| header.with_line(e))?;
    let payload = Payload {
        source,
        header: file,
        sizes: "DimSize",
        count: grid.len(),
        voxel_type: voxel_type(&header)?,
        big_endian: flag_or(&header, &["ElementByteOrderMSB", "BinaryDataByteOrderMSB"], false)?,
        files,
        start,
        from_end,
        lines: 0,
        lines_before,
        encoding,
        inside: 0,
    };
    if let (true, Some(field), &[_]) = (compressed, header.get("CompressedDataSize"), payload.files.as_slice()) {
        compressed_size(&header, field, &payload)?;
    }
    // Values from stored numbers.
    let scaling = [
        number_or(&header, "ElementToIntensityFunctionSlope", 1.0)?,
        number_or(&header, "ElementToIntensityFunctionOffset", 0.0)?,
    ];
    volume_of(file, &grid, &payload, scaling, Some(Anatomy::LeftPosteriorSuperior), choose)
}

/// Reads `Key = value` lines up to `ElementDataFile`, which is the last.
fn fields(file: &Path, lines: &mut Lines<'_>) -> Result<Header, ReadError> {
    let mut header = Header::new(file);
    while let Some(line) = lines.read()? {
        let Some((written, value)) = line.split_once('=') else {
            if line.trim().is_empty() || line.starts_with('#') {
                continue;
            }
            let found = quoted(&line);
            let fault = if lines.number == 1 {
                Fault::Magic { format: "a MetaImage file", found, expected: "`ObjectType = Image`" }
            } else {
                Fault::Line { found }
            };
            return Err(ReadError::new(file, fault).line(lines.number));
        };
        let written = written.trim();
        let Some(key) = KEYS.into_iter().find(|key| *key == written) else { continue };
        header.add(key, value, lines.number)?;
        if key == "ElementDataFile" {
            break;
        }
    }
    if let Some(field) = header.get("ObjectType").filter(|f| !f.value.eq_ignore_ascii_case("Image")) {
        return Err(header.expected(field, "Image"));
    }
    Ok(header)
}

/// Samples along every axis; those behind the third have one.
fn sizes(header: &Header) -> Result<Vec<usize>, ReadError> {
    let field = header.need("NDims", "3")?;
    let axes: usize = header.number(field, "a number of axes")?;
    if !(3..=MOST_AXES).contains(&axes) {
        let found = format!("data with {axes} axes");
        return Err(header.error(field, Fault::Unsupported { found, supported: "volumes of three axes" }));
    }
    let field = header.need("DimSize", "samples along each axis")?;
    let sizes: Vec<usize> = header.numbers(field, axes, "whole numbers, one for each axis")?;
    if let Some(axis) = (3..axes).find(|&axis| sizes[axis] != 1) {
        let found = format!("axis {axis} with {} samples", sizes[axis]);
        let supported = "one number a voxel on three axes of space";
        return Err(header.error(field, Fault::Unsupported { found, supported }));
    }
    if let Some(field) = header.get("ElementNumberOfChannels")
        && header.number::<u32>(field, "1")? != 1
    {
        let found = format!("{} channels a voxel", field.value);
        return Err(header.error(field, Fault::Unsupported { found, supported: "one number a voxel" }));
    }
    Ok(sizes)
}

/// D, origin, and the names of the fields that they come from.
fn space(header: &Header, axes: usize) -> Result<(DMat3, DVec3, [&'static str; 3]), ReadError> {
    let three = |names: &[&'static str], default: f64| -> Result<(DVec3, &'static str), ReadError> {
        let Some(field) = header.first(names) else { return Ok((DVec3::splat(default), names[0])) };
        let numbers: Vec<f64> = header.numbers(field, axes, "numbers, one for each axis")?;
        Ok((DVec3::new(numbers[0], numbers[1], numbers[2]), field.name))
    };
    let (spacing, spacing_name) = three(&["ElementSpacing", "ElementSize"], 1.0)?;
    let (origin, origin_name) = three(&["Offset", "Position", "Origin"], 0.0)?;
    let Some(field) = header.first(&["TransformMatrix", "Rotation", "Orientation"]) else {
        return Ok((DMat3::from_diagonal(spacing), origin, ["DimSize", spacing_name, origin_name]));
    };
    let m: Vec<f64> = header.numbers(field, axes * axes, "numbers, a direction for each axis")?;
    let column = |axis: usize| DVec3::new(m[axis * axes], m[axis * axes + 1], m[axis * axes + 2]) * spacing[axis];
    let name = if spacing.is_finite() && spacing.min_element() != 0.0 { field.name } else { spacing_name };
    Ok((DMat3::from_cols(column(0), column(1), column(2)), origin, ["DimSize", name, origin_name]))
}

fn voxel_type(header: &Header) -> Result<VoxelType, ReadError> {
    let expected = "a type such as MET_UCHAR, MET_SHORT or MET_FLOAT";
    let field = header.need("ElementType", expected)?;
    Ok(match field.value.as_str() {
        "MET_CHAR" | "MET_ASCII_CHAR" => VoxelType::I8,
        "MET_UCHAR" => VoxelType::U8,
        "MET_SHORT" => VoxelType::I16,
        "MET_USHORT" => VoxelType::U16,
        // A long of MetaImage has four bytes on every machine.
        "MET_INT" | "MET_LONG" => VoxelType::I32,
        "MET_UINT" | "MET_ULONG" => VoxelType::U32,
        "MET_LONG_LONG" => VoxelType::I64,
        "MET_ULONG_LONG" => VoxelType::U64,
        "MET_FLOAT" => VoxelType::F32,
        "MET_DOUBLE" => VoxelType::F64,
        name if name.ends_with("_ARRAY") || name.ends_with("_MATRIX") => {
            let found = format!("voxels of type {}", quoted(name));
            return Err(header.error(field, Fault::Unsupported { found, supported: "one number a voxel" }));
        }
        _ => return Err(header.expected(field, expected)),
    })
}

/// The first of several switches.
fn flag_or(header: &Header, names: &[&str], default: bool) -> Result<bool, ReadError> {
    let Some(field) = header.first(names) else { return Ok(default) };
    match field.value.to_ascii_lowercase().as_str() {
        "true" | "t" | "1" => Ok(true),
        "false" | "f" | "0" => Ok(false),
        _ => Err(header.expected(field, "True or False")),
    }
}

fn number_or(header: &Header, name: &str, default: f64) -> Result<f64, ReadError> {
    header.get(name).map_or(Ok(default), |field| header.number(field, "a number"))
}

/// The bytes before the voxels in each data file, and whether they are all but the last ones (−1).
fn header_size(header: &Header) -> Result<(u64, bool), ReadError> {
    let Some(field) = header.get("HeaderSize") else { return Ok((0, false)) };
    let expected = "a number of bytes, or −1";
    match header.number::<i64>(field, expected)? {
        -1 => Ok((0, true)),
        n => u64::try_from(n).map(|n| (n, false)).map_err(|_| header.expected(field, expected)),
    }
}

/// The files that `ElementDataFile` names: one, a numbered name with first, last and step, or a list that follows.
fn data_files(
    header: &Header,
    field: &HeaderField,
    sizes: &[usize],
    lines: &mut Lines<'_>,
) -> Result<Vec<PathBuf>, ReadError> {
    let words: Vec<&str> = field.value.split_whitespace().collect();
    match words.as_slice() {
        [] => Err(header.expected(field, "LOCAL, LIST or a file name")),
        // The second word says how many axes a file has. It is checked by the lengths: all shares are equal.
        ["LIST", rest @ ..] if rest.len() < 2 => series::list(&header.file, lines),
        [name, numbers @ ..] if name.contains('%') && numbers.len() <= 3 => {
            let expected = "a name, first, last and step";
            let numbers: Option<Vec<i64>> = numbers.iter().map(|word| word.parse().ok()).collect();
            let numbers = numbers.ok_or_else(|| header.expected(field, expected))?;
            // Without a last number, or without a step: so that there is one file for each slice.
            let steps = i64::try_from(sizes[2]).unwrap_or(i64::MAX).saturating_sub(1);
            let first = numbers.first().copied().unwrap_or(1);
            let last = numbers.get(1).copied().unwrap_or(first.saturating_add(steps));
            let step = match numbers.get(2) {
                Some(&step) => step,
                None => last.saturating_sub(first).checked_div(steps).unwrap_or(1),
            };
            series::numbered(lines.source, header, field, name, [first, last, step])
        }
        _ => Ok(vec![series::beside(&header.file, &field.value)]),
    }
}

/// Checks the number of compressed bytes that the header gives; 0 says that it is not known.
fn compressed_size(header: &Header, field: &HeaderField, payload: &Payload) -> Result<(), ReadError> {
    let said: u64 = header.number(field, "a number of bytes")?;
    let path = &payload.files[0];
    let (_, len) = header::open(payload.source, path)?;
    let found = len.saturating_sub(payload.start);
    if said == 0 || said == found {
        return Ok(());
    }
    let (expected, found) = (said.into(), found.into());
    let fault = if found < expected {
        Fault::Short { expected, found, unit: "compressed bytes" }
    } else {
        Fault::Long { expected, found, at_least: false, unit: "compressed bytes" }
    };
    Err(ReadError::new(path, fault).field("CompressedDataSize"))
}
