//! `[volume.parts]`: the connected parts of a volume that are kept ([VOL-2]).

use crate::document::check::Check;
use crate::document::declare::table;
use crate::document::describe::{Instead, Kind, Shape, Table};
use crate::document::item::{Item, Value};
use crate::document::kind::{Bounds, Number, Numbers, Rule, TableOf, Whole};
use crate::document::out::Out;
pub use crate::volume::parts::Keep;
use glam::DVec3;
use serde_json::{Value as Json, json};

table! {
    /// The table `[volume.parts]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct PartsTable {
        /// The parts to keep: "largest", a number of the largest, { share = 0.01 } of the largest part's voxels, or
        /// { at = [x, y, z] }, the part at a point of the world.
        keep: Keep = Keep::Largest(1), key("VOL-2", Kept);
        /// The least value of a part's voxels; with `outside = "high"`, the highest. It stands in the place of what
        /// the transfer function shows.
        at_least: Option<f64> = None, key("VOL-2", Number { bounds: Bounds::ANY, unit: "" })
            .absent("values that the transfer function shows; without [transfer], the iso-value");
    }
}

/// The description of `[volume.parts]`.
pub(super) static TABLE: Table<PartsTable> = PartsTable::description(
    "[volume.parts]",
    "Connected parts of the volume: voxels that touch with their faces. Parts that are not kept, and the voxels around \
     them, take the volume's outside value: the lowest, or the highest with `outside = \"high\"`.",
);

/// A number of parts.
const COUNT: Whole = Whole { lo: 1, hi: i64::MAX as u64 };

/// `"largest"`, a number, `{ share = 0.01 }` or `{ at = [x, y, z] }`.
struct Kept;

table! {
    /// A share or a point.
    #[derive(Clone, Copy)]
    struct Chosen {
        /// The least number of a part's voxels, as a share of the largest part's.
        share: Option<f64> = None,
            key("VOL-2", Number { bounds: Bounds::UNIT, unit: "" }).absent("`at` in its place");
        /// A point of the world in the part to keep, such as `drypoint pick` tells.
        at: Option<DVec3> = None,
            key("VOL-2", Numbers { what: "a point [x, y, z]", bounds: Bounds::ANY, rule: Rule::Free })
                .absent("`share` in its place");
    }
}

/// The description of `keep = { … }`.
static CHOSEN: Table<Chosen> = Table {
    instead: &[Instead { one: "at", others: &["share"] }],
    ..Chosen::description("keep", "Parts by their share of the largest one, or by a point.")
};

impl Shape for Kept {
    fn expected(&self) -> String {
        format!("\"largest\", a whole number{}, {{ share = 0.01 }} from 0 to 1, or {{ at = [x, y, z] }}", COUNT.words())
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [{ "const": "largest" }, COUNT.schema(), TableOf(&CHOSEN).schema()] })
    }
}

impl Kind for Kept {
    type Of = Keep;

    fn read(&self, item: &Item, check: &mut Check) -> Option<Keep> {
        match &item.value {
            Value::Text(text) if text == "largest" => Some(Keep::Largest(1)),
            Value::Table(_) => match check.table(&CHOSEN, item)? {
                Chosen { at: Some(point), .. } => Some(Keep::At(point)),
                Chosen { share: Some(share), .. } => Some(Keep::Share(share)),
                // A fault of one of the two has been said.
                _ if !check.sound(&["share", "at"]) => None,
                _ => check.wrong(item, self.expected()),
            },
            _ => match COUNT.of(item).and_then(|n| usize::try_from(n).ok()) {
                Some(n) => Some(Keep::Largest(n)),
                None => check.wrong(item, self.expected()),
            },
        }
    }

    fn write(&self, value: &Keep) -> Out {
        let chosen = |share, at| TableOf(&CHOSEN).write(&Chosen { share, at });
        match *value {
            Keep::Largest(1) => Out::Text("largest".into()),
            Keep::Largest(n) => Out::Whole(n as u64),
            Keep::Share(share) => chosen(Some(share), None),
            Keep::At(point) => chosen(None, Some(point)),
        }
    }
}
