//! Transfer functions over data values and other quantities: piecewise-linear nodes, and the visibility of a range of
//! values ([RAY-2]).

pub mod gate;
mod table;

use crate::tables::{Axis, Node, NodeColor, Over, Row, Stand, Table, Transfer, Unit};
use crate::volume::Volume;
use crate::volume::histogram::quantiles;
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;
use std::ops::Range;

/// The nodes of a transfer function ([STF-3]). Over two quantities, nodes stand row after row ([STF-4]).
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Nodes<C> {
    /// The value, or the first of the two quantities, at each node; in non-decreasing order within each row.
    pub at: Vec<f64>,
    /// α_u of each node, per reference length.
    pub opacity: Vec<f64>,
    /// The appearance of each node: an index j into the distinct styles, or a linear straight colour.
    pub color: Vec<C>,
    /// i of each entry of `at` and `opacity` if these are a table; none: `at` and `opacity` are the nodes themselves.
    pub index: Option<Vec<f64>>,
    /// The nodes as rows of a function over two quantities. None: the nodes are one line over the value.
    pub rows: Option<Rows>,
}

/// The rows of a transfer function over two quantities.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rows {
    /// The quantities: the first along a row, the second from row to row.
    pub over: [Axis<u32>; 2],
    /// The position of each row: in non-decreasing order, for labels in ascending order of their ids.
    pub at: Vec<f64>,
    /// The first node of each row.
    pub first: Vec<usize>,
    /// Whether gradient magnitudes are |g| of [VAL-2], not ‖g‖ in value per world unit.
    pub normalized: bool,
}

/// A transfer function of either kind.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
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

/// A name or an id that a transfer function gives and that makes no function.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum FunctionError {
    /// No label has that name.
    #[error("there is no label {name:?}")]
    UnknownLabel {
        /// The name.
        name: String,
        /// The row that stands at the label; none where the scene asks for a distance to the label.
        row: Option<usize>,
    },
    /// Two rows stand at one label, by its name and by its id or another name.
    #[error("row {row} is for label {id}, which has a row already")]
    LabelTwice {
        /// The later of the two.
        row: usize,
        /// The label.
        id: u32,
    },
}

impl Function {
    /// The function that shows nothing, for a scene that does not draw the volume itself.
    pub fn nothing() -> Self {
        Self::Regular(Nodes { at: vec![0.0], opacity: vec![0.0], color: vec![[0.0; 3]], index: None, rows: None })
    }

    /// Turns the nodes of a scene into nodes over the values of a volume. `id_of` knows the labels by their names.
    /// `None` if the scene leaves the function to be found from the data.
    ///
    /// # Errors
    /// Every label that `id_of` does not know; if it knows them all, a label that has two rows.
    pub fn new(
        transfer: &Transfer,
        range: [f64; 2],
        volume: &Volume,
        id_of: &dyn Fn(&str) -> Option<u32>,
    ) -> Result<Option<Self>, Vec<FunctionError>> {
        if transfer.is_automatic() {
            return Ok(None);
        }
        let to_values = |at: Vec<f64>, axis: Option<&Axis>| match axis {
            None | Some(Axis::Value) => values(at, transfer.unit, range, volume),
            Some(_) => at,
        };
        // Lines of nodes: one per row over two quantities, in the order in which rows are kept, else a single one.
        let (lines, rows) = match (&transfer.over, &transfer.rows) {
            (Over::Two(axes), Some(rows)) => {
                let unknown = |name: &str| FunctionError::UnknownLabel { name: name.into(), row: None };
                let [x, y] = axes.each_ref().map(|axis| axis.resolved(id_of).map_err(unknown));
                let (over, (order, rows_at)) = match (x, y, standing(rows, id_of)) {
                    (Ok(x), Ok(y), Ok(standing)) => ([x, y], standing),
                    (x, y, standing) => {
                        let axes = [x, y].into_iter().filter_map(Result::err);
                        return Err(axes.chain(standing.err().into_iter().flatten()).collect());
                    }
                };
                let lines: Vec<&[Node]> = order.iter().map(|&row| rows[row].nodes.as_slice()).collect();
                let first = lines.iter().scan(0, |next, line| Some(std::mem::replace(next, *next + line.len())));
                let normalized = transfer.unit == Unit::Normalized;
                let at = to_values(rows_at, Some(&axes[1]));
                let rows = Rows { over, at, first: first.collect(), normalized };
                (lines, Some(rows))
            }
            _ => (vec![transfer.nodes.as_deref().unwrap_or_default()], None),
        };
        // All lines one after the other; `rows.first` says where each begins.
        let nodes: Vec<&Node> = lines.into_iter().flatten().collect();
        let at = to_values(nodes.iter().map(|n| n.at).collect(), rows.as_ref().map(|_| &transfer.over.axes()[0]));
        let opacity: Vec<f64> = nodes.iter().map(|n| n.opacity).collect();
        // A table replaces the nodes' positions and opacities by its entries; colours and styles stay those of the
        // nodes.
        let (at, opacity, index) = match transfer.table {
            Table::Entries(n) if rows.is_none() && !at.is_empty() => {
                let table::Entries { at, opacity, index } = table::Entries::new(&at, &opacity, n, range);
                (at, opacity, Some(index))
            }
            _ => (at, opacity, None),
        };
        // j of each node: the distinct styles are numbered in the order in which they first occur.
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
        Ok(Some(if names.is_empty() {
            Self::Regular(Nodes { at, opacity, color: colors, index, rows })
        } else {
            Self::Style { nodes: Nodes { at, opacity, color: styles, index, rows }, names }
        }))
    }

    /// If the function is a table: i of each entry, and the number N of nodes.
    #[inline]
    pub fn table(&self) -> Option<(&[f64], usize)> {
        let (index, nodes) = match self {
            Self::Style { nodes, .. } => (&nodes.index, nodes.color.len()),
            Self::Regular(nodes) => (&nodes.index, nodes.color.len()),
        };
        index.as_deref().map(|index| (index, nodes))
    }

    /// The positions and opacities of the nodes, or of a table's entries, and their rows.
    #[inline]
    pub fn nodes(&self) -> (&[f64], &[f64], Option<&Rows>) {
        match self {
            Self::Style { nodes: Nodes { at, opacity, rows, .. }, .. } => (at, opacity, rows.as_ref()),
            Self::Regular(Nodes { at, opacity, rows, .. }) => (at, opacity, rows.as_ref()),
        }
    }

    /// Whether a value in [lo, hi] can have α_u > 0, for any second quantity, or for the labels in `among`. `rounded`
    /// converts the value of a node to the number type of the samples. f32 can round a node down to a value that a
    /// brick reaches.
    pub fn can_be_visible(&self, range: [f64; 2], among: Option<&[u32]>, rounded: impl Fn(f64) -> f64) -> bool {
        let (at, opacity, rows) = self.nodes();
        let Some(rows) = rows else { return can_be_above_zero(at, opacity, range, rounded) };
        match &rows.over {
            [Axis::Value, second] => {
                let occurs = |row: usize| match among {
                    Some(ids) if second.is_id() => ids.contains(&(rows.at[row] as u32)),
                    _ => true,
                };
                let spans = rows.spans(at.len()).enumerate().filter(|(row, _)| occurs(*row));
                spans.map(|(_, span)| span).any(|s| can_be_above_zero(&at[s.clone()], &opacity[s], range, &rounded))
            }
            [_, Axis::Value] => {
                let highest = |span: Range<usize>| opacity[span].iter().copied().fold(0.0, f64::max);
                let highest: Vec<f64> = rows.spans(at.len()).map(highest).collect();
                can_be_above_zero(&rows.at, &highest, range, rounded)
            }
            _ => opacity.iter().any(|&a| a > 0.0),
        }
    }
}

impl Rows {
    /// The range of each row's nodes, of `nodes` in all.
    pub fn spans(&self, nodes: usize) -> impl Iterator<Item = Range<usize>> {
        let ends = self.first.iter().skip(1).copied().chain([nodes]);
        self.first.iter().copied().zip(ends).map(|(first, end)| first..end)
    }
}

/// The order and positions of rows: as written, but rows of labels are sorted by id. A row that several labels share is
/// repeated for each.
fn standing(rows: &[Row], id_of: &dyn Fn(&str) -> Option<u32>) -> Result<(Vec<usize>, Vec<f64>), Vec<FunctionError>> {
    // Where, which row, and whether it says so by a name.
    let (mut places, mut wrong): (Vec<(f64, usize, bool)>, _) = (Vec::with_capacity(rows.len()), Vec::new());
    for (row, r) in rows.iter().enumerate() {
        for at in r.at.each() {
            match at {
                Stand::Name(name) => match id_of(name) {
                    Some(id) => places.push((f64::from(id), row, true)),
                    None => wrong.push(FunctionError::UnknownLabel { name: name.into(), row: Some(row) }),
                },
                Stand::Number(number) => places.push((number, row, false)),
            }
        }
    }
    if !wrong.is_empty() {
        return Err(wrong);
    }
    // Numbers are in order already, and the sort keeps the order of equals, 0 and −0 among them.
    places.sort_by(|a, b| a.0.partial_cmp(&b.0).unwrap_or(Ordering::Equal));
    let twice = |pair: &&[(f64, usize, bool)]| pair[0].0 == pair[1].0 && (pair[0].2 || pair[1].2);
    if let Some([_, (id, row, _)]) = places.windows(2).find(twice) {
        return Err(vec![FunctionError::LabelTwice { row: *row, id: *id as u32 }]);
    }
    Ok(places.into_iter().map(|(at, row, _)| (row, at)).unzip())
}

/// Whether a piecewise-linear opacity is above 0 somewhere on [lo, hi].
///
/// It is 0 on the whole closed range exactly if these nodes have opacity 0: every node in the range, and both ends of
/// every segment that overlaps it. All nodes at one value count. Rounding keeps nodes in order.
pub fn can_be_above_zero(at: &[f64], opacity: &[f64], [lo, hi]: [f64; 2], rounded: impl Fn(f64) -> f64) -> bool {
    // Without a node nothing is shown; that it is no function is said where the nodes are evaluated.
    let Some(end) = at.len().checked_sub(1) else { return false };
    // The nodes from lo to hi, and the next one on either side where none stands at that end itself.
    let below = at.partition_point(|&a| rounded(a) < lo);
    let first = if at.get(below).is_some_and(|&a| rounded(a) == lo) { below } else { below.saturating_sub(1) };
    let above = at.partition_point(|&a| rounded(a) <= hi);
    let last = if above > 0 && rounded(at[above - 1]) == hi { above - 1 } else { above.min(end) };
    // An empty range, from ∞ to −∞, has no node.
    opacity.get(first..=last).is_some_and(|between| between.iter().any(|&a| a > 0.0))
}

/// The places of a transfer function's nodes in the function's unit, each with its value in the volume ([VS-11]); in
/// ascending order, each once. Empty if the unit is that of values, or if no nodes are over the value.
pub fn node_values(transfer: &Transfer, range: [f64; 2], volume: &Volume) -> Vec<[f64; 2]> {
    let mut at: Vec<f64> = match (transfer.unit, transfer.over.axes()) {
        (Unit::Value, _) => Vec::new(),
        (_, [Axis::Value, ..]) => transfer.all_nodes().map(|node| node.at).collect(),
        (_, [_, Axis::Value]) => {
            let stands = transfer.rows.iter().flatten().flat_map(|row| row.at.each());
            stands.filter_map(|stand| if let Stand::Number(at) = stand { Some(at) } else { None }).collect()
        }
        _ => Vec::new(),
    };
    at.sort_by(f64::total_cmp);
    at.dedup();
    let values = values(at.clone(), transfer.unit, range, volume);
    at.into_iter().zip(values).map(|(at, value)| [at, value]).collect()
}

/// The values of numbers in a unit.
fn values(at: Vec<f64>, unit: Unit, range: [f64; 2], volume: &Volume) -> Vec<f64> {
    match unit {
        Unit::Value => at,
        Unit::Normalized => at.iter().map(|&n| from_normalized(n, range)).collect(),
        Unit::Percentile => {
            let shares: Vec<f64> = at.iter().map(|n| n / 100.0).collect();
            quantiles(volume, &shares)
        }
    }
}

/// The value that `normalized` maps to n ([VAL-1]): lo at 0 and hi at 1, both exactly, and in the order of n.
fn from_normalized(n: f64, [lo, hi]: [f64; 2]) -> f64 {
    if n == 1.0 {
        return hi;
    }
    // Halves do not overflow, and halving is exact. The sum may round to the wrong side of hi.
    let value = 2.0 * (lo / 2.0 + n * (hi / 2.0 - lo / 2.0));
    let value = if n < 1.0 { value.min(hi) } else { value.max(hi) };
    value.clamp(f64::MIN, f64::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::space::Grid;
    use crate::tables::{LabelKey, RowAt, TransferKind};
    use crate::volume::Voxels;

    /// A function of colours over two quantities, of rows with nodes (at, opacity).
    fn over(axes: [Axis; 2], unit: Unit, rows: &[(RowAt, &[(f64, f64)])]) -> Result<Function, Vec<FunctionError>> {
        let node = |&(at, opacity): &(f64, f64)| Node { at, color: NodeColor::Color([opacity; 3]), opacity };
        let row = |(at, nodes): &(RowAt, &[_])| Row { at: at.clone(), nodes: nodes.iter().map(node).collect() };
        let rows = Some(rows.iter().map(row).collect());
        let transfer = Transfer { over: Over::Two(axes), unit, rows, ..Transfer::automatic(TransferKind::Regular) };
        let grid = Grid::with_spacing([5, 1, 1], [1.0; 3]).unwrap();
        let volume = Volume::new(grid, Voxels::U8(vec![10, 20, 30, 40, 50]), 1.0, 0.0).unwrap();
        let names = |name: &str| [("liver", 5), ("spleen", 1)].iter().find(|n| n.0 == name).map(|n| n.1);
        Function::new(&transfer, [10.0, 50.0], &volume, &names).map(Option::unwrap)
    }

    fn name(name: &str) -> RowAt {
        RowAt::Name(name.into())
    }

    #[test]
    fn labels_stand_by_their_ids() {
        let nodes: [&[(f64, f64)]; 3] = [&[(1.0, 0.5), (2.0, 0.5)], &[(3.0, 0.25)], &[(4.0, 1.0)]];
        let axes = [Axis::Value, Axis::Label];
        let rows = [(name("liver"), nodes[0]), (RowAt::Number(3.0), nodes[1]), (name("spleen"), nodes[2])];
        let function = over(axes, Unit::Value, &rows).unwrap();
        let (at, opacity, rows) = function.nodes();
        let rows = rows.unwrap();
        assert_eq!((at, opacity), (&[4.0, 3.0, 1.0, 2.0][..], &[1.0, 0.25, 0.5, 0.5][..]));
        assert_eq!((&rows.at[..], &rows.first[..]), (&[1.0, 3.0, 5.0][..], &[0, 1, 2][..]));
        assert_eq!(rows.spans(4).collect::<Vec<_>>(), [0..1, 1..2, 2..4]);
    }

    #[test]
    fn labels_share_a_row() {
        let nodes: [&[(f64, f64)]; 2] = [&[(1.0, 0.5), (2.0, 0.5)], &[(3.0, 0.25)]];
        let both =
            RowAt::Labels(vec![LabelKey::Name("liver".into()), LabelKey::Id(2), LabelKey::Name("spleen".into())]);
        let rows = [(both, nodes[0]), (RowAt::Number(3.0), nodes[1])];
        let shared = over([Axis::Value, Axis::Label], Unit::Value, &rows).unwrap();
        let rows = [(name("liver"), nodes[0]), (name("spleen"), nodes[0]), (RowAt::Number(2.0), nodes[0])];
        let each = [&rows[..], &[(RowAt::Number(3.0), nodes[1])]].concat();
        assert_eq!(shared, over([Axis::Value, Axis::Label], Unit::Value, &each).unwrap());
        assert_eq!(shared.nodes().2.unwrap().at, [1.0, 2.0, 3.0, 5.0]);
    }

    #[test]
    fn every_unknown_label_is_told_and_none_stands_twice() {
        let axes = [Axis::DistanceToLabel(LabelKey::Name("heart".into())), Axis::Label];
        let nodes: &[(f64, f64)] = &[(1.0, 1.0)];
        let rows = [(name("liver"), nodes), (name("lver"), nodes)];
        let unknown = |name: &str, row| FunctionError::UnknownLabel { name: name.into(), row };
        let told = over(axes, Unit::Value, &rows).unwrap_err();
        assert_eq!(told, [unknown("heart", None), unknown("lver", Some(1))]);
        let twice = [(name("spleen"), nodes), (name("liver"), nodes), (RowAt::Number(5.0), nodes)];
        let told = over([Axis::Value, Axis::Label], Unit::Value, &twice).unwrap_err();
        assert_eq!(told, [FunctionError::LabelTwice { row: 2, id: 5 }]);
    }

    #[test]
    fn the_unit_measures_values_on_either_axis() {
        let nodes: &[(f64, f64)] = &[(0.0, 1.0), (1.0, 1.0)];
        let rows = |y| [(RowAt::Number(0.5), nodes), (RowAt::Number(y), nodes)];
        let at = |axes, unit| {
            let function = over(axes, unit, &rows(1.0)).unwrap();
            let (at, _, rows) = function.nodes();
            (at[..2].to_vec(), rows.unwrap().at.clone())
        };
        let normalized = at([Axis::Value, Axis::GradientMagnitude], Unit::Normalized);
        assert_eq!(normalized, (vec![10.0, 50.0], vec![0.5, 1.0]));
        assert_eq!(at([Axis::K1, Axis::Value], Unit::Normalized), (vec![0.0, 1.0], vec![30.0, 50.0]));
        assert_eq!(at([Axis::K1, Axis::Value], Unit::Percentile), (vec![0.0, 1.0], vec![10.0, 10.0]));
    }

    #[test]
    fn normalized_ends_are_the_range() {
        let mut off = 0;
        for i in 1..1000 {
            let [lo, hi] = [f64::from(i) * 0.1, f64::from(i) * 0.3 + 7.7];
            off += usize::from(lo + (hi - lo) != hi);
            let at = |n| from_normalized(n, [lo, hi]);
            assert_eq!([at(0.0), at(1.0)], [lo, hi], "{lo} {hi}");
            // Rounding turns no two nodes around at the end.
            assert!(at(1f64.next_down()) <= hi && hi <= at(1f64.next_up()), "{lo} {hi}");
            // Elsewhere the formula as it is printed.
            for n in [-0.5, 0.25, 1.0 / 3.0, 0.7, 2.0] {
                assert_eq!(at(n), lo + n * (hi - lo), "{n} {lo} {hi}");
            }
        }
        assert!(off > 100, "without the ends {off} of 999 ranges would end elsewhere");
        // A range whose length is no number.
        let widest = [f64::MIN, f64::MAX];
        assert_eq!([0.0, 0.5, 1.0, 2.0].map(|n| from_normalized(n, widest)), [f64::MIN, 0.0, f64::MAX, f64::MAX]);
        assert_eq!(from_normalized(0.25, [3.0, 3.0]), 3.0);
    }

    /// A ramp of the values 0 to 999, stored in another order: the percentile p is the ⌈10p⌉-th, 10p − 1.
    #[test]
    fn percentiles_of_a_ramp_are_its_closed_form() {
        let ramp = |i: usize| (i * 7 + 13) % 1000;
        let grid = Grid::with_spacing([10, 10, 10], [1.0; 3]).unwrap();
        let voxels = Voxels::U16((0..1000).map(|i| ramp(i) as u16).collect());
        let volume = Volume::new(grid, voxels, -2.0, 5.0).unwrap();
        let at = [0.0, 0.1, 7.0, 12.34, 50.0, 99.9, 100.0];
        let node = |&at: &f64| Node { at, color: NodeColor::Color([1.0; 3]), opacity: 1.0 };
        let nodes = Some(at.iter().map(node).collect());
        let transfer = Transfer { unit: Unit::Percentile, nodes, ..Transfer::automatic(TransferKind::Regular) };
        let function = Function::new(&transfer, [0.0, 1.0], &volume, &|_| None).unwrap().unwrap();
        // The slope −2 turns the order over: 999 comes first.
        let value = |p: f64| -2.0 * (999.0 - ((10.0 * p).ceil() - 1.0).max(0.0)) + 5.0;
        assert_eq!(function.nodes().0, at.map(value));
        assert_eq!(node_values(&transfer, [0.0, 1.0], &volume), at.map(|p| [p, value(p)]));
    }

    #[test]
    fn values_of_nodes_are_told_once_each_and_over_the_value_alone() {
        let grid = Grid::with_spacing([5, 1, 1], [1.0; 3]).unwrap();
        let volume = Volume::new(grid, Voxels::U8(vec![10, 20, 30, 40, 50]), 1.0, 0.0).unwrap();
        let row = |at: f64, nodes: &[f64]| Row {
            at: RowAt::Number(at),
            nodes: nodes.iter().map(|&at| Node { at, color: NodeColor::Color([0.0; 3]), opacity: 1.0 }).collect(),
        };
        let rows = Some(vec![row(0.0, &[0.5, 0.0]), row(1.0, &[0.5, 1.0])]);
        let of = |over, unit| {
            let transfer = Transfer { over, unit, rows: rows.clone(), ..Transfer::automatic(TransferKind::Regular) };
            node_values(&transfer, [10.0, 50.0], &volume)
        };
        let along = Over::Two([Axis::Value, Axis::Label]);
        assert_eq!(of(along.clone(), Unit::Normalized), [[0.0, 10.0], [0.5, 30.0], [1.0, 50.0]]);
        assert_eq!(of(Over::Two([Axis::K1, Axis::Value]), Unit::Normalized), [[0.0, 10.0], [1.0, 50.0]]);
        assert_eq!(of(along, Unit::Value), [[0.0; 2]; 0]);
        assert_eq!(of(Over::Two([Axis::K1, Axis::K2]), Unit::Normalized), [[0.0; 2]; 0]);
    }

    #[test]
    fn what_rows_can_show() {
        let low: &[(f64, f64)] = &[(10.0, 0.0), (20.0, 1.0), (30.0, 0.0)];
        let high: &[(f64, f64)] = &[(40.0, 0.0), (50.0, 1.0)];
        let rows = [(RowAt::Number(1.0), low), (RowAt::Number(2.0), high)];
        let labels = over([Axis::Value, Axis::Label], Unit::Value, &rows).unwrap();
        let sees = |range, among: Option<&[u32]>| labels.can_be_visible(range, among, |at| at);
        assert!(sees([15.0, 16.0], None) && sees([45.0, 46.0], None) && !sees([31.0, 39.0], None));
        assert!(
            sees([15.0, 16.0], Some(&[0, 1])) && !sees([15.0, 16.0], Some(&[0, 2])) && !sees([0.0, 99.0], Some(&[0]))
        );
        // From row to row: what lies between a row that shows something and one that shows nothing is seen.
        let clear: &[(f64, f64)] = &[(1.0, 0.0)];
        let rows = [(RowAt::Number(10.0), clear), (RowAt::Number(20.0), clear), (RowAt::Number(30.0), low)];
        let down = over([Axis::K1, Axis::Value], Unit::Value, &rows).unwrap();
        let sees = |range| down.can_be_visible(range, None, |at| at);
        assert!(!sees([0.0, 19.0]) && sees([25.0, 26.0]) && sees([90.0, 99.0]));
    }

    fn can_be_visible(at: &[f64], opacity: &[f64], range: [f64; 2]) -> bool {
        super::can_be_above_zero(at, opacity, range, |a| a)
    }

    #[test]
    fn a_node_is_where_it_is_rounded_to() {
        // 1000.1 is 1000.0999756 in f32, up to where a brick can reach.
        let (at, opacity, range) = ([1000.1, 1000.1], [0.0, 0.5], [1000.0, f64::from(1000.1f32)]);
        assert!(!can_be_visible(&at, &opacity, range));
        assert!(super::can_be_above_zero(&at, &opacity, range, |a| f64::from(a as f32)));
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
        assert!(!can_be_visible(&[], &[], [0.0, 1.0]), "no node, nothing to see");
        assert!(!visible(-10.0, -5.0));
    }

    /// The function at a node is that node's. An opacity of 0 all over, such as in emptied surroundings, usually has a
    /// node.
    #[test]
    fn a_range_that_ends_at_a_node_sees_nothing_of_the_next() {
        let (at, opacity) = ([0.0, 10.0, 20.0], [0.0, 1.0, 0.0]);
        let visible = |lo, hi| can_be_visible(&at, &opacity, [lo, hi]);
        assert!(!visible(0.0, 0.0) && !visible(-5.0, 0.0) && !visible(20.0, 20.0) && !visible(20.0, 25.0));
        let least = f64::MIN_POSITIVE;
        assert!(visible(0.0, least) && visible(-5.0, least) && visible(20f64.next_down(), 20.0) && visible(10.0, 10.0));
        // Any of several nodes at one value may count at an end.
        assert!(can_be_visible(&[5.0; 3], &[0.0, 0.5, 0.0], [5.0; 2]));
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
