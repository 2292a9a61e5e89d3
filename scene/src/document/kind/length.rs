//! Lengths with their units ([SCN-2], [SPACE-5]).

use super::number::Bounds;
use crate::document::check::Check;
use crate::document::describe::{Kind, Shape};
use crate::document::item::{Item, Value};
use crate::document::out::Out;
use crate::length::Length;
use crate::nearest::nearest;
use serde_json::{Value as Json, json};

/// A length.
pub(crate) struct Lengths {
    pub(crate) on: On,
    pub(crate) bounds: Bounds,
}

/// The space that a length is measured in.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum On {
    /// The world: bare numbers, and voxels.
    World,
    /// The page: mm and px.
    Page,
    /// The page, or a share of the picture: mm, px and %.
    Picture,
}

/// A length in the world above 0.
pub(crate) const WORLD_LENGTH: Lengths = Lengths { on: On::World, bounds: Bounds::POSITIVE };

/// Makes a length of a number in the unit.
type Unit = fn(f64) -> Length;

/// The units by name.
const UNITS: [(&str, Unit); 5] = [
    ("voxels", Length::Voxels),
    ("voxel", Length::Voxels),
    ("mm", Length::Millimetres),
    ("px", Length::Pixels),
    ("%", Length::Percent),
];

impl Lengths {
    fn allows(&self, length: Length) -> bool {
        match length {
            Length::World(_) | Length::Voxels(_) => self.on == On::World,
            Length::Millimetres(_) | Length::Pixels(_) => self.on != On::World,
            Length::Percent(_) => self.on == On::Picture,
        }
    }
}

/// The number of a length in its unit.
fn amount(length: Length) -> f64 {
    match length {
        Length::World(x) | Length::Voxels(x) | Length::Millimetres(x) | Length::Pixels(x) | Length::Percent(x) => x,
    }
}

/// Reads a length such as `"2 voxels"`. The error is the text that was probably meant, if the text has a number and a
/// misspelt unit.
fn parse(text: &str) -> Result<Length, Option<String>> {
    let unit_at = text.rfind(|c: char| c.is_ascii_digit() || c == '.').map_or(0, |i| i + 1);
    let (number, unit) = (text[..unit_at].trim(), text[unit_at..].trim());
    let number: f64 = number.parse().map_err(|_| None)?;
    match UNITS.iter().find(|(name, _)| *name == unit) {
        Some((_, length)) => Ok(length(number)),
        // Between short units one letter is a factor of ten: cm is no slip for mm.
        None => Err(nearest(unit, ["voxels", "voxel"]).map(|unit| format!("{number} {unit}"))),
    }
}

impl Shape for Lengths {
    fn expected(&self) -> String {
        let words = self.bounds.words();
        match self.on {
            On::World => format!("a length{words}: a number in world units, or such as \"2 voxels\""),
            On::Page => format!("a length{words} with its unit, such as \"180 mm\" or \"700 px\""),
            On::Picture => format!("a length{words} with its unit, such as \"3 mm\", \"20 px\" or \"4 %\""),
        }
    }

    fn schema(&self) -> Json {
        const NUMBER: &str = r"^\s*[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?\s*";
        match self.on {
            On::World => {
                let text = json!({ "type": "string", "pattern": format!("{NUMBER}voxels?\\s*$") });
                json!({ "anyOf": [self.bounds.schema(), text] })
            }
            On::Page => json!({ "type": "string", "pattern": format!("{NUMBER}(mm|px)\\s*$") }),
            On::Picture => json!({ "type": "string", "pattern": format!("{NUMBER}(mm|px|%)\\s*$") }),
        }
    }
}

impl Lengths {
    /// Reads a length where other values are allowed, too. `expected` names all allowed values.
    pub(crate) fn read_as(&self, item: &Item, check: &mut Check, expected: String) -> Option<Length> {
        let length = match &item.value {
            Value::Text(text) => match parse(text) {
                Ok(length) => Some(length),
                Err(nearest) => return check.wrong_name(item, expected, nearest.filter(|_| self.on == On::World)),
            },
            _ => item.number().map(Length::World),
        };
        match length {
            Some(length) if self.allows(length) && self.bounds.contain(amount(length)) => Some(length),
            _ => check.wrong(item, expected),
        }
    }
}

impl Kind for Lengths {
    type Of = Length;

    fn read(&self, item: &Item, check: &mut Check) -> Option<Length> {
        self.read_as(item, check, self.expected())
    }

    fn write(&self, value: &Length) -> Out {
        let with_unit = |x: f64, unit: &str| Out::Text(format!("{} {unit}", Out::Number(x).toml()));
        match *value {
            Length::World(x) => Out::Number(x),
            Length::Voxels(1.0) => with_unit(1.0, "voxel"),
            Length::Voxels(x) => with_unit(x, "voxels"),
            Length::Millimetres(x) => with_unit(x, "mm"),
            Length::Pixels(x) => with_unit(x, "px"),
            Length::Percent(x) => with_unit(x, "%"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_unit_is_read() {
        for (text, length) in [
            ("2 voxels", Length::Voxels(2.0)),
            ("1 voxel", Length::Voxels(1.0)),
            (" 0.5voxels ", Length::Voxels(0.5)),
            (".5 voxels", Length::Voxels(0.5)),
            ("1.5 mm", Length::Millimetres(1.5)),
            ("4 px", Length::Pixels(4.0)),
            ("5 %", Length::Percent(5.0)),
            ("1e-3 mm", Length::Millimetres(0.001)),
        ] {
            assert_eq!(parse(text), Ok(length), "{text}");
        }
    }

    #[test]
    fn a_wrong_unit_names_the_nearest() {
        assert_eq!(parse("2 voxles"), Err(Some("2 voxels".into())));
        assert_eq!(parse("18 cm"), Err(None));
        assert_eq!(parse("2 furlongs"), Err(None));
        for text in ["", "mm", "2", "two voxels", "2 voxels 3", "é", "- voxels"] {
            assert_eq!(parse(text), Err(None), "{text}");
        }
        // Whether the number is one that may stand there is decided by the bounds.
        assert_eq!(parse("-2 voxels"), Ok(Length::Voxels(-2.0)));
        assert!(!Bounds::POSITIVE.contain(amount(parse("1e999 mm").unwrap())));
    }
}
