//! Description and struct cannot part: every key that is described is read into the scene and written from it.

use super::samples::SAMPLES;
use super::*;

/// Keys that can have one value only, so far.
const ONE_VALUE: [&str; 2] = ["drypoint", "preset"];

pub(super) fn with(settings: &[(&str, &str)]) -> Result<Scene, Faults> {
    parse(HEAD, Path::new("scene.toml"), &settings.iter().copied().collect())
}

#[test]
fn every_described_key_has_a_sample_and_every_sample_a_key() {
    let described: Vec<String> = every_key().into_iter().map(|(path, _)| path).collect();
    let mut sampled: Vec<&str> = SAMPLES.iter().map(|(key, ..)| *key).chain(ONE_VALUE).collect();
    sampled.sort_unstable();
    let mut expected = described.clone();
    expected.sort_unstable();
    assert_eq!(sampled, expected);
}

#[test]
fn every_key_changes_the_scene_and_is_written_back() {
    for (key, beside, value) in SAMPLES {
        let without = with(beside);
        let all: Vec<_> = beside.iter().copied().chain([(*key, *value)]).collect();
        let changed = with(&all).unwrap_or_else(|faults| panic!("{key}\n{faults}"));
        // Without `width` a `height` is at fault, and the other way round, and a label without what it names: there is no
        // scene to compare with.
        if let Ok(without) = without {
            assert_ne!(changed, without, "{key}");
        } else {
            let names = ["label[0].at", "label[0].pixel", "label[0].object", "label[0].label", "label[0].from"];
            assert!(["picture.width", "picture.height"].contains(key) || names.contains(key), "{key}");
        }
        let full = write_full(&changed);
        let back = parse(&full, Path::new("scene.toml"), &Overrides::default()).unwrap();
        assert_eq!(back, changed, "{key}\n{full}");
    }
}

#[test]
fn every_name_of_every_choice_is_read_and_written_back() {
    let mut names = 0;
    for (path, key) in every_key() {
        for (name, doc) in key.shape.options() {
            let beside = SAMPLES.iter().find(|(key, ..)| *key == path).map_or(&[][..], |(_, beside, _)| *beside);
            // An analytic Hessian is refused with kernels that have none.
            let spline = if name == "analytic" { &[("sampling.kernel", "bspline")][..] } else { &[] };
            let all: Vec<_> = [beside, spline, &[(path.as_str(), name)]].concat();
            let scene = with(&all).unwrap_or_else(|faults| panic!("{faults}"));
            if path != "preset" {
                let line = format!("{} = {name:?}\n", key.name);
                let inline = format!("{} = {name:?}", key.name);
                let full = write_full(&scene);
                assert!(full.contains(&line) || full.contains(&inline), "{path} {name}\n{full}");
            }
            let kebab = name.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-');
            assert!(kebab, "{path}: {name}");
            assert!(doc.ends_with('.'), "{path}: {name}: {doc}");
            names += 1;
        }
    }
    assert!(names > 50, "{names}");
}

#[test]
fn keys_are_snake_case_and_documented() {
    for (path, key) in every_key() {
        assert!(key.name.bytes().all(|b| b.is_ascii_lowercase() || b == b'_'), "{path}");
        assert!(key.doc.ends_with('.'), "{path}: {}", key.doc);
        let says_what_holds = key.required || key.default.is_some() || !key.absent.is_empty();
        assert!(says_what_holds || path.starts_with("transfer.nodes[0]"), "{path} says nothing of its default");
    }
}

#[test]
fn the_reference_page_has_every_key() {
    let page = reference_markdown();
    for (path, key) in every_key() {
        assert!(page.contains(&format!("| `{}` |", key.name)), "{path}");
    }
    // Each row of a table has as many cells as its head.
    for row in page.lines().filter(|line| line.starts_with('|')) {
        assert_eq!(row.replace("\\|", "").matches('|').count(), 7, "{row}");
    }
}
