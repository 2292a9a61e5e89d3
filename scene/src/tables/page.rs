//! `[page]`: the paper that points and lines are drawn on ([IO-7], [STIP-16]).

use crate::document::declare::{choices, table};
use crate::document::describe::Table;
use crate::document::kind::{Bounds, Flag, Lengths, On};
use crate::tables::Length;

table! {
    /// The table `[page]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct PageSettings {
        /// Around the picture; nothing is drawn there, and dots stand whole beside it or not at all.
        ///
        /// In mm or px.
        margin: Length = Length::Millimetres(10.0),
            key("STIP-16", Lengths { on: On::Page, bounds: Bounds::NOT_NEGATIVE });
        /// Whether a pen plotter draws it: one nib a layer, paths in the order of a short way.
        plotter: bool = false, key("IO-7", Flag);
        /// The form of text in SVG and PDF.
        text: PageText = PageText::Text, key("VS-10", PageText::KIND);
    }
}

choices! {
    /// The form of text in vector files.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum PageText {
        /// Text that can be searched and selected, in the bundled font.
        Text = "text",
        /// Filled outlines of its letters, which need no font.
        Outlines = "outlines",
    }
}

/// The description of `[page]`.
pub(crate) static TABLE: Table<PageSettings> =
    PageSettings::description("[page]", "The paper of SVG, PDF and lists: the picture with a margin all around.");
