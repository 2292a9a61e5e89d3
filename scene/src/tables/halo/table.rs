//! The description of `[[halo]]`.

use super::profile::Profile;
use super::{ProfileNode, Seeding, Spreading, seed, spread};
use crate::document::check::Check;
use crate::document::declare::{choices, table, unless_empty};
use crate::document::describe::{Kind, Shape, Table};
use crate::document::item::Item;
use crate::document::kind::{Bounds, FEW, ListOf, Number, Numbers, Rule, TableOf, Text, Whole};
use crate::document::out::Out;
use crate::quantity::Quantity;
use crate::tables::object::{PartName, PartNames};
use serde_json::{Value as Json, json};

table! {
    /// One table `[[halo]]`. The default is a dark rim before what lies behind; it has no name yet.
    ///
    /// `kind` is read before `accumulate`, whose default it decides.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Halo {
        /// Name by which `tints` calls a halo.
        name: String = String::new(), key("HALO-1", Text { what: "the name of a halo" },
            |h| (!h.name.is_empty()).then(|| h.name.clone())).absent("\"halo N\", N its place in the list, from 0");
        /// The way it enters the picture.
        kind: HaloKind = HaloKind::Occlusive, key("HALO-7", HaloKind::KIND,
            |h| Some(h.kind),
            |h, v| (h.kind, h.accumulate) = (v, v.accumulation()));
        /// Which samples seed it, and how strong ones.
        seed: Seeding = Seeding::default(), key("HALO-2", TableOf(&seed::TABLE));
        /// a and b of |g|^a · (1 − |n·v|)^b: how much a seed depends on the strength of a boundary, and how much on the
        /// angle that it is seen at.
        exponents: Exponents = Exponents::Contour,
            key("HALO-3", ExponentsKind).needs(&[Quantity::GradientMagnitudeRange]);
        /// The part whose samples seed it: "background", the name of an object, or "NAME ghost".
        object: Option<PartName> = None, key("VS-2", PartNames).absent("all parts");
        /// From the seeds of a plane to the halo's intensities on it.
        spread: Spreading = Spreading::default(), key("HALO-5", TableOf(&spread::TABLE));
        /// Colours and opacities over the intensity, in non-decreasing order of `at`, linear between them and constant
        /// beyond both ends. Intensity 0 is always transparent.
        ///
        /// At least one node.
        profile: Vec<ProfileNode> = vec![
            ProfileNode { at: 0.2, rgb: [0.0; 3], opacity: 0.0 },
            ProfileNode { at: 0.6, rgb: [0.0; 3], opacity: 0.8 },
        ], key("HALO-6", Profile);
        /// Factor of the profile's opacities.
        opacity: f64 = 1.0, key("HALO-6", UNIT);
        /// Seeds and intensities below it are 0.
        floor: f64 = 1.0 / 255.0, key("HALO-6", UNIT);
        /// M, the planes of a group: its seeds are spread once. 1 is the truth, more are faster.
        every: u64 = 1, key("HALO-8", Whole { lo: 1, hi: 1024 });
        /// How the seeds of a group's planes come together; of emissive halos the default is "mean".
        accumulate: HaloAccumulation = HaloKind::Occlusive.accumulation(), key("HALO-8", HaloAccumulation::KIND);
        /// Names of emissive halos that this occlusive one tints.
        tints: Vec<String> = Vec::new(),
            key("HALO-7", ListOf { what: "a list of names", most: FEW, each: Text { what: "the name of a halo" } },
                |h| unless_empty(&h.tints)).absent("none");
    }
}

choices! {
    /// The way a halo enters the picture ([HALO-7]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
    pub enum HaloKind {
        /// A light or dark fog of its own, before what lies behind.
        Emissive = "emissive",
        /// A tint of what lies behind, seen only there.
        Occlusive = "occlusive",
    }
}

choices! {
    /// How seeds of several planes come together ([HALO-8]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
    pub enum HaloAccumulation {
        /// The largest: keeps shapes.
        Max = "max",
        /// Their mean: keeps the opacity of an emissive halo.
        Mean = "mean",
    }
}

/// a and b of |g|^a · (1 − |n·v|)^b ([HALO-3]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Exponents {
    /// (0.125, 32): the sides of things.
    Contour,
    /// (32, 0.125), as the paper prints them.
    Printed,
    /// Two numbers.
    Numbers([f64; 2]),
}

impl Exponents {
    /// a and b.
    pub fn numbers(self) -> [f64; 2] {
        match self {
            Self::Contour => [0.125, 32.0],
            Self::Printed => [32.0, 0.125],
            Self::Numbers(numbers) => numbers,
        }
    }
}

impl HaloKind {
    /// Returns the default of `accumulate` for this kind.
    pub fn accumulation(self) -> HaloAccumulation {
        match self {
            Self::Emissive => HaloAccumulation::Mean,
            Self::Occlusive => HaloAccumulation::Max,
        }
    }
}

impl Halo {
    /// Whether samples of a part seed it.
    pub(crate) fn takes(&self, part: &PartName) -> bool {
        self.object.as_ref().is_none_or(|own| own == part)
    }

    /// Returns the halo with a name. A halo without a name gets one from its place in the list.
    pub(crate) fn named(self, place: usize) -> Self {
        if self.name.is_empty() { Self { name: format!("halo {place}"), ..self } } else { self }
    }
}

/// A number from 0 to 1.
const UNIT: Number = Number { bounds: Bounds::UNIT, unit: "" };

/// The description of a halo.
pub(crate) static TABLE: Table<Halo> = Halo::description(
    "a halo",
    "A volumetric halo: a fog around the sides of things, or a tint of what lies behind them.",
);

/// `"contour"`, `"printed"`, or two numbers.
struct ExponentsKind;

/// The exponents that have a name.
const NAMED: [(&str, Exponents, &str); 2] = [
    ("contour", Exponents::Contour, "[0.125, 32]"),
    ("printed", Exponents::Printed, "[32, 0.125], as printed in the paper"),
];

/// a and b.
const TWO: Numbers<2> = Numbers { what: "two numbers [a, b]", bounds: Bounds::NOT_NEGATIVE, rule: Rule::Free };

impl Shape for ExponentsKind {
    fn expected(&self) -> String {
        format!("\"contour\", \"printed\", or {}", TWO.expected())
    }

    fn schema(&self) -> Json {
        let named = NAMED.map(|(name, _, doc)| json!({ "const": name, "description": doc }));
        let all: Vec<Json> = named.into_iter().chain([TWO.schema()]).collect();
        json!({ "anyOf": all })
    }
}

impl Kind for ExponentsKind {
    type Of = Exponents;

    fn read(&self, item: &Item, check: &mut Check) -> Option<Exponents> {
        let Some(name) = item.text() else {
            return TWO.of(item).map(Exponents::Numbers).or_else(|| check.wrong(item, self.expected()));
        };
        let named = NAMED.iter().find(|(known, ..)| *known == name).map(|(_, exponents, _)| *exponents);
        let nearest = || crate::nearest::nearest(name, NAMED.iter().map(|(known, ..)| *known)).map(Into::into);
        named.or_else(|| check.wrong_name(item, self.expected(), nearest()))
    }

    fn write(&self, value: &Exponents) -> Out {
        match value {
            Exponents::Numbers(numbers) => TWO.write(numbers),
            named => Out::Text(NAMED.iter().find(|(_, e, _)| e == named).map_or("", |(name, ..)| name).into()),
        }
    }
}
