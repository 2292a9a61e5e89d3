//! Errors of styles, themes and their pictures.

use crate::memory::NoRoom;
use std::path::PathBuf;

/// The fault of a picture that makes no style.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PictureFault {
    /// A file that is no PNG, JPEG or OpenEXR, or a damaged one.
    #[error("not a readable PNG, JPEG or OpenEXR: {reason}")]
    Unreadable {
        /// The decoder's reason.
        reason: String,
    },
    /// Floating-point light where a table of codes is asked for ([VS-5]).
    #[error("floating-point light, but a lighting table has 8 or 16 bits a channel")]
    FloatingPoint,
    /// Width and height differ ([STF-1]).
    #[error("{width} × {height} texels, but a style is a square picture of a sphere")]
    NotSquare {
        /// Texels from left to right.
        width: usize,
        /// Texels from top to bottom.
        height: usize,
    },
    /// A side that would ask for more memory than any style is worth.
    #[error("{width} × {height} texels, but at most {limit} × {limit} are read")]
    TooLarge {
        /// Texels from left to right.
        width: usize,
        /// Texels from top to bottom.
        height: usize,
        /// The largest side.
        limit: usize,
    },
    /// There is no memory for the pixels.
    #[error("{width} × {height} pixels need {no_room}")]
    Memory {
        /// Pixels from left to right.
        width: usize,
        /// Pixels from top to bottom.
        height: usize,
        /// The need, and the memory that is free.
        no_room: NoRoom,
    },
    /// The texels given are not S × S.
    #[error("{found} texels do not make a square of side {side}")]
    Texels {
        /// S.
        side: usize,
        /// Number of texels given.
        found: usize,
    },
    /// The pixels given are not width × height, or there is none.
    #[error("{found} pixels do not make a picture of {width} × {height}")]
    Pixels {
        /// Pixels from left to right.
        width: usize,
        /// Pixels from top to bottom.
        height: usize,
        /// Number of pixels given.
        found: usize,
    },
}

/// A style or a theme that a scene names and that cannot be loaded.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum StyleError {
    /// Neither the theme nor `[styles]` has a style of that name.
    #[error("no style `{name}` in {theme}{}; it has {}", meant(near), list(known))]
    Unknown {
        /// The name in the transfer function.
        name: String,
        /// The theme that was searched, in words.
        theme: String,
        /// The known name that is nearest to it.
        near: Option<String>,
        /// All known names, the theme's and those of `[styles]`.
        known: Vec<String>,
    },
    /// No such theme in the program.
    #[error("no theme `{name}`{}; the program has {}", meant(near), list(known))]
    UnknownTheme {
        /// The name in `[styles]`.
        name: String,
        /// The theme whose name is nearest to it.
        near: Option<String>,
        /// All embedded themes.
        known: Vec<String>,
    },
    /// A theme's folder cannot be listed.
    #[error("the theme's folder {}: {reason}", folder.display())]
    Folder {
        /// The folder.
        folder: PathBuf,
        /// The operating system's reason.
        reason: String,
    },
    /// Two pictures of a theme's folder bear one name.
    #[error("the theme's folder {} has two pictures for the style `{name}`: {}", folder.display(), list(files))]
    Ambiguous {
        /// The folder.
        folder: PathBuf,
        /// The style.
        name: String,
        /// The files' names.
        files: Vec<String>,
    },
    /// A style's file cannot be read.
    #[error("style `{name}`: {}: {reason}", file.display())]
    File {
        /// The style.
        name: String,
        /// The file.
        file: PathBuf,
        /// The operating system's reason.
        reason: String,
    },
    /// A style's picture has a fault.
    #[error("style `{name}`: {}: {fault}", file.display())]
    Picture {
        /// The style.
        name: String,
        /// The file, or the name of the embedded picture.
        file: PathBuf,
        /// The fault of the picture.
        fault: PictureFault,
    },
}

impl StyleError {
    /// One line that says what to do.
    pub fn help(&self) -> &'static str {
        match self {
            Self::Unknown { .. } => "name a style of the theme, or give it a picture in [styles]",
            Self::UnknownTheme { .. } => "name an embedded theme, or a folder of pictures",
            Self::Folder { .. } => "give a folder of pictures that may be read",
            Self::Ambiguous { .. } => "keep one of them",
            Self::File { .. } => "give a picture that may be read",
            Self::Picture { fault, .. } => fault.help(),
        }
    }
}

impl PictureFault {
    /// One line that says what to do.
    pub fn help(&self) -> &'static str {
        match self {
            Self::Unreadable { .. } => "give a picture in PNG, JPEG or OpenEXR",
            Self::FloatingPoint => "give a PNG of 8 or 16 bits",
            Self::NotSquare { .. } | Self::Texels { .. } => "cut the picture to the square around its sphere",
            Self::TooLarge { .. } | Self::Memory { .. } => "scale the picture down",
            Self::Pixels { .. } => "give one for each place of a picture that has at least one",
        }
    }
}

/// `" (did you mean `wax`?)"`, or nothing.
fn meant(near: &Option<String>) -> String {
    near.as_ref().map_or_else(String::new, |near| format!(" (did you mean `{near}`?)"))
}

/// `"`bone`, `wax`"`, or `"none"`.
fn list(names: &[String]) -> String {
    if names.is_empty() {
        return "none".into();
    }
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}
