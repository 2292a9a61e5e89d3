//! Edits of a TOML document that keep the comments and the layout of everything else.

use crate::key::{KeyPath, KeyStep};
use toml_edit::{Array, ArrayOfTables, DocumentMut, InlineTable, Item, Table, TableLike, Value};

/// The reason why a key cannot be edited.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum EditError {
    /// The text is no TOML.
    #[error("the text of the scene cannot be read; undo the last change or correct it in an editor")]
    Unreadable,
    /// A step of the key leads into a value that is no table.
    #[error("{key} cannot be set: there is a value where a table is expected")]
    NoTable {
        /// The key.
        key: String,
    },
    /// A list has no item of an index.
    #[error("{key} does not exist")]
    NoItem {
        /// The key.
        key: String,
    },
}

/// Returns the item at a key.
pub(crate) fn get<'d>(document: &'d DocumentMut, key: &KeyPath) -> Option<&'d Item> {
    let mut item = document.as_item();
    for step in key.steps() {
        item = match step {
            KeyStep::Name(name) => item.get(name.as_str()),
            KeyStep::Item(index) => item.get(*index),
        }?;
    }
    (!item.is_none()).then_some(item)
}

/// Sets a key. Tables on the way are made. A value that is replaced hands its comment on.
pub(crate) fn set(document: &mut DocumentMut, key: &KeyPath, value: Value) -> Result<(), EditError> {
    let Some((last, way)) = key.steps().split_last() else { return Err(no_table(key)) };
    let parent = walk(document, way, key)?;
    match last {
        KeyStep::Name(name) => {
            let end = parent.as_inline_table_mut().and_then(take_end);
            let table = parent.as_table_like_mut().ok_or_else(|| no_table(key))?;
            match table.get_mut(name) {
                Some(Item::Value(old)) => replace(old, value),
                Some(other) => *other = Item::Value(value),
                None => {
                    table.insert(name, Item::Value(value));
                }
            }
            if let (Some(end), Some(table)) = (end, parent.as_inline_table_mut()) {
                put_end(table, &end);
            }
        }
        KeyStep::Item(index) => {
            let array = parent.as_array_mut().ok_or_else(|| no_item(key))?;
            let old = array.get_mut(*index).ok_or_else(|| no_item(key))?;
            replace(old, value);
        }
    }
    Ok(())
}

/// Removes a key, if it is there. A list of tables that becomes empty goes with its last item.
pub(crate) fn remove(document: &mut DocumentMut, key: &KeyPath) -> Result<(), EditError> {
    if get(document, key).is_none() {
        return Ok(());
    }
    let Some((last, way)) = key.steps().split_last() else { return Err(no_table(key)) };
    let parent = walk(document, way, key)?;
    match last {
        KeyStep::Name(name) => {
            parent.as_table_like_mut().ok_or_else(|| no_table(key))?.remove(name);
        }
        KeyStep::Item(index) => {
            match parent {
                Item::ArrayOfTables(tables) => drop(tables.remove(*index)),
                Item::Value(Value::Array(array)) => remove_inline(array, *index),
                _ => return Err(no_item(key)),
            };
            let is_empty = parent.as_array_of_tables().is_some_and(ArrayOfTables::is_empty);
            if let (true, Some((KeyStep::Name(name), above))) = (is_empty, way.split_last()) {
                walk(document, above, key)?.as_table_like_mut().ok_or_else(|| no_table(key))?.remove(name);
            }
        }
    }
    Ok(())
}

/// Inserts a table into a list before the item at `index`, or at its end. A list that is not there becomes a list of
/// tables with headers, such as `[[clip]]`.
pub(crate) fn insert(
    document: &mut DocumentMut,
    list: &KeyPath,
    index: usize,
    table: InlineTable,
) -> Result<(), EditError> {
    let Some((KeyStep::Name(name), way)) = list.steps().split_last() else { return Err(no_item(list)) };
    let parent = walk(document, way, list)?;
    let is_inline = parent.is_inline_table();
    let holder = parent.as_table_like_mut().ok_or_else(|| no_table(list))?;
    match holder.get_mut(name) {
        None if is_inline => {
            holder.insert(name, Item::Value(Value::Array(Array::from_iter([table]))));
        }
        None => {
            let mut tables = ArrayOfTables::new();
            tables.push(table.into_table());
            holder.insert(name, Item::ArrayOfTables(tables));
        }
        Some(Item::ArrayOfTables(tables)) => {
            let mut all: Vec<Table> = std::mem::take(tables).into_iter().collect();
            all.insert(index.min(all.len()), table.into_table());
            // Without positions of their own the tables are written where the list is.
            *tables = all.into_iter().collect();
        }
        Some(Item::Value(Value::Array(array))) => insert_inline(array, index, table),
        Some(_) => return Err(no_table(list)),
    }
    Ok(())
}

/// Inserts a table into an array, on a line of its own if the other items are. The comment at the end of a line belongs to
/// the item of that line, although TOML has it before the next one.
fn insert_inline(array: &mut Array, index: usize, table: InlineTable) {
    let index = index.min(array.len());
    let mut value = Value::InlineTable(table);
    let [before, after] = split(&space(array, index));
    if after.is_empty() {
        // One line.
        value.decor_mut().set_prefix(if index == 0 { before.as_str() } else { " " });
        array.insert_formatted(index, value);
        if index == 0 && array.len() > 1 {
            set_space(array, 1, " ".into());
        }
    } else {
        let like = if index == array.len() { index.saturating_sub(1) } else { index };
        let indent = match array.is_empty() {
            true => "  ".to_owned(),
            false => space(array, like).rsplit('\n').next().unwrap_or_default().to_owned(),
        };
        value.decor_mut().set_prefix(format!("{before}\n{indent}"));
        array.insert_formatted(index, value);
        set_space(array, index + 1, after);
    }
}

/// Removes an item of an array, with the comments above it and at the end of its line.
fn remove_inline(array: &mut Array, index: usize) {
    let [before, _] = split(&space(array, index));
    let [own, after] = split(&space(array, index + 1));
    array.remove(index);
    match after.is_empty() {
        true if index == 0 => set_space(array, index, before),
        true => set_space(array, index, own),
        false => set_space(array, index, before + &after),
    }
}

/// Returns the space and the comments before an item of an array, or before its end.
fn space(array: &Array, index: usize) -> String {
    let raw = match array.get(index) {
        Some(item) => item.decor().prefix(),
        None => Some(array.trailing()),
    };
    raw.and_then(|raw| raw.as_str()).unwrap_or_default().to_owned()
}

fn set_space(array: &mut Array, index: usize, space: String) {
    match array.get_mut(index) {
        Some(item) => item.decor_mut().set_prefix(space),
        None => array.set_trailing(space),
    }
}

/// Cuts space before the end of its first line; the second part is empty if it has one line.
fn split(space: &str) -> [String; 2] {
    let (before, after) = space.split_at(space.find('\n').unwrap_or(space.len()));
    [before.into(), after.into()]
}

/// Takes the space after the last value of an inline table.
fn take_end(table: &mut InlineTable) -> Option<String> {
    let decor = table.iter_mut().last()?.1.decor_mut();
    let end = decor.suffix().and_then(|raw| raw.as_str()).unwrap_or_default().to_owned();
    decor.set_suffix("");
    Some(end)
}

/// Puts space after the last value of an inline table.
fn put_end(table: &mut InlineTable, end: &str) {
    if let Some((_, last)) = table.iter_mut().last() {
        last.decor_mut().set_suffix(end);
    }
}

/// Walks to the item that holds the last step of a key. Tables on the way are made.
fn walk<'d>(document: &'d mut DocumentMut, way: &[KeyStep], key: &KeyPath) -> Result<&'d mut Item, EditError> {
    let mut item = document.as_item_mut();
    for step in way {
        item = match step {
            KeyStep::Name(name) => {
                let empty = match item {
                    Item::Value(Value::InlineTable(_)) => Item::Value(Value::InlineTable(InlineTable::new())),
                    _ => Item::Table(Table::new()),
                };
                let table: &mut dyn TableLike = item.as_table_like_mut().ok_or_else(|| no_table(key))?;
                table.entry(name).or_insert(empty)
            }
            KeyStep::Item(index) => item.get_mut(*index).ok_or_else(|| no_item(key))?,
        };
    }
    Ok(item)
}

/// Replaces a value, with the space and the comment around it.
fn replace(old: &mut Value, mut new: Value) {
    *new.decor_mut() = old.decor().clone();
    *old = new;
}

fn no_table(key: &KeyPath) -> EditError {
    EditError::NoTable { key: key.to_string() }
}

fn no_item(key: &KeyPath) -> EditError {
    EditError::NoItem { key: key.to_string() }
}
