//! What parts of the program must never know (docs/architecture.md), read off their sources.

use std::path::{Path, PathBuf};

/// The sources of a folder, without their tests.
fn sources(folder: &str) -> Vec<(PathBuf, String)> {
    fn walk(folder: &Path, found: &mut Vec<(PathBuf, String)>) {
        let mut entries: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
        entries.sort();
        for path in entries {
            let name = path.file_stem().unwrap().to_string_lossy().into_owned();
            if path.is_dir() && name != "tests" {
                walk(&path, found);
            } else if path.extension().is_some_and(|suffix| suffix == "rs") && name != "tests" {
                let text = std::fs::read_to_string(&path).unwrap();
                let code = text.split("\n#[cfg(test)]\nmod ").next().unwrap().to_owned();
                found.push((path, code));
            }
        }
    }
    let mut found = Vec::new();
    walk(&Path::new(env!("CARGO_MANIFEST_DIR")).join(folder), &mut found);
    assert!(!found.is_empty(), "{folder}");
    found
}

/// Lines of code, comments apart, of a folder that have one of some words.
fn lines_with(folder: &str, words: &[&str]) -> Vec<String> {
    let of_file = |(path, code): (PathBuf, String)| {
        let lines = code.lines().map(str::trim).filter(|line| !line.starts_with("//"));
        let lines = lines.filter(|line| words.iter().any(|word| line.contains(word)));
        lines.map(|line| format!("{}: {line}", path.display())).collect::<Vec<_>>()
    };
    sources(folder).into_iter().flat_map(of_file).collect()
}

#[test]
fn the_reference_opens_no_file() {
    assert_eq!(lines_with("reference/src", &["std::fs", "File::", "OpenOptions"]), [""; 0]);
}

#[test]
fn the_files_of_a_scene_are_opened_by_its_source() {
    let mut found = lines_with("scene/src", &["fs::", "File::open", "OpenOptions"]);
    found.retain(|line| !["source.rs", "atomic.rs"].iter().any(|file| line.contains(file)));
    assert_eq!(found, [""; 0]);
}

/// A clock of `std::time` panics in wasm32-unknown-unknown.
#[test]
fn no_crate_below_src_reads_a_clock() {
    for crate_below in ["scene/src", "reference/src", "gpu/src", "output/src"] {
        assert_eq!(lines_with(crate_below, &["Instant", "SystemTime"]), [""; 0]);
    }
}

#[test]
fn output_knows_no_volume() {
    assert_eq!(lines_with("output/src", &["scene::volume", "scene::phantom", "scene::transfer"]), [""; 0]);
}

#[test]
fn rays_and_marks_read_no_table_of_a_scene() {
    let rooms = [
        "field",
        "interactive_volume_illustration",
        "mesh",
        "ray",
        "style_transfer_functions",
        "surface",
        "transfer",
        "volume_stippling",
        "volumetric_halos",
    ];
    for room in rooms {
        let words = ["scene::tables", "scene::plan", "scene::file"];
        assert_eq!(lines_with(&format!("reference/src/{room}"), &words), [""; 0]);
    }
}

#[test]
fn scene_and_output_and_reference_know_none_above_them() {
    assert_eq!(lines_with("scene/src", &["drypoint_reference", "drypoint_output", "drypoint::"]), [""; 0]);
    assert_eq!(lines_with("output/src", &["drypoint_reference", "drypoint::"]), [""; 0]);
    assert_eq!(lines_with("reference/src", &["drypoint_output", "drypoint::"]), [""; 0]);
}

#[test]
fn graphics_cards_read_the_shot_and_decide_no_meaning() {
    let words = ["scene::tables", "scene::plan", "scene::file", "drypoint_reference", "drypoint_output", "drypoint::"];
    assert_eq!(lines_with("gpu/src", &words), [""; 0]);
}

#[test]
fn a_paper_imports_no_other_paper() {
    let papers = [
        "style_transfer_functions",
        "volume_stippling",
        "interactive_volume_illustration",
        "volumetric_halos",
        "volumeshop",
    ];
    for paper in papers {
        let others: Vec<String> =
            papers.iter().filter(|other| **other != paper).map(|other| format!("crate::{other}")).collect();
        let others: Vec<&str> = others.iter().map(String::as_str).collect();
        assert_eq!(lines_with(&format!("reference/src/{paper}"), &others), [""; 0]);
    }
}

/// The share of what is laid behind, (1 − A)·α, is formed in one place: for numbers and lanes, and for numbers with bounds.
#[test]
fn there_is_one_over() {
    let words = ["- self.opacity", "- front.opacity", "1.0 - a)", "1.0 - a;", "ONE - a", "() - self)", "(1.0) - self)"];
    let found = lines_with("reference/src", &words);
    let is_own =
        |line: &str| ["accumulator.rs", "number/arithmetic.rs", "number/bounded.rs"].iter().any(|f| line.contains(f));
    let weights: Vec<&String> = found.iter().filter(|line| !is_own(line)).collect();
    assert_eq!(weights, [""; 0] as [&str; 0]);
    assert_eq!(found.len(), 4, "over, its bound, its end, and the background: {found:?}");
}
