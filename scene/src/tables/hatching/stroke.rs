//! `[hatching.stroke]`: how a stroke is drawn ([HATCH-13]).

use crate::document::check::Check;
use crate::document::describe::{Key, Kind, Shape, Slot, Table};
use crate::document::item::Item;
use crate::document::kind::{Bounds, Lengths, Number, On};
use crate::document::out::Out;
use crate::tables::shading::Light;
use crate::tables::{Length, LightDirection};
use serde_json::{Value as Json, json};

/// The table `[hatching.stroke]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StrokeStyle {
    /// a: width = w_max·τ^a·taper(u); 0: the tone does not show in it; none: the style's.
    pub tone: Option<f64>,
    /// b: taper = min(1, u/b, (1 − u)/b); 0: ends are blunt; none: the style's.
    pub taper: Option<f64>,
    /// Below it a stroke is cut, on the page.
    pub min_width: Length,
    /// τ = 1 − clamp₀₁(ambient + N·L).
    pub ambient: f64,
    /// Towards the light; none: the scene's.
    pub light: Option<LightDirection>,
    /// Drawn and left out in turn, on the page; none: solid.
    pub dash: Option<[Length; 2]>,
    /// The share of width and length that strokes have more or less, at random.
    pub jitter: f64,
    /// The share by which the farthest strokes are thinner than the nearest.
    pub depth: f64,
}

impl Default for StrokeStyle {
    fn default() -> Self {
        Self {
            tone: None,
            taper: None,
            min_width: Length::Millimetres(0.05),
            ambient: 0.1,
            light: None,
            dash: None,
            jitter: 0.0,
            depth: 0.0,
        }
    }
}

const SHARE: Number = Number { bounds: Bounds::UNIT, unit: "" };
const DASH: Lengths = Lengths { on: On::Page, bounds: Bounds::POSITIVE };

/// `[on, off]`.
struct DashKind;

impl Shape for DashKind {
    fn expected(&self) -> String {
        format!("[on, off], each {}", DASH.expected())
    }

    fn schema(&self) -> Json {
        json!({ "type": "array", "items": DASH.schema(), "minItems": 2, "maxItems": 2 })
    }
}

impl Kind for DashKind {
    type Of = [Length; 2];

    fn read(&self, item: &Item, check: &mut Check) -> Option<[Length; 2]> {
        match item.list() {
            Some([on, off]) => {
                let (on, off) = (DASH.read(on, check), DASH.read(off, check));
                on.zip(off).map(|(on, off)| [on, off])
            }
            _ => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, [on, off]: &[Length; 2]) -> Out {
        Out::List(vec![DASH.write(on), DASH.write(off)])
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
                get: |s: &StrokeStyle| s.tone,
                set: |s, v| s.tone = Some(v),
            },
        )
        .absent("1; of pencil 0"),
        Key::new(
            "taper",
            "HATCH-13",
            "b, the share of a stroke that each end takes to its full width; 0: blunt ends.",
            &Slot {
                kind: Number { bounds: Bounds::UNIT, unit: "" },
                get: |s: &StrokeStyle| s.taper,
                set: |s, v| s.taper = Some(v),
            },
        )
        .absent("0.15; of engraving 0"),
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
        Key::new(
            "dash",
            "HATCH-13",
            "[on, off]: what is drawn and what is left out in turn, from where a line begins on the page.",
            &Slot { kind: DashKind, get: |s: &StrokeStyle| s.dash, set: |s, v| s.dash = Some(v) },
        )
        .absent("solid"),
        Key::new(
            "jitter",
            "HATCH-13",
            "The share of width and length that strokes have more or less, at random.",
            &Slot { kind: SHARE, get: |s: &StrokeStyle| Some(s.jitter), set: |s, v| s.jitter = v },
        ),
        Key::new(
            "depth",
            "HATCH-13",
            "The share by which strokes at the farthest corner of the volume are thinner than at the nearest.",
            &Slot { kind: SHARE, get: |s: &StrokeStyle| Some(s.depth), set: |s, v| s.depth = v },
        ),
    ],
);
