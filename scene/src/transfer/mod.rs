//! Transfer functions over data values: piecewise-linear nodes, and what a range of values can make visible ([RAY-2]).

use crate::tables::{Node, NodeColor, Transfer, Unit};
use crate::volume::Volume;
use crate::volume::histogram::quantiles;

/// The nodes of a transfer function over data values, in non-decreasing order ([STF-3]).
#[derive(Clone, Debug, PartialEq)]
pub struct Nodes<C> {
    /// The value of each node.
    pub at: Vec<f64>,
    /// α_u of each node, per reference length.
    pub opacity: Vec<f64>,
    /// What each node shows: an index j into the distinct styles, or a linear straight colour.
    pub color: Vec<C>,
}

/// A transfer function of either kind, over data values.
#[derive(Clone, Debug, PartialEq)]
pub enum Function {
    /// Styles by their index in [`Function::Style::names`].
    Style {
        /// The nodes.
        nodes: Nodes<usize>,
        /// The M distinct styles in the order of first use: the index function ift of 4.1 maps node i to `color[i]`.
        names: Vec<String>,
    },
    /// Linear straight colours.
    Regular(Nodes<[f64; 3]>),
}

impl Function {
    /// Turns the nodes of a scene into nodes over the values of a volume. `None` where the scene leaves the function
    /// to be found from the data.
    pub fn new(transfer: &Transfer, range: [f64; 2], volume: &Volume) -> Option<Self> {
        let nodes = transfer.nodes.as_ref()?;
        let at = values(nodes, transfer.unit, range, volume);
        let opacity = nodes.iter().map(|n| n.opacity).collect();
        let mut names: Vec<String> = Vec::new();
        let mut styles = Vec::new();
        let mut colors = Vec::new();
        for node in nodes {
            match &node.color {
                NodeColor::Color(c) => colors.push(*c),
                NodeColor::Style(name) => {
                    let j = names.iter().position(|n| n == name).unwrap_or_else(|| {
                        names.push(name.clone());
                        names.len() - 1
                    });
                    styles.push(j);
                }
            }
        }
        Some(if names.is_empty() {
            Self::Regular(Nodes { at, opacity, color: colors })
        } else {
            Self::Style { nodes: Nodes { at, opacity, color: styles }, names }
        })
    }

    /// Whether a value in [lo, hi] can have α_u > 0. `rounded` gives the value of a node as samples are compared with it,
    /// in their number type: f32 can round a node down to a value that a brick reaches.
    pub fn can_be_visible(&self, range: [f64; 2], rounded: impl Fn(f64) -> f64) -> bool {
        match self {
            Self::Style { nodes, .. } => can_be_visible(&nodes.at, &nodes.opacity, range, rounded),
            Self::Regular(nodes) => can_be_visible(&nodes.at, &nodes.opacity, range, rounded),
        }
    }
}

/// Whether a piecewise-linear opacity is above 0 somewhere on [lo, hi].
///
/// On a closed range it is 0 throughout exactly if both nodes of every segment that the range touches have opacity 0;
/// a segment touched in its end alone counts, which only keeps a brick that shows nothing. Rounding keeps nodes in order.
fn can_be_visible(at: &[f64], opacity: &[f64], [lo, hi]: [f64; 2], rounded: impl Fn(f64) -> f64) -> bool {
    let n = at.len();
    // The first node at or above lo and the last at or below hi, widened by the nodes on the other side of the ends.
    let first = at.partition_point(|&a| rounded(a) < lo).saturating_sub(1);
    let last = at.partition_point(|&a| rounded(a) <= hi).min(n - 1);
    opacity[first..=last].iter().any(|&a| a > 0.0)
}

/// The values that nodes stand at.
fn values(nodes: &[Node], unit: Unit, [lo, hi]: [f64; 2], volume: &Volume) -> Vec<f64> {
    match unit {
        Unit::Value => nodes.iter().map(|n| n.at).collect(),
        Unit::Normalized => nodes.iter().map(|n| lo + n.at * (hi - lo)).collect(),
        Unit::Percentile => {
            let shares: Vec<f64> = nodes.iter().map(|n| n.at / 100.0).collect();
            quantiles(volume, &shares)
        }
    }
}

#[cfg(test)]
mod tests {
    fn can_be_visible(at: &[f64], opacity: &[f64], range: [f64; 2]) -> bool {
        super::can_be_visible(at, opacity, range, |a| a)
    }

    #[test]
    fn a_node_is_where_it_is_rounded_to() {
        // 1000.1 is 1000.0999756 in f32, up to where a brick can reach.
        let (at, opacity, range) = ([1000.1, 1000.1], [0.0, 0.5], [1000.0, f64::from(1000.1f32)]);
        assert!(!can_be_visible(&at, &opacity, range));
        assert!(super::can_be_visible(&at, &opacity, range, |a| f64::from(a as f32)));
    }

    #[test]
    fn visible_ranges_of_a_step_on_a_voxel_value() {
        // 0 up to 100, then a step: the later node holds at 100 itself.
        let (at, opacity) = ([0.0, 100.0, 100.0, 255.0], [0.0, 0.0, 0.5, 0.5]);
        let visible = |lo, hi| can_be_visible(&at, &opacity, [lo, hi]);
        assert!(!visible(0.0, 99.0));
        assert!(visible(0.0, 100.0));
        assert!(visible(100.0, 100.0));
        assert!(visible(300.0, 400.0), "beyond the last node the last one holds");
        assert!(!visible(-10.0, -5.0));
    }

    #[test]
    fn a_ramp_is_visible_inside_although_its_ends_are_far() {
        let (at, opacity) = ([0.0, 10.0, 20.0], [0.0, 1.0, 0.0]);
        assert!(can_be_visible(&at, &opacity, [4.0, 5.0]));
        assert!(can_be_visible(&at, &opacity, [15.0, 16.0]));
        assert!(!can_be_visible(&at, &opacity, [21.0, 22.0]));
        assert!(can_be_visible(&[5.0], &[0.1], [-1e9, 1e9]));
        assert!(!can_be_visible(&[5.0], &[0.0], [-1e9, 1e9]));
    }
}
