//! `[[fan]]`: two outlines that are joined, for a detail beside its place ([VS-8]).

use super::end::Places;
use super::{AnnotatedPlace, LineStyle};
use crate::color::Rgba;
use crate::document::declare::{choices, table};
use crate::document::describe::Table;
use crate::document::kind::{Bounds, Colors, Lengths, On, Text};

table! {
    /// One table `[[fan]]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct FanTable {
        /// The part at one end.
        from: Option<AnnotatedPlace> = None, key("VS-8", Places).absent("the ghost of the only object that is moved");
        /// The part at the other end.
        to: Option<AnnotatedPlace> = None, key("VS-8", Places).absent("the selection of the only object that is moved");
        /// The outlines at both ends.
        shape: FanShape = FanShape::Rectangle, key("VS-8", FanShape::KIND);
        /// Colour of the area between the outlines.
        ///
        /// Linear, straight.
        fill: Rgba = [0.0, 0.0, 0.0, 26.0 / 255.0], key("VS-8", Colors);
        /// The line of the outlines.
        line: LineStyle = LineStyle::black(0.25);
        /// Colour of the outlines.
        color: key("VS-8", Colors, |f| Some(f.line.color), |f, v| f.line.color = v);
        /// Width of the outlines.
        width: key("VS-8", Lengths { on: On::Page, bounds: Bounds::POSITIVE },
            |f| Some(f.line.width), |f, v| f.line.width = v);
        /// The pen of `[[pen]]` that draws the outlines.
        pen: key("VS-8", Text { what: "the name of a pen" }, |f| f.line.pen.clone(), |f, v| f.line.pen = Some(v))
            .absent("`color` and `width`");
    }
}

choices! {
    /// The outlines at the ends of a fan.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum FanShape {
        /// The rectangles around the boxes on the page.
        Rectangle = "rectangle",
        /// The circles around these rectangles.
        Circle = "circle",
    }
}

/// The description of a table `[[fan]]`.
pub(crate) static TABLE: Table<FanTable> = FanTable::description(
    "a fan",
    "The outlines of a part's place and of its enlarged or moved copy, with the lines that join them. It lies over the \
     picture.",
);
