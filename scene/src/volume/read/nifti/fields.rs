//! The binary headers of NIfTI-1 (348 bytes) and NIfTI-2 (540 bytes).
//!
//! A few lines of our own replace a crate: the maintained one knows NIfTI-1 only, and panics on a quaternion that is
//! too long.

use super::super::error::{Fault, ReadError, quoted};
use std::path::Path;

/// Bytes of the longer header.
pub(super) const LONGEST: usize = 540;

/// Bytes of a NIfTI-1 header.
const SHORTER: usize = 348;

/// The fields that are read, in the types of NIfTI-2.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Fields {
    /// Whether the numbers of header and voxels come highest byte first.
    pub(super) big_endian: bool,
    /// Whether header and voxels are one file.
    pub(super) single: bool,
    /// Bytes of the header.
    pub(super) size: usize,
    /// Number of axes, then the samples along each.
    pub(super) dim: [i64; 8],
    /// Code of the stored type.
    pub(super) datatype: i16,
    /// Bits of a voxel.
    pub(super) bitpix: i16,
    /// The sign of the qform's third axis, then the spacings.
    pub(super) pixdim: [f64; 8],
    /// Bytes before the first voxel.
    pub(super) vox_offset: f64,
    /// Value = `scl_slope` · stored + `scl_inter`.
    pub(super) scl_slope: f64,
    /// See `scl_slope`.
    pub(super) scl_inter: f64,
    /// Positive where the quaternion holds.
    pub(super) qform_code: i32,
    /// Positive where the rows hold.
    pub(super) sform_code: i32,
    /// b, c, d of the unit quaternion.
    pub(super) quatern: [f64; 3],
    /// Origin of the qform.
    pub(super) qoffset: [f64; 3],
    /// Rows of the sform, the origin last in each.
    pub(super) srow: [[f64; 4]; 3],
}

/// Numbers at places of a header.
struct Numbers {
    bytes: [u8; LONGEST],
    big_endian: bool,
}

macro_rules! numbers {
    ($($name:ident $type:ty;)*) => { impl Numbers {
        $(fn $name(&self, at: usize) -> $type {
            let bytes = std::array::from_fn(|i| self.bytes[at + i]);
            if self.big_endian { <$type>::from_be_bytes(bytes) } else { <$type>::from_le_bytes(bytes) }
        })*
    } };
}

numbers! {
    i16 i16;
    i32 i32;
    i64 i64;
    f32 f32;
    f64 f64;
}

impl Fields {
    /// Takes the fields from the first bytes of a file.
    pub(super) fn parse(file: &Path, start: &[u8]) -> Result<Self, ReadError> {
        let first = start.first_chunk::<4>().copied().unwrap_or_default();
        let sizes = [SHORTER, LONGEST].map(|n| n as u32);
        let big_endian = sizes.contains(&u32::from_be_bytes(first));
        let size = if big_endian { u32::from_be_bytes(first) } else { u32::from_le_bytes(first) };
        if !sizes.contains(&size) {
            let found = quoted(&String::from_utf8_lossy(&start[..start.len().min(8)]));
            let expected = "the length of its header, 348 or 540";
            return Err(
                ReadError::new(file, Fault::Magic { format: "a NIfTI file", found, expected }).field("sizeof_hdr")
            );
        }
        let size = size as usize;
        if start.len() < size {
            let (expected, found) = (size as u128, start.len() as u128);
            return Err(ReadError::new(file, Fault::Short { expected, found, unit: "bytes of the header" }));
        }
        let mut bytes = [0; LONGEST];
        bytes[..size].copy_from_slice(&start[..size]);
        let at = Numbers { bytes, big_endian };
        let magic = if size == SHORTER { &bytes[344..348] } else { &bytes[4..12] };
        let single = match magic {
            b"n+1\0" | b"n+2\0\r\n\x1a\n" => true,
            b"ni1\0" | b"ni2\0\r\n\x1a\n" => false,
            _ => {
                let found = quoted(&String::from_utf8_lossy(magic));
                let expected = "`n+1`, `ni1`, `n+2` or `ni2`".to_string();
                return Err(ReadError::new(file, Fault::Value { found, expected }).field("magic"));
            }
        };
        let fields = if size == SHORTER { first_version(&at) } else { second_version(&at) };
        Ok(Self { big_endian, single, size, ..fields })
    }

    /// Bytes before the first voxel, checked to be whole and, in a single file, behind the header.
    pub(super) fn data_offset(&self, file: &Path) -> Result<u64, ReadError> {
        let least = if self.single { self.size as f64 } else { 0.0 };
        // Whole numbers up to 2⁵³ are exact; a NaN fails every comparison.
        if self.vox_offset >= least && self.vox_offset <= 9e15 && self.vox_offset.trunc() == self.vox_offset {
            return Ok(self.vox_offset as u64);
        }
        let expected = format!("a whole number of bytes, at least {least}");
        Err(ReadError::new(file, Fault::Value { found: self.vox_offset.to_string(), expected }).field("vox_offset"))
    }
}

fn first_version(at: &Numbers) -> Fields {
    let float = |place| f64::from(at.f32(place));
    Fields {
        dim: std::array::from_fn(|i| at.i16(40 + 2 * i).into()),
        datatype: at.i16(70),
        bitpix: at.i16(72),
        pixdim: std::array::from_fn(|i| float(76 + 4 * i)),
        vox_offset: float(108),
        scl_slope: float(112),
        scl_inter: float(116),
        qform_code: at.i16(252).into(),
        sform_code: at.i16(254).into(),
        quatern: std::array::from_fn(|i| float(256 + 4 * i)),
        qoffset: std::array::from_fn(|i| float(268 + 4 * i)),
        srow: std::array::from_fn(|row| std::array::from_fn(|i| float(280 + 16 * row + 4 * i))),
        ..Fields::default()
    }
}

fn second_version(at: &Numbers) -> Fields {
    Fields {
        datatype: at.i16(12),
        bitpix: at.i16(14),
        dim: std::array::from_fn(|i| at.i64(16 + 8 * i)),
        pixdim: std::array::from_fn(|i| at.f64(104 + 8 * i)),
        vox_offset: at.i64(168) as f64,
        scl_slope: at.f64(176),
        scl_inter: at.f64(184),
        qform_code: at.i32(344),
        sform_code: at.i32(348),
        quatern: std::array::from_fn(|i| at.f64(352 + 8 * i)),
        qoffset: std::array::from_fn(|i| at.f64(376 + 8 * i)),
        srow: std::array::from_fn(|row| std::array::from_fn(|i| at.f64(400 + 32 * row + 8 * i))),
        ..Fields::default()
    }
}
