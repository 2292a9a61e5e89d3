//! Errors of picture files.

use drypoint_scene::memory::NoRoom;
use std::path::PathBuf;

/// An error in writing, reading, comparing or laying out pictures. The message says what and where;
/// [`OutputError::help`] says what to do.
#[derive(Debug, thiserror::Error)]
pub enum OutputError {
    /// The file could not be opened, read, written or renamed.
    #[error("{}: cannot be {action}: {source}", path.display())]
    Io {
        /// The file.
        path: PathBuf,
        /// "read" or "written".
        action: &'static str,
        /// The operating system's error.
        source: std::io::Error,
    },
    /// The first bytes match no format that can be read.
    #[error("{}: neither a PNG nor an EXR file: it begins with the bytes {found:02x?}", path.display())]
    UnknownFormat {
        /// The file.
        path: PathBuf,
        /// First bytes of the file, at most eight.
        found: Vec<u8>,
    },
    /// The file is damaged, or uses a part of its format that is not supported.
    #[error("{}: {field}: {fault}", path.display())]
    Malformed {
        /// The file.
        path: PathBuf,
        /// The part of the file.
        field: String,
        /// The value found there.
        fault: String,
    },
    /// The header claims more pixels than a file of that length can hold. Nothing was allocated.
    #[error("{}: its header claims {claimed} bytes of pixels, more than {length} bytes of file can hold", path.display())]
    TooLarge {
        /// The file.
        path: PathBuf,
        /// Bytes that the pixels would take.
        claimed: u64,
        /// Length of the file in bytes.
        length: u64,
    },
    /// A picture with a longer side than its use allows. Nothing was allocated.
    #[error("{}: a picture of {} × {} pixels, and at most {most} along a side are read here", path.display(), size[0], size[1])]
    Side {
        /// The file.
        path: PathBuf,
        /// Width and height in pixels.
        size: [usize; 2],
        /// Most pixels along a side.
        most: usize,
    },
    /// The memory budget does not allow the pixels. Nothing was allocated.
    #[error(
        "{}a picture of {} × {} pixels needs {no_room}; {} × {} pixels would fit",
        path.as_ref().map(|path| format!("{}: ", path.display())).unwrap_or_default(), size[0], size[1],
        no_room.fitting_size(*size)[0], no_room.fitting_size(*size)[1]
    )]
    NoRoom {
        /// The file; none for a picture that is not from a file.
        path: Option<PathBuf>,
        /// Width and height in pixels.
        size: [usize; 2],
        /// The memory needed, and the memory that is free.
        no_room: NoRoom,
    },
    /// The picture has no colours where colours are needed.
    #[error("{name}: has no channels R, G and B; it has {}", list(found))]
    NoColor {
        /// The file, or the label, of the picture.
        name: String,
        /// The channels of the picture.
        found: Vec<String>,
    },
    /// A picture without pixels, or a layer whose channels do not fit it.
    #[error("layer {layer}: {fault}")]
    Layer {
        /// Name of the layer.
        layer: String,
        /// The mismatch.
        fault: String,
    },
    /// A page or a mark with a number that is infinite or NaN. Nothing was written.
    #[error("{what} has a number that is infinite or NaN")]
    NotFinite {
        /// The page, the pen or the mark, as a noun phrase.
        what: String,
    },
    /// A bit depth that PNG does not have for colour pictures.
    #[error("picture.bits: {bits} bits per channel")]
    Bits {
        /// The requested depth.
        bits: u8,
    },
    /// Pictures of different sizes cannot be compared.
    #[error("the pictures differ in size: {}x{} and {}x{}", a[0], a[1], b[0], b[1])]
    Sizes {
        /// Width and height of the first.
        a: [usize; 2],
        /// Width and height of the second.
        b: [usize; 2],
    },
    /// A viewing distance outside the range of FLIP's filters.
    #[error("{pixels_per_degree} pixels per degree")]
    Viewing {
        /// The requested number.
        pixels_per_degree: f64,
    },
    /// Two pictures without a channel of the same name.
    #[error("the pictures have no channel in common: the first has {}, the second {}", list(a), list(b))]
    NothingInCommon {
        /// Channels of the first.
        a: Vec<String>,
        /// Channels of the second.
        b: Vec<String>,
    },
    /// A row of a list that is not a mark.
    #[error("{}: line {line}, column {column}: {fault}", path.display())]
    List {
        /// The file.
        path: PathBuf,
        /// Line number; the header is line 1.
        line: u64,
        /// Name of the column.
        column: String,
        /// The value found there, and the expected one.
        fault: String,
    },
    /// A contact sheet that cannot be laid out.
    #[error("sheet: {fault}")]
    Sheet {
        /// The reason.
        fault: String,
    },
}

impl OutputError {
    /// Returns one line that says what to do.
    pub fn help(&self) -> &'static str {
        match self {
            Self::Io { source, .. } if source.kind() == std::io::ErrorKind::OutOfMemory => {
                "give a smaller file, or allow more with --memory"
            }
            Self::Io { action: "read", .. } => "check that the file exists and may be read",
            Self::Io { source, .. } => drypoint_scene::atomic::remedy(source),
            Self::UnknownFormat { .. } => "convert the picture to PNG or EXR",
            Self::Malformed { .. } => "write the picture again, as a plain PNG or a flat scan-line EXR",
            Self::TooLarge { .. } => "the file is damaged or cut off: write or fetch it again",
            Self::Side { .. } => "make the picture smaller",
            Self::NoRoom { .. } => "make the picture smaller, or allow more with --memory",
            Self::NoColor { .. } => "give a picture with colour channels named R, G and B",
            Self::Layer { .. } => "ask for the layer with --layers and a picture of at least one pixel",
            Self::NotFinite { .. } => "make the lengths of the scene smaller, or leave the mark out",
            Self::Bits { .. } => "use 8 or 16",
            Self::Sizes { .. } => "render both with the same --size",
            Self::Viewing { .. } => "use 1 to 1000 pixels per degree; a desk screen has about 67",
            Self::NothingInCommon { .. } => "write both pictures with the same --layers",
            Self::List { .. } => "correct the line, or write the list again",
            Self::Sheet { .. } => "give at least one picture, and a cell from 16 to 4096 pixels",
        }
    }
}

/// Returns names separated by commas, or "none", for a message.
fn list(names: &[String]) -> String {
    if names.is_empty() { "none".into() } else { names.join(", ") }
}
