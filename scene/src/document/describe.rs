//! Descriptions of the tables of a document, as data. Checking, `--full`, the schema and the reference page are all made from
//! these descriptions, and each stands in the file of its table.

use super::check::Check;
use super::item::Item;
use super::out::Out;
use crate::quantity::Quantity;

/// A table whose content becomes an `S`.
pub(crate) struct Table<S: 'static> {
    /// Name in messages: `[camera]`, `a node`.
    pub(crate) title: &'static str,
    /// One or two sentences.
    pub(crate) doc: &'static str,
    /// Makes the table with every default.
    pub(crate) empty: fn() -> S,
    /// The keys, in the order in which they are read, written and documented.
    pub(crate) keys: &'static [Key<S>],
    /// Keys that the user names, if the table has such.
    pub(crate) open: Option<&'static dyn Named<S>>,
    /// Keys of the format that this version does not have.
    pub(crate) later: &'static [Later],
    /// Keys that exclude each other.
    pub(crate) instead: &'static [Instead],
    /// Checks the keys together.
    pub(crate) check: fn(&S, &mut Check),
}

impl<S> Table<S> {
    /// A table that consists of its keys only.
    pub(crate) const fn new(title: &'static str, doc: &'static str, empty: fn() -> S, keys: &'static [Key<S>]) -> Self {
        Self { title, doc, empty, keys, open: None, later: &[], instead: &[], check: |_, _| {} }
    }
}

/// The parts of a [`Table`] that a walk needs and that do not depend on the struct. Code over `Head` is compiled once
/// for all tables.
pub(crate) struct Head {
    pub(crate) title: &'static str,
    /// The names of the keys.
    pub(crate) names: Vec<&'static str>,
    /// The most keys that the user may name; none: none are allowed.
    pub(crate) most_others: Option<usize>,
    pub(crate) later: &'static [Later],
    pub(crate) instead: &'static [Instead],
}

impl Head {
    /// Returns the words for a table where one is expected.
    pub(crate) fn expected(&self) -> String {
        match self.names[..] {
            [] => "a table".into(),
            _ => format!("a table with the keys {}", self.names.join(", ")),
        }
    }
}

impl<S> Table<S> {
    /// The description without the struct.
    pub(crate) fn head(&self) -> Head {
        // Loops, which unlike closures are compiled with their table alone.
        let mut names = Vec::with_capacity(self.keys.len());
        for key in self.keys {
            names.push(key.name);
        }
        Head {
            title: self.title,
            names,
            most_others: self.open.map(Named::most),
            later: self.later,
            instead: self.instead,
        }
    }
}

/// One key of a table.
pub(crate) struct Key<S: 'static> {
    /// In snake_case.
    pub(crate) name: &'static str,
    /// One or two sentences: the first paragraph.
    pub(crate) doc: &'static str,
    /// The tag of the key's rule, such as `RAY-5`; empty for none.
    pub(crate) tag: &'static str,
    /// The default in words, if it cannot be written as a value.
    pub(crate) absent: &'static str,
    /// Whether the table must have the key.
    pub(crate) required: bool,
    /// Quantities that samples or passes may need because of the key ([PLAN-1]). Whether they do depends on other keys.
    pub(crate) needs: &'static [Quantity],
    /// Reads and writes the key's value.
    pub(crate) field: &'static dyn KeyAccess<S>,
}

impl<S> Key<S> {
    /// A key whose default can be written, and which needs no quantity.
    pub(crate) const fn new(
        name: &'static str,
        tag: &'static str,
        doc: &'static str,
        field: &'static dyn KeyAccess<S>,
    ) -> Self {
        Self { name, doc, tag, absent: "", required: false, needs: &[], field }
    }

    /// Returns the key with another name than that of its field.
    pub(crate) const fn named(self, name: &'static str) -> Self {
        Self { name, ..self }
    }

    /// Returns the key with its default in words.
    pub(crate) const fn absent(self, absent: &'static str) -> Self {
        Self { absent, ..self }
    }

    /// Returns the key as one that must be there.
    pub(crate) const fn required(self) -> Self {
        Self { required: true, ..self }
    }

    /// Returns the key with the quantities that it can make a plan need.
    pub(crate) const fn needs(self, needs: &'static [Quantity]) -> Self {
        Self { needs, ..self }
    }
}

/// Part of the format that is not built yet.
pub(crate) struct Later {
    pub(crate) name: &'static str,
    pub(crate) tag: &'static str,
}

/// Keys that exclude each other: `one` in place of all of `others`. Keys of the command line replace keys of the file.
/// Both in the file, or both on the command line, are a fault.
pub(crate) struct Instead {
    pub(crate) one: &'static str,
    pub(crate) others: &'static [&'static str],
}

/// A type of values that may stand after `key =`.
pub(crate) trait Shape: Sync {
    /// Returns the values that may stand there, for the third line of a message.
    fn expected(&self) -> String;

    /// Returns the values that may stand there as JSON Schema.
    fn schema(&self) -> serde_json::Value;

    /// The names with their meanings, if the value is one of several names.
    fn options(&self) -> Vec<(&'static str, String)> {
        Vec::new()
    }

    /// The table that the value is, if it is one.
    fn section(&self) -> Option<Section> {
        None
    }

    /// The most items, if the value is a list of any length.
    fn most_items(&self) -> Option<usize> {
        None
    }

    /// The table that each item of the list is, if the value is a list of tables.
    fn item_section(&self) -> Option<Section> {
        None
    }
}

/// A [`Shape`] with the Rust type that it stands for.
pub(crate) trait Kind: Shape {
    /// The Rust type of the value.
    type Of;

    /// Reads an item. None if the item is at fault; the fault is then already reported.
    fn read(&self, item: &Item, check: &mut Check) -> Option<Self::Of>;

    /// Reads an item that overrides lead into, over the value that a preset supplied.
    fn read_over(&self, item: &Item, supplied: Self::Of, check: &mut Check) -> Option<Self::Of> {
        let _ = supplied;
        self.read(item, check)
    }

    /// Writes a value so that reading it gives the value again.
    fn write(&self, value: &Self::Of) -> Out;
}

/// Access to a key's value in a table's struct, for a value of any type.
pub(crate) trait KeyAccess<S>: Sync {
    /// Reads an item into the struct, or reports the item's fault.
    fn read(&self, item: &Item, into: &mut S, check: &mut Check);
    /// The key's value, if it has one.
    fn write(&self, from: &S) -> Option<Out>;
    /// Copies the key's value, if it has one, to another struct.
    fn copy(&self, from: &S, into: &mut S);
    /// Returns the type of value.
    fn shape(&self) -> &dyn Shape;
}

/// Access to one key: its kind, and its field in the struct.
pub(crate) struct Slot<S, K: Kind> {
    pub(crate) kind: K,
    pub(crate) get: fn(&S) -> Option<K::Of>,
    pub(crate) set: fn(&mut S, K::Of),
}

impl<S, K: Kind> KeyAccess<S> for Slot<S, K> {
    fn read(&self, item: &Item, into: &mut S, check: &mut Check) {
        let value = match (self.get)(into) {
            Some(supplied) if item.is_way => self.kind.read_over(item, supplied, check),
            _ => self.kind.read(item, check),
        };
        if let Some(value) = value {
            (self.set)(into, value);
        }
    }

    fn write(&self, from: &S) -> Option<Out> {
        (self.get)(from).map(|value| self.kind.write(&value))
    }

    fn copy(&self, from: &S, into: &mut S) {
        if let Some(value) = (self.get)(from) {
            (self.set)(into, value);
        }
    }

    fn shape(&self) -> &dyn Shape {
        &self.kind
    }
}

/// The keys of a table that the user names.
pub(crate) trait Named<S>: Sync {
    /// Reads one key.
    fn read(&self, name: &str, item: &Item, into: &mut S, check: &mut Check);
    /// All keys with their values.
    fn write(&self, from: &S) -> Vec<(String, Out)>;
    /// Adds all keys to another struct.
    fn copy(&self, from: &S, into: &mut S);
    /// Returns the type of the keys' values.
    fn shape(&self) -> &dyn Shape;
    /// Returns the documentation of these keys.
    fn doc(&self) -> &'static str;
    /// Returns the most names that a table can have.
    fn most(&self) -> usize;
}

/// Values with the names that the user gave them.
pub(crate) type NamedValues<K> = Vec<(String, <K as Kind>::Of)>;

/// Access to the keys that the user names.
pub(crate) struct Names<S, K: Kind> {
    pub(crate) kind: K,
    pub(crate) doc: &'static str,
    /// The most names.
    pub(crate) most: usize,
    pub(crate) list: fn(&S) -> NamedValues<K>,
    pub(crate) add: fn(&mut S, String, K::Of),
}

impl<S, K: Kind> Named<S> for Names<S, K> {
    fn read(&self, name: &str, item: &Item, into: &mut S, check: &mut Check) {
        if let Some(value) = self.kind.read(item, check) {
            (self.add)(into, name.to_owned(), value);
        }
    }

    fn write(&self, from: &S) -> Vec<(String, Out)> {
        (self.list)(from).into_iter().map(|(name, value)| (name, self.kind.write(&value))).collect()
    }

    fn copy(&self, from: &S, into: &mut S) {
        (self.list)(from).into_iter().for_each(|(name, value)| (self.add)(into, name, value));
    }

    fn shape(&self) -> &dyn Shape {
        &self.kind
    }

    fn doc(&self) -> &'static str {
        self.doc
    }

    fn most(&self) -> usize {
        self.most
    }
}

/// A [`Table`] without its struct, for schema and documentation.
pub(crate) struct Section {
    pub(crate) title: &'static str,
    pub(crate) doc: &'static str,
    pub(crate) keys: Vec<SectionKey>,
    pub(crate) open: Option<OpenKeys>,
    pub(crate) later: &'static [Later],
}

/// The keys of a [`Section`] that the user names.
pub(crate) struct OpenKeys {
    pub(crate) doc: &'static str,
    pub(crate) shape: &'static dyn Shape,
    /// The most keys that the user may name.
    pub(crate) most: usize,
}

/// A [`Key`] without its struct.
pub(crate) struct SectionKey {
    pub(crate) name: &'static str,
    pub(crate) doc: String,
    pub(crate) tag: &'static str,
    pub(crate) absent: &'static str,
    pub(crate) required: bool,
    pub(crate) needs: &'static [Quantity],
    /// The value of a table without the key.
    pub(crate) default: Option<Out>,
    pub(crate) shape: &'static dyn Shape,
}

impl<S> Table<S> {
    /// The description alone.
    pub(crate) fn section(&'static self) -> Section {
        let empty = (self.empty)();
        let mut keys = Vec::with_capacity(self.keys.len());
        for key in self.keys {
            keys.push(SectionKey {
                name: key.name,
                doc: first_paragraph(key.doc),
                tag: key.tag,
                absent: key.absent,
                required: key.required,
                needs: key.needs,
                default: if key.required { None } else { key.field.write(&empty) },
                shape: key.field.shape(),
            });
        }
        let open = self.open.map(|open| OpenKeys { doc: open.doc(), shape: open.shape(), most: open.most() });
        Section { title: self.title, doc: self.doc, keys, open, later: self.later }
    }
}

/// The first paragraph of a doc comment, on one line.
pub(crate) fn first_paragraph(doc: &str) -> String {
    let lines = doc.lines().map(str::trim).take_while(|line| !line.is_empty());
    lines.collect::<Vec<_>>().join(" ")
}
