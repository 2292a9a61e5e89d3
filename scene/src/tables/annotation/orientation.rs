//! `[orientation]`: letters of directions at the edges of the picture, and a triad of axes.

use super::{Corner, LineStyle};
use crate::document::declare::table;
use crate::document::describe::Table;
use crate::document::kind::{Bounds, Colors, Flag, Lengths, On, Text};
use crate::tables::Length;

table! {
    /// The table `[orientation]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Orientation {
        /// Whether letters at the edges tell the directions: R, L, A, P, S, I where the data are anatomical, else x, y, z.
        letters: bool = true, key("VS-8", Flag);
        /// Whether a triad of axes is drawn.
        triad: bool = false, key("VS-8", Flag);
        /// The corner of the picture that the triad stands in.
        corner: Corner = Corner::BottomLeft, key("VS-8", Corner::KIND);
        /// Size of the letters; an axis of the triad is three times as long.
        ///
        /// On the page.
        size: Length = Length::Millimetres(4.0), key("VS-8", Lengths { on: On::Page, bounds: Bounds::POSITIVE });
        /// The lines of the triad.
        line: LineStyle = LineStyle::black(0.4);
        /// Colour of letters and triad.
        color: key("VS-8", Colors, |o| Some(o.line.color), |o, v| o.line.color = v);
        /// Width of the triad's lines.
        width: key("VS-8", Lengths { on: On::Page, bounds: Bounds::POSITIVE },
            |o| Some(o.line.width), |o, v| o.line.width = v);
        /// The pen of `[[pen]]` that draws letters and triad.
        pen: key("VS-8", Text { what: "the name of a pen" }, |o| o.line.pen.clone(), |o, v| o.line.pen = Some(v))
            .absent("`color` and `width`");
    }
}

/// The description of `[orientation]`.
pub(crate) static TABLE: Table<Orientation> = Orientation::description(
    "[orientation]",
    "The directions of the data: letters at the edges of the picture, and a triad of axes.",
);
