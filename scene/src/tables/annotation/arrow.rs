//! `[[arrow]]`: an arrow from a place to another ([VS-8]).

use super::end::Places;
use super::{AnnotatedPlace, LineStyle};
use crate::document::declare::{choices, table};
use crate::document::describe::Table;
use crate::document::kind::{Bounds, Colors, Flag, Lengths, Number, On, Text};
use crate::tables::Length;

table! {
    /// One table `[[arrow]]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct ArrowTable {
        /// The place where the arrow begins.
        from: Option<AnnotatedPlace> = None, key("VS-8", Places).absent("the ghost of the only object that is moved");
        /// The place that the arrow points to.
        to: Option<AnnotatedPlace> = None, key("VS-8", Places).absent("the selection of the only object that is moved");
        /// β: how far the arrow bends, as a multiple of the way in depth between its ends.
        bend: f64 = 0.5, key("VS-8", Number { bounds: Bounds::NOT_NEGATIVE, unit: "" });
        /// The ends of the arrow at parts.
        ends: ArrowEnds = ArrowEnds::Centre, key("VS-8", ArrowEnds::KIND);
        /// Length of the arrow's head.
        head: Length = Length::Millimetres(4.0), key("VS-8", Lengths { on: On::Page, bounds: Bounds::NOT_NEGATIVE });
        /// Whether the volume and meshes before the arrow hide it.
        occluded: bool = true, key("VS-8", Flag);
        /// The line of the shaft.
        line: LineStyle = LineStyle::black(0.8);
        /// Colour of the arrow.
        color: key("VS-8", Colors, |a| Some(a.line.color), |a, v| a.line.color = v);
        /// Width of the shaft.
        width: key("VS-8", Lengths { on: On::Page, bounds: Bounds::POSITIVE },
            |a| Some(a.line.width), |a, v| a.line.width = v);
        /// The pen of `[[pen]]` that draws the arrow.
        pen: key("VS-8", Text { what: "the name of a pen" }, |a| a.line.pen.clone(), |a, v| a.line.pen = Some(v))
            .absent("`color` and `width`");
    }
}

choices! {
    /// The ends of an arrow at parts.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum ArrowEnds {
        /// The centres of the boxes: the paper's.
        Centre = "centre",
        /// The outlines of the boxes, which the arrow leaves and reaches.
        Box = "box",
    }
}

/// The description of a table `[[arrow]]`.
pub(crate) static TABLE: Table<ArrowTable> = ArrowTable::description(
    "an arrow",
    "A bent arrow from the place that an object was at to the place that it is moved to, or between any two places.",
);
