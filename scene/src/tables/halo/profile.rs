//! `profile` of a halo: colour and opacity over the intensity ([HALO-6]).

use crate::document::Problem;
use crate::document::check::Check;
use crate::document::declare::table;
use crate::document::describe::{Kind, Section, Shape, Table};
use crate::document::item::Item;
use crate::document::kind::{Bounds, Colors, ListOf, MANY, Number, TableOf};
use crate::document::out::Out;
use serde::{Deserialize, Serialize};
use serde_json::Value as Json;

table! {
    /// A node of a halo's profile.
    ///
    /// A colour's opacity multiplies `opacity`, so `color` is read after it.
    #[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
    pub struct ProfileNode {
        /// The intensity, from 0 to 1.
        at: f64 = 0.0, key("HALO-6", UNIT).required();
        /// Linear straight colour.
        rgb: [f64; 3] = [0.0; 3];
        /// Opacity: of an emissive halo for a `sampling.reference_length`, of an occlusive one the share of the halo's
        /// colour in what it tints.
        opacity: f64 = 1.0, key("HALO-6", UNIT);
        /// The colour. Its own opacity multiplies `opacity`.
        color: key("VAL-3", Colors,
            |n| { let [r, g, b] = n.rgb; Some([r, g, b, 1.0]) },
            |n, [r, g, b, a]| {
                n.rgb = [r, g, b];
                n.opacity *= a;
            }).required();
    }
}

/// A number from 0 to 1.
const UNIT: Number = Number { bounds: Bounds::UNIT, unit: "" };

/// The description of a node.
static NODE: Table<ProfileNode> =
    ProfileNode::description("a node of a profile", "Colour and opacity of a halo at one intensity.");

/// Nodes in non-decreasing order of `at`.
pub(super) struct Profile;

/// The nodes, whatever their order.
const NODES: ListOf<TableOf<ProfileNode>> = ListOf { what: "a list of nodes", most: MANY, each: TableOf(&NODE) };

impl Shape for Profile {
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

impl Kind for Profile {
    type Of = Vec<ProfileNode>;

    fn read(&self, item: &Item, check: &mut Check) -> Option<Vec<ProfileNode>> {
        in_order(NODES.read(item, check)?, check)
    }

    fn read_over(&self, item: &Item, supplied: Vec<ProfileNode>, check: &mut Check) -> Option<Vec<ProfileNode>> {
        in_order(NODES.read_over(item, supplied, check)?, check)
    }

    fn write(&self, value: &Vec<ProfileNode>) -> Out {
        NODES.write(value)
    }
}

/// The nodes, if they are in order.
fn in_order(nodes: Vec<ProfileNode>, check: &mut Check) -> Option<Vec<ProfileNode>> {
    match nodes.windows(2).position(|pair| pair[1].at < pair[0].at) {
        None => Some(nodes),
        Some(i) => {
            let [before, after] = [nodes[i].at, nodes[i + 1].at];
            let what = format!("node {} at {after} stands after node {i} at {before}", i + 1);
            let remedy = "put the nodes in non-decreasing order of `at`".into();
            check.fault_in_list(&format!("[{}].at", i + 1), Problem::Contradiction { what, remedy });
            None
        }
    }
}
