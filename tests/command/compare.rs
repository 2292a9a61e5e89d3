//! `compare`.

use crate::folder::Folder;
use drypoint::output::read::read_image;
use serde_json::Value;

fn folder() -> Folder {
    let folder = Folder::new();
    folder.scene("");
    folder.good("render scene.toml -o a.png");
    folder.good("render scene.toml --set transfer.nodes[1].opacity=0.3 -o b.png");
    folder.good("render scene.toml --size 8x8 -o small.png");
    folder
}

#[test]
fn exit_code_1_where_a_bound_is_exceeded() {
    let folder = folder();
    for (bounds, code) in [
        ("", 0),
        ("--max 1 --rms 1 --flip 1", 0),
        ("--max 0", 1),
        ("--rms 0", 1),
        ("--flip 0", 1),
        ("--max 1 --flip 1e-9", 1),
    ] {
        assert_eq!(folder.line(&format!("compare a.png b.png {bounds}")).code, Some(code), "{bounds}");
        assert_eq!(folder.line(&format!("compare a.png a.png {bounds}")).code, Some(0), "{bounds}");
    }
    let said = folder.line("compare a.png b.png --max 0 --rms 0");
    assert_eq!(said.err.lines().count(), 2, "each bound that is exceeded: {}", said.err);
    assert!(said.err.starts_with("max ") && said.err.contains(" is over 0e0\nrms "), "{}", said.err);
    assert!(said.out.starts_with("layer ") && said.out.ends_with('\n'));
    assert_eq!(folder.line("-q compare a.png b.png --max 0").err, "");
}

#[test]
fn as_json_and_as_a_picture() {
    let folder = folder();
    let json: Value = serde_json::from_str(&folder.good("compare a.png b.png --json --diff d.png")).unwrap();
    assert_eq!((&json["width"], &json["height"]), (&24.into(), &16.into()));
    for name in ["max", "rms", "flip"] {
        assert!(json[name].as_f64().unwrap() > 0.0, "{name}");
    }
    let difference = read_image(&folder.path("d.png")).unwrap();
    assert_eq!((difference.width, difference.height), (24, 16));
}

#[test]
fn what_cannot_be_compared() {
    let folder = folder();
    for (line, expected) in [
        (
            "a.png small.png --diff d.png",
            "error: the pictures differ in size: 24x16 and 8x8\n  at: a.png and small.png\n  try: render both with the same --size\n",
        ),
        (
            "gone.png scene.toml",
            "error: the picture cannot be read: No such file or directory (os error 2)\n  at: gone.png\n  try: check that the file exists and may be read\n\
             error: neither a PNG nor an EXR file: it begins with the bytes [64, 72, 79, 70, 6f, 69, 6e, 74]\n  at: scene.toml\n  try: convert the picture to PNG or EXR\n",
        ),
        (
            "a.png b.png --max nan",
            "error: invalid value 'nan' for '--max <X>': a bound is a number of at least 0\n  at: drypoint compare\n  try: `drypoint compare --help` tells what there is\n",
        ),
        (
            "a.png b.png --diff d.exr",
            "error: this picture is written as PNG\n  at: d.exr\n  try: give a name that ends in .png\n",
        ),
    ] {
        assert_eq!(folder.refused(&format!("compare {line}")), expected, "{line}");
    }
}
