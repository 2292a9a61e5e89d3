//! Values that a transfer function shows, for strokes without an iso-value ([HATCH-16]).

use crate::transfer::{NodesError, Piecewise};
use drypoint_scene::transfer::Function;

/// The opacity of a transfer function of the value, as strokes in what it shows read it ([HATCH-16]).
#[derive(Clone, Debug)]
pub struct VisibleValues<'a> {
    /// Values of the nodes, and their opacities.
    nodes: [&'a [f64]; 2],
    opacity: Piecewise<f64>,
}

impl<'a> VisibleValues<'a> {
    /// Reads a function of the value; none for a function of two quantities.
    ///
    /// # Errors
    /// Nodes that make no function.
    pub fn new(function: &'a Function) -> Result<Option<Self>, NodesError> {
        let (at, opacity, None) = function.nodes() else { return Ok(None) };
        Ok(Some(Self { nodes: [at, opacity], opacity: Piecewise::new(at, opacity)? }))
    }

    /// Whether the function shows something in a closed range of values: at a node inside, or at an end.
    pub fn has(&self, [lo, hi]: [f64; 2]) -> bool {
        let [at, opacity] = self.nodes;
        let within = at.partition_point(|&a| a < lo)..at.partition_point(|&a| a <= hi);
        opacity[within].iter().any(|&a| a > 0.0) || [lo, hi].into_iter().any(|value| self.opacity(value) > 0.0)
    }

    /// Returns α of a value.
    pub fn opacity(&self, value: f64) -> f64 {
        self.opacity.locate(value).map_or(0.0, |place| place.alpha_u)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use drypoint_scene::transfer::Nodes;

    /// α is 0 up to 1, ½ at 2 and 0 again from 3 on: a range shows something if it meets the open interval (1, 3).
    #[test]
    fn a_range_shows_something_where_the_hat_is_above_it() {
        let (at, opacity) = (vec![0.0, 1.0, 2.0, 3.0], vec![0.0, 0.0, 0.5, 0.0]);
        let function = Function::Regular(Nodes { at, opacity, color: vec![[0.0; 3]; 4], index: None, rows: None });
        let shown = VisibleValues::new(&function).unwrap().unwrap();
        assert_eq!([0.5, 1.5, 2.0, 2.5, 9.0].map(|v| shown.opacity(v)), [0.0, 0.25, 0.5, 0.25, 0.0]);
        let ranges =
            [([0.0, 1.0], false), ([0.0, 1.1], true), ([1.5, 2.5], true), ([0.0, 9.0], true), ([3.0, 9.0], false)];
        for (range, has) in ranges {
            assert_eq!(shown.has(range), has, "{range:?}");
        }
    }
}
