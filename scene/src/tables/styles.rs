//! `[styles]`: the lit-sphere pictures that a transfer function names.

use std::path::PathBuf;

/// The table `[styles]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Styles {
    /// An embedded theme by name, or a folder of pictures.
    pub theme: StyleSource,
    /// Single styles, which go over the theme's.
    pub files: Vec<(String, StyleFile)>,
}

/// Where a theme comes from.
#[derive(Clone, Debug, PartialEq)]
pub enum StyleSource {
    /// Part of the program.
    Embedded(String),
    /// A folder of pictures named after their styles.
    Folder(PathBuf),
}

/// A style's picture on disk.
#[derive(Clone, Debug, PartialEq)]
pub struct StyleFile {
    /// Path to open.
    pub path: PathBuf,
    /// Whether the colours are linear, not sRGB ([VAL-3]).
    pub linear: bool,
}

impl Default for Styles {
    fn default() -> Self {
        Self { theme: StyleSource::Embedded("textbook".into()), files: Vec::new() }
    }
}
