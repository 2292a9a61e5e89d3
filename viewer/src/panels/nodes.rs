//! Nodes of a transfer function: where they stand in a plot, and the edits of the scene that move, add and rewrite them.

use crate::camera::{number, rounded};
use crate::document::{Document, Edit};
use crate::key::KeyPath;
use crate::widgets::hex;
use drypoint::scene::color::linear_to_srgb;
use drypoint::scene::tables::{Axis, Node, NodeColor, Row, RowAt, Stand, Transfer, TransferKind};
use eframe::egui::Color32;
use toml_edit::{Array, InlineTable, Item, Value};

/// A node in a plot.
pub(super) struct NodeHandle<'t> {
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

impl NodeHandle<'_> {
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
pub(super) fn handles(transfer: &Transfer) -> Vec<NodeHandle<'_>> {
    let of_line = |line: &[Node], list: KeyPath, i: usize| {
        let key = list.item(i);
        (key.name("at"), key, between(line, i, |node| node.at))
    };
    if let Some(line) = &transfer.nodes {
        let handle = |(i, node): (usize, &'_ Node)| {
            let (at, key, ends) = of_line(line, "transfer.nodes".into(), i);
            let keys = [Some(at), Some(key.name("opacity"))];
            NodeHandle { key, at: [node.at, node.opacity], keys, ends: [ends, [0.0, 1.0]], node: &line[i], row: 0 }
        };
        return line.iter().enumerate().map(handle).collect();
    }
    let (rows, is_id) = (transfer.rows.as_deref().unwrap_or_default(), transfer.over.axes()[0].is_id());
    let heights = heights(transfer);
    let of_row = |(r, row): (usize, &'_ Row)| -> Vec<NodeHandle<'_>> {
        let key_of_row = KeyPath::from("transfer.rows").item(r);
        let is_movable = !has_rows_of_labels(transfer);
        let key_up = is_movable.then(|| key_of_row.name("at"));
        let ends_up = between(&heights, r, |height| *height);
        let handle = |i: usize| {
            let (at, key, ends) = of_line(&rows[r].nodes, key_of_row.name("nodes"), i);
            let keys = [Some(at).filter(|_| !is_id), key_up.clone()];
            let node = &rows[r].nodes[i];
            NodeHandle { key, at: [node.at, heights[r]], keys, ends: [ends, ends_up], node, row: r }
        };
        (0..row.nodes.len()).map(handle).collect()
    };
    rows.iter().enumerate().flat_map(of_row).collect()
}

/// Whether the rows of a function are those of labels.
fn has_rows_of_labels(transfer: &Transfer) -> bool {
    transfer.over.second().is_some_and(Axis::is_id)
}

/// The height of each row in the plot: its number, or its index if it is that of a label.
fn heights(transfer: &Transfer) -> Vec<f64> {
    let height = |(r, row): (usize, &Row)| match row.at {
        RowAt::Number(at) if !has_rows_of_labels(transfer) => at,
        _ => r as f64,
    };
    transfer.rows.iter().flatten().enumerate().map(height).collect()
}

/// Returns the ends of a plot of the nodes along each axis: around a histogram's places, or around counts over two
/// quantities.
pub(super) fn bounds(handles: &[NodeHandle<'_>], xs: Option<&[f64]>, plane: Option<[[f64; 2]; 2]>) -> [[f64; 2]; 2] {
    let padded = |axis: usize, more: Vec<f64>, share: f64| {
        let all = handles.iter().map(|handle| handle.at[axis]).chain(more);
        let [lo, hi] = all.fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], at| [lo.min(at), hi.max(at)]);
        let pad = share * if hi > lo { hi - lo } else { hi.abs().max(1.0) };
        [lo - pad, hi + pad]
    };
    let of_plane = |axis: usize| plane.map_or_else(Vec::new, |ends| ends[axis].to_vec());
    match xs {
        Some(xs) => [padded(0, xs.first().into_iter().chain(xs.last()).copied().collect(), 0.03), [-0.05, 1.08]],
        None => [padded(0, of_plane(0), 0.03), padded(1, of_plane(1), 0.06)],
    }
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

/// Returns the edits that give a function over the value a second quantity. The function is clear at the lower end of it,
/// and unchanged at the upper end.
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

/// Returns a node at a point of the plot with the look of the node before it, its list and its index there. None over
/// labels: there is no place between two of them.
pub(super) fn added(transfer: &Transfer, [x, y]: [f64; 2]) -> Option<(KeyPath, usize, Node)> {
    let (list, line) = match (&transfer.nodes, &transfer.rows) {
        (Some(line), _) => ("transfer.nodes".into(), line),
        (None, Some(rows)) if !transfer.over.axes()[0].is_id() => {
            let far = heights(transfer).into_iter().map(|height| (height - y).abs()).enumerate();
            let (nearest, _) = far.min_by(|a, b| a.1.total_cmp(&b.1))?;
            (KeyPath::from("transfer.rows").item(nearest).name("nodes"), &rows[nearest].nodes)
        }
        _ => return None,
    };
    let index = line.iter().take_while(|node| node.at <= x).count();
    let like = line.get(index.saturating_sub(1))?.clone();
    let span = line.iter().map(|node| node.at).fold(0.0, |most: f64, at| most.max((at - x).abs()));
    let opacity = if transfer.nodes.is_some() { rounded(y.clamp(0.0, 1.0), 3) } else { like.opacity };
    Some((list, index, Node { at: round_at(x, span), opacity, ..like }))
}

/// Returns the edits that add a row with the nodes of the last one: in the middle of the last two, above a single one, or
/// for the first label that no row has.
pub(super) fn row_added(transfer: &Transfer) -> Vec<Edit> {
    let rows = transfer.rows.as_deref().unwrap_or_default();
    let Some(last) = rows.last() else { return Vec::new() };
    let (at, index) = match heights(transfer)[..] {
        _ if has_rows_of_labels(transfer) => {
            let ids = rows.iter().flat_map(|row| row.at.each()).filter_map(|stand| match stand {
                Stand::Number(id) => Some(id),
                Stand::Name(_) => None,
            });
            (ids.fold(0.0, f64::max) + 1.0, rows.len())
        }
        [.., before, up] => (round_at((before + up) / 2.0, up - before), rows.len() - 1),
        [up] => (up + up.abs().max(1.0), 1),
        [] => return Vec::new(),
    };
    let row = Row { at: RowAt::Number(at), nodes: last.nodes.clone() };
    vec![Edit::Insert("transfer.rows".into(), index, row_table(&row, transfer.kind))]
}

/// A value rounded to a thousandth of a span, or finer.
pub(super) fn round_at(at: f64, span: f64) -> f64 {
    rounded(at, 3 - span.abs().max(1e-12).log10().floor() as i32)
}

/// A node as the scene writes it.
pub(super) fn table(node: &Node, kind: TransferKind) -> InlineTable {
    let look = match (&node.color, kind) {
        (NodeColor::Style(name), _) => ("style", Value::from(name.as_str())),
        (NodeColor::Color(linear), _) => ("color", Value::from(hex(displayed(*linear)))),
    };
    InlineTable::from_iter([("at", number(node.at)), look, ("opacity", number(node.opacity))])
}

/// A linear colour as the window shows it.
pub(super) fn displayed(linear: [f64; 3]) -> Color32 {
    let [r, g, b] = linear.map(|c| (linear_to_srgb(c).clamp(0.0, 1.0) * 255.0).round() as u8);
    Color32::from_rgb(r, g, b)
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

fn stand(stand: Stand<'_>) -> Value {
    match stand {
        Stand::Number(id) => number(id),
        Stand::Name(name) => Value::from(name),
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

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint::scene::file::{Overrides, parse};

    /// Reads a function without a look at the files of labels.
    fn read(document: &Document) -> Transfer {
        parse(document.text(), document.path(), &Overrides::default()).unwrap().transfer.unwrap()
    }

    fn document(transfer: &str) -> (Document, Transfer) {
        let text = format!(
            "drypoint = 1\n[volume]\nphantom = {{ name = \"torus\", size = 8 }}\nlabels = \"a.nrrd\"\nlabel_names = \"a.txt\"\n{transfer}"
        );
        let document = Document::untitled(text, "a.toml".into());
        let transfer = read(&document);
        (document, transfer)
    }

    const NODE: &str = "nodes = [{ at = 3, color = \"#ffffff\" }, { at = 9, color = \"#000000\" }]";

    fn over(second: &str, rows: &[&str]) -> (Document, Transfer) {
        let rows: String = rows.iter().map(|at| format!("{{ at = {at}, {NODE} }}, ")).collect();
        document(&format!("[transfer]\nkind = \"regular\"\nover = [\"value\", \"{second}\"]\nrows = [{rows}]\n"))
    }

    /// Rows of labels stand at their indices, and stay there.
    #[test]
    fn rows_of_labels() {
        let (mut document, transfer) = over("label", &["7", "[9, 2]", "\"bone\""]);
        let found = handles(&transfer);
        assert_eq!(found.iter().map(|handle| handle.at[1]).collect::<Vec<_>>(), [0.0, 0.0, 1.0, 1.0, 2.0, 2.0]);
        assert!(found[0].moved([3.0, 2.0], [10.0; 2]).is_empty());
        assert_eq!(added(&transfer, [5.0, 1.9]).unwrap().0, "transfer.rows[2].nodes".into());
        document.apply("a row", row_added(&transfer)).unwrap();
        let rows = read(&document).rows.unwrap();
        assert!(rows.len() == 4 && rows[3].at == RowAt::Number(10.0), "{rows:?}");
    }

    /// A further row keeps the order, below zero, too.
    #[test]
    fn rows_of_numbers() {
        for rows in [&["-4"][..], &["-4", "-1"], &["2", "2"]] {
            let (mut document, transfer) = over("k1", rows);
            document.apply("a row", row_added(&transfer)).unwrap();
            assert_eq!(read(&document).rows.unwrap().len(), rows.len() + 1, "{rows:?}");
            let [_, [lo, hi]] = bounds(&handles(&transfer), None, None);
            assert!(hi - lo > 0.1, "{rows:?}");
        }
    }

    /// A grid becomes rows of the same function, and a function over the value comes back from two quantities.
    #[test]
    fn functions_are_rewritten_as_they_are() {
        let grid = "[transfer]\nkind = \"regular\"\nover = [\"value\", \"k1\"]\nnodes = [{ at = [1, 0], color = \"#ff0000\" }, \
                    { at = [2, 0], color = \"#00ff00\" }, { at = [1, 5], color = \"#ff0000\" }, { at = [2, 5], color = \"#00ff00\" }]\n";
        let (mut document_of_grid, transfer) = document(grid);
        assert!(!is_written(&document_of_grid, &transfer));
        document_of_grid.apply("write", written(&transfer)).unwrap();
        let again = read(&document_of_grid);
        assert!(is_written(&document_of_grid, &again) && again == transfer, "{}", document_of_grid.text());
        let (mut document, line) = document(&format!("[transfer]\nkind = \"regular\"\n{NODE}\n"));
        document.apply("lift", lifted(&line, &Axis::K1, [-1.0, 1.0])).unwrap();
        let two = read(&document);
        assert_eq!(two.rows.as_ref().unwrap()[1].nodes, line.nodes.clone().unwrap());
        document.apply("flatten", flattened(&two)).unwrap();
        assert_eq!(read(&document), line);
    }
}
