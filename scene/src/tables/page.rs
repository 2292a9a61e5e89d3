//! `[page]`: the paper that points and lines are drawn on ([IO-7], [STIP-16]).

use crate::document::describe::{Key, Slot, Table};
use crate::document::kind::{Bounds, Flag, Lengths, On};
use crate::tables::Length;

/// The table `[page]`.
#[derive(Clone, Debug, PartialEq)]
pub struct PageSettings {
    /// Around the picture, in mm or px.
    pub margin: Length,
    /// Whether a pen plotter draws it.
    pub plotter: bool,
}

impl Default for PageSettings {
    fn default() -> Self {
        Self { margin: Length::Millimetres(10.0), plotter: false }
    }
}

/// The description of `[page]`.
pub(crate) static TABLE: Table<PageSettings> = Table::new(
    "[page]",
    "The paper of SVG, PDF and lists: the picture with a margin all around.",
    PageSettings::default,
    &[
        Key::new(
            "margin",
            "STIP-16",
            "Around the picture; nothing is drawn there, and dots stand whole beside it or not at all.",
            &Slot {
                kind: Lengths { on: On::Page, bounds: Bounds::NOT_NEGATIVE },
                get: |p: &PageSettings| Some(p.margin),
                set: |p, v| p.margin = v,
            },
        ),
        Key::new(
            "plotter",
            "IO-7",
            "Whether a pen plotter draws it: one nib a layer, paths in the order of a short way.",
            &Slot { kind: Flag, get: |p: &PageSettings| Some(p.plotter), set: |p, v| p.plotter = v },
        ),
    ],
);
