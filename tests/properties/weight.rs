//! The weight of the release libraries: what everybody who builds the program pays for ([benches/runs/build.md]).

use std::path::Path;
use std::time::SystemTime;

/// Megabytes of each library when it was last measured: x86-64 Linux, release, without debug information.
const MEASURED: [(&str, f64); 2] = [("drypoint_reference", 16.3), ("drypoint_scene", 27.6)];

/// The growth that fails.
const GROWTH: f64 = 1.15;

#[test]
fn libraries_stay_light() {
    let test = std::env::current_exe().unwrap();
    let folder = test.parent().unwrap();
    if !cfg!(all(target_os = "linux", target_arch = "x86_64")) || !folder.ends_with("release/deps") {
        println!("skipped: the weights are those of a release build on x86-64 Linux");
        return;
    }
    for (name, measured) in MEASURED {
        let bytes = newest(folder, name);
        let megabytes = bytes as f64 / 1e6;
        assert!(
            megabytes <= GROWTH * measured,
            "lib{name}.rlib has {megabytes:.1} MB, over {measured} MB by more than 15 %: look for code that is compiled for \
             many types (benches/runs/build.md says how)"
        );
    }
}

/// The size of the newest library of a name.
fn newest(folder: &Path, name: &str) -> u64 {
    let is_library = |file: &str| file.starts_with(&format!("lib{name}-")) && file.ends_with(".rlib");
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap());
    let libraries = files.filter(|file| is_library(&file.file_name().to_string_lossy()));
    let dated = libraries.map(|file| file.metadata().unwrap());
    let dated = dated.map(|data| (data.modified().unwrap_or(SystemTime::UNIX_EPOCH), data.len()));
    dated.max().unwrap_or_else(|| panic!("no lib{name}.rlib in {}", folder.display())).1
}
