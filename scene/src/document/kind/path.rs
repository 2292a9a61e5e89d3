//! Paths of files and folders ([SCN-2]).

use crate::document::check::Check;
use crate::document::describe::{Kind, Shape};
use crate::document::item::Item;
use crate::document::out::Out;
use serde_json::{Value as Json, json};
use std::path::PathBuf;

/// A path, relative to the scene's folder.
pub(crate) struct PathTo {
    /// The file in words: `a volume`.
    pub(crate) what: &'static str,
}

impl Shape for PathTo {
    fn expected(&self) -> String {
        format!("the path of {} in quotes", self.what)
    }

    fn schema(&self) -> Json {
        json!({ "type": "string", "minLength": 1 })
    }
}

impl Kind for PathTo {
    type Of = PathBuf;

    fn read(&self, item: &Item, check: &mut Check) -> Option<PathBuf> {
        match item.text() {
            // No system opens a path with a NUL in it.
            Some(path) if !path.is_empty() && !path.contains('\0') => Some(check.resolve(path, &item.place)),
            _ => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, value: &PathBuf) -> Out {
        Out::Path(value.clone())
    }
}
