//! `seed` of a halo: which samples seed it ([HALO-2], [HALO-3]).

use super::HaloFocus;
use super::focus;
use crate::document::check::Check;
use crate::document::declare::{choices, table};
use crate::document::describe::{Kind, Shape, Table};
use crate::document::item::Item;
use crate::document::kind::{Bounds, Lengths, ListOf, MANY, Number, On, TableOf};
use crate::document::out::Out;
use crate::quantity::Quantity;
use crate::tables::over::Label;
use crate::tables::unit_pairs::UnitPairs;
use crate::tables::{LabelKey, Length};
use serde::{Deserialize, Serialize};
use serde_json::{Value as Json, json};

table! {
    /// The table `seed`: h = h_v·h_d·h_p·h_l, and the factor that is large at the sides of things.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Seeding {
        /// h_v: a number from 0 to 1 for each value, linear between them and constant beyond both ends; or the opacity of
        /// [transfer].
        value: Option<SeedValue> = None,
            key("HALO-2", SeedValues).absent("1 beside one of the three below, else \"opacity\"")
                .needs(OF_OPACITY);
        /// h_d: seeds of surfaces that face a direction of the picture.
        direction: Option<SeedDirection> = None, key("HALO-2", TableOf(&DIRECTION)).absent("1");
        /// h_p: seeds near a point or a polyline.
        focus: Option<HaloFocus> = None, key("HALO-2", TableOf(&focus::TABLE)).absent("1");
        /// h_l: seeds of these parts alone, each the id of a label or a name of `volume.label_names`.
        labels: Option<Vec<LabelKey>> = None,
            key("HALO-2", ListOf { what: "a list of labels", most: MANY, each: Label }).absent("1").needs(&[Quantity::Label]);
        /// The factor that is large where a surface is seen from the side.
        by: SeedBy = SeedBy::Power, key("HALO-3", SeedBy::KIND).needs(&[Quantity::PreviousNormal, Quantity::Hessian]);
        /// T of by = "curvature": how deep the band of seeds is, as `contours.thickness`.
        thickness: Length = Length::Voxels(1.0),
            key("HALO-3", Lengths { on: On::World, bounds: Bounds::NOT_NEGATIVE });
    }
}

/// Needs of the quantities of a function whose opacity seeds.
const OF_OPACITY: &[Quantity] = &[
    Quantity::Gradient,
    Quantity::PreviousNormal,
    Quantity::Hessian,
    Quantity::GradientMagnitudeRange,
    Quantity::Label,
    Quantity::Distance,
    Quantity::LabelDistance,
    Quantity::FurtherVolume,
];

/// h_v.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SeedValue {
    /// α_u of the object's transfer function.
    Opacity,
    /// Pairs of a value and h_v, linear between them, constant beyond both ends; in non-decreasing order of the value.
    Nodes(Vec<[f64; 2]>),
}

table! {
    /// h_d: the angle θ between N in the picture and up, in degrees, 0 up and 90 right.
    #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
    pub struct SeedDirection {
        /// The middle of the range: 0 is up in the picture, 90 to the right.
        toward: f64 = 0.0, key("HALO-2", Number { bounds: Bounds::ANY, unit: ", in degrees" });
        /// The width of the range in which h_d = 1; from 360 on every direction lies in it.
        width: f64 = 60.0, key("HALO-2", ANGLE);
        /// The width of the fall to 0 on each side of it; 0 is a step.
        softness: f64 = 20.0, key("HALO-2", ANGLE);
    }
}

/// A width of angles.
const ANGLE: Number = Number { bounds: Bounds::NOT_NEGATIVE, unit: ", in degrees" };

/// The description of `seed.direction`.
static DIRECTION: Table<SeedDirection> = SeedDirection::description(
    "seed.direction of a halo",
    "Seeds of surfaces whose outward normal points in a direction of the picture.",
);

choices! {
    /// The factor of a seed that is large where a surface is seen from the side ([HALO-3]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum SeedBy {
        /// A power of 1 − |n·v|: the paper's. Thin tubes are missed by large exponents.
        Power = "power",
        /// Linear in |n·v|, in a band of the depth `thickness` whatever the curvature.
        Curvature = "curvature",
    }
}

impl Seeding {
    /// Whether the transfer function's opacity seeds the halo: as the scene says, or because it has none of the four
    /// factors.
    pub fn is_by_opacity(&self) -> bool {
        match &self.value {
            Some(value) => *value == SeedValue::Opacity,
            None => self.direction.is_none() && self.focus.is_none() && self.labels.is_none(),
        }
    }

    /// Puts ids in place of the names of labels.
    ///
    /// # Errors
    /// Each name that `id_of` does not know, with its place in the list.
    pub fn resolve_labels(&mut self, id_of: impl Fn(&str) -> Option<u32>) -> Result<(), Vec<(usize, String)>> {
        let mut unknown = Vec::new();
        for (i, label) in self.labels.iter_mut().flatten().enumerate() {
            let LabelKey::Name(name) = label else { continue };
            match id_of(name) {
                Some(id) => *label = LabelKey::Id(id),
                None => unknown.push((i, name.clone())),
            }
        }
        if unknown.is_empty() { Ok(()) } else { Err(unknown) }
    }
}

/// The description of `seed`.
pub(super) static TABLE: Table<Seeding> = Seeding::description(
    "seed of a halo",
    "Which samples seed a halo, and how strong ones: the product of up to four factors. With none of the four it is the \
     opacity of [transfer].",
);

/// `"opacity"`, or a list of pairs.
struct SeedValues;

impl Shape for SeedValues {
    fn expected(&self) -> String {
        format!("\"opacity\", or {}", UnitPairs.expected())
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [{ "const": "opacity" }, UnitPairs.schema()] })
    }
}

impl Kind for SeedValues {
    type Of = SeedValue;

    fn read(&self, item: &Item, check: &mut Check) -> Option<SeedValue> {
        if item.list().is_none_or(<[_]>::is_empty) {
            let opacity = (item.text() == Some("opacity")).then_some(SeedValue::Opacity);
            return opacity.or_else(|| check.wrong(item, self.expected()));
        }
        UnitPairs.read(item, check).map(SeedValue::Nodes)
    }

    fn write(&self, value: &SeedValue) -> Out {
        match value {
            SeedValue::Opacity => Out::Text("opacity".into()),
            SeedValue::Nodes(nodes) => UnitPairs.write(nodes),
        }
    }
}
