//! Checks of the keys of `[transfer]` together.

use super::nodes::{Row, RowAt, Stand};
use super::over::{Axis, Over};
use super::transfer::{Transfer, TransferKind, Unit};
use crate::document::Problem;
use crate::document::check::Check;
use std::collections::BTreeSet;

/// The keys of every node that the document has, such as `nodes[2]` or `rows[0].nodes[1]`.
fn keys_of_nodes(check: &Check) -> Vec<String> {
    let items = |list: &str, check: &Check| -> Vec<String> {
        (0..).map(|i| format!("{list}[{i}]")).take_while(|key| check.has(key)).collect()
    };
    let rows = items("rows", check);
    let in_rows = rows.iter().flat_map(|row| items(&format!("{row}.nodes"), check));
    items("nodes", check).into_iter().chain(in_rows).collect()
}

/// Nodes carry what the kind of function has.
pub(super) fn kind(kind: TransferKind, check: &mut Check) {
    let (wrong, right, kind) = match kind {
        TransferKind::Style => ("color", "style", "style"),
        TransferKind::Regular => ("style", "color", "regular"),
    };
    for node in keys_of_nodes(check) {
        let key = format!("{node}.{wrong}");
        if check.has(&key) && !check.has(&format!("{node}.{right}")) {
            let what = format!("a node of a {kind} function has a {wrong}");
            let other = if wrong == "color" { "regular" } else { "style" };
            let remedy = format!("give it a {right}, or write kind = {other:?}");
            check.fault_in(&key, Problem::Contradiction { what, remedy });
        }
    }
}

/// Places of the `at` of rows and of nodes in the document, in rows or on a grid.
enum Places {
    InRows,
    /// The first node of each row.
    OnGrid(Vec<usize>),
}

impl Places {
    fn new(rows: &[Row], check: &Check) -> Self {
        if check.has("rows") {
            return Self::InRows;
        }
        let first = rows.iter().scan(0, |next, row| Some(std::mem::replace(next, *next + row.nodes.len())));
        Self::OnGrid(first.collect())
    }

    fn row(&self, i: usize) -> String {
        if let Self::InRows = self { format!("rows[{i}].at") } else { self.node(i, 0) }
    }

    fn node(&self, i: usize, j: usize) -> String {
        match self {
            Self::InRows => format!("rows[{i}].nodes[{j}].at"),
            Self::OnGrid(first) => format!("nodes[{}].at", first[i] + j),
        }
    }
}

fn contradiction(check: &mut Check, key: &str, what: String, remedy: &str) {
    check.fault_in(key, Problem::Contradiction { what, remedy: remedy.into() });
}

/// The nodes are over as many quantities as the function.
pub(super) fn over(transfer: &Transfer, check: &mut Check) {
    match (&transfer.over, &transfer.nodes, &transfer.rows) {
        (Over::Value, _, None) => {}
        (Over::Value, _, Some(_)) => {
            let (key, what) = if check.has("rows") {
                ("rows", "rows of a function over the value alone")
            } else {
                ("nodes[0].at", "a node of a function over the value alone has at = [x, y]")
            };
            let remedy = "name the two quantities, such as over = [\"value\", \"gradient-magnitude\"]";
            contradiction(check, key, what.into(), remedy);
        }
        (Over::Two(axes), _, Some(rows)) => {
            let places = Places::new(rows, check);
            rows_stand(&axes[1], rows, &places, check);
            if axes[0].is_id() {
                nodes_are_ids(rows, &places, check);
            }
        }
        (Over::Two(_), nodes, None) => {
            let (key, what) = match nodes {
                Some(_) => ("nodes[0].at", "a node of a function over two quantities has one number"),
                None => ("over", "a function over two quantities has no nodes"),
            };
            let remedy = "give nodes with at = [x, y] on a full grid, or rows = [{ at = y, nodes = [{ at = x }] }]";
            contradiction(check, key, what.into(), remedy);
        }
    }
}

/// Whether a number is the id of a label.
fn is_id(at: f64) -> bool {
    at >= 0.0 && at <= f64::from(u32::MAX) && at.fract() == 0.0
}

const IDS: &str = "an id is a whole number from 0 to 4294967295";

/// Rows stand where their quantity can be: labels once each, numbers in order.
fn rows_stand(second: &Axis, rows: &[Row], places: &Places, check: &mut Check) {
    let mut taken = BTreeSet::new();
    for (i, row) in rows.iter().enumerate() {
        let key = places.row(i);
        let before = i.checked_sub(1).map(|i| &rows[i].at);
        match (&row.at, before) {
            (RowAt::Name(name), _) if !second.is_id() => {
                let what = format!("a row at {name:?}, and the second quantity is {:?}", second.name());
                contradiction(check, &key, what, "give it a number; names are those of labels");
            }
            (RowAt::Number(at), _) if second.is_id() && !is_id(*at) => {
                contradiction(check, &key, format!("{at} is no label"), IDS);
            }
            (RowAt::Labels(_), _) if !second.is_id() => {
                let what = format!("a row at several labels, and the second quantity is {:?}", second.name());
                contradiction(check, &key, what, "give it a number");
            }
            (at, _) if second.is_id() && stands_twice(at, &mut taken) => {
                contradiction(check, &key, "a second row for one label".into(), "keep one row for each label");
            }
            (RowAt::Number(after), Some(RowAt::Number(before))) if !second.is_id() && after < before => {
                let what = format!("row {i} at {after} stands after row {} at {before}", i - 1);
                contradiction(check, &key, what, "put the rows in non-decreasing order of `at`");
            }
            _ => {}
        }
    }
}

/// Whether a row stands at a label that is `taken` already, by this row or another one. Adds the row's labels to
/// `taken`.
fn stands_twice(at: &RowAt, taken: &mut BTreeSet<String>) -> bool {
    let label = |stand| match stand {
        // Zeros of both signs are one id.
        Stand::Number(id) => (id + 0.0).to_string(),
        Stand::Name(name) => format!("{name:?}"),
    };
    let stands = at.each();
    let count = stands.len();
    stands.into_iter().map(label).filter(|label| taken.insert(label.clone())).count() < count
}

/// Nodes over labels stand at ids, at each once.
fn nodes_are_ids(rows: &[Row], places: &Places, check: &mut Check) {
    for (i, row) in rows.iter().enumerate() {
        for (j, node) in row.nodes.iter().enumerate() {
            let key = places.node(i, j);
            if !is_id(node.at) {
                contradiction(check, &key, format!("{} is no label", node.at), IDS);
            } else if j > 0 && row.nodes[j - 1].at == node.at {
                let what = "a second node for one label".into();
                contradiction(check, &key, what, "keep one node for each label in a row");
            }
        }
    }
}

/// Percentiles of values are from 0 to 100.
pub(super) fn percentiles(transfer: &Transfer, check: &mut Check) {
    if transfer.unit != Unit::Percentile {
        return;
    }
    let mut numbers: Vec<(String, f64)> = Vec::new();
    for (i, node) in transfer.nodes.iter().flatten().enumerate() {
        numbers.push((format!("nodes[{i}].at"), node.at));
    }
    if let (Over::Two([first, second]), Some(rows)) = (&transfer.over, &transfer.rows) {
        let places = Places::new(rows, check);
        for (i, row) in rows.iter().enumerate() {
            if *first == Axis::Value {
                numbers.extend(row.nodes.iter().enumerate().map(|(j, node)| (places.node(i, j), node.at)));
            }
            if let (Axis::Value, RowAt::Number(at)) = (second, &row.at) {
                numbers.push((places.row(i), *at));
            }
        }
    }
    for (key, at) in numbers.into_iter().filter(|(_, at)| !(0.0..=100.0).contains(at)) {
        let remedy = "write a number from 0 to 100, or another transfer.unit";
        contradiction(check, &key, format!("{at} is no percentile"), remedy);
    }
}
