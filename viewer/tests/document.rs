//! Documents: edits keep everything else, and undo restores every byte.

use drypoint::scene::file::{Overrides, parse};
use drypoint_viewer::document::{Document, Edit};
use drypoint_viewer::key::KeyPath;
use drypoint_viewer::state::State;
use drypoint_viewer::views::SavedView;
use std::time::{Duration, SystemTime};
use toml_edit::{InlineTable, Value};

const TEXT: &str = r##"# A ring, for tests.
drypoint = 1

[volume]
phantom = { name = "torus", size = 24 }   # small

[transfer]   # one boundary
kind = "regular"
nodes = [
  { at = 100, color = "#804020", opacity = 0 },     # outside
  # the surface
  { at = 150, color = "#ffcc88", opacity = 0.9 },
]

[[clip]]
normal = [1, 0, 0]
point = [12, 0, 0]   # the middle
"##;

fn document() -> Document {
    Document::untitled(TEXT.into(), "ring.toml".into())
}

fn key(text: &str) -> KeyPath {
    text.into()
}

/// Every edit changes the lines that it names, and no other byte.
#[test]
fn edits_keep_comments_and_layout() {
    let line = |at: i64| format!("  {{ at = {at}, color = \"#000000\", opacity = 0.5 }},");
    let node = |at: i64| {
        InlineTable::from_iter([("at", Value::from(at)), ("color", "#000000".into()), ("opacity", 0.5.into())])
    };
    let clip =
        || InlineTable::from_iter([("normal", Value::from_iter([0, 1, 0])), ("point", Value::from_iter([0, 5, 0]))]);
    let cases: Vec<(Edit, &str, String)> = vec![
        (Edit::set("volume.phantom.size", 25), "size = 24", "size = 25".into()),
        (Edit::set("volume.phantom.spacing", Value::from_iter([1, 2, 1])), "24 }", "24, spacing = [1, 2, 1] }".into()),
        (Edit::set("transfer.nodes[1].at", 151.5), "at = 150", "at = 151.5".into()),
        (Edit::set("transfer.nodes[0].color", "#ffffff"), "#804020", "#ffffff".into()),
        (Edit::set("clip[0].point", Value::from_iter([11, 0, 0])), "[12, 0, 0]", "[11, 0, 0]".into()),
        (Edit::set("transfer.unit", "value"), "]\n\n[[clip", "]\nunit = \"value\"\n\n[[clip".into()),
        (Edit::remove("clip[0]"), "\n[[clip]]\nnormal = [1, 0, 0]\npoint = [12, 0, 0]   # the middle\n", String::new()),
        (
            Edit::Insert(key("transfer.nodes"), 1, node(120)),
            ",     # outside",
            format!(",     # outside\n{}", line(120)),
        ),
        (
            Edit::remove("transfer.nodes[0]"),
            "\n  { at = 100, color = \"#804020\", opacity = 0 },     # outside",
            String::new(),
        ),
        (
            Edit::remove("transfer.nodes[1]"),
            "\n  # the surface\n  { at = 150, color = \"#ffcc88\", opacity = 0.9 },",
            String::new(),
        ),
        (Edit::Insert(key("transfer.nodes"), 2, node(160)), "0.9 },\n", format!("0.9 }},\n{}\n", line(160))),
        (
            Edit::Insert(key("transfer.nodes"), 0, node(90)),
            "[\n  { at = 100",
            format!("[\n{}\n  {{ at = 100", line(90)),
        ),
        (
            Edit::Insert(key("clip"), 1, clip()),
            "# the middle\n",
            "# the middle\n\n[[clip]]\nnormal = [0, 1, 0]\npoint = [0, 5, 0]\n".into(),
        ),
    ];
    for (edit, from, to) in cases {
        let mut document = document();
        let expected = TEXT.replacen(from, &to, 1);
        document.apply("edit", vec![edit.clone()]).unwrap();
        assert_eq!(document.text(), expected, "{edit:?}");
        assert!(document.scene().is_ok(), "{edit:?}: {}", document.scene().unwrap_err());
        assert!(document.is_changed() && document.undo());
        assert!(document.text() == TEXT && !document.is_changed(), "{edit:?}");
        assert!(document.redo() && document.text() == expected);
    }
}

#[test]
fn a_bad_value_is_the_commands_error_and_can_be_undone() {
    let mut document = document();
    document.set(&key("camera.fov"), 200).unwrap();
    let failures = document.scene().unwrap_err();
    let failure = failures.iter().next().unwrap();
    assert!(failure.place.contains("ring.toml") && failure.place.contains("camera.fov"), "{failure}");
    assert!(document.undo() && document.scene().is_ok());
    // A key inside a value, and an item that is not there, change nothing.
    for wrong in ["transfer.kind.x", "clip[3].point", "transfer.nodes[2]"] {
        assert!(document.set(&key(wrong), 1).is_err(), "{wrong}");
        assert_eq!(document.text(), TEXT);
    }
}

#[test]
fn a_drag_is_undone_as_a_whole() {
    let mut document = document();
    for at in [151, 152, 153] {
        document.set(&key("transfer.nodes[1].at"), at).unwrap();
    }
    document.seal();
    document.set(&key("transfer.nodes[1].at"), 160).unwrap();
    document.undo();
    assert!(document.text().contains("at = 153"));
    document.undo();
    assert_eq!(document.text(), TEXT);
}

#[test]
fn a_file_that_another_program_writes_is_read_anew() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ring.toml");
    std::fs::write(&path, TEXT).unwrap();
    let mut document = Document::open(&path).unwrap();
    document.set(&key("camera.fov"), 20).unwrap();
    document.save().unwrap();
    let ours = document.text().to_owned();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), ours);
    assert!(!document.is_changed() && !document.follow_file().unwrap());
    // Their text is taken, even if it is no TOML, and ours is one step back.
    for theirs in [TEXT, "drypoint = = 1\n", TEXT] {
        std::fs::write(&path, theirs).unwrap();
        let later = SystemTime::now() + Duration::from_secs(document.revision() + 2);
        std::fs::File::options().write(true).open(&path).unwrap().set_modified(later).unwrap();
        assert!(document.follow_file().unwrap());
        assert!(document.text() == theirs && !document.is_changed());
    }
    assert!(document.undo() && document.scene().is_err());
    assert!(document.set(&key("camera.fov"), 20).is_err());
    assert!(document.undo() && document.undo());
    assert!(document.text() == ours && document.is_changed());
}

/// A scene with a path in every table that has one. Some names are like paths and stay.
const PATHS: &str = r##"# All of them.
drypoint = 1

[volume]
file = "head.nrrd"   # the head
labels = "../labels.nrrd"
label_names = "names.csv"

[picture]
background = "sky.png"

[styles]
theme = "mine"
mine = "pictures/wax.png"
other = { file = "pictures/wax.png", linear = true }

[transfer]
kind = "style"
nodes = [{ at = 1, style = "mine", opacity = 0.5 }]

[[object]]
name = "names.csv"
volume = "part.nrrd"
labels = "ids.nrrd"
label_names = "ids.csv"
selection = "mask.nrrd"
transfer = { kind = "regular", over = ["value", { volume = "second.nrrd" }], nodes = [
  { at = [0, 0], color = "#ffffff", opacity = 0 }, { at = [1, 0], color = "#ffffff", opacity = 0.5 },
  { at = [0, 1], color = "#ffffff", opacity = 0 }, { at = [1, 1], color = "#ffffff", opacity = 0.5 },
] }

[[mesh]]
file = "knife.obj"

[[intersection]]
object = "names.csv"
color = "meeting.png"

[[pen]]
name = "black"
tone = "wedge.csv"
"##;

/// A scene that is saved in another folder names the same files, and nothing else of it changes.
#[test]
fn a_scene_that_is_saved_elsewhere_finds_its_files() {
    let folder = tempfile::tempdir().unwrap();
    let [here, there] = ["a/head.toml", "b/head.toml"].map(|path| folder.path().join(path));
    ["a", "b"].iter().for_each(|name| std::fs::create_dir(folder.path().join(name)).unwrap());
    let read = |document: &Document| {
        let scene = parse(document.text(), document.path(), &Overrides::default());
        scene.unwrap_or_else(|faults| panic!("{faults}"))
    };
    let mut document = Document::untitled(PATHS.into(), here.clone());
    let scene = read(&document);
    assert_eq!(scene.files().len(), 15);
    document.save_as(&folder.path().join("a/other.toml")).unwrap();
    assert_eq!(document.text(), PATHS);
    // What cannot be written changes nothing.
    let other = document.path().to_owned();
    assert!(document.save_as(&folder.path().join("none/head.toml")).is_err());
    assert!(document.path() == other && document.text() == PATHS && document.history().next_undo().is_none());
    document.save_as(&there).unwrap();
    assert_eq!(read(&document), scene);
    assert!(document.path() == there && !document.is_changed() && document.text().contains("# the head"));
    assert!(document.text().contains("style = \"mine\"") && document.text().contains("object = \"names.csv\""));
    assert_eq!(std::fs::read_to_string(&there).unwrap(), document.text());
    // Paths of a scene with faults are not known.
    document.set(&key("camera.fov"), 200).unwrap();
    let faulty = document.text().to_owned();
    let failure = document.save_as(&here).unwrap_err();
    assert!(failure.what.contains("paths") && document.path() == there && document.text() == faulty, "{failure}");
    document.save().unwrap();
}

/// A saved view is read back from the window's state, and gives the camera back key by key with the comments beside it.
#[test]
fn a_saved_view_is_taken_back() {
    let folder = tempfile::tempdir().unwrap();
    let mut state = State::read(Some(folder.path().into()));
    let first = format!("{TEXT}\n[camera] # mine\neye = [1, 2, 3] # near\nfov = 20\n");
    let mut document = Document::untitled(first.clone(), "ring.toml".into());
    state.views.push(SavedView::of(&document, "near"));
    state.write();
    let view = State::read(Some(folder.path().into())).views.remove(0);
    assert!(view.name == "near" && view.is_of(&document) && view.replaces(&state.views[0]));
    assert!(!view.replaces(&SavedView::of(&document, "far")));
    assert!(!view.is_of(&Document::untitled(first.clone(), "other.toml".into())));
    document.set(&key("camera.eye"), Value::from_iter([4, 5, 6])).unwrap();
    document.set(&key("camera.up"), Value::from_iter([0, 1, 0])).unwrap();
    document.remove(&key("camera.fov")).unwrap();
    document.apply("take a saved view", view.edits(&document)).unwrap();
    assert_eq!(document.text(), first);
}
