//! `data/README.md`: the checksums of volumes, and that it names every volume of the scenes; `CITATION.cff`: its version.

use drypoint::scene::file::data_folders;
use drypoint::scene::volume::read::EXTENSIONS;
use sha2::{Digest, Sha256};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Reads a file of the repository.
fn read(file: &str) -> String {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(file);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Files of the page with their checksums: rows of `| file | 64 digits |`.
fn checksums() -> BTreeMap<String, String> {
    let page = read("data/README.md");
    let row = |line: &str| -> Option<(String, String)> {
        let mut cells = line.trim_matches('|').split('|').map(|cell| cell.trim().trim_matches('`').to_owned());
        let (file, sum, None) = (cells.next()?, cells.next()?, cells.next()) else { return None };
        (sum.len() == 64 && sum.chars().all(|c| c.is_ascii_hexdigit())).then_some((file, sum))
    };
    page.lines().filter_map(row).collect()
}

/// Adds the volumes and tables that a scene's text names.
fn named(value: &toml::Value, found: &mut Vec<String>) {
    match value {
        toml::Value::String(text) => {
            let is_volume = EXTENSIONS.iter().any(|suffix| text.ends_with(&format!(".{suffix}")));
            if is_volume || text.ends_with(".csv") {
                found.push(text.clone());
            }
        }
        toml::Value::Array(items) => items.iter().for_each(|item| named(item, found)),
        toml::Value::Table(table) => table.values().for_each(|item| named(item, found)),
        _ => {}
    }
}

#[test]
fn volumes_have_the_checksums_of_the_page() {
    let sums = checksums();
    assert!(sums.len() > 30, "{}", sums.len());
    for (file, expected) in sums {
        let Some(path) = data_folders().into_iter().map(|folder| folder.join(&file)).find(|path| path.is_file()) else {
            println!("skipped: no data ({file})");
            continue;
        };
        let digest = Sha256::digest(std::fs::read(&path).unwrap());
        let found: String = digest.iter().map(|byte| format!("{byte:02x}")).collect();
        assert_eq!(found, expected, "{}", path.display());
    }
}

/// A raw file's header names its voxels, which have a checksum, too.
#[test]
fn every_volume_of_a_scene_is_on_the_page() {
    fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
        for entry in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
            if entry.is_dir() {
                walk(&entry, found);
            } else if entry.extension().is_some_and(|suffix| suffix == "toml") {
                found.push(entry);
            }
        }
    }
    let (sums, mut scenes) = (checksums(), Vec::new());
    walk(&Path::new(env!("CARGO_MANIFEST_DIR")).join("data"), &mut scenes);
    let mut count = 0;
    for scene in scenes {
        let mut files = Vec::new();
        named(&toml::Value::Table(std::fs::read_to_string(&scene).unwrap().parse().unwrap()), &mut files);
        count += files.len();
        for file in files {
            assert!(sums.contains_key(&file), "{}: data/README.md has no {file}", scene.display());
            if let Some(stem) = file.strip_suffix(".nhdr") {
                assert!(sums.contains_key(&format!("{stem}.raw.gz")), "{stem}.raw.gz");
            }
        }
    }
    assert!(count > 50, "{count}");
}

#[test]
fn the_citation_is_of_this_version() {
    let version = format!("\nversion: {}\n", env!("CARGO_PKG_VERSION"));
    assert!(read("CITATION.cff").contains(&version), "CITATION.cff needs {version:?}");
}
