//! Overrides: `--set key=value` on the command line ([SCN-1]).

use super::check::{Check, unknown_key};
use super::describe::{Section, Table};
use super::fault::{Fault, Faults, Problem};
use super::item::{Entry, Item, Value};
use super::place::Place;
use std::path::PathBuf;

/// Keys of a scene with values that replace those of its file, in the order in which they are applied.
///
/// A key is given from the top: `camera.fov`, `transfer.nodes[2].opacity` or `transfer.nodes.2.opacity`. A value is
/// TOML, or else a bare text, so that `camera.projection=orthographic` needs no quotes. The bare value `off` removes
/// the named table or key. A removed key has its default.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Overrides(Vec<(String, String)>);

impl Overrides {
    /// Adds an override, which is applied after the earlier ones.
    pub fn push(&mut self, key: impl Into<String>, value: impl Into<String>) {
        self.0.push((key.into(), value.into()));
    }

    /// Adds an override in the form of the command line: `key=value`.
    ///
    /// # Errors
    /// A text without `=`.
    pub fn push_argument(&mut self, argument: &str) -> Result<(), Faults> {
        match argument.split_once('=') {
            Some((key, value)) => {
                self.push(key.trim(), value.trim());
                Ok(())
            }
            None => {
                let fault = Fault {
                    file: PathBuf::new(),
                    place: Place::Set(argument.into()),
                    key: String::new(),
                    problem: Problem::Override {
                        what: format!("{argument:?} sets nothing"),
                        remedy: "write key=value, such as camera.fov=40, or contours=off".into(),
                    },
                };
                // One fault makes a list that is not empty.
                Faults::new(vec![fault]).map_or(Ok(()), Err)
            }
        }
    }

    /// Changes a document. An override whose key cannot be reached or removed is a fault.
    pub(crate) fn apply<S>(&self, root: &'static Table<S>, document: &mut Item, check: &mut Check) {
        for (key, text) in &self.0 {
            let place = Place::Set(format!("{key}={text}").into());
            let applied = steps(key).and_then(|steps| {
                if text == "off" {
                    is_known(root.section(), &steps)?;
                    put(document, &steps, None, &place)?;
                    take_empty_list(document, &steps);
                    Ok(())
                } else {
                    put(document, &steps, Some(Item::from_override(text, &place)), &place)
                }
            });
            if let Err(problem) = applied {
                check.fault_of(key.clone(), &place, problem);
            }
        }
    }
}

impl<K: Into<String>, V: Into<String>> FromIterator<(K, V)> for Overrides {
    fn from_iter<I: IntoIterator<Item = (K, V)>>(pairs: I) -> Self {
        Self(pairs.into_iter().map(|(key, value)| (key.into(), value.into())).collect())
    }
}

/// The most names and numbers of a key: beyond every key of the format, and few enough for tables that are walked by
/// recursion.
const DEEPEST: usize = 16;

/// The names and numbers of a key: `a."b c"[2].d` is `a`, `b c`, `2`, `d`.
pub(crate) fn steps(key: &str) -> Result<Vec<String>, Problem> {
    let mut steps = Vec::new();
    let mut rest = key;
    loop {
        let (step, after) = if let Some(quoted) = rest.strip_prefix('"') {
            quoted.split_once('"').ok_or_else(|| no_key(key))?
        } else {
            let end = rest.find(['.', '[']).unwrap_or(rest.len());
            rest.split_at(end)
        };
        if step.is_empty() {
            return Err(no_key(key));
        }
        steps.push(step.to_owned());
        rest = after;
        while let Some(index) = rest.strip_prefix('[') {
            let (index, after) = index.split_once(']').ok_or_else(|| no_key(key))?;
            if index.is_empty() || !index.bytes().all(|b| b.is_ascii_digit()) {
                return Err(no_key(key));
            }
            steps.push(index.to_owned());
            rest = after;
        }
        match rest.strip_prefix('.') {
            Some(after) => rest = after,
            None if rest.is_empty() && steps.len() <= DEEPEST => return Ok(steps),
            None => return Err(no_key(key)),
        }
    }
}

fn no_key(key: &str) -> Problem {
    Problem::Override {
        what: format!("{key:?} is no key"),
        remedy: "write names with points between them, such as transfer.nodes[2].opacity".into(),
    }
}

/// Puts an item where the steps lead, or removes the item there. Tables on the way are made.
fn put(item: &mut Item, steps: &[String], new: Option<Item>, place: &Place) -> Result<(), Problem> {
    let Some((step, rest)) = steps.split_first() else {
        // The walk ends at the last step but one; only a key without steps comes here, and there is none.
        return Ok(());
    };
    if let Value::List(items) = &mut item.value {
        let number = step.parse().ok().filter(|i| *i < items.len());
        let Some(i) = number else {
            return Err(Problem::no_item(step, items.len()));
        };
        return match (rest, new) {
            ([], Some(new)) => {
                items[i] = new;
                Ok(())
            }
            ([], None) => {
                items.remove(i);
                Ok(())
            }
            (_, new) => put(&mut items[i], rest, new, place),
        };
    }
    if !matches!(item.value, Value::Table(_)) {
        if new.is_none() {
            return Ok(());
        }
        *item = Item { value: Value::Table(Default::default()), place: place.clone(), is_way: false };
    }
    let Value::Table(entries) = &mut item.value else { return Ok(()) };
    match (rest, new) {
        ([], Some(item)) => {
            entries.insert(step.clone(), Entry { name: place.clone(), item });
            Ok(())
        }
        ([], None) => {
            // What the file does not have may be a preset's.
            let item = Item { value: Value::Off, place: place.clone(), is_way: false };
            entries.insert(step.clone(), Entry { name: place.clone(), item });
            Ok(())
        }
        (_, new) => {
            let empty = || Entry {
                name: place.clone(),
                item: Item { value: Value::Table(Default::default()), place: place.clone(), is_way: true },
            };
            put(&mut entries.entry(step.clone()).or_insert_with(empty).item, rest, new, place)
        }
    }
}

/// Removes a list of tables at the top, such as `[[pen]]`, if its last table was removed.
fn take_empty_list(document: &mut Item, steps: &[String]) {
    if let (Value::Table(entries), [list, _]) = (&mut document.value, steps)
        && let Some(entry) = entries.get_mut(list)
        && entry.item.list().is_some_and(<[Item]>::is_empty)
    {
        entry.item.value = Value::Off;
    }
}

/// Whether the format has a key. Removed items leave nothing in the document that the walk could check.
fn is_known(root: Section, steps: &[String]) -> Result<(), Problem> {
    let mut section = Some(root);
    for step in steps {
        let Some(here) = section else { return Ok(()) };
        let is_item = step.bytes().all(|b| b.is_ascii_digit());
        match here.keys.iter().find(|key| key.name == step) {
            Some(key) => section = key.shape.section().or_else(|| key.shape.item_section()),
            None if is_item => section = Some(here),
            None if here.open.is_some() || here.later.iter().any(|later| later.name == step) => return Ok(()),
            None => return Err(unknown_key(here.title, step, here.keys.iter().map(|key| key.name), here.later)),
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_cut_at_points_and_brackets() {
        let cut = |key| steps(key).unwrap();
        assert_eq!(cut("camera.fov"), ["camera", "fov"]);
        assert_eq!(cut("transfer.nodes[2].style"), cut("transfer.nodes.2.style"));
        assert_eq!(cut("styles.\"my wax.png\""), ["styles", "my wax.png"]);
        assert_eq!(cut("a[0][1]"), ["a", "0", "1"]);
        for wrong in ["", ".", "a.", ".a", "a[", "a[x]", "a[]", "a]b[", "a\"b", "\"a", "a[0]b"] {
            assert!(wrong == "a]b[" || wrong == "a\"b" || steps(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_key_of_any_length_is_a_fault_and_no_overflow() {
        assert_eq!(steps(&["a"; DEEPEST].join(".")).unwrap().len(), DEEPEST);
        for long in [vec!["a"; 100_000].join("."), format!("a{}", "[0]".repeat(100_000))] {
            assert!(steps(&long).is_err());
        }
    }

    #[test]
    fn an_argument_needs_an_equals_sign() {
        let mut overrides = Overrides::default();
        overrides.push_argument("volume.file = a=b.nrrd").unwrap();
        assert_eq!(overrides, [("volume.file", "a=b.nrrd")].into_iter().collect());
        let faults = overrides.push_argument("contours").unwrap_err();
        assert_eq!(
            faults.to_string(),
            "\"contours\" sets nothing\n  at --set contours\n  write key=value, such as camera.fov=40, or contours=off"
        );
    }
}
