//! The walk over a document that checks it against the description of its tables ([SCN-4]).

use super::describe::{Head, Key, Later, Shape, Table};
use super::fault::{Fault, Problem};
use super::item::{Entries, Entry, Item, Value};
use super::out;
use super::place::{Given, Place};
use crate::nearest::nearest;
use std::collections::BTreeSet;
use std::ops::Bound;
use std::path::{Path, PathBuf};

/// The most faults of a scene that are reported one by one.
const MOST_FAULTS: usize = 100;

/// The state of a walk: its position, and its findings.
pub(crate) struct Check {
    file: PathBuf,
    folder: PathBuf,
    path: String,
    /// The reported faults: the first [`MOST_FAULTS`].
    faults: Vec<Fault>,
    /// The number of further faults.
    untold: usize,
    /// The keys of all faults.
    at_fault: BTreeSet<String>,
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
            untold: 0,
            at_fault: BTreeSet::new(),
            given: Given::new(file),
            styles: Vec::new(),
        }
    }

    /// Ends the walk. The number of faults that are not reported is a fault of its own.
    pub(crate) fn done(mut self) -> (Given, Vec<Fault>) {
        if self.untold > 0 {
            let problem = Problem::Further { count: self.untold };
            // Nowhere is behind every place.
            self.faults.push(Fault { file: self.file, place: Place::Chosen, key: String::new(), problem });
        }
        (self.given, self.faults)
    }

    /// The key that the walk is at, from the top.
    pub(crate) fn key(&self) -> &str {
        &self.path
    }

    /// The full key, from the top, of a key in the present table, or in a table inside it (`nodes[2].style`).
    pub(crate) fn inner(&self, tail: &str) -> String {
        if self.path.is_empty() { tail.to_owned() } else { format!("{}.{tail}", self.path) }
    }

    /// The full key, from the top, of a key in the present table, with quotes where TOML needs them.
    fn key_of(&self, name: &str) -> String {
        self.inner(&out::key(name))
    }

    /// Walks into a key of a table.
    pub(crate) fn within<T>(&mut self, name: &str, walk: impl FnOnce(&mut Self) -> T) -> T {
        let outer = self.enter(name);
        let result = walk(self);
        self.path = outer;
        result
    }

    /// Enters a key of a table and returns the table's own key.
    fn enter(&mut self, name: &str) -> String {
        let inner = self.key_of(name);
        std::mem::replace(&mut self.path, inner)
    }

    /// Walks into an item of a list.
    pub(crate) fn within_item<T>(&mut self, i: usize, walk: impl FnOnce(&mut Self) -> T) -> T {
        let outer = self.enter_item(i);
        let result = walk(self);
        self.path = outer;
        result
    }

    /// Enters an item of a list and returns the list's key.
    pub(crate) fn enter_item(&mut self, i: usize) -> String {
        let inner = format!("{}[{i}]", self.path);
        std::mem::replace(&mut self.path, inner)
    }

    /// Returns from an item to its list, whose key [`Check::enter_item`] gave.
    pub(crate) fn leave(&mut self, list: String) {
        self.path = list;
    }

    /// Notes that the scene says the key that the walk is at.
    pub(crate) fn note(&mut self, place: &Place) {
        self.given.insert(self.path.clone(), place.clone());
    }

    /// Forgets a table that was added to the document and that the scene does not have.
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

    /// Whether no fault was found so far in these keys of the present table, and in their contents.
    pub(crate) fn sound(&self, names: &[&str]) -> bool {
        names.iter().all(|name| {
            let key = self.inner(name);
            // Keys in order: those inside a table follow the table's with a point or a bracket.
            let first = |of: &str| self.at_fault.range::<str, _>((Bound::Included(of), Bound::Unbounded)).next();
            let is_inside = |start: String| first(&start).is_some_and(|found| found.starts_with(&start));
            !self.at_fault.contains(&key) && !is_inside(format!("{key}.")) && !is_inside(format!("{key}["))
        })
    }

    /// Reports a fault of the key that the walk is at.
    pub(crate) fn fault(&mut self, place: &Place, problem: Problem) {
        self.fault_of(self.path.clone(), place, problem);
    }

    /// Reports a fault of a key, given from the top.
    pub(crate) fn fault_of(&mut self, key: String, place: &Place, problem: Problem) {
        self.fault_by(key, place, || problem);
    }

    /// Reports a fault. `problem` is called only if the fault is reported one by one.
    fn fault_by(&mut self, key: String, place: &Place, problem: impl FnOnce() -> Problem) {
        self.at_fault.insert(key.clone());
        if self.faults.len() < MOST_FAULTS {
            self.faults.push(Fault { file: self.file.clone(), place: place.clone(), key, problem: problem() });
        } else {
            self.untold += 1;
        }
    }

    /// Reports a fault of a key in the present table, or in a table inside it. The fault's place is the key's, or else
    /// the table's.
    pub(crate) fn fault_in(&mut self, tail: &str, problem: Problem) {
        let (key, place) = self.inner_place(tail);
        self.fault_of(key, &place, problem);
    }

    /// Reports an unknown name that a key of the present table gives. `known` are the names that exist.
    pub(crate) fn unknown_in(&mut self, tail: &str, what: &str, name: &str, known: &[&str]) {
        let (key, place) = self.inner_place(tail);
        self.unknown_of(key, &place, what, name, known);
    }

    /// Reports an unknown name. `known` are the names that exist.
    pub(crate) fn unknown_of(&mut self, key: String, place: &Place, what: &str, name: &str, known: &[&str]) {
        self.fault_by(key, place, || Problem::Reference {
            what: what.into(),
            name: name.into(),
            nearest: nearest(name, known.iter().copied()).map(Into::into),
            known: known.iter().map(|name| (*name).into()).collect(),
        });
    }

    /// The full key of [`Check::inner`], and the key's place or else the table's.
    fn inner_place(&self, tail: &str) -> (String, Place) {
        let key = self.inner(tail);
        let place = self.given.place(&key).or_else(|| self.given.place(&self.path)).cloned();
        (key, place.unwrap_or(Place::File { line: 1, column: 1 }))
    }

    /// Reports that the list or table that the walk is at has too many entries. `first` is the first of those that are
    /// too many.
    pub(crate) fn too_many<T>(&mut self, first: &Place, [count, most]: [usize; 2]) -> Option<T> {
        self.fault(first, Problem::TooMany { count, most });
        None
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

    /// Reports a value that is not allowed at its place.
    pub(crate) fn wrong<T>(&mut self, item: &Item, expected: String) -> Option<T> {
        self.wrong_name(item, expected, None)
    }

    /// Reports a value that is not allowed at its place, with the name that was probably meant. In a list, the fault is
    /// that of the first number that is not finite, if there is one.
    pub(crate) fn wrong_name<T>(&mut self, item: &Item, expected: String, nearest: Option<String>) -> Option<T> {
        self.wrong_value(item, expected, nearest);
        None
    }

    fn wrong_value(&mut self, item: &Item, expected: String, nearest: Option<String>) {
        if let Some((i, number)) = item.list().into_iter().flatten().enumerate().find(|(_, item)| !item.is_finite()) {
            return self.within_item(i, |check| check.wrong_value(number, "a finite number".into(), None));
        }
        self.fault(&item.place, Problem::Value { found: item.found(), expected, nearest });
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

    /// Reads a table; none if the item is no table. Keys at fault get their defaults, so that the walk can find further
    /// faults. A scene with a fault is never returned to the caller.
    pub(crate) fn table<S>(&mut self, table: &Table<S>, item: &Item) -> Option<S> {
        self.table_over(table, item, None)
    }

    /// Reads a table like `table`, with the values of a preset for keys that the item does not have.
    pub(crate) fn table_over<S>(&mut self, table: &Table<S>, item: &Item, supplied: Option<S>) -> Option<S> {
        let head = table.head();
        let Value::Table(entries) = &item.value else {
            return self.wrong(item, head.expected());
        };
        let is_supplied = supplied.is_some();
        let mut result = match supplied {
            Some(supplied) => supplied,
            None => (table.empty)(),
        };
        let dropped = self.alternatives(&head, entries);
        let others = self.others(&head, entries);
        for key in table.keys {
            if dropped.contains(key.name) {
                continue;
            }
            // A preset's table of which a key is overridden is still the preset's.
            let is_over = |result: &S| key.field.write(result) != key.field.write(&(table.empty)());
            match entries.get(key.name) {
                Some(entry) if entry.item.value == Value::Off => {
                    if key.required {
                        self.missing(key.name, key.field.shape(), &item.place);
                    }
                    if is_over(&result) {
                        result = without(table, key, &result);
                    }
                }
                Some(entry) if entry.item.takes_away() && key.field.write(&result).is_none() => {}
                Some(entry) => {
                    let outer = self.enter(key.name);
                    if !(entry.item.is_way && is_over(&result)) {
                        self.note(&entry.name);
                    }
                    key.field.read(&entry.item, &mut result, self);
                    self.path = outer;
                }
                None if key.required && !is_supplied => self.missing(key.name, key.field.shape(), &item.place),
                None => {}
            }
        }
        if let Some(open) = table.open {
            for (name, entry) in others {
                let outer = self.enter(name);
                self.note(&entry.name);
                open.read(name, &entry.item, &mut result, self);
                self.path = outer;
            }
        }
        (table.check)(&result, self);
        Some(result)
    }

    /// Reports a required key that is missing.
    fn missing(&mut self, name: &str, shape: &dyn Shape, place: &Place) {
        let expected = match shape.section() {
            Some(_) => format!("[{name}], {}", shape.expected()),
            None => format!("{name} = {}", shape.expected()),
        };
        let key = self.key_of(name);
        self.fault_of(key, place, Problem::Missing { expected });
    }

    /// The entries whose names are not keys of the table, if the user may name keys. If not, each such entry is a
    /// fault.
    fn others<'a>(&mut self, head: &Head, entries: &'a Entries) -> Vec<(&'a str, &'a Entry)> {
        let is_other = |name: &str, entry: &Entry| !entry.item.takes_away() && !head.names.contains(&name);
        let others = entries.iter().map(|(name, entry)| (name.as_str(), entry));
        let mut others: Vec<_> = others.filter(|(name, entry)| is_other(name, entry)).collect();
        let Some(most) = head.most_others else {
            others.into_iter().for_each(|(name, entry)| self.unknown_key(head, name, entry));
            return Vec::new();
        };
        if others.len() > most {
            let count = others.len();
            others.sort_by_key(|(_, entry)| entry.name.in_file());
            return self.too_many(&others[most].1.name, [count, most]).unwrap_or_default();
        }
        others
    }

    /// Reports a key that a table does not have.
    fn unknown_key(&mut self, head: &Head, name: &str, entry: &Entry) {
        let key = self.key_of(name);
        if head.later.iter().any(|later| later.name == name) {
            let what = match (self.path.is_empty(), &entry.item.value) {
                (true, Value::Table(_)) => format!("[{name}]"),
                (true, Value::List(_)) => format!("[[{name}]]"),
                _ => key.clone(),
            };
            self.fault_of(key, &entry.name, Problem::NotBuilt { what });
        } else {
            let known = head.names.iter().copied();
            self.fault_by(key, &entry.name, || unknown_key(head.title, name, known, head.later));
        }
    }

    /// The keys that others replace. If two keys exclude each other, the command line's key stays.
    fn alternatives(&mut self, head: &Head, entries: &Entries) -> BTreeSet<&'static str> {
        let mut dropped = BTreeSet::new();
        let get = |name: &str| entries.get(name).filter(|entry| !entry.item.takes_away());
        let set = |name: &str| get(name).is_some_and(|entry| entry.name.line().is_none());
        for instead in head.instead {
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
                let what = format!("{} has both {} and {}", head.title, instead.one, others.join(" and "));
                // Of keys that exclude each other, too, one may stay; else all others may.
                let exclude = |a: &str, b: &str| head.instead.iter().any(|i| i.one == a && i.others.contains(&b));
                let pairs = || others.iter().enumerate().flat_map(|(i, a)| others[i + 1..].iter().map(move |b| (a, b)));
                let remedy = if pairs().all(|(a, b)| exclude(a, b)) {
                    format!("keep {} or {}", instead.one, others.join(" or "))
                } else {
                    format!("keep {}, or {}", instead.one, others.join(" and "))
                };
                self.fault_of(key, &one.name, Problem::Contradiction { what, remedy });
            }
        }
        dropped
    }
}

/// Returns the table with one key at its default.
fn without<S>(table: &Table<S>, out: &Key<S>, from: &S) -> S {
    let mut rest = (table.empty)();
    for key in table.keys {
        if key.name != out.name {
            key.field.copy(from, &mut rest);
        }
    }
    if let Some(open) = table.open {
        open.copy(from, &mut rest);
    }
    rest
}

/// The fault of a key that a table does not have, with the nearest key of the table.
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
