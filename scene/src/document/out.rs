//! Values to be written: as TOML (`--full`) and as JSON (defaults of the schema).

use crate::unprintable::is_unprintable;
use std::fmt::Write;
use std::path::PathBuf;

/// A value of a scene file.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Out {
    Bool(bool),
    Whole(u64),
    Number(f64),
    Text(String),
    Path(PathBuf),
    List(Vec<Out>),
    Table(Vec<(String, Out)>),
}

impl Out {
    /// Numbers of a vector.
    pub(crate) fn numbers(values: &[f64]) -> Self {
        Self::List(values.iter().map(|&v| Self::Number(v)).collect())
    }

    /// The value on one line of TOML.
    pub(crate) fn toml(&self) -> String {
        match self {
            Self::Bool(b) => b.to_string(),
            Self::Whole(n) => n.to_string(),
            Self::Number(x) => number(*x),
            Self::Text(text) => quoted(text),
            Self::Path(path) => quoted(&path.to_string_lossy()),
            Self::List(items) => format!("[{}]", items.iter().map(Self::toml).collect::<Vec<_>>().join(", ")),
            Self::Table(entries) if entries.is_empty() => "{}".into(),
            Self::Table(entries) => {
                let entry = |(name, value): &(String, Self)| format!("{} = {}", key(name), value.toml());
                format!("{{ {} }}", entries.iter().map(entry).collect::<Vec<_>>().join(", "))
            }
        }
    }

    /// The value as TOML after `key = `: lists of tables have a line for each.
    pub(crate) fn toml_block(&self) -> String {
        match self {
            Self::List(items) if !items.is_empty() && items.iter().all(|i| matches!(i, Self::Table(_))) => {
                let lines: String = items.iter().map(|item| format!("  {},\n", item.toml())).collect();
                format!("[\n{lines}]")
            }
            other => other.toml(),
        }
    }

    /// The value as JSON.
    pub(crate) fn json(&self) -> serde_json::Value {
        use serde_json::{Value, json};
        match self {
            Self::Bool(b) => json!(b),
            Self::Whole(n) => json!(n),
            Self::Number(x) if *x == (*x as i64) as f64 => json!(*x as i64),
            Self::Number(x) => json!(x),
            Self::Text(text) => json!(text),
            Self::Path(path) => json!(path.to_string_lossy()),
            Self::List(items) => Value::Array(items.iter().map(Self::json).collect()),
            Self::Table(entries) => Value::Object(entries.iter().map(|(name, v)| (name.clone(), v.json())).collect()),
        }
    }
}

/// A finite number as TOML that reads back to the same bits; whole ones without a point.
fn number(x: f64) -> String {
    // Outside these bounds plain digits would be long, or a whole number past TOML's 64 bits.
    if x == 0.0 || (1e-5..1e15).contains(&x.abs()) { x.to_string() } else { format!("{x:e}") }
}

/// A key, in quotes where TOML needs them.
pub(crate) fn key(name: &str) -> String {
    let bare = !name.is_empty() && name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_' || b == b'-');
    if bare { name.to_owned() } else { quoted(name) }
}

/// A basic string of TOML. Characters that could disturb a terminal are escaped.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => {
                out.push('\\');
                out.push(c);
            }
            '\n' => out.push_str("\\n"),
            '\t' => out.push_str("\\t"),
            c if is_unprintable(c) => {
                // Writing to a String cannot fail.
                let _ = write!(out, "\\u{:04X}", u32::from(c));
            }
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::document::item::{Item, Value};
    use crate::document::place::Place;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn numbers_and_texts_read_back_to_the_same_bits(bits: u64, text in "\\PC*|[\\x00-\\x7f\u{80}-\u{a0}]*") {
            let place = Place::Set("".into());
            let x = f64::from_bits(bits);
            if x.is_finite() {
                let back = Item::from_override(&number(x), &place).number().unwrap();
                prop_assert_eq!(back, x);
            }
            prop_assert_eq!(Item::from_override(&quoted(&text), &place).value, Value::Text(text));
        }
    }

    #[test]
    fn numbers_are_short() {
        for (x, text) in [(30.0, "30"), (0.5, "0.5"), (-0.0, "-0"), (1e21, "1e21"), (1.0 / 256.0, "0.00390625")] {
            assert_eq!(number(x), text);
        }
    }

    #[test]
    fn texts_are_plain_on_a_terminal() {
        assert_eq!(quoted("a\u{1b}[31m\u{202e}b"), r#""a\u001B[31m\u202Eb""#);
    }

    #[test]
    fn keys_are_quoted_where_they_must_be() {
        assert_eq!(key("wax-2_b"), "wax-2_b");
        assert_eq!(key("my \"wax\""), "\"my \\\"wax\\\"\"");
        assert_eq!(key(""), "\"\"");
    }
}
