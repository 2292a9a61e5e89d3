//! `[styles]`: the lit-sphere pictures that a transfer function names.

use crate::file::Problem;
use crate::file::check::Check;
use crate::file::describe::{Key, Kind, Names, Shape, Slot, Table};
use crate::file::item::{Item, Value};
use crate::file::kind::{Flag, PathTo, TableOf};
use crate::file::names;
use crate::file::out::Out;
use crate::nearest::nearest;
use crate::tables::{Node, NodeColor, Scene, TransferKind};
use serde_json::{Value as Json, json};
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

/// The description of `[styles]`.
pub(crate) static TABLE: Table<Styles> = Table {
    open: Some(&Names {
        kind: Picture,
        doc: "A style of that name: the path of its picture, or { file = \"…\", linear = true }. It goes over the \
              theme's style of that name.",
        list: |styles: &Styles| styles.files.clone(),
        add: |styles, name, file| styles.files.push((name, file)),
    }),
    idle: |scene, _, idle| {
        let Some(transfer) = &scene.transfer else { return };
        if transfer.kind == TransferKind::Regular {
            idle.key("styles", "a regular function names no style");
        } else if !transfer.is_automatic() {
            let is = |node: &Node, style: &str| matches!(&node.color, NodeColor::Style(s) if s == style);
            let named = |style: &str| transfer.all_nodes().any(|node| is(node, style));
            for (name, _) in scene.styles.files.iter().filter(|(name, _)| !named(name)) {
                idle.key(&format!("styles.{}", crate::file::out::key(name)), "no node names it");
            }
        }
    },
    ..Table::new(
        "[styles]",
        "The lit-sphere pictures that a transfer function names: a theme first, single files over it. Exchanging the \
         theme changes no other line.",
        Styles::default,
        &[Key::new(
            "theme",
            "STF-12",
            "An embedded theme, or a folder of pictures named after their styles.",
            &Slot { kind: Theme, get: |s: &Styles| Some(s.theme.clone()), set: |s, v| s.theme = v },
        )],
    )
};

/// Every style that a node names must be one that the theme or a file provides. A folder of pictures that cannot be
/// listed is left to whoever opens it.
pub(super) fn check_styles(scene: &Scene, check: &mut Check) {
    if !check.sound(&["styles"]) {
        return;
    }
    let Some(mut known) = names::styles_of(&scene.styles.theme) else { return };
    known.extend(scene.styles.files.iter().map(|(name, _)| name.clone()));
    known.sort();
    known.dedup();
    for (name, key, place) in check.take_styles() {
        if !known.contains(&name) {
            let nearest = nearest(&name, known.iter().map(String::as_str)).map(Into::into);
            let problem = Problem::Reference { what: "style".into(), name, nearest, known: known.clone() };
            check.fault_of(key, &place, problem);
        }
    }
}

/// The name of an embedded theme, or else a folder.
struct Theme;

impl Shape for Theme {
    fn expected(&self) -> String {
        let names: Vec<String> = names::themes().into_iter().map(|name| format!("{name:?}")).collect();
        format!("an embedded theme ({}), or the path of a folder of pictures", names.join(", "))
    }

    fn schema(&self) -> Json {
        json!({ "type": "string", "minLength": 1, "examples": names::themes() })
    }
}

impl Kind for Theme {
    type Of = StyleSource;

    fn read(&self, item: &Item, check: &mut Check) -> Option<StyleSource> {
        match item.text() {
            Some(name) if names::themes().contains(&name) => Some(StyleSource::Embedded(name.into())),
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
static FILE_TABLE: Table<StyleFile> = Table::new(
    "a style",
    "A picture whose colours may be linear.",
    || StyleFile { path: PathBuf::new(), linear: false },
    &[
        Key::new(
            "file",
            "STF-1",
            "A square picture of a lit sphere.",
            &Slot { kind: FILE, get: |s: &StyleFile| Some(s.path.clone()), set: |s, v| s.path = v },
        )
        .required(),
        Key::new(
            "linear",
            "VAL-3",
            "Whether the colours are linear, not sRGB.",
            &Slot { kind: Flag, get: |s: &StyleFile| Some(s.linear), set: |s, v| s.linear = v },
        ),
    ],
);

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
