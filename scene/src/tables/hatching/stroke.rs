//! `[hatching.stroke]`: how a stroke is drawn ([HATCH-13]).

use crate::document::check::Check;
use crate::document::declare::table;
use crate::document::describe::{Kind, Shape, Table};
use crate::document::item::Item;
use crate::document::kind::{Bounds, Lengths, Number, On};
use crate::document::out::Out;
use crate::tables::shading::Light;
use crate::tables::{Length, LightDirection};
use serde_json::{Value as Json, json};

table! {
    /// The table `[hatching.stroke]`.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct StrokeStyle {
        /// a, how much of the tone is in the width; 0: nothing.
        ///
        /// The width is w_max·τ^a·taper(u).
        tone: Option<f64> = None,
            key("HATCH-13", Number { bounds: Bounds::NOT_NEGATIVE, unit: "" }).absent("1; of pencil 0");
        /// b, the share of a stroke that each end takes to its full width; 0: blunt ends.
        ///
        /// taper(u) = min(1, u/b, (1 − u)/b).
        taper: Option<f64> = None,
            key("HATCH-13", Number { bounds: Bounds::UNIT, unit: "" }).absent("0.15; of engraving 0");
        /// Smallest width: where it would be thinner, a stroke is cut.
        ///
        /// In mm or px.
        min_width: Length = Length::Millimetres(0.05),
            key("HATCH-13", Lengths { on: On::Page, bounds: Bounds::NOT_NEGATIVE });
        /// Light that falls everywhere.
        ambient: f64 = 0.1, key("HATCH-13", Number { bounds: Bounds::ANY, unit: "" });
        /// Towards the light.
        light: Option<LightDirection> = None, key("HATCH-13", Light).absent("the scene's `light`");
        /// [on, off]: what is drawn and what is left out in turn, from where a line begins on the page.
        dash: Option<[Length; 2]> = None, key("HATCH-13", DashKind).absent("solid");
        /// The share of width and length that strokes have more or less, at random.
        jitter: f64 = 0.0, key("HATCH-13", SHARE);
        /// The share by which strokes at the farthest corner of the volume are thinner than at the nearest.
        depth: f64 = 0.0, key("HATCH-13", SHARE);
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
pub(super) static STROKE: Table<StrokeStyle> = StrokeStyle::description(
    "[hatching.stroke]",
    "How a stroke is drawn: width · τ^tone · taper(u), τ = 1 − clamp₀₁(ambient + N·L), taper(u) = min(1, u/b, (1 − u)/b) \
     along its length. With a pen, or where the tone is in the spacing, it has one width.",
);
