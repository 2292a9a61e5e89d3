//! A function that is evaluated from a table ([STF-3]).

use super::NodePlace;
use crate::number::Real;

/// i at each entry of a table. It converts a place between entries to a place between nodes.
#[derive(Clone, Debug)]
pub struct IndexTable<R> {
    index: Vec<R>,
    /// N − 1, the last node.
    last: R,
}

impl<R: Real> IndexTable<R> {
    /// A table of i at each entry, for a function of N nodes.
    pub fn new(index: &[f64], nodes: usize) -> Self {
        let index = index.iter().map(|&i| R::from_f64(i)).collect();
        Self { index, last: R::from_f64(nodes.saturating_sub(1) as f64) }
    }

    /// Interpolates i linearly between two entries and splits it into node and fraction. The result is inexact
    /// between entries around a step of the function. The styles on both sides mix there, and so do styles of nodes
    /// inside the step.
    #[inline]
    pub fn between_nodes(&self, entry: &NodePlace<R>) -> NodePlace<R> {
        let i = self.index[entry.node];
        let i = if entry.w == R::ZERO { i } else { R::lerp(i, self.index[entry.node + 1], entry.w) };
        // Rounding can lead beyond the last node, behind which there is none.
        let (node, w) = if i >= self.last { (self.last.to_index(), R::ZERO) } else { i.split() };
        NodePlace { node, w, alpha_u: entry.alpha_u }
    }

    /// Size in bytes, without the entries' opacities.
    pub fn bytes(&self) -> usize {
        size_of_val(self.index.as_slice())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::transfer::Piecewise;
    use proptest::prelude::*;

    #[test]
    fn between_entries_by_hand() {
        let table = IndexTable::<f64>::new(&[0.0, 0.5, 3.0, 3.0], 4);
        let at = |node, w| table.between_nodes(&NodePlace { node, w, alpha_u: 0.25 });
        let place = |node, w| NodePlace { node, w, alpha_u: 0.25 };
        assert_eq!(
            [at(0, 0.5), at(1, 0.0), at(1, 0.8), at(3, 0.0)],
            [place(0, 0.25), place(0, 0.5), place(2, 0.5), place(3, 0.0)]
        );
    }

    proptest! {
        /// The table equals the function if every node is an entry.
        #[test]
        fn a_table_of_its_own_nodes_is_exact(s in -2.0f64..9.0) {
            let at: Vec<f64> = (0..8).map(f64::from).collect();
            let opacity = [0.5, 0.25, 1.0, 0.75, 0.125, 0.5, 1.0, 0.25];
            let function = Piecewise::new(&at, &opacity).unwrap();
            let table = IndexTable::new(&at, at.len());
            let exact = function.locate(s).unwrap();
            let read = table.between_nodes(&exact);
            prop_assert!((read.node as f64 + read.w - (exact.node as f64 + exact.w)).abs() < 1e-14);
        }
    }
}
