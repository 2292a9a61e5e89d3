//! One of several names.

use crate::document::check::Check;
use crate::document::describe::{Kind, Shape, first_paragraph};
use crate::document::item::Item;
use crate::document::out::Out;
use crate::nearest::nearest;
use serde_json::{Value as Json, json};

/// One of several names, each for a value.
pub(crate) struct Choice<T: 'static> {
    pub(crate) options: &'static [ChoiceOption<T>],
}

/// One name of a [`Choice`].
pub(crate) struct ChoiceOption<T> {
    pub(crate) name: &'static str,
    pub(crate) value: T,
    pub(crate) doc: &'static str,
}

impl<T> ChoiceOption<T> {
    pub(crate) const fn new(name: &'static str, value: T, doc: &'static str) -> Self {
        Self { name, value, doc }
    }
}

/// A name with its documentation.
type NameDoc = (&'static str, &'static str);

impl<T> Choice<T> {
    /// The names with their documentation. What is made of them is compiled once, not for each type.
    fn list(&self) -> Vec<NameDoc> {
        let mut list = Vec::with_capacity(self.options.len());
        for option in self.options {
            list.push((option.name, option.doc));
        }
        list
    }
}

impl<T: Sync> Shape for Choice<T> {
    fn expected(&self) -> String {
        expected(&self.list())
    }

    fn schema(&self) -> Json {
        schema(&self.list())
    }

    fn options(&self) -> Vec<(&'static str, String)> {
        self.list().into_iter().map(|(name, doc)| (name, first_paragraph(doc))).collect()
    }
}

impl<T: Copy + PartialEq + Sync> Kind for Choice<T> {
    type Of = T;

    fn read(&self, item: &Item, check: &mut Check) -> Option<T> {
        let chosen = chosen(&self.list(), item, check)?;
        Some(self.options[chosen].value)
    }

    fn write(&self, value: &T) -> Out {
        for option in self.options {
            if option.value == *value {
                return Out::Text(option.name.into());
            }
        }
        // A value without a name cannot be: the tests go through every one.
        Out::Text(String::new())
    }
}

fn expected(list: &[NameDoc]) -> String {
    let names: Vec<String> = list.iter().map(|(name, _)| format!("{name:?}")).collect();
    match &names[..] {
        [one] => one.clone(),
        [all @ .., last] => format!("{} or {last}", all.join(", ")),
        [] => "nothing".into(),
    }
}

fn schema(list: &[NameDoc]) -> Json {
    let options: Vec<Json> =
        list.iter().map(|(name, doc)| json!({ "const": name, "description": first_paragraph(doc) })).collect();
    json!({ "type": "string", "oneOf": options })
}

/// The place of an item's name in the list. None if the item is at fault; the fault is then already reported.
fn chosen(list: &[NameDoc], item: &Item, check: &mut Check) -> Option<usize> {
    let Some(name) = item.text() else { return check.wrong(item, expected(list)) };
    let found = list.iter().position(|(known, _)| *known == name);
    if found.is_some() {
        return found;
    }
    check.wrong_name(item, expected(list), nearest(name, list.iter().map(|(known, _)| *known)).map(Into::into))
}
