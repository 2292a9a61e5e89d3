//! `[hatching.lighting]`: light on lines ([HATCH-12]).

use crate::color::{Rgba, srgb_to_linear};
use crate::document::check::Check;
use crate::document::describe::{Key, Kind, Shape, Slot, Table};
use crate::document::item::Item;
use crate::document::kind::{Bounds, Colors, Flag, Number, Whole};
use crate::document::out::Out;
use serde_json::{Value as Json, json};

/// The table `[hatching.lighting]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineLighting {
    /// k_d.
    pub diffuse: f64,
    /// The exponent of the diffuse term.
    pub p: f64,
    /// k_s.
    pub specular: f64,
    /// The exponent of the specular term.
    pub s: f64,
    /// Where the surface faces the eye; linear, straight.
    pub front: Rgba,
    /// Where it turns away.
    pub back: Rgba,
    /// Whether max(0, N·L) multiplies the light.
    pub self_shadow: bool,
    /// Entries a side of a table in place of the formulas; none: exact.
    pub table: Option<usize>,
}

impl Default for LineLighting {
    fn default() -> Self {
        let color = |bytes: [f64; 3]| {
            let [r, g, b] = bytes.map(|byte| srgb_to_linear(byte / 255.0));
            [r, g, b, 1.0]
        };
        Self {
            diffuse: 0.7,
            p: 4.8,
            specular: 0.3,
            s: 20.0,
            front: color([32.0, 64.0, 160.0]),
            back: color([192.0, 160.0, 32.0]),
            self_shadow: false,
            table: None,
        }
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
pub(super) static LIGHTING: Table<LineLighting> = Table::new(
    "[hatching.lighting]",
    "Light on strokes as on lines, from `hatching.stroke.light`: diffuse · (√(1−(L·T)²))^p of each colour, and specular · \
     max(0, √(1−(L·T)²)√(1−(V·T)²) − (L·T)(V·T))^s in white; front and back mixed by ½ + ½N·V.",
    LineLighting::default,
    &[
        Key::new(
            "diffuse",
            "HATCH-12",
            "How much of the colour diffuse light shows.",
            &Slot { kind: NUMBER, get: |l: &LineLighting| Some(l.diffuse), set: |l, v| l.diffuse = v },
        ),
        Key::new(
            "p",
            "HATCH-12",
            "Exponent of the diffuse term: the higher, the darker what the light meets at a slant.",
            &Slot { kind: NUMBER, get: |l: &LineLighting| Some(l.p), set: |l, v| l.p = v },
        ),
        Key::new(
            "specular",
            "HATCH-12",
            "How white highlights are.",
            &Slot { kind: NUMBER, get: |l: &LineLighting| Some(l.specular), set: |l, v| l.specular = v },
        ),
        Key::new(
            "s",
            "HATCH-12",
            "Exponent of the specular term: the higher, the smaller highlights are.",
            &Slot { kind: NUMBER, get: |l: &LineLighting| Some(l.s), set: |l, v| l.s = v },
        ),
        Key::new(
            "front",
            "HATCH-12",
            "Of strokes on what faces the eye.",
            &Slot { kind: Colors, get: |l: &LineLighting| Some(l.front), set: |l, v| l.front = v },
        ),
        Key::new(
            "back",
            "HATCH-12",
            "Of strokes on what turns away.",
            &Slot { kind: Colors, get: |l: &LineLighting| Some(l.back), set: |l, v| l.back = v },
        ),
        Key::new(
            "self_shadow",
            "HATCH-12",
            "Whether max(0, N·L) multiplies both terms.",
            &Slot { kind: Flag, get: |l: &LineLighting| Some(l.self_shadow), set: |l, v| l.self_shadow = v },
        ),
        Key::new(
            "table",
            "HATCH-12",
            "Entries a side of a table of both terms over L·T and V·T, bilinear, as the paper has it; or the formulas themselves.",
            &Slot { kind: TableKind, get: |l: &LineLighting| Some(l.table), set: |l, v| l.table = v },
        ),
    ],
);
