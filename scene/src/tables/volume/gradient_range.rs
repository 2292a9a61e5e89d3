//! `gradient_range` of `[volume]`, and quantiles, which other tables have too.

use crate::document::check::Check;
use crate::document::describe::{Kind, Shape};
use crate::document::item::{Item, Value};
use crate::document::kind::{Bounds, Numbers, Rule};
use crate::document::out::Out;
use serde::{Deserialize, Serialize};
use serde_json::{Value as Json, json};

/// The gradient that |g| = 1 stands for ([VAL-2]).
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum GradientRange {
    /// lo = 0, hi the quantile of ‖g‖ over the voxels with a normal; `"max"` is the quantile 1.
    Quantile(f64),
    /// lo and hi in value per world unit.
    Fixed([f64; 2]),
}

/// `"q0.999"`, `"max"` or `[lo, hi]`.
pub(crate) struct Quantile;

impl Quantile {
    const RANGE: Numbers<2> = Numbers { what: "a range [lo, hi]", bounds: Bounds::NOT_NEGATIVE, rule: Rule::Ascending };
}

impl Shape for Quantile {
    fn expected(&self) -> String {
        "a quantile from \"q0\" to \"q1\", \"max\", or a range [lo, hi] of at least 0, the lower one first".into()
    }

    fn schema(&self) -> Json {
        let quantile = json!({ "type": "string", "pattern": r"^(max|q(0(\.[0-9]*)?|1(\.0*)?|\.[0-9]+))$" });
        json!({ "anyOf": [quantile, Self::RANGE.schema()] })
    }
}

impl Kind for Quantile {
    type Of = GradientRange;

    fn read(&self, item: &Item, check: &mut Check) -> Option<GradientRange> {
        let range = match &item.value {
            Value::Text(text) if text == "max" => Some(GradientRange::Quantile(1.0)),
            Value::Text(text) => quantile(text).map(GradientRange::Quantile),
            _ => Self::RANGE.of(item).map(GradientRange::Fixed),
        };
        range.or_else(|| check.wrong(item, self.expected()))
    }

    fn write(&self, value: &GradientRange) -> Out {
        match *value {
            GradientRange::Quantile(1.0) => Out::Text("max".into()),
            GradientRange::Quantile(q) => Out::Text(format!("q{q}")),
            GradientRange::Fixed(range) => Out::numbers(&range),
        }
    }
}

/// The number of `"q0.999"`: digits and a point only, at most 1.
pub(crate) fn quantile(text: &str) -> Option<f64> {
    let digits = text.strip_prefix('q')?;
    let plain = digits.bytes().all(|b| b.is_ascii_digit() || b == b'.');
    digits.parse().ok().filter(|q| plain && Bounds::UNIT.contain(*q))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles() {
        for (text, q) in [("q0.999", Some(0.999)), ("q0", Some(0.0)), ("q1", Some(1.0)), ("q.5", Some(0.5))] {
            assert_eq!(quantile(text), q, "{text}");
        }
        for text in ["", "q", "0.5", "q1.1", "q-0", "qnan", "q1e-3", "p50", "Q0.5"] {
            assert_eq!(quantile(text), None, "{text}");
        }
    }
}
