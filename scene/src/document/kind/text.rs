//! Names that are free.

use crate::document::check::Check;
use crate::document::describe::{Kind, Shape};
use crate::document::item::Item;
use crate::document::out::Out;
use serde_json::{Value as Json, json};

/// A text that is not empty.
pub(crate) struct Text {
    /// The value in words: `the name of a style`.
    pub(crate) what: &'static str,
}

impl Shape for Text {
    fn expected(&self) -> String {
        format!("{} in quotes", self.what)
    }

    fn schema(&self) -> Json {
        json!({ "type": "string", "minLength": 1 })
    }
}

impl Kind for Text {
    type Of = String;

    fn read(&self, item: &Item, check: &mut Check) -> Option<String> {
        match item.text() {
            Some(text) if !text.is_empty() => Some(text.to_owned()),
            _ => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, value: &String) -> Out {
        Out::Text(value.clone())
    }
}
