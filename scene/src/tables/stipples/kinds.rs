//! The types of value that `[stipples]` alone has.

use crate::color::Rgba;
use crate::document::check::Check;
use crate::document::describe::{Kind, Shape};
use crate::document::item::{Item, Value};
use crate::document::kind::{Bounds, Colors, Number, nearest_color, parse_color};
use crate::document::out::Out;
use crate::tables::volume::quantile;
use serde_json::{Value as Json, json};

/// `k_max` ([STIP-3], [STIP-17]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum PointsPerPixel {
    /// Points of a voxel for each pixel, or square of side S_max, of its projection.
    Number(f64),
    /// The number that prints a coverage of 0.9 where T = 1.
    Auto,
}

/// `threshold` ([STIP-4]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Threshold {
    /// A ‖∇V‖ of [VAL-2].
    Magnitude(f64),
    /// The quantile of ‖g‖ over the voxels with a normal.
    Quantile(f64),
}

/// `color` ([STIP-16]).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum DotColor {
    /// One colour: linear, straight.
    Fixed(Rgba),
    /// That of the transfer function at the voxel's V; of a style where it faces the eye.
    Transfer,
    /// That of the voxel's label: of the most opaque node of its row in the transfer function.
    Label,
}

/// A share that a factor has, k_gc and the like.
pub(super) const SHARE: Number = Number { bounds: Bounds::NOT_NEGATIVE, unit: "" };
/// An exponent that may not be negative.
pub(super) const EXPONENT: Number = Number { bounds: Bounds::NOT_NEGATIVE, unit: "" };
/// A number of either sign.
pub(super) const SIGNED: Number = Number { bounds: Bounds::ANY, unit: "" };

/// A colour, or where colours are taken from.
pub(super) struct DotColors;

/// Words in place of a colour.
const SOURCES: [(&str, DotColor); 2] = [("transfer", DotColor::Transfer), ("label", DotColor::Label)];

impl Shape for DotColors {
    fn expected(&self) -> String {
        format!("{}, \"transfer\" or \"label\"", Colors.expected())
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [{ "enum": SOURCES.map(|(name, _)| name) }, Colors.schema()] })
    }
}

impl Kind for DotColors {
    type Of = DotColor;

    fn read(&self, item: &Item, check: &mut Check) -> Option<DotColor> {
        let text = item.text();
        if let Some((_, source)) = SOURCES.iter().find(|(name, _)| text == Some(name)) {
            return Some(*source);
        }
        match text {
            Some(text) => match parse_color(text) {
                Some(color) => Some(DotColor::Fixed(color)),
                None => check.wrong_name(item, self.expected(), nearest_color(text)),
            },
            None => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, value: &DotColor) -> Out {
        match value {
            DotColor::Fixed(color) => Colors.write(color),
            source => Out::Text(SOURCES.iter().find(|(_, s)| s == source).map_or("", |(name, _)| name).into()),
        }
    }
}

/// A ‖∇V‖, or a quantile such as `"q0.9"`.
pub(super) struct ThresholdKind;

impl Shape for ThresholdKind {
    fn expected(&self) -> String {
        "a number from 0 to 1, or a quantile such as \"q0.9\"".into()
    }

    fn schema(&self) -> Json {
        let quantile = json!({ "type": "string", "pattern": r"^q(0(\.[0-9]*)?|1(\.0*)?|\.[0-9]+)$" });
        json!({ "anyOf": [Bounds::UNIT.schema(), quantile] })
    }
}

impl Kind for ThresholdKind {
    type Of = Threshold;

    fn read(&self, item: &Item, check: &mut Check) -> Option<Threshold> {
        let read = match &item.value {
            Value::Text(text) => quantile(text).map(Threshold::Quantile),
            _ => item.number().filter(|x| Bounds::UNIT.contain(*x)).map(Threshold::Magnitude),
        };
        read.or_else(|| check.wrong(item, self.expected()))
    }

    fn write(&self, value: &Threshold) -> Out {
        match value {
            Threshold::Magnitude(x) => Out::Number(*x),
            Threshold::Quantile(q) => Out::Text(format!("q{q}")),
        }
    }
}

/// A number above 0, or `"auto"`.
pub(super) struct PointsPerPixelKind;

/// The word in place of a number.
const AUTO: &str = "auto";

impl Shape for PointsPerPixelKind {
    fn expected(&self) -> String {
        format!("{}, or {AUTO:?}", Number { bounds: Bounds::POSITIVE, unit: "" }.expected())
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [Bounds::POSITIVE.schema(), { "const": AUTO }] })
    }
}

impl Kind for PointsPerPixelKind {
    type Of = PointsPerPixel;

    fn read(&self, item: &Item, check: &mut Check) -> Option<PointsPerPixel> {
        let read = match &item.value {
            Value::Text(text) => (text == AUTO).then_some(PointsPerPixel::Auto),
            _ => item.number().filter(|x| Bounds::POSITIVE.contain(*x)).map(PointsPerPixel::Number),
        };
        read.or_else(|| check.wrong(item, self.expected()))
    }

    fn write(&self, value: &PointsPerPixel) -> Out {
        match value {
            PointsPerPixel::Number(x) => Out::Number(*x),
            PointsPerPixel::Auto => Out::Text(AUTO.into()),
        }
    }
}
