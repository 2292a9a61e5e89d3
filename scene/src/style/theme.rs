//! Themes: sets of styles by name ([STF-12]).

use super::{Style, StyleError};
use crate::memory;
use crate::nearest::nearest;
use crate::source::Source;
use crate::tables::StyleSource;
use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};

/// Names and pictures of the styles of one embedded theme.
type Pictures = &'static [(&'static str, &'static [u8])];

/// An embedded theme: every theme has the same names, so that exchanging it changes no other line of a scene.
macro_rules! theme {
    ($theme:literal) => {
        theme!(
            $theme: "bone", "brain", "cartoon", "cartoon-2", "chalk", "constant", "copper", "engraving", "gall",
            "glass", "gut", "ink", "kidney", "liver", "lung", "metal", "muscle", "nerve", "pencil", "porcelain",
            "skin", "spleen", "tone", "vein", "vessel", "watercolour", "wax", "xray"
        )
    };
    ($theme:literal: $($style:literal),+) => {
        ($theme, &[$(($style, include_bytes!(concat!("../../../data/themes/", $theme, "/", $style, ".png")))),+])
    };
}

/// The themes that are part of the program.
const EMBEDDED: &[(&str, Pictures)] = &[theme!("textbook"), theme!("naturalist"), theme!("studio")];

/// A set of styles by name. Opening one lists it; a picture is decoded when its style is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Theme {
    source: StyleSource,
    pictures: BTreeMap<String, ThemePicture>,
}

/// The location of one picture of a theme.
#[derive(Clone, Debug, PartialEq)]
enum ThemePicture {
    Embedded(&'static [u8]),
    File(PathBuf),
}

impl Theme {
    /// Names of the themes that are part of the program.
    pub fn embedded_names() -> impl Iterator<Item = &'static str> {
        EMBEDDED.iter().map(|(name, _)| *name)
    }

    /// The theme that `[styles]` names.
    ///
    /// # Errors
    /// A name that no embedded theme has; a folder that cannot be listed or has two pictures of one name.
    pub fn open(files: &dyn Source, source: &StyleSource) -> Result<Self, StyleError> {
        let pictures = match source {
            StyleSource::Embedded(name) => embedded(name)?,
            StyleSource::Folder(folder) => pictures_of(files, folder)?,
        };
        Ok(Self { source: source.clone(), pictures })
    }

    /// Names of the styles, in alphabetical order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.pictures.keys().map(String::as_str)
    }

    /// Decodes the style of that name; none if the theme has no such style.
    ///
    /// # Errors
    /// A file that cannot be read, or a picture that is no style.
    pub fn style(&self, files: &dyn Source, name: &str) -> Option<Result<Style, StyleError>> {
        Some(match self.pictures.get(name)? {
            ThemePicture::Embedded(bytes) => {
                let file = PathBuf::from(format!("{self}/{name}.png"));
                Style::decode(name, bytes, false).map_err(|fault| StyleError::Picture {
                    name: name.into(),
                    file,
                    fault,
                })
            }
            ThemePicture::File(path) => read(files, name, path, false),
        })
    }
}

impl fmt::Display for Theme {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.source {
            StyleSource::Embedded(name) => write!(f, "theme `{name}`"),
            StyleSource::Folder(folder) => write!(f, "theme {}", folder.display()),
        }
    }
}

/// The style in a file.
pub(super) fn read(files: &dyn Source, name: &str, path: &Path, linear: bool) -> Result<Style, StyleError> {
    let bytes = memory::read(files, path).map_err(|e| StyleError::File {
        name: name.into(),
        file: path.into(),
        reason: e.to_string(),
    })?;
    Style::decode(name, &bytes, linear).map_err(|fault| StyleError::Picture {
        name: name.into(),
        file: path.into(),
        fault,
    })
}

fn embedded(name: &str) -> Result<BTreeMap<String, ThemePicture>, StyleError> {
    let (_, pictures) = EMBEDDED.iter().find(|(theme, _)| *theme == name).ok_or_else(|| StyleError::UnknownTheme {
        name: name.into(),
        near: nearest(name, Theme::embedded_names()).map(Into::into),
        known: Theme::embedded_names().map(Into::into).collect(),
    })?;
    Ok(pictures.iter().map(|(style, bytes)| ((*style).into(), ThemePicture::Embedded(bytes))).collect())
}

/// The pictures of a folder by their names without suffix. Hidden files and files of other kinds are passed over.
fn pictures_of(files: &dyn Source, folder: &Path) -> Result<BTreeMap<String, ThemePicture>, StyleError> {
    let fault = |e: std::io::Error| StyleError::Folder { folder: folder.into(), reason: e.to_string() };
    let mut pictures = BTreeMap::new();
    for path in files.list(folder).map_err(fault)? {
        let Some((name, suffix)) =
            path.file_name().and_then(|file| file.to_str()).and_then(|file| file.rsplit_once('.'))
        else {
            continue;
        };
        let is_picture = ["png", "jpg", "jpeg", "exr"].iter().any(|known| suffix.eq_ignore_ascii_case(known));
        if name.is_empty() || name.starts_with('.') || !is_picture {
            continue;
        }
        let name = name.to_owned();
        if let Some(ThemePicture::File(other)) = pictures.insert(name.clone(), ThemePicture::File(path.clone())) {
            let mut files =
                [other, path].map(|p| p.file_name().unwrap_or_default().to_string_lossy().into_owned()).to_vec();
            files.sort();
            return Err(StyleError::Ambiguous { folder: folder.into(), name, files });
        }
    }
    Ok(pictures)
}
