//! Tests of the readers as a whole, on files made here and on the shared volumes where they are.

mod forms;
mod hostile;
mod places;
mod round_trip;
mod shared;
mod subset;
mod types;
mod wording;

use super::{ReadError, read};
use crate::volume::{Volume, VoxelType, Voxels};
use flate2::Compression;
use std::io::Write;
use std::path::PathBuf;
use tempfile::TempDir;

/// A folder for the files of one test.
struct Folder(TempDir);

impl Folder {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn put(&self, name: &str, bytes: impl AsRef<[u8]>) -> PathBuf {
        let path = self.path(name);
        std::fs::write(&path, bytes).unwrap();
        path
    }

    /// Writes a file and reads it as a volume.
    fn read(&self, name: &str, bytes: impl AsRef<[u8]>) -> Result<Volume, ReadError> {
        read(&self.put(name, bytes), None)
    }
}

/// A header and the voxels behind it.
fn joined(header: impl AsRef<[u8]>, voxels: &[u8]) -> Vec<u8> {
    [header.as_ref(), voxels].concat()
}

fn gzip(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::GzEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

fn zlib(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), Compression::default());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

fn bzip2(bytes: &[u8]) -> Vec<u8> {
    let mut encoder = bzip2::write::BzEncoder::new(Vec::new(), bzip2::Compression::default());
    encoder.write_all(bytes).unwrap();
    encoder.finish().unwrap()
}

macro_rules! per_type {
    ($($variant:ident $type:ty, [$($special:expr),*];)*) => {
        /// Twelve voxels of a type, its extremes among them.
        fn sample(voxel_type: VoxelType) -> Voxels {
            match voxel_type {
                $(VoxelType::$variant => {
                    let mut v = vec![<$type>::MIN, <$type>::MAX, $($special),*];
                    while v.len() < 12 {
                        v.push((v.len() * 9) as $type);
                    }
                    Voxels::$variant(v)
                })*
            }
        }

        /// The voxels as a file has them.
        fn bytes_of(voxels: &Voxels, big_endian: bool) -> Vec<u8> {
            match voxels {
                $(Voxels::$variant(v) => v
                    .iter()
                    .flat_map(|x| if big_endian { x.to_be_bytes() } else { x.to_le_bytes() })
                    .collect(),)*
            }
        }

        /// The voxels as text has them.
        fn text_of(voxels: &Voxels, separator: &str) -> String {
            match voxels {
                $(Voxels::$variant(v) => v.iter().map(|x| format!("{x:?}")).collect::<Vec<_>>().join(separator),)*
            }
        }
    };
}

per_type! {
    U8 u8, [0x12];
    I8 i8, [0x12, -1];
    U16 u16, [0x1234];
    I16 i16, [0x1234, -2];
    U32 u32, [0x1234_5678];
    I32 i32, [0x1234_5678, -3];
    U64 u64, [0x1234_5678_9abc_def0];
    I64 i64, [0x1234_5678_9abc_def0, -4];
    F32 f32, [-0.0, 1.0e-40, 0.1, -1.5e30];
    F64 f64, [-0.0, 1.0e-310, 0.1, -1.5e300];
}

/// The name of a type in NRRD.
fn nrrd_name(voxel_type: VoxelType) -> &'static str {
    match voxel_type {
        VoxelType::U8 => "uchar",
        VoxelType::I8 => "signed char",
        VoxelType::U16 => "unsigned short",
        VoxelType::I16 => "int16_t",
        VoxelType::U32 => "uint",
        VoxelType::I32 => "int",
        VoxelType::U64 => "unsigned long long int",
        VoxelType::I64 => "longlong",
        VoxelType::F32 => "float",
        VoxelType::F64 => "double",
    }
}

/// The lines of an NRRD header without its end.
fn nrrd_lines(voxel_type: VoxelType, sizes: &str, encoding: &str, big_endian: bool) -> String {
    let endian = if big_endian { "big" } else { "little" };
    let dimension = sizes.split(' ').count();
    let name = nrrd_name(voxel_type);
    format!(
        "NRRD0004\n# made by hand\ntype: {name}\ndimension: {dimension}\nsizes: {sizes}\nencoding: {encoding}\n\
         endian: {endian}\n"
    )
}

/// The name of a type in MetaImage.
fn meta_name(voxel_type: VoxelType) -> &'static str {
    match voxel_type {
        VoxelType::U8 => "MET_UCHAR",
        VoxelType::I8 => "MET_CHAR",
        VoxelType::U16 => "MET_USHORT",
        VoxelType::I16 => "MET_SHORT",
        VoxelType::U32 => "MET_UINT",
        VoxelType::I32 => "MET_LONG",
        VoxelType::U64 => "MET_ULONG_LONG",
        VoxelType::I64 => "MET_LONG_LONG",
        VoxelType::F32 => "MET_FLOAT",
        VoxelType::F64 => "MET_DOUBLE",
    }
}

/// A MetaImage header up to, not including, `ElementDataFile`; `more` are further lines.
fn meta_lines(voxel_type: VoxelType, sizes: &str, more: &str) -> String {
    let axes = sizes.split(' ').count();
    let name = meta_name(voxel_type);
    format!("ObjectType = Image\nNDims = {axes}\nDimSize = {sizes}\nElementType = {name}\n{more}")
}

/// A binary header that is filled in at byte offsets.
struct Nifti {
    bytes: Vec<u8>,
    big_endian: bool,
}

/// Code and name of each type in NIfTI.
fn nifti_code(voxel_type: VoxelType) -> i16 {
    match voxel_type {
        VoxelType::U8 => 2,
        VoxelType::I8 => 256,
        VoxelType::U16 => 512,
        VoxelType::I16 => 4,
        VoxelType::U32 => 768,
        VoxelType::I32 => 8,
        VoxelType::U64 => 1280,
        VoxelType::I64 => 1024,
        VoxelType::F32 => 16,
        VoxelType::F64 => 64,
    }
}

macro_rules! put {
    ($($name:ident $type:ty;)*) => { impl Nifti {
        $(fn $name(&mut self, at: usize, x: $type) -> &mut Self {
            let bytes = if self.big_endian { x.to_be_bytes() } else { x.to_le_bytes() };
            self.bytes[at..at + bytes.len()].copy_from_slice(&bytes);
            self
        })*
    } };
}

put! {
    i16 i16;
    i32 i32;
    i64 i64;
    f32 f32;
    f64 f64;
}

impl Nifti {
    /// A NIfTI-1 header of a single file with four bytes behind it, spacings 1, 2, 3.
    fn one(voxel_type: VoxelType, dims: &[i16], big_endian: bool) -> Self {
        let mut header = Self { bytes: vec![0; 352], big_endian };
        header.i32(0, 348).i16(40, dims.len() as i16).i16(70, nifti_code(voxel_type));
        header.i16(72, 8 * voxel_type.bytes() as i16).f32(108, 352.0);
        for (i, &n) in dims.iter().enumerate() {
            header.i16(42 + 2 * i, n).f32(80 + 4 * i, 1.0 + i as f32);
        }
        header.bytes[344..348].copy_from_slice(b"n+1\0");
        header
    }

    /// The header in NIfTI-2.
    fn two(voxel_type: VoxelType, dims: &[i64], big_endian: bool) -> Self {
        let mut header = Self { bytes: vec![0; 544], big_endian };
        header.i32(0, 540).i64(16, dims.len() as i64).i16(12, nifti_code(voxel_type));
        header.i16(14, 8 * voxel_type.bytes() as i16).i64(168, 544);
        for (i, &n) in dims.iter().enumerate() {
            header.i64(24 + 8 * i, n).f64(112 + 8 * i, 1.0 + i as f64);
        }
        header.bytes[4..12].copy_from_slice(b"n+2\0\r\n\x1a\n");
        header
    }

    fn with(&self, voxels: &[u8]) -> Vec<u8> {
        joined(&self.bytes, voxels)
    }
}
