//! Raw voxels, described by flags or by a sidecar `FILE.toml`.
//!
//! | key | holds | default |
//! |---|---|---|
//! | `size` | voxels along x, y, z | required |
//! | `type` | `u8`, `i8`, … `f64` | required |
//! | `endian` | `"little"` or `"big"` | `"little"` |
//! | `spacing` | world units between voxels along x, y, z | `[1, 1, 1]` |
//! | `skip` | bytes before the first voxel; of a gzip file, decoded ones | 0 |

use super::data::{Payload, volume_of};
use super::error::{Fault, ReadError};
use super::limits::Encoding;
use super::{Choose, grid_of, header, with_suffix};
use crate::source::Source;
use crate::volume::RawLayout;
use crate::volume::{Volume, VoxelType};
use glam::{DMat3, DVec3};
use serde::Deserialize;
use std::io::Read;
use std::path::{Path, PathBuf};

/// The longest sidecar that is read, in bytes.
const LIMIT: u64 = 1 << 16;

/// The sidecar of a file.
pub(super) fn sidecar(file: &Path) -> PathBuf {
    with_suffix(file, ".toml")
}

/// Reads voxels in a given layout. `described` is the file that gives the layout, none where flags do. A name that
/// ends in `.gz` says that the file is compressed.
pub(super) fn read(
    source: &dyn Source,
    file: &Path,
    layout: &RawLayout,
    described: Option<&Path>,
    choose: &Choose<'_>,
) -> Result<Volume, ReadError> {
    let (described, [size, spacing]) = match described {
        Some(description) => (description, ["size", "spacing"]),
        None => (file, ["size of its layout", "spacing of its layout"]),
    };
    let axes = DMat3::from_diagonal(DVec3::from_array(layout.spacing));
    let grid =
        grid_of(described, layout.size, axes, DVec3::ZERO, [size, spacing, spacing]).map_err(ReadError::of_layout)?;
    let compressed = file.extension().is_some_and(|e| e.eq_ignore_ascii_case("gz"));
    let payload = Payload {
        source,
        header: described,
        sizes: size,
        count: grid.len(),
        voxel_type: layout.voxel_type,
        big_endian: layout.big_endian,
        files: vec![file.to_path_buf()],
        start: 0,
        from_end: false,
        lines: 0,
        lines_before: 0,
        encoding: if compressed { Encoding::Gzip } else { Encoding::Raw },
        inside: layout.skip,
    };
    volume_of(file, &grid, &payload, [1.0, 0.0], None, choose).map_err(ReadError::of_layout)
}

/// Reads voxels in the layout of a sidecar. Without one it is an error, whose advice depends on whether the suffix is
/// a known one.
pub(super) fn read_described(
    source: &dyn Source,
    file: &Path,
    known_suffix: bool,
    choose: &Choose<'_>,
) -> Result<Volume, ReadError> {
    header::open(source, file)?;
    let description = sidecar(file);
    if !source.is_file(&description) {
        return Err(ReadError::new(file, if known_suffix { Fault::NoLayout } else { Fault::Suffix }));
    }
    let layout = parse(source, &description).map_err(ReadError::of_layout)?;
    read(source, file, &layout, Some(&description), choose)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Sidecar {
    size: [usize; 3],
    #[serde(rename = "type")]
    voxel_type: String,
    #[serde(default)]
    endian: Endian,
    #[serde(default = "unit")]
    spacing: [f64; 3],
    #[serde(default)]
    skip: u64,
}

#[derive(Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Endian {
    #[default]
    Little,
    Big,
}

fn unit() -> [f64; 3] {
    [1.0; 3]
}

fn parse(source: &dyn Source, description: &Path) -> Result<RawLayout, ReadError> {
    let (file, _) = header::open(source, description)?;
    let mut text = String::new();
    file.take(LIMIT).read_to_string(&mut text).map_err(|e| ReadError::io(description, e))?;
    let Sidecar { size, voxel_type, endian, spacing, skip } = toml::from_str(&text).map_err(|e| {
        let error = ReadError::new(description, Fault::Sidecar(e.message().replace('\n', " ")));
        match e.span() {
            Some(span) => error.line(1 + text.bytes().take(span.start).filter(|&c| c == b'\n').count()),
            None => error,
        }
    })?;
    let Some(voxel_type) = VoxelType::from_name(&voxel_type) else {
        let names: Vec<&str> = VoxelType::ALL.iter().map(|t| t.name()).collect();
        let expected = format!("one of {}", names.join(", "));
        let found = super::error::quoted(&voxel_type);
        return Err(ReadError::new(description, Fault::Value { found, expected }).field("type"));
    };
    let big_endian = matches!(endian, Endian::Big);
    Ok(RawLayout { size, voxel_type, big_endian, spacing, skip })
}
