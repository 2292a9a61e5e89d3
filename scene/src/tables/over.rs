//! The quantities of a transfer function: the value, or two quantities ([STF-4], 4.2).
//!
//! The list of quantities is open. A new one takes a variant of [`Axis`], a line in the list of names or in the table
//! of quantities with a parameter, and a measure.

use crate::document::Problem;
use crate::document::check::Check;
use crate::document::declare::table;
use crate::document::describe::{Key, Kind, Section, Shape, Table};
use crate::document::item::{Item, Value};
use crate::document::kind::{Bounds, ListOf, Numbers, PathTo, Rule, TableOf, Text, Whole};
use crate::document::out::Out;
use crate::nearest::nearest;
use crate::quantity::Quantity;
use glam::DVec3;
use serde::{Deserialize, Serialize};
use serde_json::{Value as Json, json};
use std::path::PathBuf;

/// The quantities that a transfer function is over.
#[derive(Clone, Debug, PartialEq)]
pub enum Over {
    /// The value alone: one line of nodes.
    Value,
    /// Two quantities: the first along each row of nodes, the second from row to row.
    Two([Axis; 2]),
}

/// A quantity that an axis of a transfer function measures. `L` is the type of a label's name: an id or a name in a
/// scene, and an id alone after names have been looked up.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Axis<L = LabelKey> {
    /// The value of the volume.
    Value,
    /// ‖g‖ in value per world unit; |g| of [VAL-2] with `unit = "normalized"`; 0 without a normal ([PREC-3]).
    GradientMagnitude,
    /// The id of the part that a sample belongs to ([STF-13]).
    Label,
    /// κ₁ ([CUR-1]), in reciprocal world units; 0 without a normal, as all curvatures.
    K1,
    /// κ₂.
    K2,
    /// (κ₁ + κ₂)/2.
    Mean,
    /// κ₁κ₂.
    Gaussian,
    /// κ_v as the scene measures it ([STF-5], [CUR-2]).
    AlongView,
    /// The distance to a point, in world units.
    Distance(DVec3),
    /// The distance to the nearest voxel centre of a label, in world units; 0 inside.
    DistanceToLabel(L),
    /// The value of a further volume at the same place in the world; the low end of its range outside its box.
    Volume(PathBuf),
}

/// How a scene names a label.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum LabelKey {
    /// By its id.
    Id(u32),
    /// By its name in `volume.label_names`.
    Name(String),
}

/// A quantity that has nothing but a name.
struct Named {
    name: &'static str,
    axis: Axis,
    doc: &'static str,
}

impl Named {
    const fn new(name: &'static str, axis: Axis, doc: &'static str) -> Self {
        Self { name, axis, doc }
    }
}

/// The quantities that have nothing but a name.
static NAMED: [Named; 8] = [
    Named::new("value", Axis::Value, "the value"),
    Named::new("gradient-magnitude", Axis::GradientMagnitude, "‖g‖ in value per world unit"),
    Named::new("label", Axis::Label, "the id of the part"),
    Named::new("k1", Axis::K1, "the larger principal curvature"),
    Named::new("k2", Axis::K2, "the smaller one"),
    Named::new("mean", Axis::Mean, "the mean curvature"),
    Named::new("gaussian", Axis::Gaussian, "the Gaussian curvature"),
    Named::new("kv", Axis::AlongView, "the curvature along the view"),
];

table! {
    /// A quantity that has more than a name: one of these keys.
    struct AxisOf {
        /// The distance to this point, in world units.
        distance: Option<DVec3> = None,
            key("STF-4", Numbers { what: "a point [x, y, z]", bounds: Bounds::ANY, rule: Rule::Free })
                .absent("another quantity").needs(&[Quantity::Distance]);
        /// The distance to the nearest voxel centre of this label, in world units; 0 inside.
        distance_to_label: Option<LabelKey> = None,
            key("STF-4", Label).absent("another quantity").needs(&[Quantity::LabelDistance]);
        /// The value of this volume at the same place in the world, trilinear, whatever its grid. Outside its box
        /// and beside voxels without a value it counts as the lowest of its values.
        volume: Option<PathBuf> = None,
            key("STF-4", PathTo { what: "a volume" }).absent("another quantity").needs(&[Quantity::FurtherVolume]);
    }
}

impl AxisOf {
    /// The quantity. If there are several keys, the last one counts. A table without a key has no quantity.
    fn axis(self) -> Option<Axis> {
        let distance = || self.distance.map(Axis::Distance);
        let label = || self.distance_to_label.map(Axis::DistanceToLabel);
        self.volume.map(Axis::Volume).or_else(label).or_else(distance)
    }
}

/// The description of the quantities of something: one key of it.
static OF: Table<AxisOf> = Table {
    check: |_, check| {
        let given: Vec<&str> = OF.keys.iter().map(|key| key.name).filter(|name| check.has(name)).collect();
        match given[..] {
            [] => {
                let key = |key: &Key<AxisOf>| format!("{} = {}", key.name, key.field.shape().expected());
                let expected = OF.keys.iter().map(key).collect::<Vec<_>>().join(", or ");
                check.fault_in(OF.keys[0].name, Problem::Missing { expected });
            }
            [_] => {}
            [.., last] => {
                let what = format!("one quantity has both {}", given.join(" and "));
                check.fault_in(last, Problem::Contradiction { what, remedy: "keep one of them".into() });
            }
        }
    },
    ..AxisOf::description(
        "a quantity of something",
        "A quantity of a transfer function that has more than a name: one of these keys.",
    )
};

impl Over {
    /// The axis from row to row, if there are two.
    pub fn second(&self) -> Option<&Axis> {
        match self {
            Self::Value => None,
            Self::Two([_, second]) => Some(second),
        }
    }

    /// Whether there is a row of values for each label.
    pub(crate) fn is_over_labels(&self) -> bool {
        matches!(self, Self::Two([Axis::Value, Axis::Label]))
    }

    /// The quantities, one or two.
    pub fn axes(&self) -> &[Axis] {
        match self {
            Self::Value => const { &[Axis::Value] },
            Self::Two(axes) => axes,
        }
    }
}

impl<L> Axis<L> {
    /// Whether the quantity is an id. There is no value between two ids.
    pub fn is_id(&self) -> bool {
        matches!(self, Self::Label)
    }

    /// Whether it reads the label volume.
    pub fn reads_labels(&self) -> bool {
        matches!(self, Self::Label | Self::DistanceToLabel(_))
    }

    /// Whether it needs κ₁ and κ₂.
    pub fn is_principal(&self) -> bool {
        matches!(self, Self::K1 | Self::K2 | Self::Mean | Self::Gaussian)
    }
}

impl Axis {
    /// Returns the axis with the id of a label in place of its name.
    ///
    /// # Errors
    /// A name that `id_of` does not know.
    pub fn resolved(&self, id_of: impl Fn(&str) -> Option<u32>) -> Result<Axis<u32>, &str> {
        Ok(match self {
            Self::Value => Axis::Value,
            Self::GradientMagnitude => Axis::GradientMagnitude,
            Self::Label => Axis::Label,
            Self::K1 => Axis::K1,
            Self::K2 => Axis::K2,
            Self::Mean => Axis::Mean,
            Self::Gaussian => Axis::Gaussian,
            Self::AlongView => Axis::AlongView,
            Self::Distance(p) => Axis::Distance(*p),
            Self::DistanceToLabel(LabelKey::Id(id)) => Axis::DistanceToLabel(*id),
            Self::DistanceToLabel(LabelKey::Name(name)) => Axis::DistanceToLabel(id_of(name).ok_or(name.as_str())?),
            Self::Volume(path) => Axis::Volume(path.clone()),
        })
    }

    /// Its name, or the key that says what it is of.
    pub fn name(&self) -> &'static str {
        let named = NAMED.iter().find(|named| named.axis == *self).map(|named| named.name);
        named.unwrap_or(match self {
            Self::Distance(_) => "distance",
            Self::DistanceToLabel(_) => "distance_to_label",
            _ => "volume",
        })
    }
}

/// `"value"`, or a list of two quantities.
pub(super) struct OverKind;

/// The two quantities.
const TWO: ListOf<AxisKind> = ListOf { what: "a list of two quantities", most: 2, each: AxisKind };

impl Shape for OverKind {
    fn expected(&self) -> String {
        format!("\"value\", or a list of two quantities, each {}", AxisKind.expected())
    }

    fn schema(&self) -> Json {
        let two = json!({ "type": "array", "items": AxisKind.schema(), "minItems": 2, "maxItems": 2 });
        json!({ "anyOf": [{ "const": "value" }, two] })
    }

    fn item_section(&self) -> Option<Section> {
        TWO.item_section()
    }
}

impl Kind for OverKind {
    type Of = Over;

    fn read(&self, item: &Item, check: &mut Check) -> Option<Over> {
        match item.list() {
            None if item.text() == Some("value") => Some(Over::Value),
            Some(list) if list.len() == 2 => {
                let axes: [Axis; 2] = TWO.read(item, check)?.try_into().ok()?;
                if axes[0] == axes[1] {
                    let what = format!("both quantities are {}", list[1].found());
                    let remedy = "name two different ones, or over = \"value\"".into();
                    check.fault(&item.place, Problem::Contradiction { what, remedy });
                    return None;
                }
                Some(Over::Two(axes))
            }
            _ => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, value: &Over) -> Out {
        match value {
            Over::Value => Out::Text("value".into()),
            Over::Two(axes) => Out::List(axes.iter().map(|axis| AxisKind.write(axis)).collect()),
        }
    }
}

/// One quantity: a name, or a table with the quantity's parameter.
struct AxisKind;

impl Shape for AxisKind {
    fn expected(&self) -> String {
        let names: Vec<String> = NAMED.iter().map(|named| format!("{:?}", named.name)).collect();
        let of: Vec<&str> = OF.keys.iter().map(|key| key.name).collect();
        format!("{}, or a table with one of {}", names.join(", "), of.join(", "))
    }

    fn schema(&self) -> Json {
        let named = NAMED.iter().map(|named| json!({ "const": named.name, "description": named.doc }));
        let all: Vec<Json> = named.chain([TableOf(&OF).schema()]).collect();
        json!({ "anyOf": all })
    }

    fn section(&self) -> Option<Section> {
        Some(OF.section())
    }
}

impl Kind for AxisKind {
    type Of = Axis;

    fn read(&self, item: &Item, check: &mut Check) -> Option<Axis> {
        if let Value::Table(_) = item.value {
            return check.table(&OF, item)?.axis();
        }
        let Some(name) = item.text() else { return check.wrong(item, self.expected()) };
        let known = NAMED.iter().find(|named| named.name == name);
        let nearest = || nearest(name, NAMED.iter().map(|named| named.name)).map(Into::into);
        known.map(|named| named.axis.clone()).or_else(|| check.wrong_name(item, self.expected(), nearest()))
    }

    fn write(&self, value: &Axis) -> Out {
        let of = match value.clone() {
            Axis::Distance(point) => AxisOf { distance: Some(point), ..AxisOf::default() },
            Axis::DistanceToLabel(label) => AxisOf { distance_to_label: Some(label), ..AxisOf::default() },
            Axis::Volume(path) => AxisOf { volume: Some(path), ..AxisOf::default() },
            named => return Out::Text(named.name().into()),
        };
        TableOf(&OF).write(&of)
    }
}

/// A label: its id, or its name.
pub(super) struct Label;

/// The name of a label.
const LABEL_NAME: Text = Text { what: "the name of a label" };

/// The id of a label.
const LABEL_ID: Whole = Whole { lo: 0, hi: u32::MAX as u64 };

impl Shape for Label {
    fn expected(&self) -> String {
        format!("{}, or {}", LABEL_ID.expected(), LABEL_NAME.expected())
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [LABEL_ID.schema(), LABEL_NAME.schema()] })
    }
}

impl Kind for Label {
    type Of = LabelKey;

    fn read(&self, item: &Item, check: &mut Check) -> Option<LabelKey> {
        match item.text() {
            Some(name) if !name.is_empty() => Some(LabelKey::Name(name.to_owned())),
            _ => match LABEL_ID.of(item).and_then(|id| u32::try_from(id).ok()) {
                Some(id) => Some(LabelKey::Id(id)),
                None => check.wrong(item, self.expected()),
            },
        }
    }

    fn write(&self, value: &LabelKey) -> Out {
        match value {
            LabelKey::Id(id) => Out::Whole(u64::from(*id)),
            LabelKey::Name(name) => Out::Text(name.clone()),
        }
    }
}
