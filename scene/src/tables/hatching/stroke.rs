//! `[hatching.stroke]`: how a stroke is drawn ([HATCH-13]).

use crate::file::describe::{Key, Slot, Table};
use crate::file::kind::{Bounds, Lengths, Number, On};
use crate::tables::shading::Light;
use crate::tables::{Length, LightDirection};

/// The table `[hatching.stroke]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrokeStyle {
    /// a: width = w_max·τ^a·taper(u); 0: the tone does not show in it.
    pub tone: f64,
    /// b: taper = min(1, u/b, (1 − u)/b); 0: ends are blunt.
    pub taper: f64,
    /// Below it a stroke is cut, on the page.
    pub min_width: Length,
    /// τ = 1 − clamp₀₁(ambient + N·L).
    pub ambient: f64,
    /// Towards the light; none: the scene's.
    pub light: Option<LightDirection>,
}

impl Default for StrokeStyle {
    fn default() -> Self {
        Self { tone: 1.0, taper: 0.15, min_width: Length::Millimetres(0.05), ambient: 0.1, light: None }
    }
}

/// The description of `[hatching.stroke]`.
pub(super) static STROKE: Table<StrokeStyle> = Table::new(
    "[hatching.stroke]",
    "How a stroke is drawn: width · τ^tone · taper(u), τ = 1 − clamp₀₁(ambient + N·L), taper(u) = min(1, u/b, (1 − u)/b) \
     along its length. With a pen, or where the tone is in the spacing, it has one width.",
    StrokeStyle::default,
    &[
        Key::new(
            "tone",
            "HATCH-13",
            "a, how much of the tone is in the width; 0: nothing.",
            &Slot {
                kind: Number { bounds: Bounds::NOT_NEGATIVE, unit: "" },
                get: |s: &StrokeStyle| Some(s.tone),
                set: |s, v| s.tone = v,
            },
        ),
        Key::new(
            "taper",
            "HATCH-13",
            "b, the share of a stroke that each end takes to its full width; 0: blunt ends.",
            &Slot {
                kind: Number { bounds: Bounds::UNIT, unit: "" },
                get: |s: &StrokeStyle| Some(s.taper),
                set: |s, v| s.taper = v,
            },
        ),
        Key::new(
            "min_width",
            "HATCH-13",
            "Where it would be thinner, a stroke is cut.",
            &Slot {
                kind: Lengths { on: On::Page, bounds: Bounds::NOT_NEGATIVE },
                get: |s: &StrokeStyle| Some(s.min_width),
                set: |s, v| s.min_width = v,
            },
        ),
        Key::new(
            "ambient",
            "HATCH-13",
            "Light that falls everywhere.",
            &Slot {
                kind: Number { bounds: Bounds::ANY, unit: "" },
                get: |s: &StrokeStyle| Some(s.ambient),
                set: |s, v| s.ambient = v,
            },
        ),
        Key::new(
            "light",
            "HATCH-13",
            "Towards the light.",
            &Slot { kind: Light, get: |s: &StrokeStyle| s.light, set: |s, v| s.light = Some(v) },
        )
        .absent("the scene's `light`"),
    ],
);
