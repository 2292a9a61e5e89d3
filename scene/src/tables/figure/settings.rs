//! `[figure]`: the arrangement of panels, and the text around them.

use crate::color::Rgba;
use crate::document::declare::{choices, table};
use crate::document::describe::Table;
use crate::document::kind::{Bounds, Colors, FEW, Lengths, Number, On, Text, Whole};
use crate::tables::Length;

table! {
    /// The table `[figure]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct FigureSettings {
        /// Pixels per inch, which turns mm into pixels.
        dpi: f64 = 300.0, key("IO-7", Number { bounds: Bounds::POSITIVE, unit: "" });
        /// Width of the figure, without the margin of `[page]`. The height follows from the panels.
        ///
        /// On the page.
        width: Length = Length::Millimetres(180.0), key("IO-7", WIDTH);
        /// Panels in a row.
        columns: usize = 2, key("IO-7", Whole { lo: 1, hi: FEW as u64 });
        /// Space between panels.
        ///
        /// On the page.
        gap: Length = Length::Millimetres(4.0), key("IO-7", SPACE);
        /// Letters of panels.
        letters: PanelLetters = PanelLetters::Parentheses, key("IO-7", PanelLetters::KIND);
        /// The camera of each panel.
        camera: PanelCameras = PanelCameras::Own, key("RAY-5", PanelCameras::KIND);
        /// A line above the panels.
        title: Option<String> = None, key("IO-7", Text { what: "a title" }).absent("none");
        /// Text below the panels, in lines as wide as the figure.
        caption: Option<String> = None, key("IO-7", Text { what: "a caption" }).absent("none");
        /// Size of the text. That of the title is 1.4 times as large.
        ///
        /// On the page.
        size: Length = Length::Millimetres(3.2), key("VS-10", WIDTH);
        /// Colour of the text, and of the frames of insets.
        color: Rgba = [0.0, 0.0, 0.0, 1.0], key("IO-7", Colors);
        /// Colour of the page.
        background: Rgba = [1.0; 4], key("IO-6", Colors);
    }
}

const WIDTH: Lengths = Lengths { on: On::Page, bounds: Bounds::POSITIVE };
const SPACE: Lengths = Lengths { on: On::Page, bounds: Bounds::NOT_NEGATIVE };

choices! {
    /// The letters of panels.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum PanelLetters {
        /// (a), (b), (c).
        Parentheses = "(a)",
        /// a, b, c.
        Small = "a",
        /// A, B, C.
        Capital = "A",
        /// None.
        None = "none",
    }
}

choices! {
    /// The cameras of panels.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum PanelCameras {
        /// Each panel has that of its scene.
        Own = "own",
        /// All panels have that of the first one.
        Shared = "shared",
    }
}

impl PanelLetters {
    /// The letter of a panel, counted from 0: after z comes aa. None without letters.
    pub fn letter(self, panel: usize) -> Option<String> {
        let mut letters = String::new();
        let mut rest = panel + 1;
        while rest > 0 {
            rest -= 1;
            letters.insert(0, char::from(b'a' + (rest % 26) as u8));
            rest /= 26;
        }
        match self {
            Self::Parentheses => Some(format!("({letters})")),
            Self::Small => Some(letters),
            Self::Capital => Some(letters.to_ascii_uppercase()),
            Self::None => None,
        }
    }
}

/// The description of `[figure]`.
pub(crate) static TABLE: Table<FigureSettings> =
    FigureSettings::description("[figure]", "The arrangement of panels, and the text around them.");

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters_go_on_after_z() {
        let letter = |n| PanelLetters::Small.letter(n).unwrap();
        assert_eq!([0, 25, 26, 51, 52, 701, 702].map(letter), ["a", "z", "aa", "az", "ba", "zz", "aaa"]);
        assert_eq!(PanelLetters::Parentheses.letter(1).as_deref(), Some("(b)"));
        assert_eq!((PanelLetters::Capital.letter(2).as_deref(), PanelLetters::None.letter(0)), (Some("C"), None));
    }
}
