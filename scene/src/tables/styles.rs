//! `[styles]`: the lit-sphere pictures that a transfer function names.

use crate::document::check::Check;
use crate::document::declare::table;
use crate::document::describe::{Kind, Names, Shape, Table};
use crate::document::item::{Item, Value};
use crate::document::kind::{FEW, Flag, PathTo, TableOf};
use crate::document::out::Out;
use serde_json::{Value as Json, json};
use std::path::PathBuf;

table! {
    /// The table `[styles]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Styles {
        /// An embedded theme, or a folder of pictures named after their styles.
        theme: StyleSource = StyleSource::Embedded("textbook".into()), key("STF-12", Theme);
        /// Single styles, which go over the theme's.
        files: Vec<(String, StyleFile)> = Vec::new();
    }
}

/// Source of a theme.
#[derive(Clone, Debug, PartialEq)]
pub enum StyleSource {
    /// Part of the program.
    Embedded(String),
    /// A folder of pictures named after their styles.
    Folder(PathBuf),
}

table! {
    /// A style's picture on disk.
    #[derive(Clone, Debug, PartialEq)]
    pub struct StyleFile {
        /// A square picture of a lit sphere.
        path: PathBuf = PathBuf::new(), key("STF-1", FILE).named("file").required();
        /// Whether the colours are linear, not sRGB.
        linear: bool = false, key("VAL-3", Flag);
    }
}

impl Styles {
    /// The folder of the theme, and the files of single styles.
    pub(crate) fn paths(&self) -> impl Iterator<Item = &PathBuf> {
        let theme = match &self.theme {
            StyleSource::Folder(folder) => Some(folder),
            StyleSource::Embedded(_) => None,
        };
        theme.into_iter().chain(self.files.iter().map(|(_, file)| &file.path))
    }
}

/// The themes that are part of the program.
pub(crate) const THEMES: [&str; 3] = ["textbook", "naturalist", "studio"];

/// The description of `[styles]`.
pub(crate) static TABLE: Table<Styles> = Table {
    open: Some(&Names {
        kind: Picture,
        doc: "A style of that name: the path of its picture, or { file = \"…\", linear = true }. It goes over the \
              theme's style of that name.",
        most: FEW,
        list: |styles: &Styles| styles.files.clone(),
        add: |styles, name, file| styles.files.push((name, file)),
    }),
    ..Styles::description(
        "[styles]",
        "The lit-sphere pictures that a transfer function names: a theme first, single files over it. Exchanging the \
         theme changes no other line.",
    )
};

/// The name of an embedded theme, or else a folder.
struct Theme;

impl Shape for Theme {
    fn expected(&self) -> String {
        let names: Vec<String> = THEMES.iter().map(|name| format!("{name:?}")).collect();
        format!("an embedded theme ({}), or the path of a folder of pictures", names.join(", "))
    }

    fn schema(&self) -> Json {
        json!({ "type": "string", "minLength": 1, "examples": THEMES })
    }
}

impl Kind for Theme {
    type Of = StyleSource;

    fn read(&self, item: &Item, check: &mut Check) -> Option<StyleSource> {
        match item.text() {
            Some(name) if THEMES.contains(&name) => Some(StyleSource::Embedded(name.into())),
            Some(path) if !path.is_empty() && !path.contains('\0') => {
                Some(StyleSource::Folder(check.resolve(path, &item.place)))
            }
            _ => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, value: &StyleSource) -> Out {
        match value {
            StyleSource::Embedded(name) => Out::Text(name.clone()),
            StyleSource::Folder(path) => Out::Path(path.clone()),
        }
    }
}

/// The picture of a style.
struct Picture;

/// A picture's path.
const FILE: PathTo = PathTo { what: "a square picture" };

/// The description of `{ file = "…", linear = true }`.
static FILE_TABLE: Table<StyleFile> = StyleFile::description("a style", "A picture whose colours may be linear.");

impl Shape for Picture {
    fn expected(&self) -> String {
        format!("{}, or {{ file = \"…\", linear = true }}", FILE.expected())
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [FILE.schema(), TableOf(&FILE_TABLE).schema()] })
    }
}

impl Kind for Picture {
    type Of = StyleFile;

    fn read(&self, item: &Item, check: &mut Check) -> Option<StyleFile> {
        match &item.value {
            Value::Table(_) => check.table(&FILE_TABLE, item),
            Value::Text(_) => FILE.read(item, check).map(|path| StyleFile { path, linear: false }),
            _ => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, value: &StyleFile) -> Out {
        if value.linear { TableOf(&FILE_TABLE).write(value) } else { FILE.write(&value.path) }
    }
}
