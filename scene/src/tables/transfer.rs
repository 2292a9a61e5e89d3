//! `[transfer]`: colours or styles, and opacities, over the values or over two quantities.

pub use super::nodes::{Node, NodeColor};
use super::nodes::{NodeList, Nodes, ROWS, Row};
use super::over::{Axis, Over, OverKind};
use super::transfer_rules as rules;
use crate::document::check::Check;
use crate::document::declare::{choices, table};
use crate::document::describe::{Instead, Kind, Shape, Table as Description};
use crate::document::item::Item;
use crate::document::kind::Whole;
use crate::document::out::Out;
use crate::quantity::Quantity;
use serde_json::{Value as Json, json};
use std::path::PathBuf;

table! {
    /// The table `[transfer]`.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Transfer {
        /// Whether nodes carry styles or colours.
        kind: TransferKind = TransferKind::Style, key("STF-3", TransferKind::KIND).needs(&[Quantity::Gradient]);
        /// Quantities that the function is over: the value, or two quantities, such as ["value", "gradient-magnitude"].
        /// Quantities: "value"; "gradient-magnitude", in value per world unit; "label", the id of the part; "k1",
        /// "k2", "mean", "gaussian" and "kv", curvatures in reciprocal world units; or a table with one of the keys
        /// below. Of two "value" is best one: it tells what space is empty.
        over: Over = Over::Value, key("STF-4", OverKind).needs(NEEDS);
        /// Unit of `at` of values; with "normalized" gradient magnitudes are |g|, by
        /// `volume.gradient_range`.
        unit: Unit = Unit::Value, key("VS-11", Unit::KIND);
        /// Nodes in non-decreasing order of `at`. Of two at one value the later one holds at the value itself. Over
        /// two quantities each has at = [x, y], and they form a full grid, row by row.
        ///
        /// A full grid is kept as rows. With no rows either the function is automatic.
        nodes: Option<Vec<Node>> = None, key("STF-3", Nodes,
            |t| t.nodes.clone().map(NodeList::Line),
            |t, list| match list {
                NodeList::Line(nodes) => t.nodes = Some(nodes),
                NodeList::Grid(rows) => t.rows = Some(rows),
            }).absent("`rows`, or an automatic function");
        /// Nodes over two quantities: each row has its own over the first one. Between rows the function is
        /// interpolated; a label without a row shows nothing.
        rows: Option<Vec<Row>> = None, key("STF-4", ROWS).absent("`nodes`");
        /// How a style's opacity and the node's become one.
        transparency: Transparency = Transparency::Illustrative,
            key("STF-9", Transparency::KIND).needs(&[Quantity::GradientMagnitudeRange]);
        /// How two styles mix.
        mix: Mix = Mix::Premultiplied, key("STF-3", Mix::KIND);
        /// Frame of the lit sphere.
        sphere_frame: SphereFrame = SphereFrame::Eye, key("STF-1", SphereFrame::KIND);
        /// How the function is evaluated: exactly, or from a table of so many entries over the range of values, as
        /// graphics hardware does.
        table: Table = Table::Exact, key("STF-3", Evaluation);
    }
}

/// Needs of the quantities of `over`.
const NEEDS: &[Quantity] = &[
    Quantity::Gradient,
    Quantity::GradientMagnitudeRange,
    Quantity::PreviousNormal,
    Quantity::Hessian,
    Quantity::Label,
];

choices! {
    /// Whether nodes carry styles or colours.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum TransferKind {
        /// A style.
        Style = "style",
        /// A colour.
        Regular = "regular",
    }
}

choices! {
    /// Unit of the values of the nodes.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub enum Unit {
        /// Data values, as the file gives them.
        Value = "value",
        /// The volume's range mapped to 0 … 1.
        Normalized = "normalized",
        /// The volume's percentiles, 0 … 100.
        Percentile = "percentile",
    }
}

impl Unit {
    /// Its name in a scene.
    pub fn name(self) -> &'static str {
        Self::KIND.options.iter().find(|option| option.value == self).map_or("", |option| option.name)
    }
}

choices! {
    /// How α_u and α_d become α ([STF-9]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
    pub enum Transparency {
        /// Faces turned to the eye become clearer than rims.
        Illustrative = "illustrative",
        /// Their product.
        Plain = "plain",
    }
}

choices! {
    /// How two styles mix ([STF-3]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
    pub enum Mix {
        /// Colours weighted by opacity.
        Premultiplied = "premultiplied",
        /// Straight colours, as printed.
        Printed = "printed",
    }
}

choices! {
    /// Frame of the lit sphere ([STF-1]).
    #[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
    pub enum SphereFrame {
        /// Eye space.
        Eye = "eye",
        /// Turned so that silhouettes lie on the rim.
        View = "view",
    }
}

/// How the transfer function is evaluated ([STF-3]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Table {
    /// Piecewise linear, exactly.
    Exact,
    /// A table of that many entries, as on a GPU.
    Entries(usize),
}

impl Transfer {
    /// An automatic function of that kind.
    pub fn automatic(kind: TransferKind) -> Self {
        Self { kind, ..Self::default() }
    }

    /// Whether the function is left to be found from the data.
    pub fn is_automatic(&self) -> bool {
        self.nodes.is_none() && self.rows.is_none()
    }

    /// The files of the further volumes that the function is over.
    pub(crate) fn volumes(&self) -> impl Iterator<Item = &PathBuf> {
        self.over.axes().iter().filter_map(|axis| if let Axis::Volume(path) = axis { Some(path) } else { None })
    }

    /// Every node, row by row.
    pub fn all_nodes(&self) -> impl Iterator<Item = &Node> {
        let rows = self.rows.iter().flatten().flat_map(|row| &row.nodes);
        self.nodes.iter().flatten().chain(rows)
    }
}

/// The description of `[transfer]`.
pub(crate) static TABLE: Description<Transfer> = Description {
    instead: &[Instead { one: "rows", others: &["nodes"] }],
    check: |transfer, check| {
        if check.sound(&["kind"]) {
            rules::kind(transfer.kind, check);
        }
        if check.sound(&["over", "nodes", "rows"]) {
            rules::over(transfer, check);
            rules::percentiles(transfer, check);
        }
    },
    ..Transfer::description(
        "[transfer]",
        "Colours or styles, and opacities, over the values or over two quantities. Without `nodes` and `rows` the \
         function is automatic.",
    )
};

/// `"exact"`, or a number of entries.
struct Evaluation;

impl Evaluation {
    /// A table interpolates between two entries at least; 2²⁴ are past what single precision tells apart.
    const ENTRIES: Whole = Whole { lo: 2, hi: 1 << 24 };
}

impl Shape for Evaluation {
    fn expected(&self) -> String {
        format!("\"exact\" or {}", Self::ENTRIES.expected())
    }

    fn schema(&self) -> Json {
        json!({ "anyOf": [{ "const": "exact" }, Self::ENTRIES.schema()] })
    }
}

impl Kind for Evaluation {
    type Of = Table;

    fn read(&self, item: &Item, check: &mut Check) -> Option<Table> {
        match item.text() {
            Some("exact") => Some(Table::Exact),
            _ => match Self::ENTRIES.of(item) {
                Some(n) => Some(Table::Entries(n as usize)),
                None => check.wrong(item, self.expected()),
            },
        }
    }

    fn write(&self, value: &Table) -> Out {
        match value {
            Table::Exact => Out::Text("exact".into()),
            Table::Entries(n) => Out::Whole(*n as u64),
        }
    }
}
