//! Names that scenes refer to and that other modules own.

use crate::tables::StyleSource;

/// The themes that are part of the program.
pub(crate) fn themes() -> Vec<&'static str> {
    vec!["textbook"]
}

/// The styles of a theme; none where its folder cannot be listed.
pub(crate) fn styles_of(theme: &StyleSource) -> Option<Vec<String>> {
    match theme {
        StyleSource::Embedded(_) => Some(vec!["metal".into(), "wax".into()]),
        StyleSource::Folder(_) => None,
    }
}
