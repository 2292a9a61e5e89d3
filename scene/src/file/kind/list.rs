//! Lists of any length.

use crate::file::check::Check;
use crate::file::describe::{Kind, Section, Shape};
use crate::file::item::Item;
use crate::file::out::Out;
use serde_json::{Value as Json, json};

/// A list with at least one item.
pub(crate) struct ListOf<K> {
    /// What the list is: `a list of layers`.
    pub(crate) what: &'static str,
    pub(crate) each: K,
}

impl<K: Shape> Shape for ListOf<K> {
    fn expected(&self) -> String {
        format!("{} with at least one, each {}", self.what, self.each.expected())
    }

    fn schema(&self) -> Json {
        json!({ "type": "array", "items": self.each.schema(), "minItems": 1 })
    }

    fn item_section(&self) -> Option<Section> {
        self.each.section()
    }
}

impl<K: Kind> Kind for ListOf<K> {
    type Of = Vec<K::Of>;

    /// None if any item is at fault; the faults of all are said.
    fn read(&self, item: &Item, check: &mut Check) -> Option<Vec<K::Of>> {
        match item.list() {
            Some(items) if !items.is_empty() => {
                let read = |(i, item): (usize, &Item)| {
                    check.within_item(i, |check| {
                        check.note(&item.place);
                        self.each.read(item, check)
                    })
                };
                let values: Vec<Option<K::Of>> = items.iter().enumerate().map(read).collect();
                values.into_iter().collect()
            }
            _ => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, value: &Vec<K::Of>) -> Out {
        Out::List(value.iter().map(|v| self.each.write(v)).collect())
    }
}
