//! `[[box]]`: the edges of a bounding box ([VS-8]).

use super::LineStyle;
use crate::document::declare::{choices, table};
use crate::document::describe::Table;
use crate::document::kind::{Bounds, Colors, Flag, Lengths, On, Text};
use crate::tables::PartName;
use crate::tables::object::PartNames;

table! {
    /// One table `[[box]]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct BoxTable {
        /// The part whose box is drawn: "background", the name of an object, or "NAME ghost".
        of: PartName = PartName::Background, key("VS-8", PartNames);
        /// The pictures that show the box.
        show: BoxShown = BoxShown::Always, key("VS-8", BoxShown::KIND);
        /// Whether the volume and meshes before the box hide it.
        occluded: bool = true, key("VS-8", Flag);
        /// The line of the edges.
        line: LineStyle = LineStyle::black(0.25);
        /// Colour of the edges.
        color: key("VS-8", Colors, |b| Some(b.line.color), |b, v| b.line.color = v);
        /// Width of the edges.
        width: key("VS-8", Lengths { on: On::Page, bounds: Bounds::POSITIVE },
            |b| Some(b.line.width), |b, v| b.line.width = v);
        /// The pen of `[[pen]]` that draws the edges.
        pen: key("VS-8", Text { what: "the name of a pen" }, |b| b.line.pen.clone(), |b, v| b.line.pen = Some(v))
            .absent("`color` and `width`");
    }
}

choices! {
    /// The pictures that show a box.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum BoxShown {
        /// All pictures.
        Always = "always",
        /// Only the frames of a viewer while the scene is worked on.
        Draft = "draft",
    }
}

/// The description of a table `[[box]]`.
pub(crate) static TABLE: Table<BoxTable> = BoxTable::description(
    "a box",
    "The edges of a bounding box: that of the volume, or of the members of a selection or its ghost.",
);
