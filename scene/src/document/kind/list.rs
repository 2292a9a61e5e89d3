//! Lists of any length up to a limit.

use crate::document::check::Check;
use crate::document::describe::{Kind, Section, Shape};
use crate::document::fault::Problem;
use crate::document::item::{Item, Value};
use crate::document::out::Out;
use serde_json::{Value as Json, json};

/// The most items of a list of effects, or of names of effects. Every sample or every part of a scene evaluates each
/// item.
pub(crate) const FEW: usize = 256;

/// The most items of a list of data, such as nodes, labels or strokes.
pub(crate) const MANY: usize = 100_000;

/// A list with at least one item.
pub(crate) struct ListOf<K> {
    /// The list in words: `a list of layers`.
    pub(crate) what: &'static str,
    /// The most items.
    pub(crate) most: usize,
    pub(crate) each: K,
}

impl<K: Shape> Shape for ListOf<K> {
    fn expected(&self) -> String {
        format!("{} with at least one and at most {}, each {}", self.what, self.most, self.each.expected())
    }

    fn schema(&self) -> Json {
        json!({ "type": "array", "items": self.each.schema(), "minItems": 1, "maxItems": self.most })
    }

    fn most_items(&self) -> Option<usize> {
        Some(self.most)
    }

    fn item_section(&self) -> Option<Section> {
        self.each.section()
    }
}

impl<K: Kind> Kind for ListOf<K> {
    type Of = Vec<K::Of>;

    /// Returns none if any item is at fault; the faults of all items are reported.
    fn read(&self, item: &Item, check: &mut Check) -> Option<Vec<K::Of>> {
        match item.list() {
            Some(items) if items.len() > self.most => check.too_many(&items[self.most].place, [items.len(), self.most]),
            Some(items) if !items.is_empty() => {
                // Loops, which unlike closures are compiled with their kind alone.
                let mut values = Vec::with_capacity(items.len());
                for (i, item) in items.iter().enumerate() {
                    let outer = check.enter_item(i);
                    check.note(&item.place);
                    if let Some(value) = self.each.read(item, check) {
                        values.push(value);
                    }
                    check.leave(outer);
                }
                (values.len() == items.len()).then_some(values)
            }
            _ => check.wrong(item, self.expected()),
        }
    }

    /// Reads the items that overrides lead to, over those that a preset supplied.
    fn read_over(&self, item: &Item, supplied: Vec<K::Of>, check: &mut Check) -> Option<Vec<K::Of>> {
        let Value::Table(entries) = &item.value else { return self.read(item, check) };
        for (step, entry) in entries {
            if !matches!(step.parse::<usize>(), Ok(i) if i < supplied.len()) {
                check.fault(&entry.name, Problem::no_item(step, supplied.len()));
            }
        }
        let mut values = Vec::new();
        let mut is_sound = true;
        for (i, supplied) in supplied.into_iter().enumerate() {
            let value = match entries.get(&i.to_string()).map(|entry| &entry.item) {
                None => Some(supplied),
                Some(item) if item.value == Value::Off => continue,
                Some(item) => {
                    let outer = check.enter_item(i);
                    check.note(&item.place);
                    let value = match item.is_way {
                        true => self.each.read_over(item, supplied, check),
                        false => self.each.read(item, check),
                    };
                    check.leave(outer);
                    value
                }
            };
            match value {
                Some(value) => values.push(value),
                None => is_sound = false,
            }
        }
        // A list of tables at the top may lose its last one: it is then absent.
        if values.is_empty() && is_sound && check.key().contains('.') {
            return check.wrong(item, self.expected());
        }
        is_sound.then_some(values)
    }

    fn write(&self, value: &Vec<K::Of>) -> Out {
        let mut items = Vec::with_capacity(value.len());
        for value in value {
            items.push(self.each.write(value));
        }
        Out::List(items)
    }
}
