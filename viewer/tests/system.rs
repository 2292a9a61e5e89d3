//! A window of the system, under Xvfb and driven by events of the keyboard, from opening a scene to the export.
#![cfg(target_os = "linux")]

use drypoint::scene::file::{Overrides, load};
use drypoint_viewer::export::{Outcome, export};
use std::path::Path;
use std::process::Command;
use std::sync::atomic::AtomicBool;

const SCENE: &str = r##"# A ring.
drypoint = 1
[volume]
phantom = { name = "torus", size = 24 }
[picture]
size = [96, 72]
[camera]
direction = [1, 2, -3]   # from above
[transfer]
kind = "regular"
nodes = [{ at = 120, color = "#804020", opacity = 0 }, { at = 150, color = "#ffcc88", opacity = 0.9 }]
[shading]
"##;

/// Turns the picture, saves the scene, exports through the palette, and ends.
const EVENTS: &str = r#"
"$VIEWER" scene.toml --backend reference &
window=$(timeout 60 xdotool search --sync --onlyvisible --name Drypoint | head -n 1)
xdotool windowfocus --sync "$window"
sleep 1
xdotool key Right
sleep 1
xdotool key ctrl+s
sleep 1
xdotool key ctrl+p
sleep 1
xdotool type --delay 40 "$PWD/exported.png"
sleep 1
xdotool key Return
for _ in $(seq 100); do [ -f exported.png ] && break; sleep 0.2; done
xdotool key ctrl+q
wait
"#;

/// Whether a program is there.
fn has(program: &str) -> bool {
    let found = Command::new("sh").args(["-c", &format!("command -v {program}")]).output();
    found.is_ok_and(|found| found.status.success())
}

/// The exported file is that of the saved scene, byte for byte, and the scene has the turned camera and its comments.
#[test]
fn a_scene_is_opened_turned_saved_and_exported() {
    if let Some(missing) = ["xvfb-run", "xdotool"].into_iter().find(|program| !has(program)) {
        return println!("skipped: no {missing}");
    }
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("scene.toml"), SCENE).unwrap();
    let output = Command::new("xvfb-run")
        .args(["-a", "-s", "-screen 0 1440x900x24", "sh", "-c", EVENTS])
        .env("VIEWER", env!("CARGO_BIN_EXE_drypoint-viewer"))
        .env("XDG_STATE_HOME", folder.path())
        .current_dir(folder.path())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    let saved = std::fs::read_to_string(at("scene.toml")).unwrap();
    assert!(saved.contains("# A ring.") && saved.contains("# from above") && saved != SCENE, "{saved}\n{said}");
    let scene = load(&at("scene.toml"), &Overrides::default()).unwrap();
    let written = export(scene, &at("rendered.png"), &|_| (), &AtomicBool::new(false)).unwrap();
    assert_eq!(written, Outcome::Written);
    let read =
        |name: &str| std::fs::read(Path::new(&at(name))).unwrap_or_else(|error| panic!("{name}: {error}\n{said}"));
    assert!(read("exported.png") == read("rendered.png"));
}
