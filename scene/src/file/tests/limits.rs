//! Lists, tables and texts of any length are read, or refused with their number, in a time that grows with the length.

use super::drift::with;
use super::samples::SAMPLES;
use super::*;
use crate::plan::Plan;
use serde_json::Value;
use std::fmt::Write;
use std::sync::LazyLock;
use std::time::{Duration, Instant};

/// Entries of a list, and letters of a text, that no scene needs.
const MANY: usize = 100_001;

/// The longest time that a scene may take without a word.
const LONGEST: Duration = Duration::from_secs(20);

/// The time of this thread on a processor, which other programs do not lengthen; where the system does not tell it, the
/// time since the first call.
fn on_processor() -> Duration {
    static FIRST: LazyLock<Instant> = LazyLock::new(Instant::now);
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    told.split(' ').next().and_then(|ns| ns.parse().ok()).map_or_else(|| FIRST.elapsed(), Duration::from_nanos)
}

/// What is said of a scene: its plan, or its faults.
fn said(what: &str, read: impl FnOnce() -> Result<Scene, Faults>) -> String {
    let began = on_processor();
    let said = match read() {
        Ok(scene) => Plan::new(&scene).to_string(),
        Err(faults) => {
            let count = faults.iter().count();
            assert!(count <= 101, "{what}: {count} faults");
            faults.to_string()
        }
    };
    let took = on_processor() - began;
    assert!(took < LONGEST, "{what}: {took:?}");
    said
}

/// What is said of a scene in which a key of the samples has a value.
fn said_with(key: &str, value: &str) -> String {
    let beside = SAMPLES.iter().find(|(sample, ..)| *sample == key).map_or(&[][..], |(_, beside, _)| *beside);
    said(key, || with(&[beside, &[(key, value)]].concat()))
}

/// The most items, if a schema takes a list of any length.
fn most_items(schema: &Value) -> Option<usize> {
    let all = schema["anyOf"].as_array().into_iter().flatten();
    let mut lists = all.chain([schema]).filter(|schema| schema["type"] == "array");
    let list = lists.find(|list| list["minItems"] != list["maxItems"])?;
    Some(list["maxItems"].as_u64().unwrap_or_else(|| panic!("a list without a limit: {list}")) as usize)
}

/// A list of `n` items like the first of a sample. Items with names have different ones.
fn list(sample: &str, n: usize) -> String {
    let mut depth = 0;
    let is_end = |c: char| {
        depth += i32::from("[{".contains(c)) - i32::from("]}".contains(c));
        depth < 0 || c == ',' && depth == 0
    };
    let items = sample.strip_prefix('[').unwrap_or("1]");
    let item = items.split_once(is_end).map_or(items, |(item, _)| item);
    let (before, after) = item.split_once("name = \"").unwrap_or((item, ""));
    let mut all = String::from("[");
    for i in 0..n {
        let name = if after.is_empty() { String::new() } else { format!("name = \"{i} {after}") };
        write!(all, "{before}{name}, ").unwrap();
    }
    all + "]"
}

#[test]
fn every_list_has_a_limit_and_a_refusal_names_it() {
    let mut lists = 0;
    for (path, key) in every_key() {
        let Some(most) = most_items(&key.shape.schema()) else { continue };
        let sample = SAMPLES.iter().find(|(key, ..)| *key == path).map_or("", |(.., value)| *value);
        assert!(most < MANY, "{path}");
        let refused = said_with(&path, &list(sample, MANY));
        assert!(refused.contains(&format!("{path} has {MANY} entries, and {most} are the most\n")), "{refused:.300}");
        assert!(refused.contains(&format!("\n  write at most {most}")), "{refused:.300}");
        let full = said_with(&path, &list(sample, most));
        assert!(!full.contains(" entries, and "), "{full:.300}");
        lists += 1;
    }
    assert!(lists >= 20, "{lists}");
}

#[test]
fn every_table_of_names_has_a_limit() {
    let tables = || every_key().into_iter().filter_map(|(path, key)| Some((path, key.shape.section()?)));
    let mut open = 0;
    for (path, table) in tables() {
        let Some(names) = table.open else { continue };
        for value in ["1", "\"a.png\""] {
            let mut all = String::from("{");
            (0..MANY).for_each(|i| write!(all, "k{i} = {value}, ").unwrap());
            all.replace_range(all.len() - 2.., "}");
            let refused = said_with(&path, &all);
            let told = format!("{path} has {MANY} entries, and {} are the most\n", names.most);
            assert!(refused.contains(&told), "{refused:.300}");
        }
        open += 1;
    }
    assert!(open >= 3, "{open}");
}

#[test]
fn texts_of_any_length_are_read_or_refused() {
    let text = format!("\"{}\"", "é".repeat(MANY));
    for (path, _) in every_key() {
        said_with(&path, &text);
    }
    // Two names that differ in their last letters.
    let [one, other] = ["a", "b"].map(|end| "x".repeat(MANY) + end);
    let styles = format!("[styles]\n{one} = \"a.png\"\n[transfer]\nnodes = [{{ at = 1, style = \"{other}\" }}]\n");
    assert!(said("styles", || parse(&format!("{HEAD}{styles}"), Path::new("s"), &Overrides::default())).len() > MANY);
    assert!(said_with("surface.color", &format!("\"{}\"", "é".repeat(10 * MANY))).contains("surface.color cannot be"));
}

#[test]
fn the_first_table_too_many_is_told_and_of_many_faults_the_first() {
    let tables = |text: &str, n| {
        said(text, || parse(&(HEAD.to_owned() + &text.repeat(n)), Path::new("s"), &Overrides::default()))
    };
    assert_eq!(
        tables("[[object]]\n", MANY),
        "object has 100001 entries, and 256 are the most\n  at s:260:1, key object\n  write at most 256"
    );
    let mut keys = String::new();
    (0..MANY).for_each(|i| writeln!(keys, "k{i} = 1").unwrap());
    let told = tables(&format!("[camera]\n{keys}"), 1);
    assert!(told.ends_with("\nthere are 99901 more faults\n  at s\n  correct those above first"), "{told:.300}");
    // All on one line.
    let clips = format!("clip = [{}]\n", "{ point = [1, 2, 3], normal = [1, 0, 0] }, ".repeat(MANY));
    let told = said("one line", || parse(&(clips + HEAD), Path::new("s"), &Overrides::default()));
    assert!(told.starts_with("clip has 100001 entries, and 256 are the most\n  at s:1:11017, key clip\n"), "{told}");
}

#[test]
fn a_text_of_any_length_is_no_scene() {
    let told = said("a long text", || parse(&"#".repeat(LONGEST_TEXT + 1), Path::new("s"), &Overrides::default()));
    assert!(told.starts_with("the scene cannot be read: it has 16777217 bytes, and at most 16777216 are read\n"));
}

/// Every part asks for itself, and has a look of its own.
#[test]
fn a_scene_of_many_parts_is_planned() {
    let mut text = String::from(HEAD);
    text += "[transfer]\nnodes = [";
    (0..1000).for_each(|i| write!(text, "{{ at = {i}, style = \"wax\" }}, ").unwrap());
    text += "]\n";
    for i in 0..128 {
        writeln!(text, "[[object]]\nmove = [1, 0, 0]\n[object.shading]\n[[halo]]\n[[pen]]\nname = \"{i}\"").unwrap();
        writeln!(text, "[[intersection]]\nobject = \"object {i}\"\n[[mesh]]\nfile = \"a.ply\"").unwrap();
        writeln!(text, "[[clip]]\npoint = [1, 2, 3]\nnormal = [1, 0, 0]\napplies = [\"object {i}\"]").unwrap();
    }
    let plan = said("many parts", || parse(&text, Path::new("s"), &Overrides::default()));
    assert!(plan.contains("object 127 ghost") && plan.contains("intersection 127"), "{plan:.300}");
}
