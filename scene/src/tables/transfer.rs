//! `[transfer]`: colours or styles, and opacities, over the values.

/// The table `[transfer]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Transfer {
    /// Styles or colours.
    pub kind: TransferKind,
    /// What `at` is measured in.
    pub unit: Unit,
    /// Nodes in non-decreasing order of `at`; none: an automatic function.
    pub nodes: Option<Vec<Node>>,
    /// How styles become opacity ([STF-9]).
    pub transparency: Transparency,
    /// How two styles mix ([STF-3]).
    pub mix: Mix,
    /// Frame of the lit sphere ([STF-1]).
    pub sphere_frame: SphereFrame,
    /// Exact evaluation or a table ([STF-3]).
    pub table: Table,
}

/// What a node carries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TransferKind {
    /// A style ([STF-3]).
    Style,
    /// A colour ([STF-11]).
    Regular,
}

/// What the values of the nodes are measured in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Data values, after slope and intercept ([VAL-1]).
    Value,
    /// The volume's range mapped to [0, 1] ([VAL-1]).
    Normalized,
    /// The volume's percentiles.
    Percentile,
}

/// One node of a transfer function.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Value.
    pub at: f64,
    /// Style or colour.
    pub color: NodeColor,
    /// α_u per reference length; an `#rrggbbaa` colour has already been multiplied in.
    pub opacity: f64,
}

/// What a node shows.
#[derive(Clone, Debug, PartialEq)]
pub enum NodeColor {
    /// The name of a style.
    Style(String),
    /// Linear straight red, green, blue.
    Color([f64; 3]),
}

/// How α_u and α_d become α ([STF-9]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Transparency {
    /// Eq. 2.
    Illustrative,
    /// α_d · α_u.
    Plain,
}

/// How two styles mix ([STF-3]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mix {
    /// Premultiplied.
    Premultiplied,
    /// Straight RGBA, as printed in 4.1.
    Printed,
}

/// Frame of the lit sphere ([STF-1]).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SphereFrame {
    /// Eye space; the paper's.
    Eye,
    /// Eye space turned so that v is +z.
    View,
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
        Self {
            kind,
            unit: Unit::Value,
            nodes: None,
            transparency: Transparency::Illustrative,
            mix: Mix::Premultiplied,
            sphere_frame: SphereFrame::Eye,
            table: Table::Exact,
        }
    }
}
