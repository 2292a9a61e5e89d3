//! A scene's document: TOML values with their places, whether they come from the file or from the command line.

use super::fault::Problem;
use super::place::{Lines, Place};
use std::collections::BTreeMap;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// A value and where it stands.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Item {
    pub(crate) value: Value,
    pub(crate) place: Place,
    /// Whether the item is a table that overrides lead into and that the file lacks. Keys that the overrides do not
    /// name stay as without the table.
    pub(crate) is_way: bool,
}

/// A TOML value.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Value {
    Bool(bool),
    Whole(i64),
    /// A number, which may be NaN or infinite. Numbers that overflow are infinite.
    Number(f64),
    Text(String),
    Date(String),
    List(Vec<Item>),
    Table(Entries),
    /// An item that must be absent, even if a preset supplies it.
    Off,
}

/// The entries of a table by name.
pub(crate) type Entries = BTreeMap<String, Entry>;

/// A value of a table, with the place of its name.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Entry {
    pub(crate) name: Place,
    pub(crate) item: Item,
}

impl Item {
    /// Whether the item only removes things.
    pub(crate) fn takes_away(&self) -> bool {
        match &self.value {
            Value::Off => true,
            Value::Table(entries) => self.is_way && entries.values().all(|entry| entry.item.takes_away()),
            _ => false,
        }
    }

    /// Reads a whole document. Every fault of the TOML is reported with its place.
    pub(crate) fn document(text: &str) -> Result<Self, Vec<(Place, Problem)>> {
        let lines = Lines::new(text);
        let (table, errors) = DeTable::parse_recoverable(text);
        if errors.is_empty() {
            let place = |byte: usize| lines.place(byte);
            Ok(Self { value: Value::Table(entries(table.get_ref(), &place)), place: place(0), is_way: false })
        } else {
            let fault = |e: toml::de::Error| {
                let byte = e.span().map_or(0, |span| span.start);
                (lines.place(byte), Problem::Syntax { message: e.message().to_owned() })
            };
            Err(errors.into_iter().map(fault).collect())
        }
    }

    /// Reads the value of an override: TOML, or else the bare text.
    pub(crate) fn from_override(text: &str, place: &Place) -> Self {
        match DeValue::parse(text) {
            Ok(value) => item(&value, &|_| place.clone()),
            Err(_) => Self { value: Value::Text(text.to_owned()), place: place.clone(), is_way: false },
        }
    }

    /// The item as a finite number, which may be a whole one; none for any other item.
    pub(crate) fn number(&self) -> Option<f64> {
        match self.value {
            Value::Whole(n) => Some(n as f64),
            Value::Number(x) if x.is_finite() => Some(x),
            _ => None,
        }
    }

    /// Whether no number in the item is NaN or infinite.
    pub(crate) fn is_finite(&self) -> bool {
        match &self.value {
            Value::Number(x) => x.is_finite(),
            Value::List(items) => items.iter().all(Self::is_finite),
            _ => true,
        }
    }

    /// The item as text; none for any other item.
    pub(crate) fn text(&self) -> Option<&str> {
        match &self.value {
            Value::Text(text) => Some(text),
            _ => None,
        }
    }

    /// The item as a list; none for any other item.
    pub(crate) fn list(&self) -> Option<&[Self]> {
        match &self.value {
            Value::List(items) => Some(items),
            _ => None,
        }
    }

    /// The item in a few words, for messages.
    pub(crate) fn found(&self) -> String {
        /// Characters of a text that a message repeats.
        const LONGEST: usize = 40;
        match &self.value {
            Value::Bool(b) => b.to_string(),
            Value::Whole(n) => n.to_string(),
            Value::Number(x) => x.to_string(),
            Value::Text(text) if text.chars().count() > LONGEST => {
                format!("{:?}", text.chars().take(LONGEST).chain(['…']).collect::<String>())
            }
            Value::Text(text) => format!("{text:?}"),
            Value::Date(date) => format!("the date {date}"),
            Value::List(items) if items.iter().all(|item| item.number().is_some()) && items.len() <= 4 => {
                format!("[{}]", items.iter().map(Self::found).collect::<Vec<_>>().join(", "))
            }
            Value::List(items) => format!("a list of {}", items.len()),
            Value::Table(_) => "a table".into(),
            Value::Off => "nothing".into(),
        }
    }
}

fn entries(table: &DeTable<'_>, place: &dyn Fn(usize) -> Place) -> Entries {
    let entry = |(name, value): (&Spanned<_>, &Spanned<_>)| {
        let name: &Spanned<std::borrow::Cow<'_, str>> = name;
        (name.get_ref().to_string(), Entry { name: place(name.span().start), item: item(value, place) })
    };
    table.iter().map(entry).collect()
}

fn item(value: &Spanned<DeValue<'_>>, place: &dyn Fn(usize) -> Place) -> Item {
    let converted = match value.get_ref() {
        DeValue::String(text) => Value::Text(text.to_string()),
        DeValue::Integer(n) => match i64::from_str_radix(n.as_str(), n.radix()) {
            Ok(n) => Value::Whole(n),
            // Past 64 bits no key takes it as a whole number; as a number it keeps its size.
            Err(_) => Value::Number(n.as_str().parse().unwrap_or(f64::INFINITY)),
        },
        DeValue::Float(x) => Value::Number(x.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(b) => Value::Bool(*b),
        DeValue::Datetime(date) => Value::Date(date.to_string()),
        DeValue::Array(items) => Value::List(items.iter().map(|i| item(i, place)).collect()),
        DeValue::Table(table) => Value::Table(entries(table, place)),
    };
    Item { value: converted, place: place(value.span().start), is_way: false }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(line: usize, column: usize) -> Place {
        Place::File { line, column }
    }

    #[test]
    fn values_keep_their_places() {
        let document = Item::document("drypoint = 1\n[camera]\nfov = 4_0.5\nup = [0, 1]\n").unwrap();
        let Value::Table(root) = &document.value else { panic!() };
        let camera = &root["camera"];
        assert_eq!((&camera.name, &camera.item.place), (&at(2, 2), &at(2, 1)));
        let Value::Table(keys) = &camera.item.value else { panic!() };
        assert_eq!(keys["fov"].item, Item { value: Value::Number(40.5), place: at(3, 7), is_way: false });
        assert_eq!(
            keys["up"].item.list().unwrap()[1],
            Item { value: Value::Whole(1), place: at(4, 10), is_way: false }
        );
    }

    #[test]
    fn every_syntax_fault_is_reported() {
        let faults = Item::document("a = nope\nb = 'x\na = 1\n").unwrap_err();
        let places: Vec<_> = faults.iter().map(|(place, _)| place.line().unwrap()).collect();
        assert_eq!(places, [1, 2, 3]);
    }

    #[test]
    fn an_override_is_toml_or_a_bare_text() {
        let place = Place::Set("k=v".into());
        let value = |text| Item::from_override(text, &place).value;
        assert_eq!(value("40"), Value::Whole(40));
        assert_eq!(value("1e-3"), Value::Number(1e-3));
        assert_eq!(value("true"), Value::Bool(true));
        assert_eq!(value("\"q\""), Value::Text("q".into()));
        for bare in ["2 voxels", "#fff", "orthographic", "", "a/b.nrrd", "5 %"] {
            assert_eq!(value(bare), Value::Text(bare.into()));
        }
        assert_eq!(Item::from_override("[1, 2]", &place).found(), "[1, 2]");
        assert_eq!(value("99999999999999999999"), Value::Number(1e20));
        assert_eq!(value("1e400"), Value::Number(f64::INFINITY));
    }
}
