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
    /// Names of later versions.
    pub(crate) later: &'static [&'static str],
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

impl<T> Choice<T> {
    fn names(&self) -> impl Iterator<Item = &'static str> {
        self.options.iter().map(|option| option.name)
    }
}

impl<T: Sync> Shape for Choice<T> {
    fn expected(&self) -> String {
        let names: Vec<String> = self.names().map(|name| format!("{name:?}")).collect();
        match &names[..] {
            [one] => one.clone(),
            [all @ .., last] => format!("{} or {last}", all.join(", ")),
            [] => "nothing".into(),
        }
    }

    fn schema(&self) -> Json {
        let options: Vec<Json> =
            self.options.iter().map(|o| json!({ "const": o.name, "description": first_paragraph(o.doc) })).collect();
        json!({ "type": "string", "oneOf": options })
    }

    fn options(&self) -> Vec<(&'static str, String)> {
        self.options.iter().map(|option| (option.name, first_paragraph(option.doc))).collect()
    }
}

impl<T: Copy + PartialEq + Sync> Kind for Choice<T> {
    type Of = T;

    fn read(&self, item: &Item, check: &mut Check) -> Option<T> {
        let Some(name) = item.text() else { return check.wrong(item, self.expected()) };
        if let Some(option) = self.options.iter().find(|option| option.name == name) {
            return Some(option.value);
        }
        if self.later.contains(&name) {
            let what = format!("{} = {name:?}", check.key());
            return check.not_built(&item.place, what);
        }
        check.wrong_name(item, self.expected(), nearest(name, self.names()).map(Into::into))
    }

    fn write(&self, value: &T) -> Out {
        // A value without a name cannot be: the tests go through every one.
        let name = self.options.iter().find(|option| option.value == *value).map_or("", |option| option.name);
        Out::Text(name.into())
    }
}
