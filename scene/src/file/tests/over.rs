//! Functions over two quantities ([STF-4]): what is read, written and refused.

use super::*;
use crate::tables::{Axis, LabelKey, Over, RowAt};

/// A `[transfer]` over quantities, of colours.
fn over(quantities: &str, rest: &str) -> String {
    format!("[transfer]\nkind = \"regular\"\nover = {quantities}\n{rest}\n")
}

const ROW: &str = "rows = [{ at = 1, nodes = [{ at = 1, color = \"red\" }] }]";

#[test]
fn every_quantity_is_read_and_written() {
    let scene = |text: &str| scene(&format!("labels = \"l.nrrd\"\nlabel_names = \"l.csv\"\n{text}"));
    let names = ["gradient-magnitude", "label", "k1", "k2", "mean", "gaussian", "kv"];
    let quoted = names.map(|name| format!("{name:?}"));
    let of = ["{ distance = [1, 2, 3] }", "{ distance_to_label = 12 }", "{ distance_to_label = \"liver\" }"];
    let all: Vec<&str> = quoted.iter().map(String::as_str).chain(of).chain(["{ volume = \"b.nrrd\" }"]).collect();
    for (i, quantity) in all.iter().enumerate() {
        for pair in [format!("[\"value\", {quantity}]"), format!("[{quantity}, {}]", all[(i + 1) % all.len()])] {
            let read = scene(&over(&pair, ROW));
            let back = parse(&write_full(&read), Path::new("scene.toml"), &Overrides::default()).unwrap();
            assert_eq!(read, back, "{pair}");
            let Over::Two(axes) = &read.transfer.as_ref().unwrap().over else { panic!("{pair}") };
            assert!(axes.iter().all(|axis| pair.contains(axis.name())), "{pair}: {axes:?}");
        }
    }
    let distance = scene(&over("[\"value\", { distance_to_label = \"liver\" }]", ROW)).transfer.unwrap().over;
    assert_eq!(distance, Over::Two([Axis::Value, Axis::DistanceToLabel(LabelKey::Name("liver".into()))]));
}

/// The page of all keys has every name of a quantity: it is written by hand there.
#[test]
fn the_doc_names_every_quantity() {
    let doc = every_key().into_iter().find(|(path, _)| path == "transfer.over").unwrap().1.doc;
    for name in ["value", "gradient-magnitude", "label", "k1", "k2", "mean", "gaussian", "kv"] {
        assert!(doc.contains(&format!("{name:?}")), "{name}");
    }
}

#[test]
fn a_full_grid_is_its_rows() {
    let pair = "[\"value\", \"gradient-magnitude\"]";
    let node = |at: &str, c: &str| format!("{{ at = {at}, color = {c:?}, opacity = 0.5 }}");
    let grid = ["[1, 10]", "[2, 10]", "[1, 20]", "[2, 20]"];
    let colors = ["red", "blue", "lime", "#fff"];
    let nodes: Vec<String> = grid.iter().zip(colors).map(|(at, c)| node(at, c)).collect();
    let rows: Vec<String> = [["1", "2"], ["1", "2"]]
        .iter()
        .zip([10, 20])
        .enumerate()
        .map(|(i, (at, y))| {
            format!("{{ at = {y}, nodes = [{}, {}] }}", node(at[0], colors[2 * i]), node(at[1], colors[2 * i + 1]))
        })
        .collect();
    let one = scene(&over(pair, &format!("nodes = [{}]", nodes.join(", "))));
    let other = scene(&over(pair, &format!("rows = [{}]", rows.join(", "))));
    assert_eq!(one, other);
    assert_eq!(identity(&one), identity(&other));
    let rows = one.transfer.unwrap().rows.unwrap();
    assert_eq!((rows.len(), &rows[1].at, rows[1].nodes[1].at), (2, &RowAt::Number(20.0), 2.0));
}

/// What is wrong, where, and what to do, each the first line of its kind.
#[test]
fn what_makes_no_function() {
    let pair = "[\"value\", \"k1\"]";
    let grid = |at: &[&str]| {
        let nodes: Vec<String> = at.iter().map(|at| format!("{{ at = {at}, color = \"red\" }}")).collect();
        format!("nodes = [{}]", nodes.join(", "))
    };
    let rows = |at: &[&str]| {
        let row = |at: &&str| format!("{{ at = {at}, nodes = [{{ at = 1, color = \"red\" }}] }}");
        format!("rows = [{}]", at.iter().map(row).collect::<Vec<_>>().join(", "))
    };
    let mut different = Vec::new();
    for (text, what, place) in [
        (over("[\"value\", \"k3\"]", ROW), "transfer.over[1] cannot be \"k3\"", "6:18, key transfer.over[1]"),
        (over("\"k1\"", ROW), "transfer.over cannot be \"k1\"", "6:8, key transfer.over"),
        (over("[\"value\", \"k1\", \"k2\"]", ROW), "transfer.over cannot be a list of 3", "6:8, key transfer.over"),
        (over("[\"k1\", \"k1\"]", ROW), "both quantities are \"k1\"", "6:8, key transfer.over"),
        (
            over("[\"value\", { distance = [0, 0, 0], volume = \"a\" }]", ROW),
            "one quantity has both distance and volume",
            "6:42, key transfer.over[1].volume",
        ),
        (
            over("[\"value\", { distances = 1 }]", ROW),
            "transfer.over[1].distance is missing",
            "6:18, key transfer.over[1].distance",
        ),
        (
            over("[\"value\", { distance_to_label = -1 }]", ROW),
            "transfer.over[1].distance_to_label cannot be -1",
            "6:40, key transfer.over[1].distance_to_label",
        ),
        (over(pair, ""), "a function over two quantities has no nodes", "6:1, key transfer.over"),
        (
            over(pair, &grid(&["1"])),
            "a node of a function over two quantities has one number",
            "7:12, key transfer.nodes[0].at",
        ),
        (
            over("\"value\"", &grid(&["[1, 2]"])),
            "a node of a function over the value alone has at = [x, y]",
            "7:12, key transfer.nodes[0].at",
        ),
        (over("\"value\"", ROW), "rows of a function over the value alone", "7:1, key transfer.rows"),
        (
            over(pair, &grid(&["[1, 1]", "[2, 1]", "[1, 5]"])),
            "the nodes are no full grid: there is none at [2, 5]",
            "7:9, key transfer.nodes",
        ),
        (
            over(pair, &grid(&["[1, 5]", "[1, 1]"])),
            "node 1 at [1, 1] stands after node 0 at [1, 5]",
            "7:44, key transfer.nodes[1].at",
        ),
        (
            over(pair, &grid(&["[1, 5]", "2"])),
            "node 1 has one number at, node 0 another",
            "7:44, key transfer.nodes[1].at",
        ),
        (over(pair, &rows(&["5", "1"])), "row 1 at 1 stands after row 0 at 5", "7:60, key transfer.rows[1].at"),
        (
            over(pair, &rows(&["\"liver\""])),
            "a row at \"liver\", and the second quantity is \"k1\"",
            "7:11, key transfer.rows[0].at",
        ),
        (
            over(pair, "rows = [{ at = 1, nodes = [{ at = [1, 1], color = \"red\" }] }]"),
            "a node of a row has at = [x, y]",
            "7:30, key transfer.rows[0].nodes[0].at",
        ),
        (
            over(pair, "rows = [{ at = 1, nodes = [{ at = 1, style = \"wax\" }] }]"),
            "a node of a regular function has a style",
            "7:38, key transfer.rows[0].nodes[0].style",
        ),
        (
            over(pair, &format!("{ROW}\nnodes = [{{ at = 1, color = \"red\" }}]")),
            "[transfer] has both rows and nodes",
            "7:1, key transfer.rows",
        ),
        (
            over(pair, &format!("unit = \"percentile\"\n{}", ROW.replace("at = 1, c", "at = 101, c"))),
            "101 is no percentile",
            "8:30, key transfer.rows[0].nodes[0].at",
        ),
        (
            over("[\"k1\", \"value\"]", &format!("unit = \"percentile\"\n{}", grid(&["[900, 3]", "[900, 101]"]))),
            "101 is no percentile",
            "8:46, key transfer.nodes[1].at",
        ),
    ] {
        let told = faults(&text);
        let lines: Vec<&str> = told.lines().collect();
        if lines[0] != what || lines[1] != format!("  at scene.toml:{place}") {
            different.push(told);
        }
    }
    assert!(different.is_empty(), "{}", different.join("\n"));
}

#[test]
fn what_labels_need() {
    let label = "[\"value\", \"label\"]";
    let rows = |at: &[&str]| {
        let row = |at: &&str| format!("{{ at = {at}, nodes = [{{ at = 1, color = \"red\" }}] }}");
        format!("rows = [{}]", at.iter().map(row).collect::<Vec<_>>().join(", "))
    };
    let first = |text: &str| faults(text).lines().take(3).map(str::trim).collect::<Vec<_>>().join("; ");
    assert_eq!(
        first(&over(label, ROW)),
        "the function is over \"label\", and the scene has no labels; at scene.toml:6:1, key transfer.over; add the label \
         volume: volume.labels = \"…\""
    );
    let beside = |text: String| format!("labels = \"l.nrrd\"\n{text}");
    assert_eq!(
        first(&beside(over(label, &rows(&["3", "\"liver\""])))),
        "\"liver\" is the name of a label, and the scene has no names of them; at scene.toml:8:60, key \
         transfer.rows[1].at; write an id, or add the table of names: volume.label_names = \"…\""
    );
    for (at, what, place) in [
        (&["1.5"][..], "1.5 is no label", "8:11, key transfer.rows[0].at"),
        (&["-1"], "-1 is no label", "8:11, key transfer.rows[0].at"),
        (&["7", "3", "7"], "a second row for one label", "8:109, key transfer.rows[2].at"),
    ] {
        let told = first(&beside(over(label, &rows(at))));
        assert!(told.starts_with(&format!("{what}; at scene.toml:{place}; ")), "{told}");
    }
    // In any order, and along rows too.
    scene(&beside(over(label, &rows(&["7", "3"]))));
    let along =
        |nodes: &str| beside(over("[\"label\", \"value\"]", &format!("rows = [{{ at = 1, nodes = [{nodes}] }}]")));
    scene(&along("{ at = 3, color = \"red\" }, { at = 7, color = \"red\" }"));
    let twice = first(&along("{ at = 3, color = \"red\" }, { at = 3, color = \"red\" }"));
    assert!(twice.starts_with("a second node for one label; at scene.toml:8:57, key"), "{twice}");
    let broken = first(&along("{ at = 0.5, color = \"red\" }"));
    assert!(broken.starts_with("0.5 is no label; at scene.toml:8:30, key transfer.rows[0].nodes[0].at"), "{broken}");
}
