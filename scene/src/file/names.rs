//! Names that scenes refer to and that other modules own.

use crate::style::Theme;
use crate::tables::StyleSource;

/// The themes that are part of the program.
pub(crate) fn themes() -> Vec<&'static str> {
    Theme::embedded_names().collect()
}

/// The styles of a theme; none where its folder cannot be listed.
pub(crate) fn styles_of(theme: &StyleSource) -> Option<Vec<String>> {
    Theme::open(theme).ok().map(|theme| theme.names().map(Into::into).collect())
}
