//! `--stats` ([PLAN-2]).

use crate::folder::Folder;
use serde_json::Value;

/// Every count of the contract.
const NUMBERS: [&str; 16] = [
    "samples",
    "gradients",
    "hessians",
    "style_lookups",
    "halo_samples",
    "halo_passes",
    "rays",
    "refined_pixels",
    "rays_skipped",
    "without_normal",
    "masked",
    "points",
    "parts",
    "parts_kept",
    "strokes",
    "directions",
];
const OBJECTS: [&str; 4] = ["stops", "preprocess", "bytes", "seconds"];
const LISTS: [&str; 1] = ["part_sizes"];

fn stats(folder: &Folder, more: &str) -> Value {
    let out = folder.good(&format!("render scene.toml --stats {more}"));
    assert_eq!(out.lines().count(), 1, "one object, alone");
    serde_json::from_str(&out).unwrap()
}

#[test]
fn every_count_is_there_and_nothing_else() {
    let folder = Folder::new();
    folder.scene("[contours]\n");
    let stats = stats(&folder, "");
    let mut names: Vec<&str> = stats.as_object().unwrap().keys().map(String::as_str).collect();
    let mut expected: Vec<&str> = NUMBERS.into_iter().chain(OBJECTS).chain(LISTS).collect();
    names.sort_unstable();
    expected.sort_unstable();
    assert_eq!(names, expected);
    assert!(NUMBERS.iter().all(|name| stats[name].is_u64()));
    for name in ["halo_samples", "halo_passes", "points", "strokes", "directions", "hessians", "masked"] {
        assert_eq!(stats[name], 0, "{name}");
    }
    let refined = stats["refined_pixels"].as_u64().unwrap();
    assert!(refined > 0);
    // Four or eight further rays.
    let further = stats["rays"].as_u64().unwrap() - 24 * 16;
    assert!(further.is_multiple_of(4) && (4 * refined..=8 * refined).contains(&further), "{further} {refined}");
    assert_eq!(stats["bytes"]["volume"], 20 * 20 * 20);
    assert_eq!(stats["bytes"]["picture"], 4 * 8 * 24 * 16);
    assert_eq!(stats["preprocess"]["gradients"], 20 * 20 * 20);
    for pass in ["load", "prepare", "rays", "write"] {
        assert!(stats["seconds"][pass].as_f64().unwrap() >= 0.0, "{pass}");
    }
}

#[test]
fn what_was_not_done_is_zero() {
    let folder = Folder::new();
    folder.scene("");
    let nodes = "--set transfer.nodes=[{at=90,color=\"red\",opacity=0},{at=160,color=\"red\"}]";
    let stats = stats(&folder, &format!("--set transfer.kind=regular {nodes}"));
    for name in ["gradients", "hessians", "style_lookups", "without_normal"] {
        assert_eq!(stats[name], 0, "{name}");
    }
    assert_eq!([&stats["preprocess"]["gradients"], &stats["preprocess"]["differences"]], [0, 0]);
    assert!(stats["samples"].as_u64().unwrap() > 0);
}

#[test]
fn what_is_looked_at_for_an_automatic_function_is_counted() {
    let folder = Folder::new();
    folder.torus();
    folder.write("scene.toml", "drypoint = 1\nvolume.file = \"torus.nrrd\"\npicture.size = [8, 8]\n");
    assert_eq!(stats(&folder, "")["preprocess"]["differences"], 24 * 24 * 24);
    // A bare volume's function is found before its scene is made.
    let bare = folder.good("render torus.nrrd --size 8x8 --stats -o a.png");
    assert_eq!(serde_json::from_str::<Value>(&bare).unwrap()["preprocess"]["differences"], 24 * 24 * 24);
    // Labels have no boundary to look for.
    folder.good("-q phantom shepp-logan --size 24 --type u8 -o labels.nrrd");
    let labels = folder.good("render labels.nrrd --size 8x8 --stats -o a.png");
    assert_eq!(serde_json::from_str::<Value>(&labels).unwrap()["preprocess"]["differences"], 0);
}

#[test]
fn repeated_frames_are_timed() {
    let folder = Folder::new();
    folder.scene("");
    let once = stats(&folder, "");
    let thrice = stats(&folder, "--repeat 3");
    assert_eq!(thrice["samples"], once["samples"], "counts are those of one frame");
    let number = |name: &str| thrice[name].as_f64().unwrap();
    assert!(0.0 < number("min_s") && number("min_s") <= number("median_s"));
    assert_eq!(number("samples_M"), once["samples"].as_f64().unwrap() / 1e6);
    if cfg!(target_os = "linux") {
        assert!(number("cpu_s") >= 0.0);
    }
    assert!(once.get("median_s").is_none());
}

#[test]
fn verbose_says_what_was_loaded_planned_and_counted_but_not_on_standard_output() {
    let folder = Folder::new();
    folder.scene("");
    let said = folder.line("-v scene.toml");
    assert_eq!(said.out, "");
    let lines: Vec<&str> = said.err.lines().collect();
    assert_eq!(lines[0], "phantom torus: 20 × 20 × 20 voxels, u8");
    assert!(lines.iter().any(|line| line.starts_with("styles ") && line.ends_with("transfer.kind (line 6)")));
    assert!(lines.contains(&"scene.png"));
    assert!(serde_json::from_str::<Value>(lines.last().unwrap()).unwrap()["samples"].is_u64());
    // No bar, and nothing that moves the cursor, where nobody watches.
    assert!(said.err.chars().all(|c| !c.is_control() || c == '\n'));
}
