//! Values at which a transfer function over two quantities can be visible, for any value of the other quantity
//! ([RAY-2], [STF-4]).

use super::Rows;
use crate::tables::Axis;

/// Returns the places and opacities of the nodes of a function over the value. It is above 0 at least wherever the
/// function over two quantities can be above 0. `rounded` converts places to the number type of the samples.
///
/// The function gives the values that rows leave clear exactly, since nodes and steps of every row are its own. If
/// neither quantity is the value, the result is 1, or 0 if nothing is visible at all.
pub fn over_value(at: &[f64], opacity: &[f64], rows: &Rows, rounded: impl Fn(f64) -> f64) -> [Vec<f64>; 2] {
    let shows = |span: &[f64]| span.iter().any(|&a| a > 0.0);
    let rounded = |at: &[f64]| -> Vec<f64> { at.iter().map(|&a| rounded(a)).collect() };
    match &rows.over {
        [Axis::Value, _] => {
            let at = rounded(at);
            let lines: Vec<NodeRow> =
                rows.spans(at.len()).map(|span| NodeRow { at: &at[span.clone()], opacity: &opacity[span] }).collect();
            gate(&lines)
        }
        [_, Axis::Value] => {
            let seen: Vec<f64> = rows.spans(at.len()).map(|span| f64::from(u8::from(shows(&opacity[span])))).collect();
            gate(&[NodeRow { at: &rounded(&rows.at), opacity: &seen }])
        }
        _ => [vec![0.0], vec![f64::from(u8::from(shows(opacity)))]],
    }
}

/// Nodes of one row over the value, at rounded places.
struct NodeRow<'a> {
    at: &'a [f64],
    opacity: &'a [f64],
}

impl NodeRow<'_> {
    /// Whether the row is visible at a value, and just below it, as far as nodes tell. Between two nodes it is
    /// visible if it is at either node.
    fn shows(&self, value: f64) -> RowVisibility {
        let n = self.at.len();
        let visible = |k: usize| self.opacity[k] > 0.0;
        // The first node at or above the value, and the first above it.
        let first = (0..n).find(|&k| self.at[k] >= value).unwrap_or(n);
        let after = (0..n).find(|&k| self.at[k] > value).unwrap_or(n);
        let between = |k: usize| match k {
            0 => visible(0),
            k if k == n => visible(n - 1),
            k => visible(k - 1) || visible(k),
        };
        RowVisibility { below: between(first), here: if after > first { visible(after - 1) } else { between(first) } }
    }
}

/// The visibility of a row at a value.
#[derive(Clone, Copy)]
struct RowVisibility {
    below: bool,
    here: bool,
}

/// Returns a function that is 1 between two nodes if some row is visible there. It rises from 0 if no row is visible at
/// the lower node. At a node, the function is 1 if some row is visible at the node. Each node stands twice, so that a
/// step stays a step.
fn gate(lines: &[NodeRow<'_>]) -> [Vec<f64>; 2] {
    let mut at: Vec<f64> = lines.iter().flat_map(|line| line.at).copied().collect();
    at.sort_by(f64::total_cmp);
    at.dedup();
    let mut nodes = [Vec::new(), Vec::new()];
    for value in at {
        let shows: Vec<RowVisibility> = lines.iter().map(|line| line.shows(value)).collect();
        let any = |seen: fn(&RowVisibility) -> bool| f64::from(u8::from(shows.iter().any(seen)));
        for open in [any(|s| s.below), any(|s| s.here)] {
            nodes[0].push(value);
            nodes[1].push(open);
        }
    }
    nodes
}
