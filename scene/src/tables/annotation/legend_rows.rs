//! The rows of a legend.

use crate::tables::{Axis, Node, NodeColor, RowAt, Scene, Transfer};

/// A row of a legend.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LegendRow<'a> {
    /// The style or the colour.
    pub look: &'a NodeColor,
    /// The values or labels that have this look.
    pub of: LegendEntry<'a>,
}

/// The values or labels that a row of a legend stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LegendEntry<'a> {
    /// A value, in the unit of the function.
    Value(f64),
    /// A label, or several.
    Labels(&'a RowAt),
}

impl Scene {
    /// Whether a legend has rows of labels.
    pub fn legend_lists_labels(&self) -> bool {
        let transfer = self.transfer.as_ref().filter(|_| self.annotations.legend.is_some());
        transfer.is_some_and(|transfer| transfer.over.second() == Some(&Axis::Label))
    }
}

impl Transfer {
    /// Returns the rows of a legend: of each run of visible nodes of one look, or of each visible row of labels, the most
    /// opaque node. A node without opacity ends a run. Returns none over two quantities other than labels. An
    /// automatic function has no rows.
    pub fn legend_rows(&self) -> Option<Vec<LegendRow<'_>>> {
        match self.over.second() {
            None => {
                let is_run = |a: &Node, b: &Node| a.opacity > 0.0 && b.opacity > 0.0 && a.color == b.color;
                let runs = self.nodes.as_deref().unwrap_or_default().chunk_by(is_run).filter_map(most_opaque);
                Some(runs.map(|node| LegendRow { look: &node.color, of: LegendEntry::Value(node.at) }).collect())
            }
            Some(Axis::Label) => {
                let rows = self.rows.iter().flatten();
                let seen = rows.filter_map(|row| Some((most_opaque(&row.nodes)?, &row.at)));
                Some(seen.map(|(node, at)| LegendRow { look: &node.color, of: LegendEntry::Labels(at) }).collect())
            }
            Some(_) => None,
        }
    }
}

/// The first of the most opaque nodes; none if no node is visible.
fn most_opaque(nodes: &[Node]) -> Option<&Node> {
    let visible = nodes.iter().filter(|node| node.opacity > 0.0);
    visible.reduce(|most, node| if node.opacity > most.opacity { node } else { most })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::{Overrides, parse};
    use std::path::Path;

    /// The names of the styles of rows, with their values.
    fn rows(nodes: &str) -> Vec<(String, f64)> {
        let text = format!("drypoint = 1\n[volume]\nfile = \"a.nrrd\"\n[transfer]\nnodes = [{nodes}]\n");
        let scene = parse(&text, Path::new("scene.toml"), &Overrides::default()).unwrap();
        let transfer = scene.transfer.unwrap();
        let found = transfer.legend_rows().unwrap().into_iter().map(|row| match (row.look, row.of) {
            (NodeColor::Style(name), LegendEntry::Value(at)) => (name.clone(), at),
            _ => unreachable!("the function is of styles over the value"),
        });
        found.collect()
    }

    #[test]
    fn visible_nodes_of_one_look_share_a_row() {
        let node =
            |at: f64, style: &str, opacity: f64| format!("{{ at = {at}, style = \"{style}\", opacity = {opacity} }}, ");
        let wax = |at: f64| ("wax".to_owned(), at);
        let ramp = node(1.0, "wax", 0.0) + &node(2.0, "wax", 0.2) + &node(3.0, "wax", 0.9) + &node(4.0, "metal", 0.9);
        assert_eq!(rows(&ramp), [wax(3.0), ("metal".into(), 4.0)]);
        // Two tents of one style are two structures.
        let tents = [(1.0, 0.0), (2.0, 0.5), (3.0, 0.0), (4.0, 0.5)].map(|(at, opacity)| node(at, "wax", opacity));
        assert_eq!(rows(&tents.concat()), [wax(2.0), wax(4.0)]);
        assert_eq!(rows(&node(1.0, "wax", 0.0)), []);
    }

    #[test]
    fn a_row_of_labels_has_a_row_if_it_is_visible() {
        let row = |at: &str, opacity: f64| {
            format!("{{ at = {at}, nodes = [{{ at = 1, style = \"wax\", opacity = {opacity} }}] }}, ")
        };
        let text = format!(
            "drypoint = 1\n[volume]\nfile = \"a.nrrd\"\nlabels = \"l.nrrd\"\n[legend]\nnames = [\"a\", \"b\"]\n\
             [transfer]\nover = [\"value\", \"label\"]\nrows = [{}{}{}]\n",
            row("1", 0.5),
            row("2", 0.0),
            row("[3, 4]", 1.0)
        );
        let scene = parse(&text, Path::new("scene.toml"), &Overrides::default()).unwrap();
        assert!(scene.legend_lists_labels());
        let transfer = scene.transfer.unwrap();
        let labels = transfer.legend_rows().unwrap().into_iter().map(|row| match row.of {
            LegendEntry::Labels(at) => at.each().len(),
            LegendEntry::Value(_) => 0,
        });
        assert_eq!(labels.collect::<Vec<_>>(), [1, 2]);
    }
}
