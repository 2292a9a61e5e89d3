//! Names of parts: what other tables call the background, an object's selection, and its ghost.

use crate::document::check::Check;
use crate::document::describe::{Kind, Shape};
use crate::document::item::Item;
use crate::document::kind::Text;
use crate::document::out::Out;
use serde_json::Value as Json;
use std::fmt;

/// The name of a part of a scene.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum PartName {
    /// `"background"`: the volume of `[volume]`, with everything that is drawn of it.
    Background,
    /// `"NAME"`: the selection of the object with that name.
    Selection(String),
    /// `"NAME ghost"`: the ghost of the object with that name.
    Ghost(String),
}

impl PartName {
    /// The name of the background.
    pub(crate) const BACKGROUND: &'static str = "background";
    /// The end of a ghost's name.
    pub(crate) const GHOST: &'static str = " ghost";
}

impl fmt::Display for PartName {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Background => f.write_str(Self::BACKGROUND),
            Self::Selection(name) => f.write_str(name),
            Self::Ghost(name) => write!(f, "{name}{}", Self::GHOST),
        }
    }
}

/// The name of a part.
pub(crate) struct PartNames;

const NAME: Text = Text { what: "\"background\", the name of an object, or \"NAME ghost\"" };

impl Shape for PartNames {
    fn expected(&self) -> String {
        NAME.what.into()
    }

    fn schema(&self) -> Json {
        NAME.schema()
    }
}

impl Kind for PartNames {
    type Of = PartName;

    fn read(&self, item: &Item, check: &mut Check) -> Option<PartName> {
        match item.text() {
            Some(PartName::BACKGROUND) => Some(PartName::Background),
            Some(text) if !text.is_empty() => Some(match text.strip_suffix(PartName::GHOST) {
                Some(name) => PartName::Ghost(name.into()),
                None => PartName::Selection(text.into()),
            }),
            _ => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, value: &PartName) -> Out {
        Out::Text(value.to_string())
    }
}
