//! `[transfer]`: colours or styles, and opacities, over the values.

use crate::file::Problem;
use crate::file::check::Check;
use crate::file::describe::{Key, Kind, Later, Section, Shape, Slot, Table as Description};
use crate::file::item::{Item, Value};
use crate::file::kind::{Bounds, Choice, ChoiceOption, Colors, ListOf, Number, TableOf, Text, Whole};
use crate::file::out::Out;
use crate::plan::{Pass, Quantity};
use crate::tables::Projection;
use serde_json::{Value as Json, json};

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

/// The description of `[transfer]`.
pub(crate) static TABLE: Description<Transfer> = Description {
    later: &[Later { name: "rows", tag: "STF-4" }],
    check: |transfer, check| {
        if !check.sound(&["kind"]) {
            return;
        }
        let (wrong, right, kind) = match transfer.kind {
            TransferKind::Style => ("color", "style", "style"),
            TransferKind::Regular => ("style", "color", "regular"),
        };
        let mut i = 0;
        while check.has(&format!("nodes[{i}]")) {
            let key = format!("nodes[{i}].{wrong}");
            if check.has(&key) && !check.has(&format!("nodes[{i}].{right}")) {
                let what = format!("a node of a {kind} function has a {wrong}");
                let remedy = format!(
                    "give it a {right}, or write kind = {:?}",
                    if wrong == "color" { "regular" } else { "style" }
                );
                check.fault_in(&key, Problem::Contradiction { what, remedy });
            }
            if transfer.unit == Unit::Percentile
                && let Some(node) = transfer.nodes.as_ref().and_then(|nodes| nodes.get(i))
                && !(0.0..=100.0).contains(&node.at)
            {
                let what = format!("{} is no percentile", node.at);
                let remedy = "write a number from 0 to 100, or another transfer.unit".into();
                check.fault_in(&format!("nodes[{i}].at"), Problem::Contradiction { what, remedy });
            }
            i += 1;
        }
    },
    asks: |scene, asks| {
        let Some(transfer) = &scene.transfer else { return };
        asks.need(Quantity::Value, "transfer function", "transfer");
        if transfer.nodes.is_none() {
            asks.pass(Pass::AutomaticTransfer, "automatic function", "transfer.nodes");
        }
        if transfer.kind == TransferKind::Style {
            asks.need(Quantity::Gradient, "styles", "transfer.kind");
            if transfer.transparency == Transparency::Illustrative {
                asks.need(Quantity::GradientMagnitudeRange, "illustrative transparency", "transfer.transparency");
            }
        }
    },
    idle: |scene, _, idle| {
        let Some(transfer) = &scene.transfer else { return };
        if transfer.nodes.is_none() {
            idle.key("transfer.unit", "an automatic function has no nodes to measure");
        }
        if transfer.kind == TransferKind::Regular {
            for key in ["transfer.transparency", "transfer.mix", "transfer.sphere_frame"] {
                idle.key(key, "it acts on styles, and the function is regular");
            }
        } else if matches!(scene.camera.projection, Projection::Orthographic { .. }) {
            idle.key("transfer.sphere_frame", "both frames are the same in an orthographic picture");
        }
    },
    ..Description::new(
        "[transfer]",
        "Colours or styles, and opacities, over the values. Without `nodes` the function is automatic.",
        || Transfer::automatic(TransferKind::Style),
        &[
            Key::new(
                "kind",
                "STF-3",
                "What a node carries.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new("style", TransferKind::Style, "A style."),
                            ChoiceOption::new("regular", TransferKind::Regular, "A colour."),
                        ],
                        later: &[],
                    },
                    get: |t: &Transfer| Some(t.kind),
                    set: |t, v| t.kind = v,
                },
            )
            .needs(&[Quantity::Gradient]),
            Key::new(
                "over",
                "STF-4",
                "The quantity that the function is over.",
                &Slot { kind: Over, get: |_| Some(()), set: |_, ()| {} },
            ),
            Key::new(
                "unit",
                "VS-11",
                "What `at` is measured in.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new("value", Unit::Value, "Data values, as the file gives them."),
                            ChoiceOption::new("normalized", Unit::Normalized, "The volume's range mapped to 0 … 1."),
                            ChoiceOption::new("percentile", Unit::Percentile, "The volume's percentiles, 0 … 100."),
                        ],
                        later: &[],
                    },
                    get: |t: &Transfer| Some(t.unit),
                    set: |t, v| t.unit = v,
                },
            ),
            Key::new(
                "nodes",
                "STF-3",
                "Nodes in non-decreasing order of `at`. Of two at one value the later one holds at the value itself.",
                &Slot { kind: Nodes, get: |t: &Transfer| t.nodes.clone(), set: |t, v| t.nodes = Some(v) },
            )
            .absent("an automatic function"),
            Key::new(
                "transparency",
                "STF-9",
                "How a style's opacity and the node's become one.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new(
                                "illustrative",
                                Transparency::Illustrative,
                                "Faces turned to the eye become clearer than rims.",
                            ),
                            ChoiceOption::new("plain", Transparency::Plain, "Their product."),
                        ],
                        later: &[],
                    },
                    get: |t: &Transfer| Some(t.transparency),
                    set: |t, v| t.transparency = v,
                },
            )
            .needs(&[Quantity::GradientMagnitudeRange]),
            Key::new(
                "mix",
                "STF-3",
                "How two styles mix.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new("premultiplied", Mix::Premultiplied, "Colours weighted by opacity."),
                            ChoiceOption::new("printed", Mix::Printed, "Straight colours, as printed."),
                        ],
                        later: &[],
                    },
                    get: |t: &Transfer| Some(t.mix),
                    set: |t, v| t.mix = v,
                },
            ),
            Key::new(
                "sphere_frame",
                "STF-1",
                "Frame of the lit sphere.",
                &Slot {
                    kind: Choice {
                        options: &[
                            ChoiceOption::new("eye", SphereFrame::Eye, "Eye space."),
                            ChoiceOption::new("view", SphereFrame::View, "Turned so that silhouettes lie on the rim."),
                        ],
                        later: &[],
                    },
                    get: |t: &Transfer| Some(t.sphere_frame),
                    set: |t, v| t.sphere_frame = v,
                },
            ),
            Key::new(
                "table",
                "STF-3",
                "How the function is evaluated.",
                &Slot { kind: Evaluation, get: |t: &Transfer| Some(t.table), set: |t, v| t.table = v },
            ),
        ],
    )
};

/// The description of a node. A colour's opacity multiplies `opacity`, so `color` is read after it.
static NODE: Description<Node> = Description {
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
    ..Description::new(
        "a node",
        "One node of a transfer function.",
        || Node { at: 0.0, color: NodeColor::Style(String::new()), opacity: 1.0 },
        &[
            Key::new(
                "at",
                "STF-3",
                "The value.",
                &Slot {
                    kind: Number { bounds: Bounds::ANY, unit: "" },
                    get: |n: &Node| Some(n.at),
                    set: |n, v| n.at = v,
                },
            )
            .required(),
            Key::new(
                "style",
                "STF-3",
                "The name of a style; in a style function.",
                &Slot {
                    kind: StyleName,
                    get: |n: &Node| match &n.color {
                        NodeColor::Style(name) => Some(name.clone()).filter(|name| !name.is_empty()),
                        NodeColor::Color(_) => None,
                    },
                    set: |n, v| n.color = NodeColor::Style(v),
                },
            ),
            Key::new(
                "opacity",
                "VAL-4",
                "Opacity for a `sampling.reference_length`.",
                &Slot {
                    kind: Number { bounds: Bounds::UNIT, unit: "" },
                    get: |n: &Node| Some(n.opacity),
                    set: |n, v| n.opacity = v,
                },
            ),
            Key::new(
                "color",
                "VAL-3",
                "A colour; in a regular function. Its own opacity multiplies `opacity`.",
                &Slot {
                    kind: Colors,
                    get: |n: &Node| match n.color {
                        NodeColor::Style(_) => None,
                        NodeColor::Color([r, g, b]) => Some([r, g, b, 1.0]),
                    },
                    set: |n, [r, g, b, a]| {
                        n.color = NodeColor::Color([r, g, b]);
                        n.opacity *= a;
                    },
                },
            ),
        ],
    )
};

/// A list of nodes in order.
struct Nodes;

/// The nodes, whatever their order.
const NODES: ListOf<TableOf<Node>> = ListOf { what: "a list of nodes", each: TableOf(&NODE) };

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
}

impl Kind for Nodes {
    type Of = Vec<Node>;

    fn read(&self, item: &Item, check: &mut Check) -> Option<Vec<Node>> {
        let nodes = NODES.read(item, check);
        // The order is looked at in the document, so that it is judged beside other faults of the nodes.
        let at = |node: &Item| match &node.value {
            Value::Table(entries) => entries.get("at").and_then(|entry| entry.item.number()),
            _ => None,
        };
        let values: Vec<Option<f64>> = item.list().unwrap_or_default().iter().map(at).collect();
        let mut ordered = true;
        for (i, pair) in values.windows(2).enumerate() {
            if let [Some(before), Some(after)] = pair
                && after < before
            {
                ordered = false;
                let what = format!("node {} at {after} stands after node {i} at {before}", i + 1);
                let remedy = "put the nodes in non-decreasing order of `at`".into();
                let tail = format!("[{}].at", i + 1);
                check.fault_in_list(&tail, Problem::Contradiction { what, remedy });
            }
        }
        nodes.filter(|_| ordered)
    }

    fn write(&self, value: &Vec<Node>) -> Out {
        NODES.write(value)
    }
}

/// The name of a style, which must be known once the whole scene is read.
struct StyleName;

/// A name.
const NAME: Text = Text { what: "the name of a style" };

impl Shape for StyleName {
    fn expected(&self) -> String {
        NAME.expected()
    }

    fn schema(&self) -> Json {
        NAME.schema()
    }
}

impl Kind for StyleName {
    type Of = String;

    fn read(&self, item: &Item, check: &mut Check) -> Option<String> {
        let name = NAME.read(item, check)?;
        check.refer_to_style(&name, &item.place);
        Some(name)
    }

    fn write(&self, value: &String) -> Out {
        NAME.write(value)
    }
}

/// `"value"`; further quantities and pairs of them are not built yet.
struct Over;

impl Over {
    const ONE: Choice<()> = Choice {
        options: &[ChoiceOption::new("value", (), "The value of the volume.")],
        later: &[
            ("gradient-magnitude", "STF-4"),
            ("label", "STF-4"),
            ("k1", "STF-4"),
            ("k2", "STF-4"),
            ("mean", "STF-4"),
            ("gaussian", "STF-4"),
            ("kv", "STF-4"),
        ],
    };
}

impl Shape for Over {
    fn expected(&self) -> String {
        Self::ONE.expected()
    }

    fn schema(&self) -> Json {
        Self::ONE.schema()
    }
}

impl Kind for Over {
    type Of = ();

    fn read(&self, item: &Item, check: &mut Check) -> Option<()> {
        match item.value {
            Value::List(_) => check.not_built(&item.place, "a function over two quantities".into(), "STF-4"),
            Value::Table(_) => check.not_built(&item.place, "a function over another quantity".into(), "STF-4"),
            _ => Self::ONE.read(item, check),
        }
    }

    fn write(&self, value: &()) -> Out {
        Self::ONE.write(value)
    }
}

/// `"exact"`; a number of entries is what a GPU does, and nothing here evaluates it yet.
struct Evaluation;

impl Evaluation {
    /// A table interpolates between two entries at least; 2²⁴ are past what single precision tells apart.
    const ENTRIES: Whole = Whole { lo: 2, hi: 1 << 24 };
}

impl Shape for Evaluation {
    fn expected(&self) -> String {
        "\"exact\"".into()
    }

    fn schema(&self) -> Json {
        json!({ "const": "exact" })
    }
}

impl Kind for Evaluation {
    type Of = Table;

    fn read(&self, item: &Item, check: &mut Check) -> Option<Table> {
        match item.text() {
            Some("exact") => Some(Table::Exact),
            _ => match Self::ENTRIES.of(item) {
                Some(n) => check.not_built(&item.place, format!("a table of {n} entries"), "STF-3"),
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
