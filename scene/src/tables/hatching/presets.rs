//! The presets of hatching ([HATCH-17]).

use super::{Hatching, Hidden, LineLighting, SeedsBy, Spacing, StrokeStyle};
use crate::color::opaque;
use crate::tables::{Length, LightDirection, Outlines, Shading, Surface, SurfaceLook};
use glam::DVec3;

/// A preset that supplies `[hatching]`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HatchPreset {
    /// A first picture, for a pen.
    Plain,
    /// Fig. 4: lit strokes over a Phong surface.
    Fig4,
    /// Fig. 5: lit strokes alone, from both sides.
    Fig5,
    /// Fig. 6, left: seeds by curvature, crossed in the dark.
    Fig6Left,
    /// Fig. 6, right: a stroke in every cell.
    Fig6Right,
}

impl HatchPreset {
    /// The outlines around it.
    pub(crate) fn outlines(self) -> Option<Outlines> {
        (self == Self::Plain).then(Outlines::for_print)
    }

    /// The surface under it, with its shading.
    pub(crate) fn surface(self) -> Option<(Surface, Shading)> {
        let surface = Surface { look: SurfaceLook::Phong, color: opaque([228.0, 220.0, 203.0]), ..Surface::default() };
        let shading = Shading { light: Some(upper_left()), ..Shading::default() };
        (self == Self::Fig4).then_some((surface, shading))
    }

    /// The table. The paper gives no numbers but those of the defaults.
    pub(crate) fn table(self) -> Hatching {
        // As thin as a pixel of the paper's pictures.
        let stroke = StrokeStyle { min_width: Length::Millimetres(0.02), ..StrokeStyle::default() };
        let fine = Hatching { width: Length::Millimetres(0.1), stroke, ..Hatching::default() };
        // The tone is in their colour.
        let even = StrokeStyle { tone: Some(0.0), ..stroke };
        // Seen on a white page.
        let bright = LineLighting {
            diffuse: 1.0,
            front: opaque([48.0, 96.0, 224.0]),
            back: opaque([216.0, 168.0, 24.0]),
            ..LineLighting::default()
        };
        match self {
            Self::Plain => {
                Hatching { seeds: SeedsBy::Dense, cross: Some(60.0), spacing: Spacing::Tone, ..Hatching::default() }
            }
            Self::Fig4 => {
                Hatching { lighting: Some(bright), stroke: StrokeStyle { light: Some(upper_left()), ..even }, ..fine }
            }
            Self::Fig5 => Hatching {
                hidden: Hidden::Drawn,
                lighting: Some(bright),
                stroke: StrokeStyle { light: Some(upper_left()), ..even },
                ..fine
            },
            Self::Fig6Left => Hatching { cross: Some(60.0), ..fine },
            Self::Fig6Right => Hatching {
                seeds: SeedsBy::Dense,
                length: Length::Voxels(10.0),
                stroke: StrokeStyle { tone: Some(2.0), ..stroke },
                ..fine
            },
        }
    }
}

/// Light from over the left shoulder, in eye space.
fn upper_left() -> LightDirection {
    LightDirection::Eye(DVec3::new(-1.0, 1.5, 0.8))
}
