//! Functions over two quantities ([STF-4]) at random, and what holds for all of them.

use super::generator::{at, dims, grid, opacity, scene, volume};
use crate::common::Stage;
use crate::common::random::Random;
use drypoint::scene::glam::DVec3;
use drypoint::scene::space::Grid;
use drypoint::scene::tables::{Axis, LabelKey, LabelLookup, Node, NodeColor, Over, Row, RowAt, Table, Transfer, Unit};
use drypoint::scene::volume::labels::LabelVolume;
use drypoint::scene::volume::{Volume, Voxels};

/// Ids 0 … 4 in blocks and single voxels, 1 among them, on the data's grid or another.
fn labels(r: &mut Random, own: &Grid) -> LabelVolume {
    let dims = dims(r);
    let on = if r.once_in(2) { own.clone() } else { grid(r, dims) };
    let block = 1 + r.below(40);
    let mut ids: Vec<u8> = Vec::new();
    while ids.len() < on.len() {
        let id = r.below(5) as u8;
        ids.extend(std::iter::repeat_n(id, block.min(on.len() - ids.len())));
    }
    ids[0] = 1;
    LabelVolume::new(&Volume::new(on, Voxels::U8(ids), 1.0, 0.0).unwrap()).unwrap()
}

/// Gives a scene labels, now and then with names: that of label n is `part n`.
fn give_labels(r: &mut Random, shot: &mut Stage, own: &Grid) {
    shot.labels = Some(labels(r, own));
    let table = &mut shot.scene.volume;
    table.labels = Some("labels.nrrd".into());
    table.label_names = if r.once_in(2) { Some("labels.csv".into()) } else { None };
}

/// Whether the labels of a scene have names.
fn names(shot: &Stage) -> bool {
    shot.scene.volume.label_names.is_some()
}

/// Where the rows for some ids stand: at ids, at names, or several at one row.
fn rows_of_ids(r: &mut Random, ids: &[f64], named: bool) -> Vec<RowAt> {
    let name = |id: f64| format!("part {id}");
    if r.once_in(3) {
        let key = |&id: &f64| if named { LabelKey::Name(name(id)) } else { LabelKey::Id(id as u32) };
        return ids.chunks(2).map(|pair| RowAt::Labels(pair.iter().map(key).collect())).collect();
    }
    let by_name = named && r.once_in(2);
    ids.iter().map(|&id| if by_name { RowAt::Name(name(id)) } else { RowAt::Number(id) }).collect()
}

/// A quantity other than the value, and numbers that it has or nearly has.
fn quantity(r: &mut Random, shot: &mut Stage, which: usize) -> (Axis, [f64; 2]) {
    let own = shot.volume.grid().clone();
    let [lo, hi] = shot.volume.range();
    match r.below(11) {
        0 | 1 => (Axis::GradientMagnitude, [0.0, 0.7 * (hi - lo) / own.voxel()]),
        2 => (Axis::K1, [-1.0, 2.0]),
        3 => (Axis::K2, [-2.0, 1.0]),
        4 => (Axis::Mean, [-1.0, 1.0]),
        5 => (Axis::Gaussian, [-1.0, 1.0]),
        6 => (Axis::AlongView, [-0.5, 2.0]),
        7 => {
            let point = own.centre() + DVec3::from_array(r.direction()) * own.radius() * r.between(0.0, 2.0);
            (Axis::Distance(point), [0.0, own.radius() * 2.0])
        }
        8 => {
            give_labels(r, shot, &own);
            // Both axes may read labels: those that one wants are there.
            let label = if names(shot) { LabelKey::Name("part 1".into()) } else { LabelKey::Id(1) };
            (Axis::DistanceToLabel(label), [0.0, own.radius() * 2.0])
        }
        9 => {
            give_labels(r, shot, &own);
            shot.scene.volume.label_lookup = r.pick(&[LabelLookup::Nearest, LabelLookup::Smooth]);
            (Axis::Label, [0.0, 5.0])
        }
        _ => {
            let (dims, own_grid) = (dims(r), r.once_in(2));
            let other = if own_grid { own } else { grid(r, dims) };
            let further = volume(r, other);
            let range = further.range();
            shot.further[which] = Some(further);
            (Axis::Volume(r.pick(&["further.nrrd", "importance.nrrd"]).into()), range)
        }
    }
}

/// Gives the function of a scene two quantities: rows of its own nodes' looks.
pub(crate) fn over_two(r: &mut Random, shot: &mut Stage) {
    let looks: Vec<NodeColor> =
        shot.scene.transfer.as_ref().unwrap().nodes.iter().flatten().map(|node| node.color.clone()).collect();
    let values = |r: &mut Random, shot: &Stage, n: usize| match shot.scene.transfer.as_ref().unwrap().unit {
        Unit::Percentile => (0..n).map(|i| 100.0 * i as f64 / n.max(2) as f64).collect(),
        Unit::Normalized => (0..n).map(|i| (i as f64 + 0.2) / n as f64).collect(),
        _ => at(r, &shot.volume, n),
    };
    let numbers = |r: &mut Random, [lo, hi]: [f64; 2], n: usize| {
        let mut at: Vec<f64> = (0..n).map(|_| r.between(lo, hi)).collect();
        at.sort_by(f64::total_cmp);
        if n > 1 && r.once_in(2) {
            at[n - 1] = at[n - 2];
        }
        at
    };
    // Labels stand once each.
    let ids = |r: &mut Random, n: usize| -> Vec<f64> { (0..5).filter(|_| r.below(5) <= n).map(f64::from).collect() };
    // The value along a row, from row to row, or not at all.
    let value = r.pick(&[Some(0), Some(0), Some(0), Some(1), None]);
    let mut ranges = [[0.0; 2]; 2];
    let axes = [0, 1].map(|i| {
        if value == Some(i) {
            return Axis::Value;
        }
        let (axis, range) = quantity(r, shot, i);
        ranges[i] = range;
        axis
    });
    if axes[0] == axes[1] {
        return;
    }
    let is_id = axes.each_ref().map(Axis::is_id);
    let places = |r: &mut Random, shot: &Stage, i: usize, n| match value {
        Some(v) if v == i => values(r, shot, n),
        _ if is_id[i] => match ids(r, n) {
            none if none.is_empty() => vec![2.0],
            some => some,
        },
        _ => numbers(r, ranges[i], n),
    };
    let count = 1 + r.below(4);
    let down = places(r, shot, 1, count);
    let down = match is_id[1] {
        true => rows_of_ids(r, &down, names(shot)),
        false => down.into_iter().map(RowAt::Number).collect(),
    };
    let rows = down.into_iter().map(|at| {
        let n = 1 + r.below(4);
        let nodes = places(r, shot, 0, n).into_iter();
        let nodes = nodes.map(|at| Node { at, color: r.pick(&looks), opacity: opacity(r) }).collect();
        Row { at, nodes }
    });
    let rows = rows.collect();
    let t = shot.scene.transfer.as_mut().unwrap();
    *t = Transfer { over: Over::Two(axes), nodes: None, rows: Some(rows), ..t.clone() };
}

/// A function whose rows are all its nodes is the function of its nodes, bit for bit, whatever the second quantity.
#[test]
fn rows_that_are_alike_are_one() {
    let (mut covered, mut two) = (0, 0);
    for seed in 5000..5200 {
        // A function over two quantities is never read from a table.
        let mut shot = scene(seed).with_transfer(|t| t.table = Table::Exact);
        let t = shot.scene.transfer.clone().unwrap();
        let Some(nodes) = t.nodes.clone() else { continue };
        let one = shot.render();
        let r = &mut Random(seed ^ 0x2d);
        let (axis, [lo, hi]) = quantity(r, &mut shot, 1);
        let row = |y| Row { at: RowAt::Number(y), nodes: nodes.clone() };
        let rows = match axis {
            Axis::Label => (0..5).map(|id| row(f64::from(id))).collect(),
            _ => vec![row(lo), row(lo + 0.4 * (hi - lo)), row(hi)],
        };
        shot.scene.transfer =
            Some(Transfer { over: Over::Two([Axis::Value, axis]), nodes: None, rows: Some(rows), ..t });
        let both = shot.render();
        assert_eq!(one.bits(), both.bits(), "seed {seed}: {:?}", shot.scene);
        assert_eq!(one.counts.style_lookups, both.counts.style_lookups, "seed {seed}");
        covered += both.covered();
        two += 1;
    }
    assert!(covered > 1000 && two > 80, "{covered} {two}");
}

/// A function between whose nodes more are put, on the lines that they span, is the same one.
#[test]
fn nodes_on_the_way_change_nothing() {
    for seed in 5300..5400 {
        let r = &mut Random(seed);
        let mut shot = scene(seed).with(|s| s.sampling.number = drypoint::scene::tables::Number::F64);
        let t = shot.scene.transfer.clone().unwrap();
        if t.nodes.is_none() {
            continue;
        }
        let (axis, [lo, hi]) = quantity(r, &mut shot, 1);
        if axis.is_id() {
            continue;
        }
        let [a, b] = shot.volume.range();
        let style = t.nodes.as_ref().unwrap()[0].color.clone();
        let o: [f64; 4] = [0; 4].map(|_| r.unit());
        let node = |at, opacity| Node { at, color: style.clone(), opacity };
        let row = |y, nodes| Row { at: RowAt::Number(y), nodes };
        let mut with = |rows| {
            let unit = Unit::Value;
            let over = Over::Two([Axis::Value, axis.clone()]);
            shot.scene.transfer = Some(Transfer { over, unit, nodes: None, rows: Some(rows), ..t.clone() });
            shot.render()
        };
        let plain =
            with(vec![row(lo, vec![node(a, o[0]), node(b, o[1])]), row(hi, vec![node(a, o[2]), node(b, o[3])])]);
        let (x, y) = (0.5 * (a + b), 0.5 * (lo + hi));
        let mean = |p: f64, q: f64| 0.5 * (p + q);
        let more = with(vec![
            row(lo, vec![node(a, o[0]), node(x, mean(o[0], o[1])), node(b, o[1])]),
            row(y, vec![node(a, mean(o[0], o[2])), node(b, mean(o[1], o[3]))]),
            row(hi, vec![node(a, o[2]), node(x, mean(o[2], o[3])), node(b, o[3])]),
        ]);
        // A sample's α_u differs by a few ε; eq. 2's and the correction's powers multiply that by up to 1/α and Δ/Δ₀, and
        // pixels sum some hundred samples. Termination and half-way depths may move by one sample.
        if shot.scene.sampling.stop_below == 0.0 {
            let d = crate::common::largest_difference(&plain, &more);
            assert!(d < 1e-10, "seed {seed}: {d} {:?}", shot.scene);
        }
    }
}

/// A full grid with its axes exchanged is the same function.
#[test]
fn axes_can_be_exchanged() {
    let mut covered = 0;
    for seed in 5500..5600 {
        let r = &mut Random(seed);
        let mut shot = scene(seed).with(|s| {
            s.sampling.number = drypoint::scene::tables::Number::F64;
            s.sampling.stop_below = 0.0;
        });
        let t = shot.scene.transfer.clone().unwrap();
        let (axis, [lo, hi]) = quantity(r, &mut shot, 1);
        let looks: Vec<NodeColor> = t.all_nodes().map(|node| node.color.clone()).collect();
        let xs = at(r, &shot.volume, 3);
        let ys = if axis.is_id() { [0.0, 1.0, 3.0] } else { [lo, lo + (hi - lo) * r.unit(), hi] };
        let grid: Vec<(NodeColor, f64)> = (0..9).map(|_| (r.pick(&looks), opacity(r))).collect();
        let rows = |along: &[f64], down: &[f64], which: &dyn Fn(usize, usize) -> usize| -> Vec<Row> {
            let node = |i: usize, j: usize| {
                let (color, opacity) = grid[which(i, j)].clone();
                Node { at: along[i], color, opacity }
            };
            let row = |j: usize| Row { at: RowAt::Number(down[j]), nodes: (0..3).map(|i| node(i, j)).collect() };
            (0..3).map(row).collect()
        };
        let with = |shot: &Stage, axes, rows| {
            shot.with_transfer(|t| {
                *t = Transfer { over: Over::Two(axes), unit: Unit::Value, nodes: None, rows: Some(rows), ..t.clone() };
            })
        };
        let one = with(&shot, [Axis::Value, axis.clone()], rows(&xs, &ys, &|i, j| 3 * j + i)).render();
        let mut other = with(&shot, [axis, Axis::Value], rows(&ys, &xs, &|i, j| 3 * i + j));
        other.further.reverse();
        let other = other.render();
        let d = crate::common::largest_difference(&one, &other);
        // As above: α_u to a few ε, through powers and sums.
        assert!(d < 1e-10, "seed {seed}: {d} {:?}", shot.scene);
        covered += one.covered();
    }
    assert!(covered > 500, "{covered}");
}
