//! Reading volumes ([IO-1]): NRRD, NIfTI, MetaImage, and raw voxels with a described layout.
//!
//! Every reader takes the header first and checks its claims against the lengths of the files. Only then does it ask
//! for memory: exactly the voxels if they are stored raw; in doubling steps behind the arriving data if they are
//! compressed or text. For every file the result is a volume or a [`ReadError`].

mod data;
mod error;
mod header;
mod limits;
mod metaimage;
mod nifti;
mod nrrd;
mod raw;
mod series;
#[cfg(test)]
mod tests;

pub(super) use error::quoted;
pub use error::{Fault, ReadError};

use super::{Anatomy, KeptVoxels, NotInVolume, Volume};
use crate::source::{Disk, Source};
use crate::space::{Grid, SpaceError};
use crate::volume::RawLayout;
use glam::{DMat3, DVec3};
use std::io::Read;
use std::path::{Path, PathBuf};

/// The suffixes of volume files. A file of raw voxels with a sidecar may have any other suffix.
pub const EXTENSIONS: [&str; 12] =
    ["nrrd", "nhdr", "nii", "nii.gz", "hdr", "hdr.gz", "img", "img.gz", "mhd", "mha", "raw", "raw.gz"];

/// Whether a path names a volume: by its suffix (case does not count), or by a sidecar `FILE.toml` that describes raw
/// voxels.
pub fn is_volume(path: &Path) -> bool {
    suffix(path).is_some() || Disk.is_file(&raw::sidecar(path))
}

/// Reads a volume file of the disk. The suffix chooses the reader; `raw` describes a file without header and wins over both the
/// suffix and a sidecar.
///
/// The voxels keep the file's own type and order, slope and intercept are kept beside them ([VAL-1]), and world
/// coordinates are the file's own ([SPACE-2]).
///
/// # Errors
/// A file that cannot be opened, or does not match its suffix or its header's claims. Axes that do not span space,
/// several numbers a voxel, or no finite value. See [`Fault`].
pub fn read(path: &Path, raw: Option<&RawLayout>) -> Result<Volume, ReadError> {
    read_part(&Disk, path, raw, &all_voxels)
}

/// Chooses the voxels to keep of a volume, by its grid and its anatomical space.
pub type Choose<'a> = dyn Fn(&Grid, Option<Anatomy>) -> Result<KeptVoxels, NotInVolume> + 'a;

/// The [`Choose`] of all voxels, which never fails.
pub fn all_voxels(grid: &Grid, _: Option<Anatomy>) -> Result<KeptVoxels, NotInVolume> {
    Ok(KeptVoxels::all(grid.dims()))
}

/// Reads a volume file of a source like [`read`](fn@read), as if the file held only the voxels that `choose` keeps
/// ([VOL-1]). Other voxels take no memory.
///
/// # Errors
/// Those of [`read`](fn@read), and voxels that the file does not have.
pub fn read_part(
    source: &dyn Source,
    path: &Path,
    raw: Option<&RawLayout>,
    choose: &Choose<'_>,
) -> Result<Volume, ReadError> {
    if let Some(layout) = raw {
        return raw::read(source, path, layout, None, choose);
    }
    refuse_dicom(source, path)?;
    match suffix(path) {
        Some("nrrd" | "nhdr") => nrrd::read(source, path, choose),
        Some("nii" | "nii.gz" | "hdr" | "hdr.gz" | "img" | "img.gz") => nifti::read(source, path, choose),
        Some("mhd" | "mha") => metaimage::read(source, path, choose),
        known => raw::read_described(source, path, known.is_some(), choose),
    }
}

/// Refuses a DICOM file, and a folder of such files.
///
/// # Errors
/// [`Fault::Dicom`] and [`Fault::DicomFolder`]. A path that cannot be read passes; a later reader reports it.
pub fn refuse_dicom(source: &dyn Source, path: &Path) -> Result<(), ReadError> {
    /// Entries of a folder that are looked at.
    const ENTRIES: usize = 64;
    if let Ok(entries) = source.list(path) {
        let mut files = entries.into_iter().take(ENTRIES);
        return if files.any(|file| is_dicom(source, &file)) {
            Err(ReadError::new(path, Fault::DicomFolder))
        } else {
            Ok(())
        };
    }
    if is_dicom(source, path) { Err(ReadError::new(path, Fault::Dicom)) } else { Ok(()) }
}

/// Whether a file is one of DICOM: by its suffix, or by its mark behind a preamble of 128 bytes.
fn is_dicom(source: &dyn Source, path: &Path) -> bool {
    let Ok((file, _)) = header::open(source, path) else { return false };
    let has_suffix = path.extension().is_some_and(|e| ["dcm", "dicom"].iter().any(|s| e.eq_ignore_ascii_case(s)));
    let mut start = Vec::new();
    has_suffix || file.take(132).read_to_end(&mut start).is_ok() && start.get(128..) == Some(b"DICM")
}

/// The longest of [`EXTENSIONS`] that a path ends with.
fn suffix(path: &Path) -> Option<&'static str> {
    let name = path.file_name()?.to_string_lossy().to_ascii_lowercase();
    let ends = |suffix: &&str| name.strip_suffix(suffix).is_some_and(|stem| stem.ends_with('.'));
    EXTENSIONS.into_iter().filter(ends).max_by_key(|suffix| suffix.len())
}

/// A path with text behind its last name.
fn with_suffix(path: &Path, suffix: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(suffix);
    name.into()
}

/// The grid that a header describes. `fields` are the names of sizes, axes and origin in the format, for the error.
fn grid_of(
    file: &Path,
    dims: [usize; 3],
    axes: DMat3,
    origin: DVec3,
    [sizes_field, axes_field, origin_field]: [&str; 3],
) -> Result<Grid, ReadError> {
    if !origin.is_finite() {
        let fault = Fault::Value { found: format!("{origin}"), expected: "three finite numbers".into() };
        return Err(ReadError::new(file, fault).field(origin_field));
    }
    Grid::new(dims, axes, origin).map_err(|error| {
        let field = match &error {
            SpaceError::EmptyAxis { .. } | SpaceError::Overflow { .. } => sizes_field,
            SpaceError::Singular { .. } => axes_field,
        };
        ReadError::new(file, error).field(field)
    })
}
