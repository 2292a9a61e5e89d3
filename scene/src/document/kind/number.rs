//! Numbers, whole numbers and flags.

use crate::document::check::Check;
use crate::document::describe::{Kind, Shape};
use crate::document::item::{Item, Value};
use crate::document::out::Out;
use serde_json::{Value as Json, json};

/// Interval of numbers. NaN and ±∞ lie in none.
#[derive(Clone, Copy)]
pub(crate) struct Bounds {
    pub(crate) lo: End,
    pub(crate) hi: End,
}

/// One end of [`Bounds`].
#[derive(Clone, Copy)]
pub(crate) enum End {
    /// No end.
    None,
    /// The end itself belongs to the range.
    In(f64),
    /// The end itself does not.
    Out(f64),
}

impl Bounds {
    /// Every number.
    pub(crate) const ANY: Self = Self { lo: End::None, hi: End::None };
    /// Above 0.
    pub(crate) const POSITIVE: Self = Self { lo: End::Out(0.0), hi: End::None };
    /// 0 or above.
    pub(crate) const NOT_NEGATIVE: Self = Self { lo: End::In(0.0), hi: End::None };
    /// From 0 to 1.
    pub(crate) const UNIT: Self = Self { lo: End::In(0.0), hi: End::In(1.0) };
    /// From 0 to below 1.
    pub(crate) const BELOW_ONE: Self = Self { lo: End::In(0.0), hi: End::Out(1.0) };

    /// Above `lo` and below `hi`.
    pub(crate) const fn between(lo: f64, hi: f64) -> Self {
        Self { lo: End::Out(lo), hi: End::Out(hi) }
    }

    pub(crate) fn contain(&self, x: f64) -> bool {
        let above = match self.lo {
            End::None => true,
            End::In(lo) => x >= lo,
            End::Out(lo) => x > lo,
        };
        let below = match self.hi {
            End::None => true,
            End::In(hi) => x <= hi,
            End::Out(hi) => x < hi,
        };
        x.is_finite() && above && below
    }

    /// `" above 0 and below 180"`, with a space before it; empty for every number.
    pub(crate) fn words(&self) -> String {
        let lo = match self.lo {
            End::None => None,
            End::In(lo) => Some(format!(" of at least {lo}")),
            End::Out(lo) => Some(format!(" above {lo}")),
        };
        let hi = match self.hi {
            End::None => None,
            End::In(hi) => Some(format!(" of at most {hi}")),
            End::Out(hi) => Some(format!(" below {hi}")),
        };
        match (self.lo, self.hi, lo, hi) {
            (End::In(lo), End::In(hi), ..) => format!(" from {lo} to {hi}"),
            (_, _, Some(lo), Some(hi)) => format!("{lo} and{hi}"),
            (_, _, lo, hi) => lo.or(hi).unwrap_or_default(),
        }
    }

    /// Returns the bounds as JSON Schema.
    pub(crate) fn schema(&self) -> Json {
        let mut schema = json!({ "type": "number" });
        let ends = [(self.lo, "minimum", "exclusiveMinimum"), (self.hi, "maximum", "exclusiveMaximum")];
        for (end, closed, open) in ends {
            match end {
                End::None => {}
                End::In(x) => schema[closed] = Out::Number(x).json(),
                End::Out(x) => schema[open] = Out::Number(x).json(),
            }
        }
        schema
    }
}

/// A number in some unit.
pub(crate) struct Number {
    pub(crate) bounds: Bounds,
    /// `", in degrees"`, with a comma before it; empty for none.
    pub(crate) unit: &'static str,
}

impl Shape for Number {
    fn expected(&self) -> String {
        format!("a number{}{}", self.bounds.words(), self.unit)
    }

    fn schema(&self) -> Json {
        self.bounds.schema()
    }
}

impl Kind for Number {
    type Of = f64;

    fn read(&self, item: &Item, check: &mut Check) -> Option<f64> {
        match item.number() {
            Some(x) if self.bounds.contain(x) => Some(x),
            _ => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, value: &f64) -> Out {
        Out::Number(*value)
    }
}

/// A whole number from `lo` to `hi`.
pub(crate) struct Whole {
    pub(crate) lo: u64,
    /// At most 2⁶³ − 1, the largest number of TOML.
    pub(crate) hi: u64,
}

impl Whole {
    /// The item as a whole number, if it is one in the range.
    pub(crate) fn of(&self, item: &Item) -> Option<u64> {
        match item.value {
            Value::Whole(n) => u64::try_from(n).ok().filter(|n| (self.lo..=self.hi).contains(n)),
            _ => None,
        }
    }

    /// `" from 1 to 9"`, with a space before it.
    pub(crate) fn words(&self) -> String {
        if self.hi >= i64::MAX as u64 {
            format!(" of at least {}", self.lo)
        } else {
            format!(" from {} to {}", self.lo, self.hi)
        }
    }
}

impl Shape for Whole {
    fn expected(&self) -> String {
        format!("a whole number{}", self.words())
    }

    fn schema(&self) -> Json {
        json!({ "type": "integer", "minimum": self.lo, "maximum": self.hi })
    }
}

impl Kind for Whole {
    type Of = u64;

    fn read(&self, item: &Item, check: &mut Check) -> Option<u64> {
        self.of(item).or_else(|| check.wrong(item, self.expected()))
    }

    fn write(&self, value: &u64) -> Out {
        Out::Whole(*value)
    }
}

/// `true` or `false`.
pub(crate) struct Flag;

impl Shape for Flag {
    fn expected(&self) -> String {
        "true or false".into()
    }

    fn schema(&self) -> Json {
        json!({ "type": "boolean" })
    }
}

impl Kind for Flag {
    type Of = bool;

    fn read(&self, item: &Item, check: &mut Check) -> Option<bool> {
        match item.value {
            Value::Bool(b) => Some(b),
            _ => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, value: &bool) -> Out {
        Out::Bool(*value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bounds_hold_their_ends_and_say_so() {
        let angle = Bounds::between(0.0, 180.0);
        assert!(angle.contain(1e-300) && !angle.contain(0.0) && !angle.contain(180.0));
        assert_eq!(angle.words(), " above 0 and below 180");
        assert!(Bounds::UNIT.contain(0.0) && Bounds::UNIT.contain(1.0) && !Bounds::UNIT.contain(1.0 + f64::EPSILON));
        assert_eq!(Bounds::UNIT.words(), " from 0 to 1");
        assert_eq!(Bounds::BELOW_ONE.words(), " of at least 0 and below 1");
        assert_eq!(Bounds::POSITIVE.words(), " above 0");
        assert_eq!(Bounds::ANY.words(), "");
        for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            assert!(!Bounds::ANY.contain(x));
        }
        assert_eq!(angle.schema(), json!({ "type": "number", "exclusiveMinimum": 0, "exclusiveMaximum": 180 }));
    }
}
