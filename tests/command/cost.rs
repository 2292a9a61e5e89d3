//! `cost`: what accuracy costs ([COST-1] … [COST-3]). Times are never asserted.

use crate::folder::Folder;
use std::collections::BTreeMap;

/// A row of the CSV.
#[derive(Debug)]
struct Row {
    setting: String,
    rms: f64,
    max: f64,
    flip: f64,
    seconds: f64,
    spread: f64,
    samples: u64,
    bytes: u64,
    truth: String,
    angle: Option<f64>,
}

/// Runs a sweep, by knob.
fn rows(folder: &Folder, line: &str) -> BTreeMap<String, Vec<Row>> {
    let csv = folder.good(line);
    let mut lines = csv.lines();
    assert_eq!(lines.next(), Some("knob,setting,rms,max,flip,seconds,spread,samples,bytes,truth,angle"));
    let mut rows: BTreeMap<String, Vec<Row>> = BTreeMap::new();
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        assert_eq!(cells.len(), 11, "{line}");
        let number = |i: usize| cells[i].parse::<f64>().unwrap_or_else(|_| panic!("{line}"));
        rows.entry(cells[0].into()).or_default().push(Row {
            setting: cells[1].into(),
            rms: number(2),
            max: number(3),
            flip: number(4),
            seconds: number(5),
            spread: number(6),
            samples: cells[7].parse().unwrap(),
            bytes: cells[8].parse().unwrap(),
            truth: cells[9].into(),
            angle: cells[10].parse().ok(),
        });
    }
    rows
}

const REGULAR: &str = r##"drypoint = 1
[volume]
phantom = { name = "torus", size = 14, type = "f64" }
[picture]
size = [12, 10]
samples = 1
[transfer]
kind = "regular"
nodes = [{ at = -1.5, color = "#f80", opacity = 0 }, { at = 1, color = "#fff", opacity = 0.8 }]
"##;

/// The largest part of a channel: unshaded, premultiplied colours, and the white behind, are at most 1.
const BRIGHTEST: f64 = 1.0;

#[test]
fn every_setting_of_every_knob_has_a_row() {
    let folder = Folder::new();
    folder.scene("[contours]\nkappa = \"exact\"\n[style_mipmaps]\n");
    let rows = rows(&folder, "cost scene.toml --runs 1 --set picture.size=[12,8]");
    let counts: Vec<(&str, usize)> = rows.iter().map(|(knob, rows)| (knob.as_str(), rows.len())).collect();
    let expected = [
        ("contours.kappa", 2),
        ("picture.samples", 5),
        ("sampling.gradient", 4),
        // `auto`, what the scene has, is none of the settings.
        ("sampling.hessian", 3),
        ("sampling.kernel", 5),
        ("sampling.number", 2),
        ("sampling.scale", 4),
        ("sampling.step", 7),
        ("sampling.stop_below", 8),
        ("style_mipmaps.curvature_bias", 4),
        ("style_mipmaps.gradient_bias", 4),
        ("transfer.table", 5),
    ];
    assert_eq!(counts, expected);
    for (knob, rows) in &rows {
        let last = rows.last().unwrap();
        for row in rows {
            assert!(0.0 <= row.rms && row.rms <= row.max && row.max <= 1.0 && row.flip <= 1.0, "{knob} {row:?}");
            assert!(row.seconds > 0.0 && row.spread == 0.0, "one run has no spread: {row:?}");
            assert!(row.samples > 0 && row.bytes >= 20 * 20 * 20, "{knob} {row:?}");
            assert!(row.truth == "analytic" || row.truth == format!("finest: {}", last.setting), "{knob} {row:?}");
        }
        if last.truth != "analytic" {
            assert_eq!((last.rms, last.max, last.flip), (0.0, 0.0, 0.0), "{knob}: its own truth");
        }
    }
    let of = |knob: &str, setting: &str| rows[knob].iter().find(|row| row.setting == setting).unwrap();
    // Prefiltering keeps one f64 a voxel.
    let kept = of("sampling.kernel", "bspline").bytes as i64 - of("sampling.kernel", "trilinear").bytes as i64;
    assert!(kept >= 8 * 20 * 20 * 20, "{kept}");
    // Every setting is rendered: no two of the function's tables are alike, and larger ones are nearer.
    let tables = ["64", "256", "1024", "4096"].map(|entries| of("transfer.table", entries).rms);
    assert!(tables.windows(2).all(|pair| pair[1] < 0.7 * pair[0]) && tables[3] > 0.0, "{tables:?}");
    // Four times as many rays.
    let (one, four) = (of("picture.samples", "1").samples as f64, of("picture.samples", "2").samples as f64);
    assert!((four / one - 4.0).abs() < 0.5, "{one} {four}");
}

#[test]
fn an_unshaded_scene_has_no_gradient_knob() {
    let folder = Folder::new();
    folder.write("scene.toml", REGULAR);
    let unshaded: Vec<String> = rows(&folder, "cost scene.toml --runs 1").into_keys().collect();
    let expected = [
        "picture.samples",
        "sampling.kernel",
        "sampling.number",
        "sampling.step",
        "sampling.stop_below",
        "transfer.table",
    ];
    assert_eq!(unshaded, expected);
    folder.write("scene.toml", format!("{REGULAR}[shading]\n"));
    let shaded = rows(&folder, "cost scene.toml --runs 1 --knob sampling.gradient");
    assert_eq!(shaded.into_keys().collect::<Vec<_>>(), ["sampling.gradient"]);
}

/// What is cut off has a weight of at most ε, of colours up to the brightest ([RAY-2]).
#[test]
fn early_termination_stays_under_its_bound_in_every_row() {
    let folder = Folder::new();
    folder.write("scene.toml", REGULAR);
    let line = "cost scene.toml --runs 1 --knob sampling.stop_below --set transfer.nodes[1].opacity=0.97";
    let mut cut = 0;
    for space in ["linear", "srgb"] {
        for row in &rows(&folder, &format!("{line} --set picture.blend_space={space}"))["sampling.stop_below"] {
            let epsilon: f64 = row.setting.parse().unwrap();
            assert_eq!(row.truth, "finest: 0", "the same reconstruction");
            assert!(row.max <= epsilon * BRIGHTEST + 1e-15, "{space} {row:?}");
            cut += u32::from(row.max > 0.0);
        }
    }
    assert!(cut >= 6, "rays are cut: {cut}");
}

/// The field is linear, so that the trilinear kernel is exact and the error is the step's alone. The slab that is shown
/// lies across the view and meets no side of the box within the picture, tilted by more than the longest step.
fn slab(nodes: &str) -> String {
    format!(
        "drypoint = 1\n[volume]\nphantom = {{ name = \"plane\", size = 64, type = \"f64\" }}\n\
         [camera]\nprojection = \"orthographic\"\nheight = 20\ndirection = [0.3, 0.1, -1]\nup = [0, 1, 0]\n\
         [picture]\nsize = [24, 24]\nsamples = 1\n[transfer]\nkind = \"regular\"\nnodes = [{nodes}]\n"
    )
}

/// The order of the error against Δ: the slope of log e over log Δ, by least squares over the steps 4, 2, 1 and ½.
fn order(nodes: &str) -> f64 {
    let folder = Folder::new();
    folder.write("scene.toml", slab(nodes));
    let rows = &rows(&folder, "cost scene.toml --runs 1 --knob sampling.step")["sampling.step"];
    let points: Vec<(f64, f64)> = rows[..4]
        .iter()
        .map(|row| {
            assert_eq!(row.truth, "analytic");
            let step: f64 = row.setting.split(' ').next().unwrap().parse().unwrap();
            (step.ln(), row.rms.ln())
        })
        .collect();
    let mean = |of: fn(&(f64, f64)) -> f64| points.iter().map(of).sum::<f64>() / points.len() as f64;
    let (x, y) = (mean(|p| p.0), mean(|p| p.1));
    let along: f64 = points.iter().map(|p| (p.0 - x) * (p.1 - y)).sum();
    along / points.iter().map(|p| (p.0 - x).powi(2)).sum::<f64>()
}

/// Samples in the middle of their steps are the midpoint rule: order 2 where the integrand is continuous.
#[test]
fn a_continuous_function_is_of_order_two() {
    let hill = "{ at = -14, color = \"#f00\", opacity = 0 }, { at = 0, color = \"#0f0\", opacity = 0.15 }, \
                { at = 14, color = \"#00f\", opacity = 0 }";
    let order = order(hill);
    assert!((order - 2.0).abs() <= 0.3, "{order}");
}

/// Where it jumps, a sample falls on either side: order 1.
#[test]
fn a_function_with_steps_is_of_order_one() {
    let step = "{ at = -9.3, color = \"#f00\", opacity = 0 }, { at = -9.3, color = \"#f00\", opacity = 0.1 }, \
                { at = 8.6, color = \"#00f\", opacity = 0.1 }, { at = 8.6, color = \"#00f\", opacity = 0 }";
    let order = order(step);
    assert!((order - 1.0).abs() <= 0.3, "{order}");
}

/// A linear field sampled on voxels and its formula are the same to rounding, for every kernel that interpolates.
#[test]
fn where_voxels_lose_nothing_the_formula_and_the_finest_step_agree() {
    let folder = Folder::new();
    folder.write(
        "scene.toml",
        slab("{ at = -9, color = \"#f00\", opacity = 0 }, { at = 9, color = \"#0f0\", opacity = 0.2 }"),
    );
    let rows = rows(&folder, "cost scene.toml --runs 1 --knob sampling.step");
    assert!(rows["sampling.step"].last().unwrap().max < 1e-12);
}

/// With ever finer steps the error against the formula is what the voxels lose: of order 2 in their distance with the
/// trilinear kernel, whose error is h² f″/8.
#[test]
fn what_fine_steps_leave_is_the_voxels() {
    let folder = Folder::new();
    let left = |size: usize, spacing: f64| {
        let volume =
            format!("phantom = {{ name = \"torus\", size = {size}, spacing = [{spacing}, {spacing}, {spacing}]");
        folder.write(
            "scene.toml",
            format!(
                "drypoint = 1\n[volume]\n{volume}, type = \"f64\", param = {{ w = 3 }} }}\n[sampling]\nreference_length = 1\n\
                 [picture]\nsize = [24, 24]\nsamples = 1\n[transfer]\nkind = \"regular\"\nnodes = [{{ at = 90, color = \"#f80\", \
                 opacity = 0 }}, {{ at = 200, color = \"#08f\", opacity = 0.5 }}]\n"
            ),
        );
        rows(&folder, "cost scene.toml --runs 1 --knob sampling.step")["sampling.step"].last().unwrap().rms
    };
    // The same box: 19 edges of 1, 38 of ½.
    let order = (left(20, 1.0) / left(39, 0.5)).log2();
    assert!((order - 2.0).abs() <= 0.3, "{order}");
}

/// A ring with an edge three voxels wide, and no `[transfer]`.
fn ring(more: &str) -> String {
    format!(
        "drypoint = 1\n[volume]\nphantom = {{ name = \"torus\", size = 32, param = {{ w = 3 }} }}\n\
         [picture]\nsize = [160, 120]\n{more}"
    )
}

/// The light of dots, blurred over 4 S_max: where two lists of random dots cover c, they differ by √(2c)/16. Another order
/// of the points keeps the tone and stays below that; a second and a third layer of voxels change it.
#[test]
fn dots_are_compared_by_their_tone() {
    let folder = Folder::new();
    folder.write(
        "scene.toml",
        ring(
            "[stipples]\nsize = \"2 px\"\nk_max = 0.5\nthreshold = 0.2\n[stipples.silhouette]\nsc = 0.2\nss = 0.8\nse = 1\n",
        ),
    );
    let rows = rows(&folder, "cost scene.toml --runs 1");
    let knobs: Vec<&str> = rows.keys().map(String::as_str).collect();
    assert_eq!(knobs, ["stipples.even", "stipples.gradient", "stipples.order", "stipples.snap", "stipples.thin"]);
    for (knob, rows) in &rows {
        let [coarse, fine] = rows.as_slice() else { panic!("{knob}: {rows:?}") };
        assert_eq!((fine.rms, fine.max, fine.flip), (0.0, 0.0, 0.0), "{knob}: its own truth");
        assert!(coarse.rms > 0.0 && coarse.rms <= coarse.max && coarse.max <= 1.0 && coarse.flip > 0.0, "{coarse:?}");
        for row in rows {
            assert_eq!((row.samples, &row.truth), (0, &format!("finest: {}", fine.setting)), "{knob}");
            assert_eq!(row.angle, None, "{knob}");
            // The volume, 12 bytes a point, and the page.
            assert!(row.seconds > 0.0 && row.bytes > 32 * 32 * 32 + 12 * 1000, "{row:?}");
        }
    }
    let noise = (2.0_f64).sqrt() / 16.0;
    let of = |knob: &str| rows[knob][0].rms;
    assert!(of("stipples.order") < noise, "{}", of("stipples.order"));
    assert!(of("stipples.thin") > noise, "{}", of("stipples.thin"));
    let said = folder.line("cost scene.toml --runs 1 --knob stipples.order -o a.svg -o a.md");
    assert_eq!((said.code, said.err.as_str()), (Some(0), "a.svg\na.md\n"));
    let plot = String::from_utf8(folder.read("a.svg")).unwrap();
    assert!(["stipples.order", "RMS error of tone"].iter().all(|text| plot.contains(text)));
}

/// A chord may leave its stroke by c, and by what hides a stroke that lies a little lower; so each place of most strokes is
/// nearer than c to the finest, whose own c is 0.01.
#[test]
fn strokes_are_compared_by_their_distance() {
    let folder = Folder::new();
    folder.write("scene.toml", ring("[hatching]\n"));
    let line = "cost scene.toml --runs 1 --set volume.phantom.size=20 --set picture.size=[80,60] --knob hatching.chord";
    let rows = rows(&folder, line);
    let chords = &rows["hatching.chord"];
    assert_eq!((rows.len(), chords.len()), (1, 5));
    for row in chords {
        let chord: f64 = row.setting.split(' ').next().unwrap().parse().unwrap();
        assert!(row.rms <= row.max && row.rms <= chord && row.seconds > 0.0 && row.bytes > 20 * 20 * 20, "{row:?}");
    }
    let [coarse, .., fine] = chords.as_slice() else { panic!("{chords:?}") };
    assert!(coarse.rms > 0.05 && coarse.flip > 0.0 && coarse.angle > Some(0.0), "{coarse:?}");
    assert_eq!((fine.rms, fine.max, fine.flip, fine.angle), (0.0, 0.0, 0.0, Some(0.0)));
    let table = folder.good(&format!("{line} -o a.md"));
    assert_eq!(table, "");
    assert!(String::from_utf8(folder.read("a.md")).unwrap().contains("RMS and max of strokes are in voxels."));
}

#[test]
fn suffixes_choose_and_several_files_are_written() {
    let folder = Folder::new();
    folder.write("scene.toml", REGULAR);
    let said = folder.line("cost scene.toml --runs 2 --knob sampling.step -o a.csv -o b.md -o c.svg -o d.PNG");
    assert_eq!((said.code, said.out.as_str(), said.err.as_str()), (Some(0), "", "a.csv\nb.md\nc.svg\nd.PNG\n"));
    let text = |name: &str| String::from_utf8(folder.read(name)).unwrap();
    assert_eq!(text("a.csv").lines().count(), 8);
    assert!(text("b.md").contains("| `sampling.step` | 4 voxels") && text("b.md").contains("**0.5 voxels**"));
    assert!(text("c.svg").starts_with("<svg") && text("c.svg").contains("sampling.step"));
    assert!(folder.read("d.PNG").starts_with(b"\x89PNG"));
}

#[test]
fn what_cannot_be_done_is_told_before_work() {
    let folder = Folder::new();
    folder.write("scene.toml", REGULAR);
    for (line, expected) in [
        (
            "cost scene.toml -o a.csv -o b.pdf",
            "error: .pdf is the suffix of no form that costs are written in\n  at: b.pdf\n  try: give a name that ends in .csv, .md, .svg or .png\n",
        ),
        (
            "cost scene.toml --knob sampling.gradient",
            "error: \"sampling.gradient\" is no knob that the scene uses\n  at: scene.toml\n  try: the knobs of this scene are picture.samples, sampling.step, sampling.kernel, sampling.number, sampling.stop_below, transfer.table\n",
        ),
        (
            "cost scene.toml --runs 0",
            "error: invalid value '0' for '--runs <N>': 0 is not in 1..=1000\n  at: drypoint cost\n  try: `drypoint cost --help` tells what there is\n",
        ),
    ] {
        assert_eq!(folder.refused(line), expected, "{line}");
    }
    let refused = folder.refused("cost scene.toml -o gone/a.csv");
    assert!(refused.contains("gone"), "{refused}");
    assert!(folder.refused("cost gone.toml -o a.csv").contains("gone.toml"));
}

/// Halos have knobs of their own, each by its place in the list: groups of planes, how their seeds come together, and passes
/// where the reach is given.
#[test]
fn halos_are_swept_by_their_places() {
    let folder = Folder::new();
    let halos = "[[halo]]\nevery = 2\n[[halo]]\nkind = \"emissive\"\nfloor = 0\nseed.by = \"curvature\"\n\
                 spread.reach = \"3 px\"\n[[halo]]\nopacity = 0\n";
    folder.write("scene.toml", format!("{REGULAR}{halos}"));
    let rows = rows(&folder, "cost scene.toml --runs 1");
    let halos: Vec<(&str, usize)> = rows
        .iter()
        .filter(|(knob, _)| knob.starts_with("halo"))
        .map(|(knob, rows)| (knob.as_str(), rows.len()))
        .collect();
    let expected =
        [("halo[0].accumulate", 2), ("halo[0].every", 4), ("halo[1].every", 4), ("halo[1].spread.passes", 6)];
    assert_eq!(halos, expected);
    let every = &rows["halo[1].every"];
    assert_eq!(every.iter().map(|row| row.setting.as_str()).collect::<Vec<_>>(), ["8", "4", "2", "1"]);
    for row in every {
        assert_eq!(row.truth, "finest: 1");
        assert_eq!(row.samples, every[0].samples, "groups change no sample: {row:?}");
    }
    // One plane to a group is the truth, and ever larger groups are farther from it.
    assert_eq!((every[3].rms, every[3].max), (0.0, 0.0));
    assert!(every[0].rms > every[2].rms && every[2].rms > 0.0, "{every:?}");
}
