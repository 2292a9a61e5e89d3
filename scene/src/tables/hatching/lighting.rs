//! `[hatching.lighting]`: light on lines ([HATCH-12]).

use crate::color::{Rgba, opaque};
use crate::document::check::Check;
use crate::document::declare::table;
use crate::document::describe::{Kind, Shape, Table};
use crate::document::item::Item;
use crate::document::kind::{Bounds, Colors, Flag, Number, Whole};
use crate::document::out::Out;
use serde_json::{Value as Json, json};

table! {
    /// The table `[hatching.lighting]`.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct LineLighting {
        /// How much of the colour diffuse light shows.
        diffuse: f64 = 0.7, key("HATCH-12", NUMBER);
        /// Exponent of the diffuse term: the higher, the darker what the light meets at a slant.
        p: f64 = 4.8, key("HATCH-12", NUMBER);
        /// How white highlights are.
        specular: f64 = 0.3, key("HATCH-12", NUMBER);
        /// Exponent of the specular term: the higher, the smaller highlights are.
        s: f64 = 20.0, key("HATCH-12", NUMBER);
        /// Colour of strokes on surfaces that face the eye.
        ///
        /// Linear, straight.
        front: Rgba = opaque([32.0, 64.0, 160.0]), key("HATCH-12", Colors);
        /// Colour of strokes on surfaces that turn away.
        ///
        /// Linear, straight.
        back: Rgba = opaque([192.0, 160.0, 32.0]), key("HATCH-12", Colors);
        /// Whether max(0, N·L) multiplies both terms.
        self_shadow: bool = false, key("HATCH-12", Flag);
        /// Entries a side of a table of both terms over L·T and V·T, bilinear, as the paper has it; or the formulas
        /// themselves.
        table: Option<usize> = None, key("HATCH-12", TableKind);
    }
}

/// `"exact"`, or a number of entries.
struct TableKind;

const ENTRIES: Whole = Whole { lo: 2, hi: 4096 };

impl Shape for TableKind {
    fn expected(&self) -> String {
        format!("\"exact\", or {}", ENTRIES.expected())
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [{ "const": "exact" }, ENTRIES.schema()] })
    }
}

impl Kind for TableKind {
    type Of = Option<usize>;

    fn read(&self, item: &Item, check: &mut Check) -> Option<Option<usize>> {
        if item.text() == Some("exact") {
            return Some(None);
        }
        ENTRIES.read(item, check).map(|entries| Some(entries as usize))
    }

    fn write(&self, value: &Option<usize>) -> Out {
        match value {
            None => Out::Text("exact".into()),
            Some(entries) => ENTRIES.write(&(*entries as u64)),
        }
    }
}

const NUMBER: Number = Number { bounds: Bounds::NOT_NEGATIVE, unit: "" };

/// The description of `[hatching.lighting]`.
pub(super) static LIGHTING: Table<LineLighting> = LineLighting::description(
    "[hatching.lighting]",
    "Light on strokes as on lines, from `hatching.stroke.light`: diffuse · (√(1−(L·T)²))^p of each colour, and specular · \
     max(0, √(1−(L·T)²)√(1−(V·T)²) − (L·T)(V·T))^s in white; front and back mixed by ½ + ½N·V.",
);
