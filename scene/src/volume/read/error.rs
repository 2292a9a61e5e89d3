//! Errors of volume files: the fault, its position, and its remedy.

use crate::memory::NoRoom;
use crate::space::SpaceError;
use crate::volume::{NotInVolume, VolumeError};
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// A volume that could not be read. [`ReadError::what`], [`ReadError::place`] and [`ReadError::remedy`] are the three
/// lines of an error message; `Display` prints them one below the other.
#[derive(Debug)]
pub struct ReadError {
    /// The file at fault: the header, or the data beside it.
    pub file: PathBuf,
    /// The line of a text header or of text data, from 1.
    pub line: Option<usize>,
    /// The field at fault, named as in the format.
    pub field: Option<String>,
    /// Whether the file has no header, and a layout describes it.
    pub has_layout: bool,
    /// The fault.
    pub fault: Box<Fault>,
}

/// A fault of a volume file.
#[derive(Debug, thiserror::Error)]
pub enum Fault {
    /// The operating system refuses.
    #[error("the file cannot be read: {0}")]
    Io(#[source] io::Error),
    /// A folder, a pipe or a device.
    #[error("this is not a regular file")]
    NotAFile,
    /// A suffix of no known format, and no sidecar.
    #[error("the suffix is not that of a supported volume format")]
    Suffix,
    /// Raw voxels that nothing describes.
    #[error("raw voxels without a description of their layout")]
    NoLayout,
    /// A DICOM file, which this program does not read.
    #[error("this is a DICOM file, and DICOM is not read yet")]
    Dicom,
    /// A folder of DICOM files.
    #[error("this is a folder of DICOM files, and DICOM is not read yet")]
    DicomFolder,
    /// The file does not begin with the first bytes of its format.
    #[error("this is not {format}: it begins with {found}, expected {expected}")]
    Magic {
        /// The format that the suffix names, with its article.
        format: &'static str,
        /// The first bytes.
        found: String,
        /// The first bytes of such a file.
        expected: &'static str,
    },
    /// A text header that is longer than `limit`.
    #[error("the header has no end within its first {limit} bytes")]
    EndlessHeader {
        /// The longest header that is read.
        limit: u64,
    },
    /// A line of a text header that is not a field.
    #[error("the line {found} is not a field")]
    Line {
        /// The line.
        found: String,
    },
    /// A field that the format does not have.
    #[error("the format has no such field")]
    UnknownField,
    /// A required field is missing.
    #[error("the field is missing, expected {expected}")]
    Missing {
        /// The content that the field should have.
        expected: String,
    },
    /// A field that is given twice.
    #[error("the field is given a second time")]
    Repeated,
    /// A field with a wrong value.
    #[error("found {found}, expected {expected}")]
    Value {
        /// The content found.
        found: String,
        /// The content expected.
        expected: String,
    },
    /// A part of the format that this program does not read.
    #[error("{found}; supported: {supported}")]
    Unsupported {
        /// The content of the file.
        found: String,
        /// The alternatives that are supported.
        supported: &'static str,
    },
    /// A sidecar that is not valid.
    #[error("the description of raw voxels is not valid: {0}")]
    Sidecar(String),
    /// Fewer data than the header says.
    #[error("the data are too short: found {found} {unit}, expected {expected}")]
    Short {
        /// The number that the header asks for.
        expected: u128,
        /// The number found.
        found: u128,
        /// The unit of both numbers.
        unit: &'static str,
    },
    /// More data than the header says.
    #[error("the data are too long: found {}{found} {unit}, expected {expected}", if *.at_least { "at least " } else { "" })]
    Long {
        /// The number that the header asks for.
        expected: u128,
        /// The number found.
        found: u128,
        /// Whether counting stopped before the end.
        at_least: bool,
        /// The unit of both numbers.
        unit: &'static str,
    },
    /// Sizes that the file cannot hold, however well it is compressed.
    #[error("the sizes claim {claimed} bytes, but a file of this length holds at most {limit}")]
    Oversized {
        /// Bytes of all voxels.
        claimed: u128,
        /// The most that the stored bytes can decode to.
        limit: u128,
    },
    /// Compressed data that do not decode.
    #[error("the compressed data are damaged: {0}")]
    Damaged(String),
    /// Voxels that cannot be shared out evenly over the data files.
    #[error("{voxels} voxels cannot be shared out evenly over {files} data files")]
    Shares {
        /// Voxels of the volume.
        voxels: usize,
        /// Data files that the header names.
        files: usize,
    },
    /// The memory budget does not allow the voxels.
    #[error("{voxels} voxels need {no_room}")]
    Memory {
        /// Voxels of the volume.
        voxels: usize,
        /// The need, and the memory that is free.
        no_room: NoRoom,
    },
    /// Voxels to keep that the volume does not have.
    #[error(transparent)]
    NotInVolume(#[from] NotInVolume),
    /// Sizes or axes that make no grid.
    #[error(transparent)]
    Space(#[from] SpaceError),
    /// Voxels that make no volume.
    #[error(transparent)]
    Volume(#[from] VolumeError),
}

impl ReadError {
    /// An error about a whole file.
    pub(super) fn new(file: &Path, fault: impl Into<Fault>) -> Self {
        Self { file: file.to_path_buf(), line: None, field: None, has_layout: false, fault: Box::new(fault.into()) }
    }

    /// An error of the operating system about a file.
    pub(super) fn io(file: &Path, error: io::Error) -> Self {
        Self::new(file, Fault::Io(error))
    }

    /// Sets the field of the error.
    pub(super) fn field(self, field: impl Into<String>) -> Self {
        Self { field: Some(field.into()), ..self }
    }

    /// Marks the error as one about a file that a layout describes.
    pub(super) fn of_layout(self) -> Self {
        Self { has_layout: true, ..self }
    }

    /// Sets the line of the error, counted from 1.
    pub(super) fn line(self, line: usize) -> Self {
        Self { line: Some(line), ..self }
    }

    /// The fault, in one line.
    pub fn what(&self) -> String {
        self.fault.to_string()
    }

    /// File, line and field as far as they are known, in one line.
    pub fn place(&self) -> String {
        let mut place = self.file.display().to_string();
        if let Some(line) = self.line {
            place += &format!(", line {line}");
        }
        if let Some(field) = &self.field {
            place += &format!(", field {field}");
        }
        place
    }

    /// The remedy, in one line.
    pub fn remedy(&self) -> String {
        let name = self.file.file_name().unwrap_or_default().to_string_lossy();
        let header = if self.has_layout { "layout" } else { "header" };
        match &*self.fault {
            Fault::Io(error) if error.kind() == io::ErrorKind::NotFound => "check the path".into(),
            Fault::Io(_) | Fault::NotAFile => "give a file that may be read".into(),
            Fault::Suffix => format!(
                "give a file with one of the suffixes {}, or describe raw voxels in {name}.toml, with --raw or as \
                 volume.raw",
                super::EXTENSIONS.join(", ")
            ),
            Fault::NoLayout => format!(
                "open the header that belongs to it, or describe it in {name}.toml, with --raw or as volume.raw: size, \
                 type, endian, spacing and skip"
            ),
            Fault::Dicom => {
                "convert its series to .nii.gz or .nrrd first: dcm2niix, 3D Slicer and ITK-SNAP do that".into()
            }
            Fault::DicomFolder => format!(
                "convert its series to .nii.gz or .nrrd first, such as with dcm2niix -z y -o . {}; 3D Slicer and \
                 ITK-SNAP do that, too",
                self.file.display()
            ),
            Fault::Magic { .. } => "check that the suffix says what the file holds".into(),
            Fault::EndlessHeader { .. } | Fault::Line { .. } | Fault::Value { .. } | Fault::Sidecar(_) => {
                format!("correct the {header}")
            }
            Fault::UnknownField => "correct its name, or make it a key with := in place of the colon".into(),
            Fault::Missing { .. } => "add the field to the header".into(),
            Fault::Repeated => "keep one of the two".into(),
            Fault::Unsupported { .. } => "convert the file first".into(),
            Fault::Short { .. } | Fault::Long { .. } | Fault::Oversized { .. } => {
                format!("get the file again, or correct the sizes and the type in the {header}")
            }
            Fault::Damaged(_) => "get the file again".into(),
            Fault::Shares { .. } => "correct the list of data files".into(),
            Fault::Memory { .. } => "read less of it with volume.box or volume.stride".into(),
            Fault::NotInVolume(_) => "give ranges [first, last] within the volume as volume.box".into(),
            Fault::Space(_) if self.has_layout => "correct the sizes or the spacing in the layout".into(),
            Fault::Space(_) => "correct the sizes or the axis directions in the header".into(),
            Fault::Volume(VolumeError::Scaling { .. }) => "correct slope and intercept in the header".into(),
            Fault::Volume(_) => "give a volume with at least one finite value".into(),
        }
    }
}

impl fmt::Display for ReadError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n{}\n{}", self.what(), self.place(), self.remedy())
    }
}

impl std::error::Error for ReadError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&*self.fault)
    }
}

/// Text from a file for a message of one line: escaped, in quotes, cut after 40 characters.
pub(in crate::volume) fn quoted(text: &str) -> String {
    let mut quoted: String = text.chars().take(40).flat_map(char::escape_debug).collect();
    if text.chars().nth(40).is_some() {
        quoted += "…";
    }
    format!("`{quoted}`")
}
