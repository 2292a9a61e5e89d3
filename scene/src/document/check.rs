//! Walking a document against the description of its tables, collecting every fault ([SCN-4]).

use super::describe::{Key, Later, Table};
use super::fault::{Fault, Problem};
use super::item::{Entries, Entry, Item, Value};
use super::out;
use super::place::{Given, Place};
use crate::nearest::nearest;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// The state of a walk: where it is, and what it found.
pub(crate) struct Check {
    file: PathBuf,
    folder: PathBuf,
    path: String,
    faults: Vec<Fault>,
    given: Given,
    styles: Vec<(String, String, Place)>,
}

impl Check {
    pub(crate) fn new(file: &Path) -> Self {
        Self {
            file: file.to_owned(),
            folder: file.parent().unwrap_or(Path::new("")).to_owned(),
            path: String::new(),
            faults: Vec::new(),
            given: Given::new(file),
            styles: Vec::new(),
        }
    }

    pub(crate) fn done(self) -> (Given, Vec<Fault>) {
        (self.given, self.faults)
    }

    /// The key that the walk is at, from the top.
    pub(crate) fn key(&self) -> &str {
        &self.path
    }

    /// A key of the table that the walk is at, or of a table in it (`nodes[2].style`), from the top.
    pub(crate) fn inner(&self, tail: &str) -> String {
        if self.path.is_empty() { tail.to_owned() } else { format!("{}.{tail}", self.path) }
    }

    /// A key of the table that the walk is at, from the top, in quotes where it must be.
    fn key_of(&self, name: &str) -> String {
        self.inner(&out::key(name))
    }

    /// Walks into a key of a table.
    pub(crate) fn within<T>(&mut self, name: &str, walk: impl FnOnce(&mut Self) -> T) -> T {
        let inner = self.key_of(name);
        self.at(inner, walk)
    }

    /// Walks into an item of a list.
    pub(crate) fn within_item<T>(&mut self, i: usize, walk: impl FnOnce(&mut Self) -> T) -> T {
        let inner = format!("{}[{i}]", self.path);
        self.at(inner, walk)
    }

    fn at<T>(&mut self, key: String, walk: impl FnOnce(&mut Self) -> T) -> T {
        let outer = std::mem::replace(&mut self.path, key);
        let result = walk(self);
        self.path = outer;
        result
    }

    /// Notes that the scene says the key that the walk is at.
    pub(crate) fn note(&mut self, place: &Place) {
        self.given.insert(self.path.clone(), place.clone());
    }

    /// Forgets a table that was put into the document and that the scene did not say.
    pub(crate) fn forget_chosen(&mut self, key: &str) {
        if self.given.place(key) == Some(&Place::Chosen) {
            self.given.remove(key);
        }
    }

    /// Returns the place of a key in the scene; the key is given from the top.
    pub(crate) fn place(&self, key: &str) -> Option<&Place> {
        self.given.place(key)
    }

    /// Whether the scene says a key of the table that the walk is at, or of a table in it.
    pub(crate) fn has(&self, tail: &str) -> bool {
        self.given.contains(&self.inner(tail))
    }

    /// Whether nothing was wrong so far with these keys of the table that the walk is at, and with what is in them.
    pub(crate) fn sound(&self, names: &[&str]) -> bool {
        names.iter().all(|name| {
            let key = self.inner(name);
            !self.faults.iter().any(|fault| is_within(&fault.key, &key))
        })
    }

    /// Reports a fault of the key that the walk is at.
    pub(crate) fn fault(&mut self, place: &Place, problem: Problem) {
        self.fault_of(self.path.clone(), place, problem);
    }

    /// Reports a fault of a key, given from the top.
    pub(crate) fn fault_of(&mut self, key: String, place: &Place, problem: Problem) {
        self.faults.push(Fault { file: self.file.clone(), place: place.clone(), key, problem });
    }

    /// Reports a fault of a key of the table that the walk is at, or of a table in it; its place is the key's, or else
    /// the table's.
    pub(crate) fn fault_in(&mut self, tail: &str, problem: Problem) {
        let key = self.inner(tail);
        let place = self.given.place(&key).or_else(|| self.given.place(&self.path)).cloned();
        self.fault_of(key, &place.unwrap_or(Place::File { line: 1, column: 1 }), problem);
    }

    /// Reports a fault of an item, or of a key in it, of the list that the walk is at.
    pub(crate) fn fault_in_list(&mut self, tail: &str, problem: Problem) {
        let key = format!("{}{tail}", self.path);
        let place = self.given.place(&key).cloned().unwrap_or(Place::File { line: 1, column: 1 });
        self.fault_of(key, &place, problem);
    }

    /// Notes that the key that the walk is at names a style.
    pub(crate) fn refer_to_style(&mut self, name: &str, place: &Place) {
        self.styles.push((name.to_owned(), self.path.clone(), place.clone()));
    }

    /// The names of styles, each with the key and the place that said it.
    pub(crate) fn take_styles(&mut self) -> Vec<(String, String, Place)> {
        std::mem::take(&mut self.styles)
    }

    /// Reports a value that may not stand where it stands.
    pub(crate) fn wrong<T>(&mut self, item: &Item, expected: String) -> Option<T> {
        self.wrong_name(item, expected, None)
    }

    /// Reports a value that may not stand where it stands, with the name that was probably meant. In a list the fault is
    /// that of the first number that is not finite, if there is one.
    pub(crate) fn wrong_name<T>(&mut self, item: &Item, expected: String, nearest: Option<String>) -> Option<T> {
        if let Some((i, number)) = item.list().into_iter().flatten().enumerate().find(|(_, item)| !item.is_finite()) {
            return self.within_item(i, |check| check.wrong_name(number, "a finite number".into(), None));
        }
        self.fault(&item.place, Problem::Value { found: item.found(), expected, nearest });
        None
    }

    /// Reports a part of the format that this version does not have.
    pub(crate) fn not_built<T>(&mut self, place: &Place, what: String) -> Option<T> {
        self.fault(place, Problem::NotBuilt { what });
        None
    }

    /// A path that an item gives: relative to the scene's folder, or to the working directory if the command line gave
    /// it ([SCN-2]).
    pub(crate) fn resolve(&self, path: &str, place: &Place) -> PathBuf {
        match place {
            Place::File { .. } => self.folder.join(path),
            Place::Set(_) | Place::Chosen => PathBuf::from(path),
        }
    }

    /// The path that the scene wrote, before [`Check::resolve`].
    pub(crate) fn unresolved<'a>(&self, path: &'a Path, place: &Place) -> &'a Path {
        match place {
            Place::File { .. } => path.strip_prefix(&self.folder).unwrap_or(path),
            Place::Set(_) | Place::Chosen => path,
        }
    }

    /// Reads a table as far as it can be read; none if it is no table. Keys at fault have their defaults: a scene with
    /// a fault is never handed out, but what else is wrong with it must be seen.
    pub(crate) fn table<S>(&mut self, table: &Table<S>, item: &Item) -> Option<S> {
        self.table_over(table, item, None)
    }

    /// Reads a table like `table`, with the values of a preset for keys that the item does not have.
    pub(crate) fn table_over<S>(&mut self, table: &Table<S>, item: &Item, supplied: Option<S>) -> Option<S> {
        let Value::Table(entries) = &item.value else {
            return self.wrong(item, table_expected(table));
        };
        let is_supplied = supplied.is_some();
        let mut result = supplied.unwrap_or_else(table.empty);
        let dropped = self.alternatives(table, entries);
        self.unknown_keys(table, entries);
        for key in table.keys.iter().filter(|key| !dropped.contains(key.name)) {
            match entries.get(key.name) {
                Some(entry) if entry.item.value == Value::Off => {
                    if key.required {
                        self.missing(key, &item.place);
                    }
                    if key.field.write(&result) != key.field.write(&(table.empty)()) {
                        result = without(table, key, &result);
                    }
                }
                Some(entry) if entry.item.takes_away() && key.field.write(&result).is_none() => {}
                Some(entry) => self.within(key.name, |check| {
                    // A preset's table of which a key is overridden is still the preset's.
                    let is_over = || key.field.write(&result) != key.field.write(&(table.empty)());
                    if !(entry.item.is_way && is_over()) {
                        check.note(&entry.name);
                    }
                    key.field.read(&entry.item, &mut result, check);
                }),
                None if key.required && !is_supplied => self.missing(key, &item.place),
                None => {}
            }
        }
        if let Some(open) = table.open {
            for (name, entry) in others(table, entries) {
                self.within(name, |check| {
                    check.note(&entry.name);
                    open.read(name, &entry.item, &mut result, check);
                });
            }
        }
        (table.check)(&result, self);
        Some(result)
    }

    fn missing<S>(&mut self, key: &Key<S>, place: &Place) {
        let shape = key.field.shape();
        let expected = match shape.section() {
            Some(_) => format!("[{}], {}", key.name, shape.expected()),
            None => format!("{} = {}", key.name, shape.expected()),
        };
        let name = self.key_of(key.name);
        self.fault_of(name, place, Problem::Missing { expected });
    }

    fn unknown_keys<S>(&mut self, table: &Table<S>, entries: &Entries) {
        if table.open.is_some() {
            return;
        }
        for (name, entry) in others(table, entries) {
            if table.later.iter().any(|later| later.name == name) {
                let what = match (self.path.is_empty(), &entry.item.value) {
                    (true, Value::Table(_)) => format!("[{name}]"),
                    (true, Value::List(_)) => format!("[[{name}]]"),
                    _ => self.key_of(name),
                };
                let key = self.key_of(name);
                self.fault_of(key, &entry.name, Problem::NotBuilt { what });
            } else {
                let problem = unknown_key(table.title, name, table.keys.iter().map(|key| key.name), table.later);
                let key = self.key_of(name);
                self.fault_of(key, &entry.name, problem);
            }
        }
    }

    /// The keys that give way to others. Of two that stand in each other's place the command line's stays.
    fn alternatives<S>(&mut self, table: &Table<S>, entries: &Entries) -> BTreeSet<&'static str> {
        let mut dropped = BTreeSet::new();
        let get = |name: &str| entries.get(name).filter(|entry| !entry.item.takes_away());
        let set = |name: &str| get(name).is_some_and(|entry| entry.name.line().is_none());
        for instead in table.instead {
            let Some(one) = get(instead.one) else { continue };
            let others: Vec<&str> = instead.others.iter().copied().filter(|other| get(other).is_some()).collect();
            if others.is_empty() {
                continue;
            }
            let (one_set, other_set) = (set(instead.one), others.iter().any(|other| set(other)));
            if one_set && !other_set {
                dropped.extend(others);
            } else if other_set && !one_set {
                dropped.insert(instead.one);
            } else {
                let key = self.key_of(instead.one);
                // Others that exclude each other are alternatives, too; else they go together.
                let is_one_of_all = table.instead.iter().any(|further| instead.others.contains(&further.one));
                let rest = if is_one_of_all { others.join(" or ") } else { instead.others.join(" with ") };
                let problem = Problem::Contradiction {
                    what: format!("{} has both {} and {}", table.title, instead.one, others.join(", ")),
                    remedy: format!("keep {} or {rest}", instead.one),
                };
                self.fault_of(key, &one.name, problem);
            }
        }
        dropped
    }
}

/// Returns the entries that are none of the table's keys.
fn others<'a, S>(table: &Table<S>, entries: &'a Entries) -> impl Iterator<Item = (&'a String, &'a Entry)> {
    entries.iter().filter(|(name, entry)| !entry.item.takes_away() && table.keys.iter().all(|key| key.name != *name))
}

/// Returns the table with one key at its default.
fn without<S>(table: &Table<S>, out: &Key<S>, from: &S) -> S {
    let mut rest = (table.empty)();
    for key in table.keys.iter().filter(|key| key.name != out.name) {
        key.field.copy(from, &mut rest);
    }
    if let Some(open) = table.open {
        open.copy(from, &mut rest);
    }
    rest
}

/// Returns the words for a table where one is expected.
pub(crate) fn table_expected<S>(table: &Table<S>) -> String {
    let names: Vec<&str> = table.keys.iter().map(|key| key.name).collect();
    match names[..] {
        [] => "a table".into(),
        _ => format!("a table with the keys {}", names.join(", ")),
    }
}

/// The fault of a key that a table does not know, with the nearest that it does.
pub(crate) fn unknown_key<'a>(
    table: &str,
    name: &str,
    known: impl Iterator<Item = &'a str> + Clone,
    later: &'a [Later],
) -> Problem {
    Problem::UnknownKey {
        table: table.into(),
        name: name.into(),
        nearest: nearest(name, known.clone().chain(later.iter().map(|l| l.name))).map(Into::into),
        known: known.map(Into::into).collect(),
    }
}

/// Whether a key is another one or lies in it.
fn is_within(key: &str, outer: &str) -> bool {
    key.strip_prefix(outer).is_some_and(|rest| rest.is_empty() || rest.starts_with(['.', '[']))
}
