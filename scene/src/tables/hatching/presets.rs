//! The presets of hatching ([HATCH-17]).

use super::{Hatching, SeedsBy, Spacing, StrokeStyle};
use crate::tables::{Length, Outlines};

/// A preset that supplies `[hatching]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HatchPreset {
    /// A first picture, for a pen.
    Plain,
    /// Fig. 6, left: seeds by curvature, crossed in the dark.
    Fig6Left,
    /// Fig. 6, right: a stroke in every cell.
    Fig6Right,
}

impl HatchPreset {
    /// The outlines around it.
    pub(crate) fn outlines(self) -> Option<Outlines> {
        (self == Self::Plain).then(Outlines::default)
    }

    /// The table. The paper gives no numbers but those of the defaults.
    pub(crate) fn table(self) -> Hatching {
        // As thin as a pixel of the paper's pictures.
        let stroke = StrokeStyle { min_width: Length::Millimetres(0.02), ..StrokeStyle::default() };
        let fine = Hatching { width: Length::Millimetres(0.1), stroke, ..Hatching::default() };
        match self {
            Self::Plain => {
                Hatching { seeds: SeedsBy::Dense, cross: Some(60.0), spacing: Spacing::Tone, ..Hatching::default() }
            }
            Self::Fig6Left => Hatching { cross: Some(60.0), ..fine },
            Self::Fig6Right => Hatching {
                seeds: SeedsBy::Dense,
                length: Length::Voxels(10.0),
                stroke: StrokeStyle { tone: 2.0, ..stroke },
                ..fine
            },
        }
    }
}
