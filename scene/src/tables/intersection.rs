//! `[[intersection]]`: the look of a place where a selection meets its ghost or the background ([VS-4]).

use super::dab::{DABS, Dab};
use crate::document::check::Check;
use crate::document::declare::{choices, table, unless_empty};
use crate::document::describe::{Kind, Shape, Table};
use crate::document::item::Item;
use crate::document::kind::{Colors, Flag, PathTo, Text};
use crate::document::out::Out;
use serde_json::{Value as Json, json};
use std::path::PathBuf;

table! {
    /// One table `[[intersection]]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct IntersectionTable {
        /// Name of the object whose selection meets something.
        object: String = String::new(), key("VS-4", Text { what: "the name of an object" }).required();
        /// The other side: the object's own ghost, or the background.
        with: Opposite = Opposite::Ghost, key("VS-4", Opposite::KIND);
        /// Colour of the intersection: the mean of both by their opacities, a colour, or a picture over both values. An
        /// opacity in the colour multiplies.
        color: IntersectionColor = IntersectionColor::Mean, key("VS-4", ColorKind);
        /// Opacity of the intersection, made of a, the selection's, and b, the other's.
        opacity: IntersectionOpacity = IntersectionOpacity::Max, key("VS-4", IntersectionOpacity::KIND);
        /// Whether a and b are exchanged.
        swap: bool = false, key("VS-4", Flag);
        /// Dabs of a Gaussian brush on the function of both values, in their order. Each lies over the colour and opacity, and
        /// over earlier dabs.
        dabs: Vec<Dab> = Vec::new(),
            key("VS-4", DABS, |t| unless_empty(&t.dabs)).absent("none");
    }
}

choices! {
    /// The thing that a selection meets ([VS-4]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Opposite {
        /// The ghost of the object itself.
        Ghost = "ghost",
        /// The background of `[volume]`.
        Background = "background",
    }
}

choices! {
    /// The opacity of an intersection ([VS-4]), by the operators of Porter and Duff.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
    pub enum IntersectionOpacity {
        /// max(a, b).
        Max = "max",
        /// a + b − ab.
        Over = "over",
        /// ab.
        In = "in",
        /// a(1 − b).
        Out = "out",
        /// b.
        Atop = "atop",
        /// a + b − 2ab.
        Xor = "xor",
        /// min(1, a + b).
        Plus = "plus",
    }
}

impl IntersectionTable {
    /// The file of the picture, if the colour is one.
    pub(crate) fn picture(&self) -> Option<&PathBuf> {
        if let IntersectionColor::Picture(path) = &self.color { Some(path) } else { None }
    }
}

/// The colour of an intersection.
#[derive(Clone, Debug, PartialEq)]
pub enum IntersectionColor {
    /// (α₁c₁ + α₂c₂)/(α₁ + α₂).
    Mean,
    /// One colour, linear and straight; its opacity multiplies.
    Color([f64; 4]),
    /// A picture over the value at p, from left to right, and the value at T p, from bottom to top.
    Picture(PathBuf),
}

/// The description of a table `[[intersection]]`.
pub(crate) static TABLE: Table<IntersectionTable> = IntersectionTable::description(
    "an intersection",
    "The look of places where an object's selection meets its own ghost, or the background. Without such a table both \
     show, each by its share.",
);

/// `"mean"`, a colour, or a picture's path.
struct ColorKind;

const PICTURE: PathTo = PathTo { what: "a picture" };

impl Shape for ColorKind {
    fn expected(&self) -> String {
        format!("\"mean\", {}, or {}", Colors.expected(), PICTURE.expected())
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [{ "const": "mean" }, Colors.schema(), PICTURE.schema()] })
    }
}

impl Kind for ColorKind {
    type Of = IntersectionColor;

    fn read(&self, item: &Item, check: &mut Check) -> Option<IntersectionColor> {
        match item.text() {
            Some("mean") => Some(IntersectionColor::Mean),
            // No name of a colour has a dot in it, and every picture's has.
            Some(text) if text.contains('.') => PICTURE.read(item, check).map(IntersectionColor::Picture),
            _ => Colors.read(item, check).map(IntersectionColor::Color),
        }
    }

    fn write(&self, value: &IntersectionColor) -> Out {
        match value {
            IntersectionColor::Mean => Out::Text("mean".into()),
            IntersectionColor::Color(color) => Colors.write(color),
            IntersectionColor::Picture(path) => PICTURE.write(path),
        }
    }
}
