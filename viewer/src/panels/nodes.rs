//! Nodes of a transfer function: where they stand in a plot, and the edits of the scene that move, add and rewrite them.

use crate::camera::{number, rounded};
use crate::document::{Document, Edit};
use crate::key::KeyPath;
use crate::widgets::hex;
use drypoint::scene::color::linear_to_srgb;
use drypoint::scene::tables::{Axis, Node, NodeColor, Over, Row, RowAt, Transfer, TransferKind};
use eframe::egui::Color32;
use toml_edit::{Array, InlineTable, Item, Value};

/// A node in a plot.
pub(super) struct Handle<'t> {
    /// Its key.
    pub(super) key: KeyPath,
    /// Its place in the plot.
    pub(super) at: [f64; 2],
    /// The keys that a drag to the right and upwards changes.
    keys: [Option<KeyPath>; 2],
    /// The ends of a drag: the neighbours.
    ends: [[f64; 2]; 2],
    /// The node.
    pub(super) node: &'t Node,
    /// The index of its row.
    pub(super) row: usize,
}

impl Handle<'_> {
    /// Returns the edits of a drag to a point of the plot, rounded to a thousandth of the plot's sides.
    pub(super) fn moved(&self, to: [f64; 2], sides: [f64; 2]) -> Vec<Edit> {
        let place = |axis: usize| {
            let [lo, hi] = self.ends[axis];
            round_at(to[axis].clamp(lo, hi.max(lo)), sides[axis]).clamp(lo, hi.max(lo))
        };
        let differs = |axis: &usize| self.keys[*axis].is_some() && place(*axis) != self.at[*axis];
        let edit = |axis: usize| Some(Edit::Set(self.keys[axis].clone()?, number(place(axis))));
        // Both keys are written together, so that a drag is undone as one.
        if [0, 1].iter().any(differs) { [0, 1].into_iter().filter_map(edit).collect() } else { Vec::new() }
    }
}

/// The neighbours of an item in an order: the range that keeps it.
fn between<T>(all: &[T], i: usize, at: impl Fn(&T) -> f64) -> [f64; 2] {
    let before = i.checked_sub(1).and_then(|i| all.get(i)).map_or(f64::NEG_INFINITY, &at);
    [before, all.get(i + 1).map_or(f64::INFINITY, at)]
}

/// Returns the nodes of a function with their places: over the value the opacity is upwards, over two quantities the
/// second one. Rows of labels stand at their indices.
pub(super) fn handles(transfer: &Transfer) -> Vec<Handle<'_>> {
    let of_line = |line: &[Node], list: KeyPath, i: usize| {
        let key = list.item(i);
        (key.name("at"), key, between(line, i, |node| node.at))
    };
    if let Some(line) = &transfer.nodes {
        let handle = |(i, node): (usize, &'_ Node)| {
            let (at, key, ends) = of_line(line, "transfer.nodes".into(), i);
            let keys = [Some(at), Some(key.name("opacity"))];
            Handle { key, at: [node.at, node.opacity], keys, ends: [ends, [0.0, 1.0]], node: &line[i], row: 0 }
        };
        return line.iter().enumerate().map(handle).collect();
    }
    let (rows, is_id) = (transfer.rows.as_deref().unwrap_or_default(), transfer.over.axes()[0].is_id());
    let of_row = |(r, row): (usize, &'_ Row)| -> Vec<Handle<'_>> {
        let key_of_row = KeyPath::from("transfer.rows").item(r);
        let (up, key_up) = match row.at {
            RowAt::Number(up) if transfer.over.second().is_none_or(|axis| !axis.is_id()) => {
                (up, Some(key_of_row.name("at")))
            }
            _ => (r as f64, None),
        };
        let ends_up = between(rows, r, place_of_row);
        let handle = |i: usize| {
            let (at, key, ends) = of_line(&rows[r].nodes, key_of_row.name("nodes"), i);
            let keys = [Some(at).filter(|_| !is_id), key_up.clone()];
            let node = &rows[r].nodes[i];
            Handle { key, at: [node.at, up], keys, ends: [ends, ends_up], node, row: r }
        };
        (0..row.nodes.len()).map(handle).collect()
    };
    rows.iter().enumerate().flat_map(of_row).collect()
}

/// The number of a row. A row of a label has none.
fn place_of_row(row: &Row) -> f64 {
    if let RowAt::Number(at) = row.at { at } else { f64::NAN }
}

/// Returns the ends of a plot of the nodes along each axis: around a histogram's places, or around counts over two
/// quantities.
pub(super) fn bounds(handles: &[Handle<'_>], xs: Option<&[f64]>, plane: Option<[[f64; 2]; 2]>) -> [[f64; 2]; 2] {
    let along = |axis: usize, more: &[f64]| {
        let all = handles.iter().map(|handle| handle.at[axis]).chain(more.iter().copied());
        let [lo, hi] = all.fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], at| [lo.min(at), hi.max(at)]);
        let pad = (hi - lo).max(1e-9);
        [lo, hi, pad]
    };
    let ends_of = |axis: usize| plane.map_or([0.0; 2], |ends| ends[axis]);
    let more: Vec<f64> = match xs {
        Some(xs) => [xs.first(), xs.last()].map(|x| x.copied().unwrap_or_default()).to_vec(),
        None => plane.map(|ends| ends[0].to_vec()).unwrap_or_default(),
    };
    let [lo, hi, pad] = along(0, &more);
    let across = [lo - 0.03 * pad, hi + 0.03 * pad];
    if xs.is_some() {
        return [across, [-0.05, 1.08]];
    }
    let more = if plane.is_some() { ends_of(1).to_vec() } else { Vec::new() };
    let [lo, hi, pad] = along(1, &more);
    [across, [lo - 0.06 * pad, hi + 0.06 * pad]]
}

/// Whether the document has all nodes of the function, each with a key of its own.
pub(super) fn is_written(document: &Document, transfer: &Transfer) -> bool {
    let count = |key: &KeyPath| match document.get(key)? {
        Item::ArrayOfTables(tables) => Some(tables.len()),
        item => item.as_array().map(Array::len),
    };
    match (&transfer.nodes, &transfer.rows) {
        (Some(line), _) => count(&"transfer.nodes".into()) == Some(line.len()),
        (_, Some(rows)) => count(&"transfer.rows".into()) == Some(rows.len()),
        _ => false,
    }
}

/// Returns the edits that write all nodes of a function, in rows if it is over two quantities.
pub(super) fn written(transfer: &Transfer) -> Vec<Edit> {
    match (&transfer.nodes, &transfer.rows) {
        (Some(line), _) => vec![Edit::set("transfer.nodes", lines(line.iter().map(|node| table(node, transfer.kind))))],
        (_, Some(rows)) => {
            vec![Edit::remove("transfer.nodes"), Edit::set("transfer.rows", all_rows(rows, transfer.kind))]
        }
        _ => Vec::new(),
    }
}

/// Returns the edits that make a function over the value one over the value and a second quantity: clear at the lower of
/// two ends of it, and as it is at the upper one.
pub(super) fn lifted(transfer: &Transfer, second: &Axis, [lo, hi]: [f64; 2]) -> Vec<Edit> {
    let line = transfer.nodes.as_deref().unwrap_or_default();
    let clear = line.iter().map(|node| Node { opacity: 0.0, ..node.clone() }).collect();
    let place = |at: f64| RowAt::Number(round_at(at, hi - lo));
    let rows = [Row { at: place(lo), nodes: clear }, Row { at: place(hi), nodes: line.to_vec() }];
    let over: Array = ["value", second.name()].into_iter().collect();
    vec![
        Edit::remove("transfer.nodes"),
        Edit::set("transfer.over", over),
        Edit::set("transfer.rows", all_rows(&rows, transfer.kind)),
    ]
}

/// Returns the edits that make a function in rows over the value one over the value alone: that of the last row.
pub(super) fn flattened(transfer: &Transfer) -> Vec<Edit> {
    let line = transfer.rows.iter().flatten().last().map(|row| &row.nodes[..]).unwrap_or_default();
    let nodes = lines(line.iter().map(|node| table(node, transfer.kind)));
    vec![Edit::remove("transfer.over"), Edit::remove("transfer.rows"), Edit::set("transfer.nodes", nodes)]
}

/// Returns a node at a point of the plot with the look of the node before it, its list and its index there.
pub(super) fn added(transfer: &Transfer, [x, y]: [f64; 2]) -> Option<(KeyPath, usize, Node)> {
    let far = |row: &&(usize, &Row)| (place_of_row(row.1) - y).abs();
    let rows = transfer.rows.iter().flatten().enumerate().collect::<Vec<_>>();
    let nearest = rows.iter().min_by(|a, b| far(a).total_cmp(&far(b)));
    let (list, line) = match (&transfer.nodes, nearest) {
        (Some(line), _) => ("transfer.nodes".into(), line),
        (None, Some((i, row))) => (KeyPath::from("transfer.rows").item(*i).name("nodes"), &row.nodes),
        (None, None) => return None,
    };
    let index = line.iter().take_while(|node| node.at <= x).count();
    let like = line.get(index.saturating_sub(1))?.clone();
    let span = line.iter().map(|node| node.at).fold(0.0, |most: f64, at| most.max((at - x).abs()));
    let opacity = if transfer.nodes.is_some() { rounded(y.clamp(0.0, 1.0), 3) } else { like.opacity };
    Some((list, index, Node { at: round_at(x, span), opacity, ..like }))
}

/// Returns the edits that add a row in the middle of the last two, with the nodes of the last one.
pub(super) fn row_added(transfer: &Transfer) -> Vec<Edit> {
    let (Some([.., last]), Over::Two([_, second])) = (transfer.rows.as_deref(), &transfer.over) else {
        return Vec::new();
    };
    let rows = transfer.rows.as_deref().unwrap_or_default();
    let RowAt::Number(up) = last.at else { return Vec::new() };
    let before = rows.len().checked_sub(2).map_or(0.0, |i| place_of_row(&rows[i]));
    let (at, index) = match second.is_id() {
        true => (up + 1.0, rows.len()),
        false => (round_at((before + up) / 2.0, up - before), rows.len() - 1),
    };
    let row = Row { at: RowAt::Number(at), nodes: last.nodes.clone() };
    vec![Edit::Insert("transfer.rows".into(), index, row_table(&row, transfer.kind))]
}

/// A value rounded to a thousandth of a span, or finer.
fn round_at(at: f64, span: f64) -> f64 {
    rounded(at, 3 - span.abs().max(1e-12).log10().floor() as i32)
}

/// A node as the scene writes it.
pub(super) fn table(node: &Node, kind: TransferKind) -> InlineTable {
    let look = match (&node.color, kind) {
        (NodeColor::Style(name), _) => ("style", Value::from(name.as_str())),
        (NodeColor::Color(linear), _) => {
            let [r, g, b] = linear.map(|c| (linear_to_srgb(c).clamp(0.0, 1.0) * 255.0).round() as u8);
            ("color", Value::from(hex(Color32::from_rgb(r, g, b))))
        }
    };
    InlineTable::from_iter([("at", number(node.at)), look, ("opacity", number(node.opacity))])
}

fn row_table(row: &Row, kind: TransferKind) -> InlineTable {
    let nodes: Array = row.nodes.iter().map(|node| table(node, kind)).collect();
    let at = match &row.at {
        RowAt::Number(at) => number(*at),
        RowAt::Name(name) => Value::from(name.as_str()),
        RowAt::Labels(_) => Value::Array(row.at.each().into_iter().map(stand).collect()),
    };
    InlineTable::from_iter([("at", at), ("nodes", Value::Array(nodes))])
}

fn stand(stand: drypoint::scene::tables::Stand<'_>) -> Value {
    match stand {
        drypoint::scene::tables::Stand::Number(id) => number(id),
        drypoint::scene::tables::Stand::Name(name) => Value::from(name),
    }
}

fn all_rows(rows: &[Row], kind: TransferKind) -> Array {
    lines(rows.iter().map(|row| row_table(row, kind)))
}

/// A list of tables, a line each.
fn lines(tables: impl Iterator<Item = InlineTable>) -> Array {
    let on_a_line = |table| {
        let mut value = Value::InlineTable(table);
        value.decor_mut().set_prefix("\n  ");
        value
    };
    tables.map(on_a_line).collect()
}
