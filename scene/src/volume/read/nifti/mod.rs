//! NIfTI-1 and NIfTI-2: `.nii`, `.nii.gz`, and `.hdr` with `.img` ([IO-1], [VAL-1], [SPACE-2]).
//!
//! The world is RAS. D and origin come from the sform if its code is positive, else from the qform, else from
//! `pixdim` alone, which names no anatomical space. A slope of 0 or NaN says that values are as stored.

mod affine;
mod fields;

use super::data::{Payload, volume_of};
use super::error::{Fault, ReadError};
use super::limits::Encoding;
use super::{Choose, grid_of, header, suffix};
use crate::source::Source;
use crate::volume::{Anatomy, Volume, VoxelType};
use fields::Fields;
use flate2::bufread::MultiGzDecoder;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};

/// Reads a NIfTI file, or the pair that an `.hdr` or `.img` file belongs to.
pub(super) fn read(source: &dyn Source, file: &Path, choose: &Choose<'_>) -> Result<Volume, ReadError> {
    let (header, data) = pair(source, file);
    let (bytes, header_encoding) = start_of(source, &header)?;
    let fields = Fields::parse(&header, &bytes)?;
    let (data, encoding) = if fields.single {
        (header.clone(), header_encoding)
    } else {
        let encoding = start_of(source, &data)?.1;
        (data, encoding)
    };
    let dims = dims(&header, &fields)?;
    let voxel_type = voxel_type(&header, &fields)?;
    let inside = fields.data_offset(&header)?;
    let placed = affine::place(&fields);
    let grid = grid_of(&header, dims, placed.axes, placed.origin, ["dim", placed.axes_field, placed.origin_field])?;
    let scaling = match fields.scl_slope {
        slope if slope == 0.0 || slope.is_nan() => [1.0, 0.0],
        slope => [slope, fields.scl_inter],
    };
    let payload = Payload {
        source,
        header: &header,
        sizes: "dim",
        count: grid.len(),
        voxel_type,
        big_endian: fields.big_endian,
        files: vec![data],
        start: 0,
        from_end: false,
        lines: 0,
        lines_before: 0,
        encoding,
        inside,
    };
    let anatomy = placed.anatomical.then_some(Anatomy::RightAnteriorSuperior);
    volume_of(&header, &grid, &payload, scaling, anatomy, choose)
}

/// The header that a path belongs to, and the data file beside it, which only a pair has.
fn pair(source: &dyn Source, file: &Path) -> (PathBuf, PathBuf) {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let suffix = suffix(file).unwrap_or_default();
    let stem = file.with_file_name(&name[..name.len() - suffix.len()]);
    // Any of the ways to write the other half's suffix; the plain one is what an error names.
    let half = |suffix: &str| {
        let candidates = [suffix.to_string(), format!("{suffix}.gz"), suffix.to_uppercase()];
        let [plain, rest @ ..] = candidates.map(|suffix| super::with_suffix(&stem, &suffix));
        if source.is_file(&plain) { plain } else { rest.into_iter().find(|path| source.is_file(path)).unwrap_or(plain) }
    };
    if suffix.starts_with("img") { (half("hdr"), file.to_path_buf()) } else { (file.to_path_buf(), half("img")) }
}

/// The first bytes of a file, decoded, and how the file is stored; its own magic says so, not its name.
fn start_of(source: &dyn Source, file: &Path) -> Result<(Vec<u8>, Encoding), ReadError> {
    let (opened, _) = header::open(source, file)?;
    let mut reader = BufReader::new(opened);
    let failed = |e| ReadError::io(file, e);
    let zipped = reader.fill_buf().map_err(failed)?.starts_with(&[0x1f, 0x8b]);
    let mut bytes = Vec::new();
    let most = fields::LONGEST as u64;
    if zipped {
        let damaged = |e: std::io::Error| ReadError::new(file, Fault::Damaged(e.to_string()));
        MultiGzDecoder::new(reader).take(most).read_to_end(&mut bytes).map_err(damaged)?;
        Ok((bytes, Encoding::Gzip))
    } else {
        reader.take(most).read_to_end(&mut bytes).map_err(failed)?;
        Ok((bytes, Encoding::Raw))
    }
}

/// Voxels along x, y, z. `dim[0]` says how many axes count; the rest have length 1 whatever stands there.
fn dims(header: &Path, fields: &Fields) -> Result<[usize; 3], ReadError> {
    let value = |i: usize, expected: &str| {
        let fault = Fault::Value { found: fields.dim[i].to_string(), expected: expected.into() };
        ReadError::new(header, fault).field(format!("dim[{i}]"))
    };
    let axes = usize::try_from(fields.dim[0]).ok().filter(|n| (1..=7).contains(n));
    let axes = axes.ok_or_else(|| value(0, "1 to 7 axes"))?;
    let mut dims = [1; 3];
    for i in 1..=axes {
        let n = usize::try_from(fields.dim[i]).ok().filter(|&n| n > 0);
        let n = n.ok_or_else(|| value(i, "at least 1"))?;
        if i <= 3 {
            dims[i - 1] = n;
        } else if n > 1 {
            let found = match i {
                4 => format!("a series of {n} volumes"),
                5 => format!("{n} components a voxel"),
                _ => format!("an axis {i} of length {n}"),
            };
            let fault = Fault::Unsupported { found, supported: "one number a voxel on three axes of space" };
            return Err(ReadError::new(header, fault).field(format!("dim[{i}]")));
        }
    }
    Ok(dims)
}

fn voxel_type(header: &Path, fields: &Fields) -> Result<VoxelType, ReadError> {
    let unsupported = |found: &str| {
        let fault = Fault::Unsupported { found: found.into(), supported: "one number a voxel, of at most 64 bits" };
        Err(ReadError::new(header, fault).field("datatype"))
    };
    let voxel_type = match fields.datatype {
        2 => VoxelType::U8,
        4 => VoxelType::I16,
        8 => VoxelType::I32,
        16 => VoxelType::F32,
        64 => VoxelType::F64,
        256 => VoxelType::I8,
        512 => VoxelType::U16,
        768 => VoxelType::U32,
        1024 => VoxelType::I64,
        1280 => VoxelType::U64,
        1 => return unsupported("voxels of one bit"),
        32 | 1792 | 2048 => return unsupported("complex numbers"),
        128 => return unsupported("colours, RGB"),
        2304 => return unsupported("colours, RGBA"),
        1536 => return unsupported("floating-point numbers of 128 bits"),
        other => {
            let expected = "a code of NIfTI such as 2, 4, 8, 16 or 512".to_string();
            let fault = Fault::Value { found: other.to_string(), expected };
            return Err(ReadError::new(header, fault).field("datatype"));
        }
    };
    if usize::try_from(fields.bitpix).ok() != Some(8 * voxel_type.bytes()) {
        let expected = format!("{}, as the datatype {} has", 8 * voxel_type.bytes(), voxel_type.name());
        let fault = Fault::Value { found: fields.bitpix.to_string(), expected };
        return Err(ReadError::new(header, fault).field("bitpix"));
    }
    Ok(voxel_type)
}
