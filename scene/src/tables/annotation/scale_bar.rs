//! `[scale_bar]`: a line of known length in the world.

use super::LineStyle;
use crate::document::declare::{choices, table};
use crate::document::describe::Table;
use crate::document::kind::{Bounds, Colors, Lengths, Number, On, Text};
use crate::tables::Length;

table! {
    /// The table `[scale_bar]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct ScaleBar {
        /// Its length in world units.
        length: Option<f64> = None,
            key("VS-8", Number { bounds: Bounds::POSITIVE, unit: "" })
            .absent("1, 2 or 5 times a power of ten, at most a quarter of the picture's width");
        /// The unit that follows the number in its text.
        unit: String = String::from("mm"), key("VS-8", Text { what: "a unit" });
        /// The corner of the picture that it stands in.
        corner: Corner = Corner::BottomRight, key("VS-8", Corner::KIND);
        /// Size of the text.
        ///
        /// On the page.
        size: Length = Length::Millimetres(3.0), key("VS-8", Lengths { on: On::Page, bounds: Bounds::POSITIVE });
        /// The line.
        line: LineStyle = LineStyle::black(0.6);
        /// Colour of line and text.
        color: key("VS-8", Colors, |b| Some(b.line.color), |b, v| b.line.color = v);
        /// Width of the line.
        width: key("VS-8", Lengths { on: On::Page, bounds: Bounds::POSITIVE },
            |b| Some(b.line.width), |b, v| b.line.width = v);
        /// The pen of `[[pen]]` that draws line and text.
        pen: key("VS-8", Text { what: "the name of a pen" }, |b| b.line.pen.clone(), |b, v| b.line.pen = Some(v))
            .absent("`color` and `width`");
    }
}

choices! {
    /// A corner of the picture.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Corner {
        /// Top left.
        TopLeft = "top-left",
        /// Top right.
        TopRight = "top-right",
        /// Bottom left.
        BottomLeft = "bottom-left",
        /// Bottom right.
        BottomRight = "bottom-right",
    }
}

/// The description of `[scale_bar]`.
pub(crate) static TABLE: Table<ScaleBar> = ScaleBar::description(
    "[scale_bar]",
    "A line of known length in the world. It is true everywhere in orthographic views. In perspective it is true at the \
     depth of the camera's target, and its text says so.",
);
