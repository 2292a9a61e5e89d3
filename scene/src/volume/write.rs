//! Writing volumes: NRRD with attached header.

use super::bytes::Stored;
use super::{Access, Volume, VoxelType};
use crate::atomic;
use flate2::Compression;
use flate2::write::GzEncoder;
use glam::DVec3;
use std::fmt;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The encoding of a written file's voxels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// Bytes as in memory, lowest byte first.
    Raw,
    /// Raw bytes, compressed by gzip.
    Gzip,
}

/// A volume that could not be written; nothing is left behind. [`WriteError::what`], [`WriteError::place`] and
/// [`WriteError::remedy`] are the three lines of an error message.
#[derive(Debug)]
pub struct WriteError {
    /// The file that was to be written.
    pub file: PathBuf,
    /// The operating system's error.
    pub source: io::Error,
}

impl WriteError {
    /// The fault, in one line.
    pub fn what(&self) -> String {
        format!("the volume cannot be written: {}", self.source)
    }

    /// The file, in one line.
    pub fn place(&self) -> String {
        self.file.display().to_string()
    }

    /// The remedy, in one line.
    pub fn remedy(&self) -> String {
        atomic::remedy(&self.source).into()
    }
}

impl fmt::Display for WriteError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n{}\n{}", self.what(), self.place(), self.remedy())
    }
}

impl std::error::Error for WriteError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.source)
    }
}

/// Writes a volume as NRRD, compressed. See [`write_nrrd_as`].
///
/// # Errors
/// Any error of the operating system.
pub fn write_nrrd(volume: &Volume, path: &Path) -> Result<(), WriteError> {
    write_nrrd_as(volume, path, Encoding::Gzip)
}

/// Writes a volume as NRRD with attached header. Reading it gives the same dims, axes, origin, values and mask bit by
/// bit; a masked voxel is written as NaN. The stored type is kept if there are no slope and intercept. NRRD has
/// neither, so scaled values are written in f64. The same volume gives the same bytes.
///
/// A partly written file never has its name ([`atomic::write()`]).
///
/// # Errors
/// Any error of the operating system.
pub fn write_nrrd_as(volume: &Volume, path: &Path, encoding: Encoding) -> Result<(), WriteError> {
    let filled = atomic::write(path, |out| {
        write_header(volume, encoding, out)?;
        match encoding {
            Encoding::Raw => write_voxels(volume, out),
            Encoding::Gzip => {
                let mut encoder = GzEncoder::new(out, Compression::default());
                write_voxels(volume, &mut encoder)?;
                encoder.finish().map(|_| ())
            }
        }
    });
    filled.map_err(|source| WriteError { file: path.to_path_buf(), source })
}

/// Whether values equal the stored numbers.
fn as_stored(volume: &Volume) -> bool {
    volume.slope() == 1.0 && volume.intercept() == 0.0
}

fn write_header(volume: &Volume, encoding: Encoding, out: &mut dyn Write) -> io::Result<()> {
    let voxel_type = if as_stored(volume) { volume.voxels().voxel_type() } else { VoxelType::F64 };
    let name = match voxel_type {
        VoxelType::U8 => "uint8",
        VoxelType::I8 => "int8",
        VoxelType::U16 => "uint16",
        VoxelType::I16 => "int16",
        VoxelType::U32 => "uint32",
        VoxelType::I32 => "int32",
        VoxelType::U64 => "uint64",
        VoxelType::I64 => "int64",
        VoxelType::F32 => "float",
        VoxelType::F64 => "double",
    };
    let grid = volume.grid();
    let [nx, ny, nz] = grid.dims();
    // `{:?}` of an f64 is the shortest text that reads back as the same number.
    let vector = |v: DVec3| format!("({:?},{:?},{:?})", v.x, v.y, v.z);
    let axes = grid.axes();
    writeln!(out, "NRRD0004\ntype: {name}\ndimension: 3")?;
    match volume.anatomy() {
        Some(anatomy) => writeln!(out, "space: {}", anatomy.name())?,
        None => writeln!(out, "space dimension: 3")?,
    }
    writeln!(out, "sizes: {nx} {ny} {nz}")?;
    writeln!(out, "space directions: {} {} {}", vector(axes.x_axis), vector(axes.y_axis), vector(axes.z_axis))?;
    writeln!(out, "kinds: domain domain domain")?;
    if voxel_type.bytes() > 1 {
        writeln!(out, "endian: little")?;
    }
    writeln!(out, "encoding: {}", if encoding == Encoding::Raw { "raw" } else { "gzip" })?;
    writeln!(out, "space origin: {}\n", vector(grid.origin()))
}

fn write_voxels(volume: &Volume, out: &mut dyn Write) -> io::Result<()> {
    if !as_stored(volume) {
        return rows(volume, out, |at| volume.value(at));
    }
    with_access!(volume, |access| rows(volume, out, |[x, y, z]| access.at(x, y, z)))
}

/// Writes the voxels row by row, NaN where they are masked.
fn rows<T: Stored>(volume: &Volume, out: &mut dyn Write, voxel: impl Fn([usize; 3]) -> T) -> io::Result<()> {
    let [nx, ny, nz] = volume.dims();
    let mut row = Vec::with_capacity(nx * size_of::<T>());
    for z in 0..nz {
        for y in 0..ny {
            row.clear();
            for x in 0..nx {
                let masked = volume.mask().is_some_and(|mask| mask.voxel([x, y, z]));
                let stored = voxel([x, y, z]);
                T::nan().filter(|_| masked).unwrap_or(stored).push_little(&mut row);
            }
            out.write_all(&row)?;
        }
    }
    Ok(())
}
