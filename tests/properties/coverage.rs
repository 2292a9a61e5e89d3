//! The random scenes draw every key of a scene file: else the properties hold only of what they happen to draw.

use super::generator::scene;
use drypoint::scene::file::{schema, write_full};
use serde_json::Value as Json;
use std::collections::{BTreeMap, BTreeSet};
use toml::Value;

/// Keys that the generator does not draw, each with why: a key with all below it.
const NOT_DRAWN: [(&str, &str); 26] = [
    ("drypoint", "it has one value"),
    ("preset", "it fills in tables that a drawn scene has itself"),
    ("picture.width", "another word for size, which is drawn"),
    ("picture.height", "another word for size, which is drawn"),
    ("halo", "planes.rs adds halos to drawn scenes"),
    ("hatching", "marks/ draws every key of it"),
    ("object", "tests of the paper draw objects"),
    ("box", "no picture of rays depends on it: tests of output draw it"),
    ("arrow", "no picture of rays depends on it: tests of output draw it"),
    ("fan", "no picture of rays depends on it: tests of output draw it"),
    ("label", "no picture of rays depends on it: tests of output draw it"),
    ("labels", "no picture of rays depends on it: tests of output draw labels"),
    ("scale_bar", "no picture of rays depends on it: tests of output draw it"),
    ("legend", "no picture of rays depends on it: tests of output draw it"),
    ("orientation", "no picture of rays depends on it: tests of output draw it"),
    ("combine", "tests of the paper draw objects"),
    ("intersection", "tests of the paper draw objects"),
    ("mesh", "it names a file: hard cases draw meshes"),
    ("outlines", "marks/ draws every key of them"),
    ("stipples", "marks/ draws every key of them"),
    ("shading.table", "it names a file: presets are drawn"),
    ("styles.*", "it names a file: styles are handed over decoded, themes are drawn"),
    ("volume.box", "voxels are handed over: subset.rs draws it"),
    ("volume.parts", "voxels are handed over: parts.rs draws every key of it"),
    ("volume.stride", "voxels are handed over: subset.rs draws it"),
    ("volume.raw", "the layout of a file: voxels are handed over, of every type"),
];

/// The names of colours, each of which stands for numbers, which are drawn and written.
const COLORS: [&str; 3] = [".color = ", ".tones[][] = ", ".cap = "];

/// What there is to draw: keys such as `camera.fov`, `transfer.nodes[].at` and `styles.*`, and for keys that are one of
/// some names `sampling.kernel = bspline`.
pub(super) fn described(path: &str, schema: &Json, all: &mut BTreeSet<String>) {
    let below = |name: &str| if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
    let list = |key: &str| schema[key].as_array().map(Vec::as_slice).unwrap_or_default();
    for (name, property) in schema["properties"].as_object().into_iter().flatten() {
        all.insert(below(name));
        described(&below(name), property, all);
    }
    if schema["additionalProperties"].is_object() {
        all.insert(below("*"));
    }
    for alternative in list("anyOf").iter().chain(list("oneOf")) {
        described(path, alternative, all);
    }
    if schema["items"].is_object() {
        described(&format!("{path}[]"), &schema["items"], all);
    }
    let names = list("enum").iter().chain(schema.get("const"));
    all.extend(names.filter_map(Json::as_str).map(|name| format!("{path} = {name}")));
}

/// The keys of a scene with their values, and the names that they are.
pub(super) fn drawn(path: &str, value: &Value, described: &BTreeSet<String>, all: &mut Vec<(String, String)>) {
    match value {
        Value::Table(table) => {
            for (name, value) in table {
                let named = if path.is_empty() { name.clone() } else { format!("{path}.{name}") };
                let known = described.contains(&named);
                let path = if known { named } else { format!("{path}.*") };
                all.push((path.clone(), value.to_string()));
                drawn(&path, value, described, all);
            }
        }
        Value::Array(items) => items.iter().for_each(|item| drawn(&format!("{path}[]"), item, described, all)),
        Value::String(name) => all.push((format!("{path} = {name}"), String::new())),
        _ => {}
    }
}

/// A key is drawn if it has two values over all scenes, where being absent is one; a name, if some scene has it.
#[test]
fn every_key_is_drawn() {
    const SCENES: u64 = 2000;
    let mut keys = BTreeSet::new();
    described("", &schema(), &mut keys);
    let excluded = |key: &str| {
        let below = |(not, _): &(&str, &str)| {
            key.strip_prefix(not).is_some_and(|rest| !rest.starts_with(char::is_alphanumeric))
        };
        NOT_DRAWN.iter().any(below) || COLORS.iter().any(|color| key.contains(color))
    };
    for (not, _) in NOT_DRAWN {
        assert!(keys.contains(not), "{not} is no key");
    }
    let mut found: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    let mut scenes_with: BTreeMap<String, u64> = BTreeMap::new();
    for seed in 0..SCENES {
        let table: toml::Table = write_full(&scene(seed).scene).parse().unwrap();
        let mut all = Vec::new();
        drawn("", &Value::Table(table), &keys, &mut all);
        let present: BTreeSet<String> = all.iter().map(|(key, _)| key.clone()).collect();
        present.into_iter().for_each(|key| *scenes_with.entry(key).or_default() += 1);
        all.into_iter().for_each(|(key, value)| {
            found.entry(key).or_default().insert(value);
        });
    }
    let is_drawn = |key: &&String| {
        let (values, scenes) = (found.get(*key).map_or(0, BTreeSet::len), scenes_with.get(*key).copied().unwrap_or(0));
        if key.contains(" = ") { scenes > 0 } else { values > 1 || values == 1 && scenes < SCENES }
    };
    let wanted: Vec<&String> = keys.iter().filter(|key| !excluded(key)).collect();
    let missing: Vec<&&String> = wanted.iter().filter(|key| !is_drawn(key)).collect();
    let share = 100.0 * (wanted.len() - missing.len()) as f64 / wanted.len() as f64;
    println!("{} of {} keys and names are drawn: {share:.1} %", wanted.len() - missing.len(), wanted.len());
    for (not, why) in NOT_DRAWN {
        println!("not drawn: {not}: {why}");
    }
    assert!(missing.is_empty(), "never drawn, or always the same: {missing:?}");
    assert!(wanted.len() > 150, "{}", wanted.len());
}
