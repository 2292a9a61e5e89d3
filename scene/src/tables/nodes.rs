//! Nodes of a transfer function, in a line, on a full grid, or in rows of their own ([STF-3], [STF-4]).

use super::LabelKey;
use super::over::Label;
use crate::document::Problem;
use crate::document::check::Check;
use crate::document::declare::table;
use crate::document::describe::{Kind, Section, Shape, Table};
use crate::document::item::{Item, Value};
use crate::document::kind::{Bounds, Colors, ListOf, MANY, Number, Numbers, Rule, TableOf, Text};
use crate::document::out::Out;
use serde_json::{Value as Json, json};

/// One node of a transfer function.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// The value, or the first of two quantities.
    pub at: f64,
    /// Style or colour.
    pub color: NodeColor,
    /// α_u per reference length; an `#rrggbbaa` colour has already been multiplied in.
    pub opacity: f64,
}

impl Node {
    /// The name of its style, if it has one.
    pub fn style(&self) -> Option<&str> {
        match &self.color {
            NodeColor::Style(name) => Some(name),
            NodeColor::Color(_) => None,
        }
    }
}

/// The look of a node.
#[derive(Clone, Debug, PartialEq)]
pub enum NodeColor {
    /// The name of a style.
    Style(String),
    /// Linear straight red, green, blue.
    Color([f64; 3]),
}

table! {
    /// A row of nodes of a function over two quantities: a function of its own over the first one ([STF-4]).
    #[derive(Clone, Debug, PartialEq)]
    pub struct Row {
        /// Place of the row: a number of the second quantity; for labels an id, a name of `volume.label_names`, or
        /// a list of labels that share the row.
        at: RowAt = RowAt::Number(0.0), key("STF-4", RowAtKind).required();
        /// Nodes over the first quantity, in non-decreasing order of `at`.
        nodes: Vec<Node> = Vec::new(), key("STF-4", LineOfNodes).required();
    }
}

/// Place of a row.
#[derive(Clone, Debug, PartialEq)]
pub enum RowAt {
    /// At a number; for labels, an id.
    Number(f64),
    /// At the label of that name.
    Name(String),
    /// At each of these labels, which share the row.
    Labels(Vec<LabelKey>),
}

/// One of the places where a row stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Stand<'a> {
    /// A number, or an id.
    Number(f64),
    /// The name of a label.
    Name(&'a str),
}

impl RowAt {
    /// The places one by one.
    pub fn each(&self) -> Vec<Stand<'_>> {
        let one = |label| match label {
            &LabelKey::Id(id) => Stand::Number(f64::from(id)),
            LabelKey::Name(name) => Stand::Name(name),
        };
        match self {
            Self::Number(number) => vec![Stand::Number(*number)],
            Self::Name(name) => vec![Stand::Name(name)],
            Self::Labels(labels) => labels.iter().map(one).collect(),
        }
    }
}

/// The two forms of `nodes`.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum NodeList {
    /// Each `at` is a number.
    Line(Vec<Node>),
    /// Each `at` is a pair: a full grid, cut into its rows.
    Grid(Vec<Row>),
}

/// Place of a node, as the scene writes it.
#[derive(Clone, Copy, PartialEq)]
enum At {
    One(f64),
    Two([f64; 2]),
}

table! {
    /// A node as the scene writes it.
    ///
    /// A colour's opacity multiplies `opacity`, so `color` is read after it.
    struct Written {
        /// The value; the two quantities in a grid over two; the first of them in a row.
        at: At = At::One(0.0), key("STF-3", AtKind).required();
        /// Style or colour, as in [`Node`].
        look: NodeColor = NodeColor::Style(String::new());
        /// The name of a style; in a style function.
        style: key("STF-3", StyleName,
            |n| match &n.look {
                NodeColor::Style(name) => Some(name.clone()).filter(|name| !name.is_empty()),
                NodeColor::Color(_) => None,
            },
            |n, v| n.look = NodeColor::Style(v));
        /// Opacity for a `sampling.reference_length`.
        opacity: f64 = 1.0, key("VAL-4", Number { bounds: Bounds::UNIT, unit: "" });
        /// A colour; in a regular function. Its own opacity multiplies `opacity`.
        color: key("VAL-3", Colors,
            |n| match n.look {
                NodeColor::Style(_) => None,
                NodeColor::Color([r, g, b]) => Some([r, g, b, 1.0]),
            },
            |n, [r, g, b, a]| {
                n.look = NodeColor::Color([r, g, b]);
                n.opacity *= a;
            });
    }
}

impl Written {
    /// The node in its row.
    fn node(&self) -> Node {
        let (At::One(at) | At::Two([at, _])) = self.at;
        Node { at, color: self.look.clone(), opacity: self.opacity }
    }
}

/// The description of a node.
static NODE: Table<Written> = Table {
    check: |_, check| match (check.has("style"), check.has("color")) {
        (true, true) => {
            let what = "a node has both style and color".into();
            let remedy = "keep the style in a style function, the color in a regular one".into();
            check.fault_in("color", Problem::Contradiction { what, remedy });
        }
        (false, false) => {
            let expected = "style = \"…\", or color = \"#rrggbb\" in a regular function".into();
            check.fault_in("style", Problem::Missing { expected });
        }
        (true, false) | (false, true) => {}
    },
    ..Written::description("a node", "One node of a transfer function.")
};

/// Place of a node: a number, or a pair of them.
struct AtKind;

const ONE: Number = Number { bounds: Bounds::ANY, unit: "" };
const PAIR: Numbers<2> = Numbers { what: "two numbers [x, y]", bounds: Bounds::ANY, rule: Rule::Free };

impl Shape for AtKind {
    fn expected(&self) -> String {
        format!("{}, or {} in a function over two quantities", ONE.expected(), PAIR.expected())
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [ONE.schema(), PAIR.schema()] })
    }
}

impl Kind for AtKind {
    type Of = At;

    fn read(&self, item: &Item, check: &mut Check) -> Option<At> {
        let one = item.number().map(At::One);
        one.or_else(|| PAIR.of(item).map(At::Two)).or_else(|| check.wrong(item, self.expected()))
    }

    fn write(&self, value: &At) -> Out {
        match value {
            At::One(x) => ONE.write(x),
            At::Two(pair) => PAIR.write(pair),
        }
    }
}

/// The name of a style. It is checked after the whole scene is read.
pub(super) struct StyleName;

const STYLE_NAME: Text = Text { what: "the name of a style" };

impl Shape for StyleName {
    fn expected(&self) -> String {
        STYLE_NAME.expected()
    }

    fn schema(&self) -> Json {
        STYLE_NAME.schema()
    }
}

impl Kind for StyleName {
    type Of = String;

    fn read(&self, item: &Item, check: &mut Check) -> Option<String> {
        let name = STYLE_NAME.read(item, check)?;
        check.refer_to_style(&name, &item.place);
        Some(name)
    }

    fn write(&self, value: &String) -> Out {
        STYLE_NAME.write(value)
    }
}

/// A list of nodes in order: of `at`, or row by row.
pub(super) struct Nodes;

/// The nodes, whatever their order.
const NODES: ListOf<TableOf<Written>> = ListOf { what: "a list of nodes", most: MANY, each: TableOf(&NODE) };

impl Shape for Nodes {
    fn expected(&self) -> String {
        NODES.expected()
    }

    fn schema(&self) -> Json {
        NODES.schema()
    }

    fn item_section(&self) -> Option<Section> {
        NODES.item_section()
    }

    fn most_items(&self) -> Option<usize> {
        NODES.most_items()
    }
}

impl Kind for Nodes {
    type Of = NodeList;

    fn read(&self, item: &Item, check: &mut Check) -> Option<NodeList> {
        let nodes = NODES.read(item, check);
        // The order is looked at in the document, so that it is judged beside other faults of the nodes.
        let at: Vec<Option<At>> = item.list().unwrap_or_default().iter().map(at_of).collect();
        if let Some(i) = mixed(&at) {
            let what = format!("node {i} has {} at, node 0 another", if one(at[i]) { "one number" } else { "a pair" });
            let remedy = "give every node a number, or every node a pair [x, y]".into();
            check.fault_in_list(&format!("[{i}].at"), Problem::Contradiction { what, remedy });
            return None;
        }
        let disorder: Vec<(usize, String)> = at.windows(2).enumerate().filter_map(disordered).collect();
        let ordered = disorder.is_empty();
        for (i, what) in disorder {
            let remedy = match at[i] {
                Some(At::Two(_)) => "put the nodes row by row, each row in non-decreasing order of x, rows of y",
                _ => "put the nodes in non-decreasing order of `at`",
            };
            let problem = Problem::Contradiction { what, remedy: remedy.into() };
            check.fault_in_list(&format!("[{i}].at"), problem);
        }
        let nodes = nodes.filter(|_| ordered)?;
        if matches!(nodes[0].at, At::One(_)) {
            return Some(NodeList::Line(nodes.iter().map(Written::node).collect()));
        }
        match rows(&nodes) {
            Ok(rows) => Some(NodeList::Grid(rows)),
            Err([x, y]) => {
                let what = format!("the nodes are no full grid: there is none at [{x}, {y}]");
                let remedy = "add it, or give each row its own nodes with transfer.rows".into();
                check.fault(&item.place, Problem::Contradiction { what, remedy });
                None
            }
        }
    }

    fn write(&self, value: &NodeList) -> Out {
        let written = |node: &Node, at: At| Written { at, look: node.color.clone(), opacity: node.opacity };
        let nodes: Vec<Written> = match value {
            NodeList::Line(nodes) => nodes.iter().map(|node| written(node, At::One(node.at))).collect(),
            NodeList::Grid(rows) => {
                let at = |row: &Row| if let RowAt::Number(y) = row.at { y } else { 0.0 };
                let grid = rows.iter().flat_map(|row| row.nodes.iter().map(move |node| (node, [node.at, at(row)])));
                grid.map(|(node, at)| written(node, At::Two(at))).collect()
            }
        };
        NODES.write(&nodes)
    }
}

/// Returns the place of the node that an item writes, if it has one.
fn at_of(node: &Item) -> Option<At> {
    let Value::Table(entries) = &node.value else { return None };
    let at = &entries.get("at")?.item;
    at.number().map(At::One).or_else(|| PAIR.of(at).map(At::Two))
}

fn one(at: Option<At>) -> bool {
    matches!(at, Some(At::One(_)))
}

/// The first node whose `at` is of another kind than the first one's.
fn mixed(at: &[Option<At>]) -> Option<usize> {
    let kind = |at: &At| matches!(at, At::One(_));
    let first = kind(at.iter().flatten().next()?);
    at.iter().position(|at| at.as_ref().is_some_and(|at| kind(at) != first))
}

/// The later of two neighbours that stand in the wrong order, and the fault.
fn disordered((i, pair): (usize, &[Option<At>])) -> Option<(usize, String)> {
    match *pair {
        [Some(At::One(before)), Some(At::One(after))] if after < before => {
            Some((i + 1, format!("node {} at {after} stands after node {i} at {before}", i + 1)))
        }
        [Some(At::Two(before)), Some(At::Two(after))] if after[1] < before[1] => {
            let [[a, b], [c, d]] = [after, before];
            Some((i + 1, format!("node {} at [{a}, {b}] stands after node {i} at [{c}, {d}]", i + 1)))
        }
        _ => None,
    }
}

/// Cuts a grid of nodes into its rows: a new one begins where y rises or x falls. Rows must have the same x.
///
/// # Errors
/// A place that one row has and another row lacks.
fn rows(nodes: &[Written]) -> Result<Vec<Row>, [f64; 2]> {
    let mut rows: Vec<(f64, Vec<Node>)> = Vec::new();
    for node in nodes {
        let (At::One(y) | At::Two([_, y])) = node.at;
        let node = node.node();
        match rows.last_mut() {
            Some((at, row)) if *at == y && row.last().is_some_and(|last| last.at <= node.at) => row.push(node),
            _ => rows.push((y, vec![node])),
        }
    }
    // A row that has all x of the first one and differs from it has one that the first lacks.
    let xs = |row: &[Node]| row.iter().map(|node| node.at).collect::<Vec<_>>();
    let first = rows.first().map_or(Vec::new(), |(_, row)| xs(row));
    for (y, row) in &rows {
        if let Some(x) = missing(&first, &xs(row)) {
            return Err([x, *y]);
        }
    }
    if let Some(x) = rows.iter().find_map(|(_, row)| missing(&xs(row), &first)) {
        return Err([x, rows[0].0]);
    }
    Ok(rows.into_iter().map(|(y, nodes)| Row { at: RowAt::Number(y), nodes }).collect())
}

/// The first number of a list that another list lacks, or has less often. Both are in non-decreasing order.
fn missing(full: &[f64], row: &[f64]) -> Option<f64> {
    let mut rest = row.iter().peekable();
    full.iter().copied().find(|x| {
        while rest.next_if(|other| *other < x).is_some() {}
        rest.next_if(|other| *other == x).is_none()
    })
}

/// The description of a row.
static ROW: Table<Row> = Row::description("a row", "One row of nodes of a function over two quantities.");

/// Place of a row: a number, a name, or several labels.
struct RowAtKind;

const ROW_NAME: Text = Text { what: "the name of a label" };
const ROW_LABELS: ListOf<Label> = ListOf { what: "a list of labels", most: MANY, each: Label };

impl Shape for RowAtKind {
    fn expected(&self) -> String {
        format!("{}, {}, or a list of labels, each its id or its name", ONE.expected(), ROW_NAME.expected())
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [ONE.schema(), ROW_NAME.schema(), ROW_LABELS.schema()] })
    }
}

impl Kind for RowAtKind {
    type Of = RowAt;

    fn read(&self, item: &Item, check: &mut Check) -> Option<RowAt> {
        match (item.number(), item.text()) {
            (Some(at), _) => Some(RowAt::Number(at)),
            (None, Some(name)) if !name.is_empty() => Some(RowAt::Name(name.to_owned())),
            _ if item.list().is_some_and(|labels| !labels.is_empty()) => {
                ROW_LABELS.read(item, check).map(RowAt::Labels)
            }
            _ => check.wrong(item, self.expected()),
        }
    }

    fn write(&self, value: &RowAt) -> Out {
        match value {
            RowAt::Number(at) => Out::Number(*at),
            RowAt::Name(name) => Out::Text(name.clone()),
            RowAt::Labels(labels) => ROW_LABELS.write(labels),
        }
    }
}

/// Nodes of one row, each with a number. Their table is described with `nodes`.
struct LineOfNodes;

impl Shape for LineOfNodes {
    fn expected(&self) -> String {
        NODES.expected()
    }

    fn schema(&self) -> Json {
        NODES.schema()
    }

    fn most_items(&self) -> Option<usize> {
        NODES.most_items()
    }
}

impl Kind for LineOfNodes {
    type Of = Vec<Node>;

    fn read(&self, item: &Item, check: &mut Check) -> Option<Vec<Node>> {
        match Nodes.read(item, check)? {
            NodeList::Line(nodes) => Some(nodes),
            NodeList::Grid(_) => {
                let what = "a node of a row has at = [x, y]".into();
                let remedy = "give it the first quantity alone; the row's own `at` is the second".into();
                check.fault_in_list("[0].at", Problem::Contradiction { what, remedy });
                None
            }
        }
    }

    fn write(&self, value: &Vec<Node>) -> Out {
        Nodes.write(&NodeList::Line(value.clone()))
    }
}

/// The rows of a function over two quantities.
pub(super) const ROWS: ListOf<TableOf<Row>> = ListOf { what: "a list of rows", most: MANY, each: TableOf(&ROW) };

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(at: &[[f64; 2]]) -> Result<Vec<(RowAt, Vec<f64>)>, [f64; 2]> {
        let style = NodeColor::Style("wax".into());
        let nodes: Vec<Written> =
            at.iter().map(|&at| Written { at: At::Two(at), look: style.clone(), opacity: 1.0 }).collect();
        Ok(rows(&nodes)?.into_iter().map(|row| (row.at, row.nodes.iter().map(|n| n.at).collect())).collect())
    }

    #[test]
    fn a_grid_is_cut_into_rows() {
        let at = |y, x: &[f64]| (RowAt::Number(y), x.to_vec());
        let two = grid(&[[0.0, 1.0], [9.0, 1.0], [0.0, 2.0], [9.0, 2.0]]).unwrap();
        assert_eq!(two, [at(1.0, &[0.0, 9.0]), at(2.0, &[0.0, 9.0])]);
        // Steps: of x in every row, of y where x begins anew.
        let steps = grid(&[[0.0, 1.0], [5.0, 1.0], [5.0, 1.0], [0.0, 1.0], [5.0, 1.0], [5.0, 1.0]]).unwrap();
        assert_eq!(steps, [at(1.0, &[0.0, 5.0, 5.0]), at(1.0, &[0.0, 5.0, 5.0])]);
    }

    #[test]
    fn what_a_grid_lacks_is_named() {
        assert_eq!(grid(&[[0.0, 1.0], [9.0, 1.0], [0.0, 2.0]]), Err([9.0, 2.0]));
        assert_eq!(grid(&[[0.0, 1.0], [0.0, 2.0], [9.0, 2.0]]), Err([9.0, 1.0]));
        assert_eq!(grid(&[[0.0, 1.0], [4.0, 2.0]]), Err([0.0, 2.0]));
        // A step in one row alone.
        assert_eq!(grid(&[[0.0, 1.0], [0.0, 1.0], [0.0, 2.0]]), Err([0.0, 2.0]));
    }
}
